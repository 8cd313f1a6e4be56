// SPDX-License-Identifier: MIT
// Paths as text, without file system access.
#include "model/io/path.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/base/ascii.h"

namespace tspace {

namespace fs = std::filesystem;

Path Path::operator/(const std::string& name) const { return fs::path(*this) / fs::path(Path(name)); }

Path folderOf(const Path& file) {
    const fs::path folder = fs::path(file).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

std::string stemOf(const Path& file) { return Path(fs::path(file).stem()).string(); }

std::string lowerExtension(const Path& path) { return lowerAscii(Path(fs::path(path).extension()).string()); }

bool isGlbName(const Path& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".glb" || extension == ".vrm";
}

bool isGltfName(const Path& path) { return isGlbName(path) || lowerExtension(path) == ".gltf"; }

bool isImageName(const Path& path) {
    static constexpr std::array<const char*, 8> kExtensions = {".png", ".jpg", ".jpeg", ".webp",
                                                               ".exr", ".tga", ".ktx2", ".dds"};
    const std::string extension = lowerExtension(path);
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace tspace
