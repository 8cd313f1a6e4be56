// SPDX-License-Identifier: MIT
// Writes DDS and KTX2 containers for levels of texels or blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "images/image.h"
#include "images/textures/texel_format.h"
#include "tspace/map_files.h"

namespace tspace {

/// Texture with its levels, largest first: each is half as wide and high as the previous one, rounded down, but at
/// least 1.
struct Texture {
    std::uint32_t width = 0, height = 0;
    TexelKind kind = TexelKind::bc5;  ///< rg8, rgba8, bc5, eacRg or their signed variants; or astc with 4 x 4 texels
    std::vector<std::vector<std::uint8_t>> levels = {};
};

/// Returns the reason why DDS does not support the format, as a sentence fragment; null if it does.
const char* whyNotDds(TexelKind kind);
/// Writes a DDS with a Direct3D 10 header, or with a Direct3D 9 header if `old_four_cc` is not null: the FourCC for
/// unsigned BC5. Texels of other formats are then described by masks. Requires whyNotDds(texture.kind) == nullptr.
std::vector<std::uint8_t> writeDds(const Texture& texture, const char* old_four_cc = nullptr);

/// Returns the reason why this build cannot compress levels with Zstandard, as a sentence; null if it can.
const char* whyNotZstd();
/// Writes a linear KTX2 with rows from the top. `zstd_level`: from 1 (fast) to 22 (small), applied to each level
/// separately; 0: uncompressed. Returns nullopt if memory runs out.
std::optional<std::vector<std::uint8_t>> writeKtx2(const Texture& texture, int zstd_level = 0);

/// Returns the reason why ASTC cannot be written, as a sentence; null if it can.
const char* whyNoAstcWritten();
/// Encodes x (in red, green and blue) and y (in alpha) as ASTC blocks of 4 x 4 texels, row by row. Replaces `texels`
/// (-1 to 1) by the decoded values. Returns nullopt if the library fails. The result does not depend on the number of
/// threads. Requires whyNoAstcWritten() == nullptr.
std::optional<std::vector<std::uint8_t>> packAstc(std::uint32_t width, std::uint32_t height, TextureQuality quality,
                                                  std::span<Vec2> texels, Parallel& parallel);

}  // namespace tspace
