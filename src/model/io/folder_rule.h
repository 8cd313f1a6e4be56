// SPDX-License-Identifier: MIT
// Rule for the files that a model may reference: those in its folder and below. It applies to URIs of glTF and OBJ
// (uri.h) and to names in other formats: tspace-import includes this header without linking the model library.
#pragma once

#include <algorithm>
#include <filesystem>

namespace tspace {

/// Returns whether a path starts with a Windows drive and a separator ("C:/"), on any system.
inline bool startsAtDrive(const std::filesystem::path& path) {
    const std::filesystem::path::string_type& text = path.native();
    if (text.size() < 3 || text[1] != ':' || (text[2] != '/' && text[2] != '\\')) return false;
    return (text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z');
}

/// Returns why a path in a model is rejected, or null if it stays below the folder, as "textures/../n.png" does.
inline const char* leadsAway(const std::filesystem::path& relative) {
    // On Windows a path may start at a root, or in a folder of a drive, without being absolute.
    if (relative.has_root_path() || startsAtDrive(relative)) return "is an absolute path";
    const std::filesystem::path normal = relative.lexically_normal();
    return !normal.empty() && *normal.begin() == ".." ? "leads outside the folder of the model" : nullptr;
}

/// Returns whether `path` is `folder` or below it. Both must be without links and "..".
inline bool isBelow(const std::filesystem::path& folder, const std::filesystem::path& path) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace tspace
