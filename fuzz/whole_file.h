// SPDX-License-Identifier: MIT
// Runs every command on a hostile file. Requirements: no crash, no leak, no sanitizer report; and a failed run leaves
// no files behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "files.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"
#include "tspace/result.h"

namespace tspace::fuzz {

inline void runOnFile(const std::uint8_t* bytes, std::size_t count, const char* name, const FileOptions& how = {}) {
    static const std::filesystem::path folder = makeFolder();
    static const std::string input = (folder / name).string();
    const std::filesystem::path out_folder = folder / "out";
    const std::string output = (out_folder / "out.glb").string();
    writeFile(input, {bytes, count});

    GenerateOptions options{.selection = {.all = true}};
    options.selection.existing = ExistingTangents::replace;
    options.execution.thread_count = 1;
    options.file = how;
    const Result<GenerateReport> report = generateFile(input, output, options);
    std::error_code ignored;
    require(report.ok() == std::filesystem::exists(output, ignored),
            "there is an output exactly when the run succeeds");
    if (report) {
        GenerateOptions again = options;
        again.selection.existing = ExistingTangents::keep;
        require(generateFile(output, (out_folder / "again.glb").string(), again).ok(), "what was written can be read");
    } else {
        require(!report.error().message.empty(), "an error has a message");
        require(!std::filesystem::exists(out_folder, ignored), "a failed run leaves nothing behind");
    }
    std::filesystem::remove_all(out_folder, ignored);
    (void)inspectFile(input, how);
    (void)checkFile(input, {.file = how});
    (void)identifyFile(input, {.file = how, .execution = {.thread_count = 1}});
}

}  // namespace tspace::fuzz
