// SPDX-License-Identifier: MIT
// Searches for element names, which FBX (including its binary form) and COLLADA store as plain text.
#include "stored_tangents.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace tspace::import {
namespace {

struct Names {
    const char *extension, *tangents, *bitangents;
};

// TEXTANGENT and TEXBINORMAL of COLLADA have the same ending.
constexpr std::array kFormats = {Names{".fbx", "LayerElementTangent", "LayerElementBinormal"},
                                 Names{".dae", "TANGENT\"", "BINORMAL\""}, Names{".dae", "TANGENT'", "BINORMAL'"}};

bool contains(const std::string& path, std::string_view name) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    std::vector<char> block(kBlock + name.size());
    std::ifstream file(path, std::ios::binary);
    // The end of each block is copied to the start of the next one, for names that span both.
    for (std::size_t kept = 0; file;) {
        file.read(block.data() + kept, static_cast<std::streamsize>(kBlock));
        const std::size_t count = kept + static_cast<std::size_t>(file.gcount());
        if (std::string_view(block.data(), count).find(name) != std::string_view::npos) return true;
        const std::size_t next_kept = std::min(count, name.size() - 1);
        std::copy_n(block.data() + (count - next_kept), next_kept, block.data());
        kept = next_kept;
    }
    return false;
}

}  // namespace

StoredTangents storedTangents(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    bool is_known = false, has_tangents = false, has_bitangents = false;
    for (const Names& names : kFormats) {
        if (extension != names.extension) continue;
        is_known = true;
        has_tangents = has_tangents || contains(path, names.tangents);
        has_bitangents = has_bitangents || contains(path, names.bitangents);
    }
    if (!is_known) return StoredTangents::unknown;
    if (!has_tangents) return StoredTangents::none;
    return has_bitangents ? StoredTangents::withBitangents : StoredTangents::unknown;
}

}  // namespace tspace::import
