// SPDX-License-Identifier: MIT
// Which files a model may name: those in its folder and below. One rule for the URIs of glTF and OBJ (uri.h) and for the
// names in other formats: tspace-import includes this header without linking the model wing.
#pragma once

#include <algorithm>
#include <filesystem>

namespace tspace {

/// Whether a path begins with a drive of Windows and a separator, on any system: "C:/".
inline bool startsAtDrive(const std::filesystem::path& path) {
    const std::filesystem::path::string_type& text = path.native();
    if (text.size() < 3 || text[1] != ':' || (text[2] != '/' && text[2] != '\\')) return false;
    return (text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z');
}

/// Why a path as a model spells it is refused; null when its text stays below the folder, as "textures/../n.png" does.
inline const char* leadsAway(const std::filesystem::path& relative) {
    // On Windows a path may begin at a root, or in a folder of a drive, and not be absolute.
    if (relative.has_root_path() || startsAtDrive(relative)) return "is an absolute path";
    const std::filesystem::path normal = relative.lexically_normal();
    return !normal.empty() && *normal.begin() == ".." ? "leads out of the model's folder" : nullptr;
}

/// Whether `path` is `folder` or below it. Both must be without links and "..".
inline bool isBelow(const std::filesystem::path& folder, const std::filesystem::path& path) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace tspace
