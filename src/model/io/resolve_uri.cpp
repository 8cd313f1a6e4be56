// SPDX-License-Identifier: MIT
// Paths on the disk, where links lead anywhere.
#include <filesystem>
#include <system_error>

#include "model/io/disk_paths.h"
#include "model/io/file_error.h"
#include "model/io/folder_rule.h"
#include "model/io/system_files.h"
#include "model/io/uri.h"

namespace tspace {

namespace fs = std::filesystem;

Path resolveUri(const Path& in_folder, std::string_view uri, bool allow_external, const std::string& place) {
    const fs::path folder = in_folder, relative{Path(checkedPathOfUri(uri, allow_external, place))};
    const fs::path root = canonicalPath(in_folder);
    fs::path file;
    try {
        file = canonicalPath(root / relative);
    } catch (const fs::filesystem_error& failure) {
        // A name that is longer than names may be, links in a circle.
        failFile(ErrorCode::invalidFile,
                 "the URI " + inQuotes(uri, 200) + " can be no file: " + failure.code().message(), place);
    }
    if (!allow_external && !isBelow(root, file)) {
        refuseUri(uri, "leads out of the model's folder by a symbolic link", place);
    }
    return folder / relative;
}

std::uint64_t fileSize(const Path& path) {
    std::error_code no_file;
    const std::uintmax_t size = fs::file_size(fs::path(path), no_file);
    return no_file ? 0 : size;
}

bool isGlbOutput(const Path& path) {
    return isGlbName(path) || (kindOf(path) == PathKind::stream && lowerExtension(path) != ".gltf");
}

std::string pathBelow(const Path& folder, const Path& file) {
    const fs::path root = canonicalPath(folder);
    const fs::path relative = fs::path(canonicalPath(file)).lexically_relative(root);
    return relative.empty() || *relative.begin() == ".." ? "" : Path(relative).string();
}

}  // namespace tspace
