// SPDX-License-Identifier: MIT
// Headers of texture files, KTX2 and DDS. Arbitrary input is allowed; all ranges that a header declares are checked
// against the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "images/image.h"
#include "images/textures/texel_format.h"
#include "tspace/map_files.h"

namespace tspace {

/// Supercompression scheme of KTX2 levels.
enum class Repacking : std::uint8_t { none, zstd, zlib, basisLz };

/// Maximum side length; larger sizes in headers are clamped to it. The product of two sides and up to 256 bytes per
/// texel then fits in 64 bits.
inline constexpr std::uint32_t kMaxTextureSide = std::uint32_t{1} << 28;

struct TextureFile {
    const char* container = "";  ///< "KTX2", "DDS"
    ImageSize size = {};         ///< at most kMaxTextureSide each
    TexelFormat format = {};
    Repacking repacking = Repacking::none;
    /// Level `level_number`, as stored in the file. In a supercompressed KTX2 it may have any number of bytes.
    ByteSpan level = {};
    /// Index of the level that `level` and `size` describe: 0 (the largest) unless another one was requested.
    std::size_t level_number = 0;
    struct Place {
        std::size_t at = 0, bytes = 0;
    };
    std::vector<Place> levels = {};  ///< positions of all levels in the file
    /// number of levels that the header declares but the file does not contain
    std::uint32_t cut_count = 0;
    ByteSpan global = {};                            ///< codebooks of BasisLZ
    bool is_srgb = false;                            ///< the file declares its values as sRGB
    bool turns_columns = false, turns_rows = false;  ///< columns are stored from right to left, rows from bottom to top
    /// Source of each output color: a channel of the format, or one of these constants.
    static constexpr std::uint8_t kZero = 4, kOne = 5;
    std::array<std::uint8_t, 4> swizzle = {0, 1, 2, 3};
    /// Channels of x, y and z among the output colors if the format defines them; otherwise as in glTF.
    MapLayout layout = {};

    /// Returns the decompressed size of the level, in bytes.
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
Result<TextureFile> readTextureHeader(ByteSpan bytes);
Result<TextureFile> readKtx2Header(ByteSpan bytes);
Result<TextureFile> readDdsHeader(ByteSpan bytes);

/// Unpacks the blocks of texture.level from BasisLZ. Returns false if the data is corrupt.
bool unpackBasisLz(const TextureFile& texture, std::span<std::uint8_t> blocks);

/// Returns why ASTC cannot be read, or null if it can.
const char* whyNotAstc();
/// Decodes ASTC blocks to red, green, blue and alpha, four floats per texel; `texels` must have this size. Returns
/// false if the library fails.
bool decodeAstc(const TextureFile& texture, ByteSpan blocks, std::span<std::uint8_t> texels);

/// Returns why this build cannot decompress the scheme, or null if it can.
const char* whyNotUnpacked(Repacking repacking);
/// Decompresses a level. Returns false unless `packed` decompresses to exactly out.size() bytes.
bool unpackLevel(Repacking repacking, ByteSpan packed, std::span<std::uint8_t> out);

}  // namespace tspace
