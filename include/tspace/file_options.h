// SPDX-License-Identifier: MIT
// How model files are opened, and the temporary files that killed runs leave. CMake target tspace::asset.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "tspace/result.h"

namespace tspace {

inline constexpr std::uint64_t kNoMemoryLimit = ~std::uint64_t{0};

/// Gives the bytes of a file that a model in memory names. `path` is relative to the model: escapes of the URI decoded, with
/// slashes. The bytes must stay as they are until the call that asks is over. cannotRead: there is no such file; any other
/// error ends the call. Called from the thread of the call, and perhaps more than once for a file.
using FindFile = std::function<Result<std::span<const std::uint8_t>>(const std::string& path)>;

/// How files are opened.
struct FileOptions {
    /// URIs in a model may lead only to files in its own folder (and below). true: anywhere.
    bool allow_external = false;
    /// Path of tspace-import, the program that reads .fbx, .ply, .stl, .dae, .3ds and others; empty: such files are
    /// refused. It runs as a process of its own, so that a crash or a runaway there is an error here (invalidFile).
    std::string importer = {};
    /// Files of more bytes are not given to the importer. The default is 2 GiB.
    std::uint64_t import_max_file_bytes = std::uint64_t{2} << 30;
    /// Address space of the importer, in bytes; a file gets 192 MiB and 256 times its size at most.
    std::uint64_t import_max_memory_bytes = std::uint64_t{16} << 30;
    /// Time limit of the importer: processor time in seconds, and twice that in wall-clock time. 0: 2 s, and 1 s more per MiB
    /// of the file.
    std::uint32_t import_max_seconds = 0;
    /// What working on one file may take of memory, about; what it would take is estimated first, and more is
    /// refused (tooLarge). 0: 64 MB, and 16 times the bytes of the file, of those it names, and of what its
    /// compressed geometry unpacks to. Other values stand for that, and for import_max_memory_bytes;
    /// kNoMemoryLimit: as much as there is.
    std::uint64_t memory_limit_bytes = 0;
    /// The model itself, where it is not in a file: GLB, glTF, or OBJ where the path, which is only what it is called,
    /// ends in .obj. Read during the call only. It has no folder: files that it names come from `find_file`.
    std::span<const std::uint8_t> content = {};
    /// Gives the files that `content` names; only those in the model's own folder (and below), unless `allow_external`.
    /// Without it they are an error (invalidFile) where they are needed.
    FindFile find_file = {};
    /// Told the path of each file that is read, at once, and of each image on the disk that a glTF names, read or not. Perhaps
    /// called by several threads at one time.
    std::function<void(const std::string& path)> opened = {};
    /// Told of the images that a glTF names, in the place of `opened`, where it is there: they need not be read.
    std::function<void(const std::string& path)> named = {};
    /// A written file is on the disk, and not in its cache alone, before it takes its name: after a power cut the old file is
    /// there or the new one, and never half of one. false: for many small files, where that takes most of the time.
    bool sync = true;
    /// OBJ, PLY and STL: coordinates so far from the origin (metres of a map) that 32-bit floats would not hold the shape are
    /// read in double, and an offset is taken out of them before they become floats. In glTF it is the translation of the
    /// nodes. true: no offset; the shape then loses what floats lose, and a warning says so.
    bool keep_coordinates = false;
};

/// Removes the temporary files that killed runs of any call that writes left in a folder, and below it where that is asked
/// for. Their names tell which process on which machine made them; only those of processes of this machine that are gone are
/// removed. A file that such a run had set aside comes back where its place is empty. Returns how many files it was. What
/// cannot be read or removed is passed over. Linear in the number of files there; thread-safe.
std::uint64_t removeAbandonedFiles(const std::string& folder, bool with_folders_below = true);

}  // namespace tspace
