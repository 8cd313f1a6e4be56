// SPDX-License-Identifier: MIT
// DDS and KTX2 around levels of texels or blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "images/image.h"
#include "images/texel_format.h"

namespace tspace {

/// Levels, the largest first: each half as wide and high as the one before, rounded down, and 1 at least.
struct Texture {
    std::uint32_t width = 0, height = 0;
    TexelKind kind = TexelKind::bc5;  ///< rg8, rgba8, bc5, eacRg and those with a sign; astc of 4 x 4 texels
    std::vector<std::vector<std::uint8_t>> levels = {};
};

/// Null, or why no DDS holds the format: half a sentence.
const char* whyNotDds(TexelKind kind);
/// With the head of Direct3D 10. whyNotDds must be null.
std::vector<std::uint8_t> writeDds(const Texture& texture);

/// Null, or why this build does not pack levels by Zstandard: a sentence.
const char* whyNotZstd();
/// Linear, rows from the top. `zstd_level`: from 1 (fast) to 22 (small), each level by itself; 0: not packed. Nothing where it runs out of
/// memory.
std::optional<std::vector<std::uint8_t>> writeKtx2(const Texture& texture, int zstd_level = 0);

}  // namespace tspace
