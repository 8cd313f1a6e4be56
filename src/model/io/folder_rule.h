// SPDX-License-Identifier: MIT
// Which files a model may name: those in its folder and below. One rule for the URIs of glTF and OBJ (uri.h) and for the
// names in other formats: tspace-import includes this header without linking the model wing.
#pragma once

#include <algorithm>
#include <filesystem>

namespace tspace {

/// Why a path as a model spells it is refused; null when its text stays below the folder.
inline const char* leadsAway(const std::filesystem::path& relative) {
    // On Windows a path may begin at a root, or in a folder of a drive, and not be absolute.
    if (relative.has_root_path()) return "is an absolute path";
    const bool goes_up = std::find(relative.begin(), relative.end(), std::filesystem::path("..")) != relative.end();
    return goes_up ? "leads out of the model's folder" : nullptr;
}

/// Whether `path` is `folder` or below it. Both must be without links and "..".
inline bool isBelow(const std::filesystem::path& folder, const std::filesystem::path& path) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace tspace
