// SPDX-License-Identifier: MIT
// Models of the shared test data, as parameters for tests.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "model/io/file_io.h"
#include "support/shared_data.h"

namespace tspace::test {

/// Returns the .glb and .gltf files below a folder of the shared data, as sorted relative paths. If the folder is
/// absent, returns one empty name, so that a test is reported as skipped.
inline std::vector<std::string> modelFiles(const std::string& folder) {
    std::vector<std::string> names;
    const std::filesystem::path root = shared(folder);
    if (std::filesystem::exists(root)) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
            const std::string extension = lowerExtension(entry.path());
            if (entry.is_regular_file() && (extension == ".glb" || extension == ".gltf")) {
                names.push_back(std::filesystem::relative(entry.path(), root).generic_string());
            }
        }
    }
    std::sort(names.begin(), names.end());
    if (names.empty()) names.emplace_back();
    return names;
}

/// Returns a test name for a file name.
inline std::string testName(std::string file) {
    for (char& c : file) {
        const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!plain) c = '_';
    }
    return file.empty() ? "none" : file;
}

}  // namespace tspace::test
