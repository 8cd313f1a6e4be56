// SPDX-License-Identifier: MIT
// Whole files in and out of memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tspace {

using Bytes = std::vector<std::uint8_t>;

/// Reads a regular file. Fails with cannotRead; with invalidFile when `place` says where a model names it.
Bytes readFile(const std::filesystem::path& path, const std::string& place = {});

/// The folder that a file lies in; "." for a bare name.
std::filesystem::path folderOf(const std::filesystem::path& file);

/// True when both paths name the same existing file, or are the same path where nothing exists yet.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// The extension in lower case with its dot, or "".
std::string lowerExtension(const std::filesystem::path& path);

}  // namespace tspace
