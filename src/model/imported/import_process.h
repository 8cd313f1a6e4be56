// SPDX-License-Identifier: MIT
// The importer as a child process: its limits, its end, and what it wrote. It leaves no file behind, whatever ends it or
// this program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/io/file_io.h"

namespace tspace {

struct ImportLimits {
    std::uint64_t memory_bytes = 0;       ///< address space; the result cannot be larger
    std::uint32_t processor_seconds = 0;  ///< processor time
    std::uint32_t seconds = 0;            ///< on the clock
    bool reads_anywhere = false;          ///< also files outside of the model's folder
};

enum class ImportEnd {
    done,
    refused,     ///< it ended by itself; `messages` says why
    crashed,     ///< ended by a signal
    outOfTime,   ///< stopped
    outOfSpace,  ///< stopped: the result is larger than its memory can be
};

struct ImportResult {
    ImportEnd end = ImportEnd::done;
    Bytes glb = {};
    std::string messages = {};  ///< lines; at most 64 KiB of them
};

/// Runs `program` on a file, with its result and its messages in pipes. `keep_coordinates` as in FileOptions. `tick` is called
/// twenty times a second; what it throws ends the child. Fails with unsupportedFile where the program cannot be started.
ImportResult runImporter(const std::string& program, const std::string& path, bool keep_coordinates,
                         const ImportLimits& limits, const std::function<void()>& tick);

}  // namespace tspace
