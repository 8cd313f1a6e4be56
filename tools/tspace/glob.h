// SPDX-License-Identifier: MIT
// Patterns for file names, where the shell does not expand them, or where the list would be too long for a command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tspace::tool {

/// true when the text has *, ? or [.
bool isPattern(const std::string& text);

/// The longest leading folder of a pattern that has no wildcard; "." for none. Results lie below it.
std::filesystem::path patternRoot(const std::string& pattern);

/// Files that match, in the order of their names. *, ? and [...] stay inside one name and do not match a leading dot; a
/// whole name ** matches any number of folders, none too, but for hidden ones.
std::vector<std::filesystem::path> matchPattern(const std::string& pattern);

}  // namespace tspace::tool
