// SPDX-License-Identifier: MIT
// Texture files, KTX2 and DDS: what their heads say. Any bytes may come; all that a head names lies inside of the file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "images/image.h"
#include "images/texel_format.h"
#include "tspace/map_layout.h"

namespace tspace {

/// How KTX2 packs its levels once more.
enum class Repacking : std::uint8_t { none, zstd, zlib, basisLz };

struct TextureFile {
    const char* container = "";  ///< "KTX2", "DDS"
    ImageSize size = {};         ///< at most 2^30 each
    TexelFormat format = {};
    Repacking repacking = Repacking::none;
    /// The first, which is the largest, as it lies in the file. Of a KTX2 that is packed once more any number of bytes.
    ByteSpan level = {};
    struct Place {
        std::size_t at = 0, bytes = 0;
    };
    std::vector<Place> levels = {};                  ///< where all of them are in the file
    ByteSpan global = {};                            ///< code books of BasisLZ
    bool is_srgb = false;                            ///< the file says that its numbers have the sRGB curve
    bool turns_columns = false, turns_rows = false;  ///< the first texel is not the top left one
    /// Of each colour that is shown: the channel of the format, or one of these.
    static constexpr std::uint8_t kZero = 4, kOne = 5;
    std::array<std::uint8_t, 4> swizzle = {0, 1, 2, 3};
    /// Where x, y and z are among the colours that are shown, where the format says so; else as glTF has it.
    MapLayout layout = {};

    /// Bytes of the first level, unpacked.
    [[nodiscard]] std::uint64_t levelBytes() const { return format.bytesOf(size.width, size.height); }
    /// "BC5 in a DDS".
    [[nodiscard]] std::string name() const {
        std::string text = format.name;
        if (format.decode == nullptr)
            text.append(" ").append(std::to_string(format.width)).append("x").append(std::to_string(format.height));
        return text.append(" in a ").append(container);
    }
};

/// Nothing, with the reason in `why`, for what is broken, is no picture (cubes, volumes, arrays) or has a format that is not read.
std::optional<TextureFile> readTextureHead(ByteSpan bytes, std::string& why);
std::optional<TextureFile> readKtx2Head(ByteSpan bytes, std::string& why);
std::optional<TextureFile> readDdsHead(ByteSpan bytes, std::string& why);

/// The blocks of the first level, packed by BasisLZ. False where it is broken.
bool unpackBasisLz(const TextureFile& texture, std::span<std::uint8_t> blocks);

/// Null, or why ASTC is not read.
const char* whyNotAstc();
/// Decodes blocks of ASTC to red, green, blue and alpha, four floats a texel: `texels` has as many bytes. False where the library
/// fails.
bool decodeAstc(const TextureFile& texture, ByteSpan blocks, std::span<std::uint8_t> texels);

/// The layout of two channels where colours `x` and `y` are shown.
MapLayout twoChannelLayout(MapChannel x, MapChannel y);

/// Why this build does not unpack it; null where it does.
const char* whyNotUnpacked(Repacking repacking);
/// False where `packed` does not unpack to exactly as many bytes as `out` has.
bool unpackLevel(Repacking repacking, ByteSpan packed, std::span<std::uint8_t> out);

}  // namespace tspace
