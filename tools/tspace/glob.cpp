// SPDX-License-Identifier: MIT
// One name of the pattern after the other, over sorted folders.
#include "glob.h"

#include <fnmatch.h>

#include <algorithm>
#include <set>

namespace tspace::tool {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

Names namesOf(const fs::path& path) {
    Names names;
    for (const fs::path& name : path) {
        if (!name.empty()) names.push_back(name.string());
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

/// Adds what matches the names from `first` on below `folder`. As deep as the folders are.
void match(const fs::path& folder, const Names& names, std::size_t first, std::set<fs::path>& found) {
    const bool is_last = first + 1 == names.size();
    const bool is_any_depth = names[first] == "**" && !is_last;
    if (is_any_depth) match(folder, names, first + 1, found);
    for (const fs::directory_entry& entry : entriesOf(folder)) {
        const std::string name = entry.path().filename().string();
        const fs::path path = folder / name;
        std::error_code ignored;
        if (is_any_depth) {
            // Links to folders could lead in a circle.
            if (name.front() != '.' && entry.is_directory(ignored) && !entry.is_symlink(ignored))
                match(path, names, first, found);
        } else if (fnmatch(names[first].c_str(), name.c_str(), FNM_PERIOD) == 0) {
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
    for (const fs::path& name : fs::path(pattern)) {
        if (isPattern(name.string())) break;
        root /= name;
    }
    return root.empty() ? fs::path(".") : root;
}

std::vector<fs::path> matchPattern(const std::string& pattern) {
    const fs::path root = patternRoot(pattern);
    const bool has_root = root != fs::path(".") || pattern.starts_with("./");
    const Names names = namesOf(has_root ? fs::path(pattern).lexically_relative(root) : fs::path(pattern));
    std::set<fs::path> found;
    if (!names.empty()) match(has_root ? root : fs::path(), names, 0, found);
    return {found.begin(), found.end()};
}

}  // namespace tspace::tool
