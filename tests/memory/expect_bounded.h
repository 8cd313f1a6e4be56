// SPDX-License-Identifier: MIT
// Tests of the memory limit: a command uses at most 16 times the size of its files, plus 64 MB.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "measured_run.h"
#include "support/temp_folder.h"

namespace tspace::test {

constexpr std::uint64_t kCeilingBase = std::uint64_t{64} << 20;
constexpr std::uint64_t kCeilingRatio = 16;

/// Returns the total size of the model and the files that it references.
inline std::uint64_t bytesOf(const std::vector<std::filesystem::path>& files) {
    std::uint64_t sum = 0;
    for (const std::filesystem::path& file : files) sum += std::filesystem::file_size(file);
    return sum;
}

/// Runs every command on `model`. Each one must end soon, with success or with one line of message, and stay below the
/// limit for files of `file_bytes`. Returns the number of commands that rejected the model.
inline int expectBounded(const std::filesystem::path& model, std::uint64_t file_bytes,
                         const std::vector<std::string>& more_options = {}) {
    // Work proportional to a declared size would take hours. 40 s were measured on virtual machines on which fresh
    // pages are expensive.
    constexpr double kMostSeconds = 100;
    const TempFolder scratch;
    const std::string out = scratch.path(model.extension() == ".gltf" ? "out/out.gltf" : "out/out.glb").string();
    std::filesystem::create_directory(scratch.path("out"));
    const std::uint64_t ceiling = kCeilingRatio * file_bytes + kCeilingBase;
    int refused = 0;
    for (const std::string command : {"generate", "check", "identify", "inspect"}) {
        std::vector<std::string> arguments = {command};
        if (command == "generate") {
            arguments.insert(arguments.end(), {"--all", "--overwrite", "-o", out});
            arguments.insert(arguments.end(), more_options.begin(), more_options.end());
        }
        arguments.push_back(model.string());
        const MeasuredRun run = runMeasured(arguments, scratch.path("messages"));
        const std::string message = scratch.read("messages");
        const std::string what = command + " " + model.filename().string() + ": " + message.substr(0, 300);
        EXPECT_LE(run.peak_bytes, ceiling)
            << what << " (" << (run.peak_bytes >> 20) << " MiB of " << (ceiling >> 20) << ")";
        EXPECT_LT(run.processor_seconds, kMostSeconds) << what;
        const bool is_known_end =
            run.exit_code == 0 || run.exit_code == 3 || (run.exit_code == 1 && command == "check");
        EXPECT_TRUE(is_known_end) << what << " (exit code " << run.exit_code << ")";
        if (run.exit_code == 3) {
            ++refused;
            EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << what;
        }
        if (command != "generate") continue;
        EXPECT_EQ(scratch.files("out").empty(), run.exit_code != 0) << what;
    }
    return refused;
}

}  // namespace tspace::test
