// SPDX-License-Identifier: MIT
// Headers of texture files, KTX2 and DDS. Arbitrary input is allowed; all ranges that a header declares are checked
// against the file.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "images/image.h"
#include "images/texel_format.h"
#include "tspace/map_files.h"

namespace tspace {

// Detects textures whose four channels contain only x and y of a normal map, and which channels hold them.

/// Common layouts: x in alpha and y in green, with constant red; or x in all three colors and y in alpha.
class LayoutGuess {
  public:
    /// Adds a texel with channels from 0 to 1.
    void add(const Vec3& texel, float alpha) {
        constexpr float kApart = 8.0F / 255.0F;  // errors due to compression
        const std::array<float, 4> values{texel.x, texel.y, texel.z, alpha};
        for (std::size_t i = 0; i < 4; ++i) {
            least_[i] = std::fmin(least_[i], values[i]);
            most_[i] = std::fmax(most_[i], values[i]);
        }
        grey_ += std::fabs(texel.x - texel.y) <= kApart && std::fabs(texel.x - texel.z) <= kApart ? 1 : 0;
        green_.add(alpha, texel.y);
        red_.add(texel.x, alpha);
        ++count_;
    }

    [[nodiscard]] std::optional<MapLayout> layout() const {
        constexpr float kSame = 3.0F / 255.0F;
        const auto varies = [&](std::size_t i) { return most_[i] - least_[i] > kSame; };
        if (count_ == 0 || !varies(3) || !varies(1)) return {};
        if (!varies(0) && green_.fits(count_)) return made(MapChannel::alpha, MapChannel::green);
        if (isNearlyAll(grey_, count_) && red_.fits(count_)) return made(MapChannel::red, MapChannel::alpha);
        return {};
    }

  private:
    static bool isNearlyAll(std::uint64_t part, std::uint64_t count) {
        constexpr double kNearly = 0.99;
        return static_cast<double>(part) >= kNearly * static_cast<double>(count);
    }
    static MapLayout made(MapChannel x, MapChannel y) { return {.x = {x}, .y = {y}, .z = {MapChannel::none}}; }

    /// Counts whether pairs are x and y of unit vectors around z.
    struct Pairs {
        double sum_x = 0, sum_y = 0;
        std::uint64_t inside = 0;

        void add(float x, float y) {
            constexpr double kLongest = 1.04;
            const double a = 2 * static_cast<double>(x) - 1, b = 2 * static_cast<double>(y) - 1;
            sum_x += a;
            sum_y += b;
            inside += a * a + b * b <= kLongest ? 1 : 0;
        }
        [[nodiscard]] bool fits(std::uint64_t count) const {
            constexpr double kMostMean = 0.3;
            const auto total = static_cast<double>(count);
            return std::fabs(sum_x) < kMostMean * total && std::fabs(sum_y) < kMostMean * total &&
                   isNearlyAll(inside, count);
        }
    };

    std::array<float, 4> least_ = {1, 1, 1, 1}, most_ = {};
    std::uint64_t grey_ = 0, count_ = 0;
    Pairs green_ = {}, red_ = {};
};

/// Supercompression scheme of KTX2 levels.
enum class Repacking : std::uint8_t { none, zstd, zlib, basisLz };

/// Maximum side to which header sizes are clamped. The product of two sides and up to 256 bytes per texel then fits in
/// 64 bits.
inline constexpr std::uint32_t kMostTextureSide = std::uint32_t{1} << 28;

struct TextureFile {
    const char* container = "";  ///< "KTX2", "DDS"
    ImageSize size = {};         ///< at most kMostTextureSide each
    TexelFormat format = {};
    Repacking repacking = Repacking::none;
    /// First (largest) level, as stored in the file. In a supercompressed KTX2 it may have any size.
    ByteSpan level = {};
    std::size_t level_number = 0;  ///< index of the level in `level` and `size`: 0 unless another one was requested
    struct Place {
        std::size_t at = 0, bytes = 0;
    };
    std::vector<Place> levels = {};  ///< positions of all levels in the file
    /// number of levels that the header declares but the file does not contain
    std::uint32_t cut_count = 0;
    ByteSpan global = {};                            ///< codebooks of BasisLZ
    bool is_srgb = false;                            ///< the file declares its values as sRGB
    bool turns_columns = false, turns_rows = false;  ///< the first texel is not the top left one
    /// For each output color: a channel of the format, or one of these constants.
    static constexpr std::uint8_t kZero = 4, kOne = 5;
    std::array<std::uint8_t, 4> swizzle = {0, 1, 2, 3};
    /// Channels of x, y and z among the output colors if the format defines them; otherwise as in glTF.
    MapLayout layout = {};

    /// Returns the size of the first level, decompressed.
    [[nodiscard]] std::uint64_t levelBytes() const { return format.bytesOf(size.width, size.height); }
    /// Returns a name such as "BC5 in a DDS".
    [[nodiscard]] std::string name() const {
        std::string text = format.name;
        if (format.decode == nullptr)
            text.append(" ").append(std::to_string(format.width)).append("x").append(std::to_string(format.height));
        return text.append(" in a ").append(container);
    }
};

/// Parses the header. A corrupt file is an error, and so are cube maps, volumes, arrays and unsupported formats.
Result<TextureFile> readTextureHead(ByteSpan bytes);
Result<TextureFile> readKtx2Head(ByteSpan bytes);
Result<TextureFile> readDdsHead(ByteSpan bytes);

/// Unpacks the blocks of the first level from BasisLZ. Returns false if it is corrupt.
bool unpackBasisLz(const TextureFile& texture, std::span<std::uint8_t> blocks);

/// Returns why ASTC cannot be read, or null if it can.
const char* whyNotAstc();
/// Decodes ASTC blocks to red, green, blue and alpha, four floats per texel; `texels` must have this size. Returns
/// false if the library fails.
bool decodeAstc(const TextureFile& texture, ByteSpan blocks, std::span<std::uint8_t> texels);

/// Returns the two-channel layout with x and y in the given output colors.
MapLayout twoChannelLayout(MapChannel x, MapChannel y);

/// Returns why this build cannot decompress the scheme, or null if it can.
const char* whyNotUnpacked(Repacking repacking);
/// Decompresses a level. Returns false unless `packed` decompresses to exactly out.size() bytes.
bool unpackLevel(Repacking repacking, ByteSpan packed, std::span<std::uint8_t> out);

}  // namespace tspace
