// SPDX-License-Identifier: MIT
// DDS and KTX2 around levels of texels or blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"
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
/// The header of Direct3D 9 in place of that of Direct3D 10. `four_cc` names BC5, with a sign or not; texels are described by masks.
struct OldDdsHeader {
    const char* four_cc = "ATI2";
};
/// With the header of Direct3D 10, or `old`. whyNotDds must be null.
std::vector<std::uint8_t> writeDds(const Texture& texture, const OldDdsHeader* old = nullptr);

/// Null, or why this build does not pack levels by Zstandard: a sentence.
const char* whyNotZstd();
/// Linear, rows from the top. `zstd_level`: from 1 (fast) to 22 (small), each level by itself; 0: not packed. Nothing where it runs out of
/// memory.
std::optional<std::vector<std::uint8_t>> writeKtx2(const Texture& texture, int zstd_level = 0);

enum class AstcEffort : std::uint8_t { quick, fast, best };

/// Null, or why no ASTC is written here: a sentence.
const char* whyNoAstcWritten();
/// Blocks of 4 x 4 texels of x (in red, green and blue) and y (in alpha), row by row. `texels`, from -1 to 1, become those of the blocks. Nothing
/// where the library fails. The same for any number of threads. whyNoAstcWritten must be null.
std::optional<std::vector<std::uint8_t>> packAstc(std::uint32_t width, std::uint32_t height, AstcEffort effort,
                                                  std::span<Vec2> texels, Parallel& parallel);

}  // namespace tspace
