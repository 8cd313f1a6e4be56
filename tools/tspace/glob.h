// SPDX-License-Identifier: MIT
// Patterns for file names, for shells that do not expand them, and for lists that are too long for a command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tspace::tool {

/// Returns whether the text contains *, ? or [.
bool isPattern(const std::string& text);

/// Returns the longest leading folder of a pattern without a wildcard; "." if there is none. All results are below it.
std::filesystem::path patternRoot(const std::string& pattern);

/// Returns the matching files, sorted by name. *, ? and [...] match within one path component and do not match a
/// leading dot; a component ** matches any number of folders, including none, except hidden ones.
std::vector<std::filesystem::path> matchPattern(const std::string& pattern);

}  // namespace tspace::tool
