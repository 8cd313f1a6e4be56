// SPDX-License-Identifier: MIT
// Matches a pattern one path component after the other, in sorted folders.
#include "glob.h"

#include <algorithm>
#include <set>

#include "model/io/path.h"
#include "model/io/system_files.h"
#include "system.h"

namespace tspace::tool {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

Names namesOf(const fs::path& path) {
    Names names;
    for (const fs::path& name : path) {
        if (!name.empty()) names.push_back(Path(name).string());
    }
    return names;
}

/// Adds the files below `folder` that match the components from `first` on. The recursion is as deep as the folders.
void match(const fs::path& folder, const Names& names, std::size_t first, std::set<fs::path>& found) {
    const bool is_last = first + 1 == names.size();
    const bool is_any_depth = names[first] == "**" && !is_last;
    if (is_any_depth) match(folder, names, first + 1, found);
    std::vector<FolderEntry> entries;
    listFolder(folder.empty() ? Path(".") : Path(folder), entries);
    for (const FolderEntry& entry : entries) {
        const fs::path path = folder / fs::path(Path(entry.name));
        if (is_any_depth) {
            // Links to folders are not followed, because they could form a cycle.
            if (entry.name.front() != '.' && entry.kind == PathKind::folder && !entry.is_link)
                match(path, names, first, found);
        } else if (matchesName(names[first], entry.name)) {
            if (!is_last) {
                if (entry.kind == PathKind::folder) match(path, names, first + 1, found);
            } else if (entry.kind == PathKind::file) {
                found.insert(path);
            }
        }
    }
}

}  // namespace

bool isPattern(const std::string& text) { return text.find_first_of("*?[") != std::string::npos; }

fs::path patternRoot(const std::string& pattern) {
    fs::path root;
    for (const fs::path& name : fs::path(Path(pattern))) {
        if (isPattern(Path(name).string())) break;
        root /= name;
    }
    return root.empty() ? fs::path(".") : root;
}

std::vector<fs::path> matchPattern(const std::string& pattern) {
    const fs::path root = patternRoot(pattern);
    const bool has_root = root != fs::path(".") || pattern.starts_with("./");
    const Names names = namesOf(has_root ? fs::path(Path(pattern)).lexically_relative(root) : fs::path(Path(pattern)));
    std::set<fs::path> found;
    if (!names.empty()) match(has_root ? root : fs::path(), names, 0, found);
    return {found.begin(), found.end()};
}

}  // namespace tspace::tool
