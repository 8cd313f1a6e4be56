// SPDX-License-Identifier: MIT
// SPIR-V modules that the build compiled from the shaders.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace tspace::shaders {

/// Reads a SPIR-V file. Returns no words if it does not exist.
inline std::vector<std::uint32_t> readSpirv(const std::string& name) {
    std::ifstream file(TSPACE_SPIRV_DIR "/" + name + ".spv", std::ios::binary);
    std::vector<std::uint32_t> words;
    for (std::uint32_t word = 0; file.read(reinterpret_cast<char*>(&word), sizeof word);) words.push_back(word);
    return words;
}

}  // namespace tspace::shaders
