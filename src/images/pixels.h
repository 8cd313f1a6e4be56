// SPDX-License-Identifier: MIT
// Images as arrays of numbers, and information about their source file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tspace/map_files.h"
#include "tspace/span.h"

namespace tspace {

using ByteSpan = std::span<const std::uint8_t>;

enum class ImageFormat { unknown, png, jpeg, webp, ktx2, basis, dds, avif, exr, tga };

/// Rounds a channel from 0 to 1 to 8 bits. NaN becomes 0.
inline std::uint8_t roundedChannel(float channel) {
    return channel > 0 ? static_cast<std::uint8_t>(std::min(channel, 1.0F) * 255.0F + 0.5F) : std::uint8_t{0};
}

/// Image with 8 bits per channel; the first row is the top row.
struct RgbImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb = {};
    std::uint64_t not_finite = 0;  ///< see FloatImage
    std::string layer_text = {};   ///< see FloatImage
};

struct ImageSize {
    std::uint32_t width = 0, height = 0;

    [[nodiscard]] std::uint64_t pixels() const { return std::uint64_t{width} * height; }
};

/// Intended use of an image. Float files do not declare whether they contain vectors from -1 to 1 or numbers from 0 to
/// 1.
enum class ImageUse {
    vectors,  ///< a normal map: floats from -1 to 1 are mapped to (v + 1) / 2, the encoding of all other files
    numbers   ///< heights, colors, roughness: floats as stored
};

/// Pixel information from a file with its own channel layout (KTX2, DDS, EXR).
struct TextureFacts {
    std::string name = {};  ///< such as "BC5 in a DDS"
    /// Channels of x, y and z in a normal map. If the channel of z is `none`, z must be reconstructed.
    MapLayout layout = {};
    bool is_guessed = false;  ///< the layout was detected from the texels, because the format does not define it
    bool is_srgb = false;     ///< the file declares its values as sRGB, which is wrong for normal maps
    bool has_blocks = false;  ///< block-compressed, so that loaders cannot generate smaller levels
    std::uint32_t level_count = 1;
};

/// Channels as stored in the file, scaled so that the integer 0 is 0 and the largest integer is 1. Floats are
/// unchanged, except that vectors in the range -1 to 1 are mapped (ImageUse). For texture files, see Rgba in
/// texel_format.h. The first row is the top row. An integer of up to 16 bits is restored exactly when it is written
/// with the same number of bits.
struct FloatImage {
    std::uint32_t width = 0, height = 0;
    unsigned bits = 8;              ///< bits per channel in the file: 8 or 16; floats: 16 or 32. BC4, BC5 and EAC: 16
    std::vector<Vec3> texels = {};  ///< width * height; in gray images all three channels are equal
    std::vector<float> alpha = {};  ///< one per texel; empty: opaque
    /// Number of texels of an EXR file or texture that were not finite and were filled from their neighbors.
    std::uint64_t not_finite = 0;
    TextureFacts texture = {};  ///< from the header of a KTX2, DDS or EXR file; other formats: the name is empty
    /// One sentence with the reason and its certainty if the values of the file were mapped to 0 to 1; otherwise empty.
    std::string range_text = {};
    /// Clause on the layer of an EXR that was read, and the layers that were not; empty if there is only one.
    std::string layer_text = {};
};

/// Rounds to 8 bits per channel.
RgbImage roundedImage(const FloatImage& image);

/// Pixels of 3 or 4 channels with 8 bits each; the first row is the top row.
struct ChannelImage {
    std::uint32_t width = 0, height = 0;
    unsigned channels = 3;
    std::vector<std::uint8_t> pixels = {};
};

}  // namespace tspace
