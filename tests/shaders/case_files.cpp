// SPDX-License-Identifier: MIT
// case_files write FOLDER FRAMES: writes the cases as N.case, for programs in other languages. case_files compare
// FOLDER FRAMES: checks the results of these programs, LANGUAGE.N.results (little-endian floats). The exit status is 1
// if any result is wrong, or if all results of a language are missing.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "cases.h"

namespace {

using tspace::shaders::Case;

std::string pathOf(const std::string& folder, const std::string& language, std::uint32_t number, const char* ending) {
    return folder + "/" + language + std::to_string(number) + ending;
}

bool writeCase(const std::string& folder, const Case& c) {
    std::ofstream file(pathOf(folder, "", c.number, ".case"), std::ios::binary);
    file.write(reinterpret_cast<const char*>(c.buffer.data()), static_cast<std::streamsize>(4 * c.buffer.size()));
    return file.good();
}

std::vector<float> readResults(const std::string& folder, const std::string& language, std::uint32_t number) {
    std::ifstream file(pathOf(folder, language + ".", number, ".results"), std::ios::binary);
    std::vector<float> results;
    for (float value = 0; file.read(reinterpret_cast<char*>(&value), sizeof value);) results.push_back(value);
    return results;
}

bool compare(const Case& c, const std::string& language, const std::vector<float>& results) {
    const std::string wrong = tspace::shaders::whatIsWrong(c, results);
    std::printf("%s: %s: %zu items, differences up to %.3g\n", language.c_str(), c.name.c_str(), c.count(),
                tspace::shaders::worstDifference(c, results));
    if (!wrong.empty()) std::printf("FAILED %s: %s\n", language.c_str(), wrong.c_str());
    return wrong.empty();
}

/// Compares frames of pixels. They must equal the first items of frameOfSteps, with a wider bound, because they are
/// computed from rounded derivatives.
bool comparePixels(Case c, const std::vector<float>& results) {
    if (results.size() > c.expected.size()) return false;
    c.expected.resize(results.size());
    c.bound *= 10;
    return compare(c, "pixel", results);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() != 3) return 2;
    const bool is_write = arguments[0] == "write";
    const std::string& folder = arguments[1];
    const std::size_t frames = std::strtoull(arguments[2].c_str(), nullptr, 10);
    const bool has_wgsl = !is_write && !readResults(folder, "wgsl", 0).empty();
    constexpr std::uint32_t kStepsCase = 14;
    bool is_right = true;
    for (std::uint32_t number = 0; number < tspace::shaders::caseCount(); ++number) {
        const Case c = tspace::shaders::makeCase(number, frames);
        if (is_write) {
            is_right = writeCase(folder, c) && is_right;
            continue;
        }
        is_right = compare(c, "gles", readResults(folder, "gles", number)) && is_right;
        if (has_wgsl) is_right = compare(c, "wgsl", readResults(folder, "wgsl", number)) && is_right;
        if (number == kStepsCase) is_right = comparePixels(c, readResults(folder, "pixel", number)) && is_right;
    }
    return is_right ? 0 : 1;
}
