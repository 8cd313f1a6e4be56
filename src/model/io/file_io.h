// SPDX-License-Identifier: MIT
// Reading of whole files, and file identity.
#pragma once

#include <string>
#include <string_view>

#include "model/io/bytes.h"
#include "model/io/path.h"
#include "tspace/execution.h"

namespace tspace {

/// Reads a regular file; a large one with all threads. Fails with cannotRead, or with invalidFile if `place` (the
/// model's reference to the file) is not empty.
Bytes readFile(const Path& path, const std::string& place = {}, const Execution& execution = {.thread_count = 1});

/// Returns whether the path exists; false if this cannot be determined.
bool isThere(const Path& path);
bool isFolder(const Path& path);

/// Returns whether both paths refer to the same existing file.
bool isOneFile(const Path& a, const Path& b);
/// Returns a string that is equal for all names of a file, which need not exist yet.
std::string identityOf(const Path& path);
/// Returns whether both paths refer to the same file, which need not exist yet.
bool isSameFile(const Path& a, const Path& b);

/// Returns the file that `uri` refers to in a folder on the disk. Fails like checkedPathOfUri; with forbiddenPath if a
/// symbolic link leaves `folder`, unless `allow_external`; and with invalidFile if no file can have that name, for
/// example because it is too long.
Path resolveUri(const Path& folder, std::string_view uri, bool allow_external, const std::string& place);

/// Returns the size in bytes; 0 if the file does not exist.
std::uint64_t fileSize(const Path& path);

/// Returns the path of `file` relative to `folder`, with slashes; empty if the file is elsewhere.
std::string pathBelow(const Path& folder, const Path& file);

/// Returns whether a model written to this path is a GLB: if isGlbName(), or if it is a stream (kindOf()) whose name
/// does not end in .gltf.
bool isGlbOutput(const Path& path);

}  // namespace tspace
