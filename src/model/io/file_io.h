// SPDX-License-Identifier: MIT
// Whole files in and out of memory.
#pragma once

#include <string>
#include <string_view>

#include "model/io/bytes.h"
#include "model/io/path.h"
#include "tspace/execution.h"

namespace tspace {

/// Reads a regular file, a large one with all threads. Fails with cannotRead, or with invalidFile when `place` (where a
/// model names the file) is not empty.
Bytes readFile(const Path& path, const std::string& place = {}, const Execution& execution = {.thread_count = 1});

/// Whether the path exists; false where the system cannot tell.
bool isThere(const Path& path);
bool isFolder(const Path& path);

/// True when both paths name the same existing file.
bool isOneFile(const Path& a, const Path& b);
/// Equal for all names of a file, which need not exist yet.
std::string identityOf(const Path& path);
/// True when both paths name the same existing file, or are the same path where nothing exists yet.
bool isSameFile(const Path& a, const Path& b);

/// The file that `uri` names in a folder on the disk. Fails as checkedPathOfUri, and with forbiddenPath when a symbolic
/// link leads out of `folder`, unless `allow_external`; with invalidFile where no file can have that name, as one that is
/// longer than the system takes.
Path resolveUri(const Path& folder, std::string_view uri, bool allow_external, const std::string& place);

/// In bytes; 0 where there is no such file.
std::uint64_t fileSize(const Path& path);

/// The path of `file` relative to `folder`, with slashes; empty where it lies elsewhere.
std::string pathBelow(const Path& folder, const Path& file);

/// Whether a model written to this path is a GLB: isGlbName(), or a stream (kindOf()) that is not called .gltf.
bool isGlbOutput(const Path& path);

}  // namespace tspace
