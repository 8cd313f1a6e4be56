// SPDX-License-Identifier: MIT
// Images as arrays of numbers, and what is known of the file that they come from.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tspace/map_files.h"
#include "tspace/span.h"

namespace tspace {

using ByteSpan = std::span<const std::uint8_t>;

enum class ImageFormat { unknown, png, jpeg, webp, ktx2, basis, dds, avif, exr, tga };

/// 8 bits a channel; the first row is the top one.
struct RgbImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb = {};
};

struct ImageSize {
    std::uint32_t width = 0, height = 0;

    [[nodiscard]] std::uint64_t pixels() const { return std::uint64_t{width} * height; }
};

/// Intended use of an image. Float files do not declare whether they hold vectors from -1 to 1 or numbers from 0 to 1.
enum class ImageUse {
    vectors,  ///< a normal map: floats from -1 to 1 become (v + 1) / 2, as all other files hold them
    numbers   ///< heights, colors, roughness: floats as stored
};

/// Pixel information from a file with its own channel layout (KTX2, DDS, EXR).
struct TextureFacts {
    std::string name = {};  ///< "BC5 in a DDS"
    MapLayout layout =
        {};  ///< layout of a normal map: the channels of x, y and z. If not the default, z must be reconstructed
    bool is_guessed = false;  ///< the layout is not said by the format, but the texels look like it
    bool is_srgb = false;     ///< it says that its numbers have the sRGB curve, which normal maps must not have
    bool has_blocks = false;  ///< smaller levels cannot be made of it by who loads it
    std::uint32_t level_count = 1;
};

/// Channels as stored, from 0 (the integer 0) to 1 (the largest integer); floats as
/// they are, but for vectors from -1 to 1 (ImageUse). Of textures see Rgba in texel_format.h. The first row is the top one. An integer n of up to 16 bits comes back as n when it is written with as many bits.
struct FloatImage {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 8;              ///< bits per channel in the file: 8 or 16; floats: 16 or 32. BC4, BC5 and EAC: 16
    std::vector<Vec3> texels = {};  ///< width * height; of grey images all three are equal
    std::vector<float> alpha = {};  ///< one per texel, or empty: opaque
    std::uint64_t not_finite = 0;   ///< texels of an EXR or texture that were not finite, and are grey now
    TextureFacts texture = {};      ///< with an empty name for other files
    /// If the values of the file were mapped to 0 to 1: one sentence with the reason and its certainty. Otherwise empty.
    std::string range_text = {};
};

/// Pixels of 3 or 4 channels, 8 bits each; the first row is the top one.
struct ChannelImage {
    std::uint32_t width = 0, height = 0;
    unsigned channels = 3;
    std::vector<std::uint8_t> pixels = {};
};

}  // namespace tspace
