// SPDX-License-Identifier: MIT
// Paths as text, without access to the disk.
#include "model/io/path.h"

#include <filesystem>

namespace tspace {

namespace fs = std::filesystem;

Path Path::operator/(const std::string& name) const { return fs::path(*this) / fs::path(Path(name)); }

Path folderOf(const Path& file) {
    const fs::path folder = fs::path(file).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

std::string stemOf(const Path& file) { return Path(fs::path(file).stem()).string(); }

std::string lowerExtension(const Path& path) {
    std::string extension = Path(fs::path(path).extension()).string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

bool isGlbName(const Path& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".glb" || extension == ".vrm";
}

bool isGltfName(const Path& path) { return isGlbName(path) || lowerExtension(path) == ".gltf"; }

}  // namespace tspace
