// SPDX-License-Identifier: MIT
// Normal maps as compressed textures for engines, with all their levels. CMake target tspace::asset.
#pragma once

#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/map_convert_file.h"

namespace tspace {

/// x and y of a normal map; z is made by who reads it.
enum class TextureFormat : std::uint32_t {
    bc5 = 0,      ///< one byte a texel: desktops and consoles
    eacRg11 = 1,  ///< one byte a texel: phones (OpenGL ES 3, Vulkan)
    rg8 = 2,      ///< two bytes a texel, each rounded: where nothing is compressed
    astc4x4 =
        3  ///< one byte a texel, x in red, green and blue, y in alpha: phones; by the library astcenc, where it is installed
};

enum class TextureQuality : std::uint32_t {
    fast = 0,  ///< blocks with the least error as it is filtered, two rounds
    best = 1,  ///< three rounds, and more palettes: about 1 % nearer, and 2.5 times as long
    quick = 2  ///< each channel of a block by itself: about a fifth farther off, and a quarter of the time
};

struct CompressMapFileOptions {
    TextureFormat format = TextureFormat::bc5;
    TextureQuality quality = TextureQuality::fast;
    bool is_signed = false;  ///< with a sign: 0 is exact, which flat parts of maps of more than 8 bits gain by
    bool levels = true;      ///< all smaller levels too
    /// A texture of glTF's occlusion, roughness (green) and metalness; empty: none. Its levels are written to `roughness_output`, wider by what
    /// the normals of each texel spread.
    std::string roughness = {}, roughness_output = {};
    double roughness_factor = 1;  ///< is multiplied into green, before: the material's factor is then 1
    unsigned zstd_level = 0;      ///< packs levels of a KTX2 once more, 1 to 22; 0: not
    unsigned bits = 16;           ///< of the PNGs of normals: 8 or 16
    /// Limits for the image: as ConvertMapFileOptions::file.
    FileOptions file = {};
    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    Sink sink = {};                              ///< takes the output, a KTX2, in place of a file; without roughness
    bool dry_run = false;                        ///< everything but writing
    Execution execution = {};
    MapAlpha alpha = MapAlpha::automatic;    ///< of `input`
    DdsHeader dds_header = DdsHeader::dx10;  ///< of outputs in DDS
};

struct CompressMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8;        ///< of a channel of the input
    std::string format = {};         ///< what was written: "BC5", "BC5 signed", "PNG"
    std::uint32_t level_count = 1;   ///< in the output
    std::uint64_t output_bytes = 0;  ///< of the normal map
    std::uint64_t roughness_bytes = 0;
    /// Between the map as three channels of full depth and as the texture, of the first level: bilinear, then unit, at 3 x 3
    /// points a texel (of some rows, where it is large). What rebuilding z after the filter costs is in it, and what looks below
    /// the horizon.
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;
    double max_error_x = 0, max_error_y = 0;  ///< where, in texels from the top left corner
    std::uint64_t below_horizon = 0;          ///< texels whose z is below 0: of two channels laid on the horizon
    std::uint64_t not_unit = 0;               ///< texels that are a tenth or more longer or shorter than unit vectors
    /// Means of the roughness of the last level, as plain means and as written; 0 without roughness.
    double mean_roughness = 0, mean_widened_roughness = 0;
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Packs a normal map in tangent space: x in red, y in green; z is made by who reads it. `output` ends in .dds or .ktx2; or in / for a
/// folder of PNGs, NAME.0.png and on, with three channels. From PNG of 16 bits or EXR blocks are better than from 8 bits.
/// Errors: those of convertMapFile, and invalidOption: grids of normals and roughness that do not fit, a format that
/// the container does not hold. Thread-safe; the same bytes for any number of threads.
Result<CompressMapFileReport> compressMapFile(const std::string& input, const std::string& output,
                                              const CompressMapFileOptions& options = {});

struct TextureErrorOptions {
    FileOptions file = {};      ///< limits for the images: as ConvertMapFileOptions::file
    bool two_channels = false;  ///< z is made from red and green of the texture, whatever its format; blue is not read
    Execution execution = {};
};

struct TextureErrorReport {
    std::uint32_t width = 0, height = 0;
    std::string format = {};  ///< "BC5 in a DDS"; empty for other images
    bool makes_z = false;     ///< it has two channels: z is made after the filter, as by renderers
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;  ///< as CompressMapFileReport
    double max_error_x = 0, max_error_y = 0;
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// How far anybody's texture (its first level) is from the normal map that it was made of. Errors: those of convertMapFile, and countMismatch: of
/// other sizes. Thread-safe; the same for any number of threads.
Result<TextureErrorReport> textureErrorFile(const std::string& texture, const std::string& source,
                                            const TextureErrorOptions& options = {});

}  // namespace tspace
