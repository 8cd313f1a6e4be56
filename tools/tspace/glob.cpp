// SPDX-License-Identifier: MIT
// One name of the pattern after the other, over sorted folders.
#include "glob.h"

#include <algorithm>
#include <set>

#include "model/io/path.h"
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

std::vector<fs::directory_entry> entriesOf(const fs::path& folder) {
    std::error_code failed;
    std::vector<fs::directory_entry> entries;
    fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, failed);
    for (; !failed && entry != fs::directory_iterator(); entry.increment(failed)) entries.push_back(*entry);
    return entries;
}

/// Adds the files below `folder` that match the names from `first` on. Recursion is as deep as the folders are.
void match(const fs::path& folder, const Names& names, std::size_t first, std::set<fs::path>& found) {
    const bool is_last = first + 1 == names.size();
    const bool is_any_depth = names[first] == "**" && !is_last;
    if (is_any_depth) match(folder, names, first + 1, found);
    for (const fs::directory_entry& entry : entriesOf(folder)) {
        const fs::path path = folder / entry.path().filename();
        const std::string name = Path(path.filename()).string();
        std::error_code ignored;
        if (is_any_depth) {
            // Links to folders could lead in a circle.
            if (name.front() != '.' && entry.is_directory(ignored) && !entry.is_symlink(ignored))
                match(path, names, first, found);
        } else if (matchesName(names[first], name)) {
            if (!is_last) {
                if (entry.is_directory(ignored)) match(path, names, first + 1, found);
            } else if (entry.is_regular_file(ignored)) {
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
