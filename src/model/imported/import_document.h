// SPDX-License-Identifier: MIT
// Files of other formats, by the program tspace-import.
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

// Runs the importer as a child process with limits. It leaves no files behind, however it or this program ends.

struct ImportLimits {
    std::uint64_t memory_bytes = 0;       ///< address space; the result cannot be larger
    std::uint32_t processor_seconds = 0;  ///< processor time
    std::uint32_t seconds = 0;            ///< on the clock
    bool reads_anywhere = false;          ///< may read files outside of the model's folder
};

enum class ImportEnd {
    done,
    refused,     ///< it exited with an error; `messages` says why
    crashed,     ///< ended by a signal
    outOfTime,   ///< stopped
    outOfSpace,  ///< stopped: the result is larger than its memory can be
};

struct ImportResult {
    ImportEnd end = ImportEnd::done;
    Bytes glb = {};
    std::string messages = {};  ///< lines; at most 64 KiB of them
};

/// Runs `program` on a file. `keep_coordinates`: as in FileOptions. `tick` is called twenty times per second; an exception
/// from it kills the child and is passed on. Fails with unsupportedFile where the program cannot be started.
ImportResult runImporter(const std::string& program, const std::string& path, bool keep_coordinates,
                         const ImportLimits& limits, const std::function<void()>& tick);

// Formats that tspace-import, a program of its own, converts to GLB.

/// True for the extensions of formats that tspace reads through the importer (.fbx, .ply, .stl, .dae, .3ds, ...).
bool isImportedFormat(const Path& path);

/// Runs the importer on the file, with limits on memory and time, and parses what it wrote. `path` and `folder` are
/// those of the file. `progress` is called while the importer works, and may end it by throwing. Fails with
/// unsupportedFile when there is no importer; with invalidFile when it cannot read the file, crashes, or passes a limit.
gltf::Document importDocument(const Path& path, const FileOptions& options, const Progress& progress = {});

}  // namespace tspace
