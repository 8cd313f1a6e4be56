// SPDX-License-Identifier: MIT
// One hostile file through every command. What must hold: no crash, no leak, no report of a sanitizer; and a run that
// fails leaves nothing behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tspace/asset.h"
#include "tspace/check.h"
#include "tspace/identify.h"

namespace tspace::fuzz {

/// A folder in memory where there is one.
inline std::filesystem::path makeFolder() {
    std::error_code failed;
    const std::filesystem::path shm = "/dev/shm";
    const std::filesystem::path base =
        std::filesystem::is_directory(shm, failed) ? shm : std::filesystem::temp_directory_path();
    std::string name = (base / "tspace_fuzz_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    return name;
}

inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: this does not hold: %s\n", what);
    std::abort();
}

inline void runOnFile(const std::uint8_t* bytes, std::size_t count, const char* name) {
    static const std::filesystem::path folder = makeFolder();
    static const std::string input = (folder / name).string();
    const std::filesystem::path out_folder = folder / "out";
    const std::string output = (out_folder / "out.glb").string();
    std::FILE* file = std::fopen(input.c_str(), "wb");
    const bool written = file != nullptr && (count == 0 || std::fwrite(bytes, 1, count, file) == count);
    require(written && std::fclose(file) == 0, "a file can be written");

    GenerateOptions options{.all = true};
    options.existing = ExistingTangents::replace;
    options.execution.thread_count = 1;
    const Result<GenerateReport> report = generateFile(input, output, options);
    std::error_code ignored;
    require(report.ok() == std::filesystem::exists(output, ignored),
            "there is an output exactly when the run succeeds");
    if (report) {
        GenerateOptions again = options;
        again.existing = ExistingTangents::keep;
        require(generateFile(output, (out_folder / "again.glb").string(), again).ok(), "what was written can be read");
    } else {
        require(!report.error().message.empty(), "an error has a message");
        require(!std::filesystem::exists(out_folder, ignored), "a failed run leaves nothing behind");
    }
    std::filesystem::remove_all(out_folder, ignored);
    (void)inspectFile(input);
    (void)checkFile(input);
    (void)identifyFile(input, {.execution = {.thread_count = 1}});
}

}  // namespace tspace::fuzz
