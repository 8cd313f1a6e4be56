// SPDX-License-Identifier: MIT
// The importer on corrupt files: files collected by other projects, renamed to all formats, and damaged files of the
// importer's own formats. Each file gives a model or an error, and uses no more memory than its size allows.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>

#include "support/scene_file.h"
#include "support/shared_data.h"
#include "tspace/inspect.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

namespace fs = std::filesystem;

/// One file name extension for each parser.
constexpr const char* kExtensions[] = {".3ds", ".ac",   ".b3d", ".blend", ".dae", ".dxf", ".fbx",
                                       ".lwo", ".ms3d", ".off", ".ply",   ".smd", ".stl", ".x"};

/// Reads the file with the importer, as tspace does.
void expectModelOrError(const std::string& path, const std::string& from) {
    const Result<Inspection> result = inspectFile(path, {.importer = TSPACE_IMPORTER});
    if (result) return;
    EXPECT_EQ(result.error().code, ErrorCode::invalidFile) << from << ": " << result.error().message;
    EXPECT_EQ(std::count(result.error().message.begin(), result.error().message.end(), '\n'), 0) << from;
}

/// Checks the peak memory of the importers that this process has run. The limit of a small file is 192 MiB of address
/// space.
void expectLittleMemory() {
#ifndef TSPACE_SANITIZED  // with sanitizers the importer has no such limit
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_LT(usage.ru_maxrss, 200 << 10) << "KiB";
#endif
}

TEST(ImportBadFiles, OfOtherProjectsUnderAnyNameGiveModelsOrErrors) {
    const fs::path folder = shared("bad");
    if (!fs::is_directory(folder)) GTEST_SKIP() << folder << " is missing";
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        constexpr std::uintmax_t kSmall = 100'000;
        const bool is_text = entry.path().extension() == ".json" || entry.path().extension() == ".md";
        if (entry.is_regular_file() && !is_text && entry.file_size() <= kSmall) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    ASSERT_GT(files.size(), 400U);
    const TempFolder copies;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string own = files[i].extension().string();
        const bool is_own = own == ".ply" || own == ".off" || own == ".dae";
        const std::string copy = copies.path("bad" + (is_own ? own : kExtensions[i % std::size(kExtensions)])).string();
        fs::copy_file(files[i], copy, fs::copy_options::overwrite_existing);
        expectModelOrError(copy, files[i].string());
        fs::remove(copy);
    }
    expectLittleMemory();
}

TEST(ImportBadFiles, OfItsOwnFormatsGiveModelsOrErrors) {
    const TempFolder folder;
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(writeModel(folder, "sheet.glb", {bentSheet(4)}), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    std::uint32_t random = 1;
    const auto next = [&random](std::size_t end) {
        random = random * 1664525U + 1013904223U;
        return (random >> 8) % end;
    };
    for (const auto& [format, extension] : {std::pair("fbxa", "fbx"),
                                            {"fbx", "fbx"},
                                            {"collada", "dae"},
                                            {"ply", "ply"},
                                            {"plyb", "ply"},
                                            {"stlb", "stl"},
                                            {"3ds", "3ds"},
                                            {"x", "x"}}) {
        const std::string name = std::string("sheet.") + extension;
        Assimp::Exporter exporter;
        ASSERT_EQ(exporter.Export(scene, format, folder.path(name).string()), AI_SUCCESS) << format;
        const std::string good = folder.read(name);
        ASSERT_FALSE(good.empty()) << format;
        for (int round = 0; round < 20; ++round) {
            std::string bad = good;
            if (round % 4 == 0) bad.resize(next(bad.size()));
            for (int i = 0; i <= round && !bad.empty(); ++i) bad[next(bad.size())] = static_cast<char>(next(256));
            expectModelOrError(folder.write(name, bad), std::string(format) + " " + std::to_string(round));
        }
    }
    expectLittleMemory();
}

}  // namespace
}  // namespace tspace::test
