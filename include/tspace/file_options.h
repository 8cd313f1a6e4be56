// SPDX-License-Identifier: MIT
// Options for reading model files, and removal of temporary files that killed runs left behind. CMake target
// tspace::asset.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "tspace/result.h"

namespace tspace {

inline constexpr std::uint64_t kNoMemoryLimit = ~std::uint64_t{0};

/// Returns the bytes of a file that a model in memory refers to. `path` is relative to the model, with URI escapes
/// decoded and slashes as separators. The bytes must stay valid until the calling function returns. Return cannotRead
/// if the file does not exist; any other error ends the call. Called from the thread of the call, possibly repeatedly
/// for one file.
using FindFile = std::function<Result<std::span<const std::uint8_t>>(const std::string& path)>;

/// Options for reading files.
struct FileOptions {
    /// true: URIs in a model may refer to any file. false: only to files in the model's folder and below.
    bool allow_external = false;
    /// Path of tspace-import, the program that reads .fbx, .ply, .stl, .dae, .3ds and others; empty: such files are
    /// rejected. It runs in a separate process, so that a crash or an endless loop of the importer only causes an error
    /// (invalidFile).
    std::string importer = {};
    /// Maximum size of a file for the importer, in bytes. Default: 2 GiB.
    std::uint64_t import_max_file_bytes = std::uint64_t{2} << 30;
    /// Maximum address space of the importer, in bytes; the limit for a file is at most 192 MiB plus 256 times its
    /// size.
    std::uint64_t import_max_memory_bytes = std::uint64_t{16} << 30;
    /// Time limit of the importer in seconds, for processor time and for wall-clock time. 0: 2 s plus 1 s per MiB of
    /// the file for processor time, and ten times that for wall-clock time.
    std::uint32_t import_max_seconds = 0;
    /// Approximate memory limit per file. The need is estimated first; more than the limit is rejected (tooLarge). 0:
    /// 64 MB plus 16 times the bytes of the file, of the files it refers to, and of its unpacked geometry. Other values
    /// replace both that limit and import_max_memory_bytes; kNoMemoryLimit: unlimited.
    std::uint64_t memory_limit_bytes = 0;
    /// The model itself, if it is in memory: GLB, glTF, or OBJ if the path (used only as its name) ends in .obj. Read
    /// during the call only. It has no folder: `find_file` provides the files that it refers to.
    std::span<const std::uint8_t> content = {};
    /// Provides the files that `content` refers to, restricted to the model's folder and below unless `allow_external`.
    /// Without it, a required reference is an error (invalidFile).
    FindFile find_file = {};
    /// Called with the path of each file at the time when it is read, and of each image on disk that a glTF refers to,
    /// whether or not it is read. May be called by several threads at the same time.
    std::function<void(const std::string& path)> opened = {};
    /// If set, called instead of `opened` with the path of each image that a glTF references, whether or not the image
    /// is read.
    std::function<void(const std::string& path)> named = {};
    /// true: flush a written file to disk before it is renamed to its final name, so that after a power failure either
    /// the complete old file or the complete new file exists. false: faster for many small files.
    bool sync = true;
    /// OBJ, PLY and STL: if coordinates are so far from the origin (meters of a map) that 32-bit floats would lose the
    /// shape, they are read as doubles, and an offset is subtracted before the conversion to float. In glTF the offset
    /// becomes the translation of the nodes. true: no offset; the precision is lost, and a warning reports it.
    bool keep_coordinates = false;
};

/// Removes temporary files that killed runs of any writing call left in a folder and, on request, in its subfolders.
/// Their names identify process and machine; only files of terminated processes of this machine are removed. A file
/// that such a run had set aside is restored if its original path is free. Files that cannot be read or removed are
/// skipped. Returns the number of files. Linear in the number of files in the folders; thread-safe.
std::uint64_t removeAbandonedFiles(const std::string& folder, bool with_folders_below = true);

}  // namespace tspace
