// SPDX-License-Identifier: MIT
// Reads files of other formats with the program tspace-import.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/io/file_io.h"
#include "model/io/path.h"
#include "tspace/callbacks.h"
#include "tspace/file_options.h"

namespace tspace {

// Runs the importer as a child process with limits. It leaves no files behind, regardless of how it or this program
// ends.

struct ImportLimits {
    std::uint64_t memory_bytes = 0;       ///< address space; the result cannot be larger
    std::uint32_t processor_seconds = 0;  ///< limit of processor time, in seconds
    std::uint32_t seconds = 0;            ///< limit of wall-clock time, in seconds
    bool reads_anywhere = false;          ///< may read files outside the model's folder
};

enum class ImportEnd {
    done,
    refused,             ///< exited with an error; `messages` contains the reason
    crashed,             ///< terminated by a signal
    outOfProcessorTime,  ///< stopped: limit of processor time exceeded
    outOfTime,           ///< stopped: limit of wall-clock time exceeded
    outOfSpace,          ///< stopped: the result exceeds its memory limit
};

struct ImportResult {
    ImportEnd end = ImportEnd::done;
    Bytes glb = {};
    std::string messages = {};  ///< text output, at most 64 KiB
};

/// Runs `program` on a file. `keep_coordinates`: see FileOptions. `tick` is called 20 times per second; an exception
/// from it kills the child and is passed on. Fails with unsupportedFile if the program cannot be started.
ImportResult runImporter(const std::string& program, const std::string& path, bool keep_coordinates,
                         const ImportLimits& limits, const std::function<void()>& tick);

// Formats that the separate program tspace-import converts to GLB.

/// Returns whether tspace reads this file extension through the importer (.fbx, .ply, .stl, .dae, .3ds, ...).
bool isImportedFormat(const Path& path);

/// Runs the importer on the file, with limits on memory and time, and parses its output. `progress` is called while the
/// importer works, and may stop it by throwing. Fails with unsupportedFile if there is no importer; with invalidFile if
/// it cannot read the file, crashes, or exceeds a limit.
gltf::Document importDocument(const Path& path, const FileOptions& options, const Progress& progress = {});

}  // namespace tspace
