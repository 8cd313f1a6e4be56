// SPDX-License-Identifier: MIT
// Normal maps from file to file: conversion, heights, compressed textures. CMake target tspace::asset.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/maps.h"
#include "tspace/result.h"
#include "tspace/span.h"
#include "tspace/tangents.h"

namespace tspace {

// Images of normal maps: file formats, channel layouts, and inversion of green. CMake target tspace::asset. Reads PNG
// (8 and 16 bits), JPEG and WebP if tspace was built with their libraries, and always KTX2, DDS and TGA (which is
// written as PNG). The format is detected by content.
//
// All functions are thread-safe and deterministic.

// Layout of the vectors in an image whose x, y and z are not in red, green and blue.

/// Channel of an image.
enum class MapChannel : std::uint32_t {
    red = 0,
    green = 1,
    blue = 2,
    alpha = 3,
    none = 4  ///< for z only: computed as sqrt(1 - x^2 - y^2)
};

/// Transfer curve that was wrongly applied to the values of a normal map, as to a picture.
enum class MapCurve : std::uint32_t {
    none = 0,
    srgb = 1,       ///< the sRGB curve was applied: a flat texel is (188, 188, 255)
    linearized = 2  ///< the sRGB curve was removed: a flat texel is (55, 55, 255)
};

struct MapComponent {
    MapChannel channel = MapChannel::red;
    bool is_inverted = false;  ///< true: the channel stores 1 - c

    friend bool operator==(const MapComponent&, const MapComponent&) = default;
};

/// Channels of x, y and z, and their encoding. The default is the layout of glTF.
struct MapLayout {
    MapComponent x{MapChannel::red}, y{MapChannel::green}, z{MapChannel::blue};
    MapCurve curve = MapCurve::none;  ///< encoding of red, green and blue; alpha is always linear

    friend bool operator==(const MapLayout&, const MapLayout&) = default;
};

/// Converts a texel of an image with the given layout to (x, y, z), each from 0 to 1 as in a normal map. If z is
/// computed and x and y are longer than 1, z is 0.5. Thread-safe.
Vec3 readTexel(const Vec3& rgb, float alpha, const MapLayout& layout);

enum class ImageFileFormat : std::uint32_t {
    sameAsInput = 0,
    png = 1,
    jpeg = 2,
    webp = 3,
    ktx2 = 4,
    dds = 5,
};

struct FlipGreenOptions {
    /// Format of the output: format of the input, or PNG. Other formats are rejected (unsupportedFile), because they
    /// would lose precision.
    ImageFileFormat format = ImageFileFormat::sameAsInput;
    /// JPEG quality, 1 to 100. The default adds a smaller error than rounding to 8 bits.
    int jpeg_quality = 98;
    /// Approximate memory limit; same meaning as FileOptions::memory_limit_bytes.
    std::uint64_t memory_limit_bytes = 0;

    // Options of flipGreenFile only:

    /// The image, instead of the file `input`; must stay valid during the call.
    std::span<const std::uint8_t> content = {};
    /// Receives the bytes instead of the file `output`; same rules as GenerateOptions::sink.
    Sink sink = {};
    bool dry_run = false;  ///< true: nothing is written
    bool sync = true;      ///< same meaning as FileOptions::sync
};

struct FlipGreenReport {
    ImageFileFormat format = ImageFileFormat::png;  ///< format of the output; never sameAsInput
    std::uint32_t width = 0, height = 0;
    std::uint32_t bits = 8;  ///< bits per channel
    /// true: every texel has exactly 255 - G (65535 - G with 16 bits), and all other channels are unchanged. false: a
    /// JPEG was written, whose texels are rounded again, or a PNG from a KTX2 or DDS with values between the integers.
    bool is_exact = true;
    std::vector<std::string> warnings = {};  ///< one sentence per warning
};

struct FlippedImage {
    std::vector<std::uint8_t> bytes = {};  ///< the image file
    FlipGreenReport report = {};
};

/// Inverts the green channel of an image: converts between normal maps for OpenGL and DirectX.
///
/// PNG keeps its color type, bit depth, alpha, palette, and all chunks; interlaced files become non-interlaced. Green
/// of a transparent or background color is inverted too. JPEG is recompressed, without subsampling, and keeps its Exif
/// data, profile and comments. WebP is written losslessly, without metadata. KTX2 and DDS keep their blocks, whose
/// green is inverted exactly in all levels, if they contain uncompressed integers or BC5; others, and supercompressed
/// KTX2 (Zstandard or zlib), are rejected (unsupportedFile), but can be written as PNG with x, y and z, where z of
/// two-channel maps is computed. Color space information of the file is kept, and none is added: glTF normal maps are
/// linear.
///
/// Errors: unsupportedFile (not an image that this build reads; gray, without a green channel; animated; a format that
/// cannot be written), invalidFile (corrupt), invalidOption, tooLarge, outOfMemory. Time and memory: linear in the
/// pixels; a PNG that is not interlaced needs a few rows and the size of its file. tooLarge also for a PNG that claims
/// to unpack to more than 16 times the memory limit, 1 GB and more by default.
Result<FlippedImage> flipGreen(std::span<const std::uint8_t> image, const FlipGreenOptions& options = {});

/// Reads an image, inverts its green channel like flipGreen, and writes it; `output` may be `input`. If no format is
/// requested, the extension of the output decides: .png, .jpg, .jpeg, .webp, .ktx2 or .dds. The output is written
/// atomically. Further errors: cannotRead, cannotWrite; invalidOption for an extension that is neither .png nor one of
/// the format of the input.
Result<FlipGreenReport> flipGreenFile(const std::string& input, const std::string& output,
                                      const FlipGreenOptions& options = {});

// Conversion of normal maps from file to file, for the frames of model files.

/// Space of the vectors of a map in a file.
enum class MapFileSpace : std::uint32_t {
    tangent = 0,
    object = 1,  ///< mesh coordinates, as in the model file
    world = 2    ///< scene axes: the mesh's nodes, which must agree, rotate and scale the vectors
};

/// Meaning of the alpha channel of a normal map, for computing smaller mip levels.
enum class MapAlpha : std::uint32_t {
    automatic = 0,  ///< coverage if texels with alpha 0 hold no unit vectors and nearly all others do; otherwise data
    coverage = 1,   ///< part of a texel that is surface, as in sprites and foliage: mip levels are alpha-weighted means
    data = 2        ///< anything else, such as heights: ignored
};

/// Header type of a DDS file.
enum class DdsHeader : std::uint32_t {
    dx10 = 0,    ///< Direct3D 10, with a DXGI number: the only header that can describe every format
    legacy = 1,  ///< Direct3D 9: BC5 as FourCC ATI2 (signed: BC5S), uncompressed texels by masks
    bc5u = 2     ///< like legacy, but BC5 as FourCC BC5U
};

struct ConvertMapFileOptions {
    std::string mesh = {};     ///< model that the map was made for; empty: no mesh is needed
    std::string to_mesh = {};  ///< model that will use the map, with the same surface and UVs; empty: `mesh`
    /// Uses the primitives of the material with this name. Empty: primitives whose material refers to an image with the
    /// map's name, otherwise all that have UVs.
    std::string material = {};
    std::uint32_t tile = 0;  ///< uses only triangles of this UDIM tile, from 1001, to which the map belongs; 0: all
    MapFileSpace from = MapFileSpace::tangent, to = MapFileSpace::tangent;
    MapReading from_reading = {}, to_reading = {};
    /// Axes of the side in object or world space, if the other side is in tangent space. Unset: the mesh's axes, or
    /// Blender's if z appears to point up in the input map (a warning reports it).
    std::optional<MapAxes> axes = {};
    /// Channel layout of `input`. The output always has x, y and z in red, green and blue; alpha is copied only if it
    /// held none of them.
    MapLayout layout = {};
    /// Bits per channel: 8 or 16 in a PNG; 16 (half) or 32 (float) in an EXR. 0: the maximum of the format.
    unsigned bits = 0;
    TexelLengths lengths = TexelLengths::even;  ///< same meaning as ConvertMapOptions::lengths
    std::uint32_t padding = 0;                  ///< same meaning as ConvertMapOptions::padding
    /// Options for tangents of meshes without tangents, which are computed as by generateFile.
    TangentOptions tangents{.convention = conventions::gltf};
    /// Options for reading models and the image. A memory limit also applies to the image; without one, images of up to
    /// 2^24 pixels are read regardless of their file size.
    FileOptions file = {};
    /// The image, instead of the file `input`; must stay valid during the call.
    std::span<const std::uint8_t> content = {};
    Sink sink = {};        ///< receives the output instead of a file
    bool dry_run = false;  ///< true: nothing is written
    Execution execution = {};
    Progress progress = {};
    MapAlpha alpha = MapAlpha::automatic;    ///< alpha of `input`, if the output has mip levels (KTX2, DDS)
    DdsHeader dds_header = DdsHeader::dx10;  ///< header of an output in DDS
};

/// Part of a model file that was used.
struct MapMeshReport {
    std::uint32_t primitive_count = 0;
    std::uint64_t triangle_count = 0;
    std::vector<std::string> materials = {};  ///< material names, without duplicates
    bool tangents_made = false;               ///< tangents were computed with `tangents`, at least for some primitives
    double scale = 1;                         ///< factor of x and y of the map in its materials
};

struct ConvertMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8,
             bits = 16;  ///< bits per channel in the files: integers of 8 or 16 bits, or floats of 16 or 32 bits
    MapMeshReport from = {}, to = {};  ///< empty if there is no mesh
    ConvertMapReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence per warning
};

/// Converts the image `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA) into `output` (.png or .exr), which is written
/// atomically. Alpha is kept; the output contains no color space information. In tangent space, the map scale of a
/// model's material is taken into account.
///
/// Errors: those of convertMap and of readers of models; cannotRead, cannotWrite, unsupportedFile, invalidFile (a
/// corrupt image; a model without required data, or whose primitives need different maps), invalidOption, tooLarge,
/// outOfMemory. Thread-safe.
Result<ConvertMapFileReport> convertMapFile(const std::string& input, const std::string& output,
                                            const ConvertMapFileOptions& options = {});

// Conversion of height maps to normal maps, from file to file.

/// Encoding of heights in an image.
enum class HeightEncoding : std::uint32_t {
    gray = 0,        ///< 0 (black) to 1 (white)
    terrainRgb = 1,  ///< meters, as in Mapbox tiles: -10000 + (65536 R + 256 G + B) / 10, with bytes R, G and B
    terrarium = 2    ///< meters, as in Mapzen tiles: 256 R + G + B / 256 - 32768
};

struct HeightToNormalFileOptions {
    /// Factor of the heights. For gray images: height of white above black, in model units with `mesh`, otherwise in
    /// the unit of texel_size. For heights in meters: 1 keeps them, 2 doubles the slopes.
    double strength = 1;
    std::string mesh = {};      ///< model that uses the map; empty: none
    std::string material = {};  ///< same meaning as ConvertMapFileOptions::material
    Green green = Green::up;    ///< direction of green in the output
    /// true: the image ends at its borders; false: it repeats, or is wrapped like the mesh's texture
    bool clamp = false;
    unsigned bits = 16;                                        ///< bits per channel of the output: 8 or 16
    TangentOptions tangents{.convention = conventions::gltf};  ///< same meaning as ConvertMapFileOptions::tangents
    FileOptions file = {};                                     ///< same meaning as ConvertMapFileOptions::file
    std::span<const std::uint8_t> content = {};                ///< the image, instead of the file `input`
    Sink sink = {};                                            ///< receives the output instead of a file
    bool dry_run = false;                                      ///< true: nothing is written
    Execution execution = {};
    HeightEncoding encoding = HeightEncoding::gray;
    /// Width and height of a texel without `mesh`, in the unit of the heights: meters for terrain. Must be positive.
    /// For a Web Mercator tile of 256 texels: 156543.03 m * cos(latitude) / 2^zoom.
    double texel_size = 1;
};

struct HeightToNormalFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8, bits = 16;  ///< bits per channel
    MapMeshReport mesh = {};              ///< empty if there is none
    HeightToNormalReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence per warning
};

/// Converts the height map `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA; the mean of color channels, unless `encoding`
/// states otherwise) to a normal map, `output` (.png). Errors: those of heightToNormal and of convertMapFile.
/// Thread-safe.
Result<HeightToNormalFileReport> heightToNormalFile(const std::string& input, const std::string& output,
                                                    const HeightToNormalFileOptions& options = {});

// Compressed normal map textures for engines, with all mip levels.

/// Two-channel formats for x and y of a normal map; readers reconstruct z.
enum class TextureFormat : std::uint32_t {
    bc5 = 0,      ///< 8 bits per texel, for desktops and consoles
    eacRg11 = 1,  ///< 8 bits per texel, for phones (OpenGL ES 3, Vulkan)
    rg8 = 2,      ///< 16 bits per texel, rounded, for uncompressed textures
    astc4x4 = 3   ///< 8 bits per texel, x in red, green and blue, y in alpha, for phones; requires the library astcenc
};

enum class TextureQuality : std::uint32_t {
    fast = 0,  ///< minimizes the error after filtering, in two rounds
    best = 1,  ///< three rounds, and more palettes: up to 3 % less error (ASTC: 33 %), 2.1 to 2.3 times as slow
    quick = 2  ///< fits each channel of a block independently: 10 to 75 % more error, in 35 to 60 % of the time
};

struct CompressMapFileOptions {
    TextureFormat format = TextureFormat::bc5;
    TextureQuality quality = TextureQuality::fast;
    /// True: signed format, which represents 0 exactly. This improves flat parts of maps with more than 8 bits.
    bool is_signed = false;
    bool levels = true;  ///< also write all smaller mip levels
    /// A glTF texture of occlusion, roughness (green) and metalness; empty: none. Its levels are written to
    /// `roughness_output`, with roughness increased by the variation of the normals in each texel.
    std::string roughness = {}, roughness_output = {};
    double roughness_factor = 1;  ///< multiplied into green first; the material's factor must then be set to 1
    unsigned zstd_level = 0;      ///< Zstandard level for the levels of a KTX2, 1 to 22; 0: no supercompression
    unsigned bits = 16;           ///< bits per channel of normal map PNGs: 8 or 16
    /// Limits for the image; same meaning as ConvertMapFileOptions::file.
    FileOptions file = {};
    /// The image, instead of the file `input`; must stay valid during the call.
    std::span<const std::uint8_t> content = {};
    Sink sink = {};        ///< receives the output, a KTX2, instead of a file; without roughness
    bool dry_run = false;  ///< true: nothing is written
    Execution execution = {};
    MapAlpha alpha = MapAlpha::automatic;    ///< alpha of `input`
    DdsHeader dds_header = DdsHeader::dx10;  ///< header of outputs in DDS
};

struct CompressMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8;        ///< bits per channel of the input
    std::string format = {};         ///< format that was written: "BC5", "BC5 signed", "PNG"
    std::uint32_t level_count = 1;   ///< levels in the output
    std::uint64_t output_bytes = 0;  ///< size of the normal map
    std::uint64_t roughness_bytes = 0;
    /// Angles between the map as three full-precision channels and as the texture, at the first level: bilinearly
    /// filtered and normalized, at 3 x 3 points per texel (of some rows of large maps). Includes the error of
    /// reconstructing z after filtering, and of vectors below the horizon.
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;
    double max_error_x = 0, max_error_y = 0;  ///< position of the maximum, in texels from the top left corner
    std::uint64_t below_horizon = 0;          ///< texels with z below 0: moved to the horizon in two-channel formats
    std::uint64_t not_unit = 0;               ///< texels whose vectors deviate from unit length by at least a tenth
    /// Mean roughness of the last level, as averaged and as written; 0 without roughness.
    double mean_roughness = 0, mean_widened_roughness = 0;
    std::vector<std::string> warnings = {};  ///< one sentence per warning
};

/// Compresses a tangent-space normal map: x in red, y in green; readers reconstruct z. `output` ends in .dds or .ktx2,
/// or in / for a folder of PNGs, NAME.0.png etc., with three channels. Input from a 16-bit PNG or an EXR gives better
/// blocks than 8-bit input. Errors: those of convertMapFile, and invalidOption: sizes of normals and roughness that do
/// not match, or a format that the container does not support. Thread-safe; the same bytes for any number of threads.
Result<CompressMapFileReport> compressMapFile(const std::string& input, const std::string& output,
                                              const CompressMapFileOptions& options = {});

struct TextureErrorOptions {
    FileOptions file = {};  ///< limits for the images; same meaning as ConvertMapFileOptions::file
    /// True: z is computed from red and green of the texture, whatever its format; blue is ignored.
    bool two_channels = false;
    Execution execution = {};
};

struct TextureErrorReport {
    std::uint32_t width = 0, height = 0;
    std::string format = {};  ///< "BC5 in a DDS"; empty for other images
    /// true: the texture has two channels, and z is computed after filtering, as in renderers
    bool makes_z = false;
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;  ///< same meaning as in CompressMapFileReport
    double max_error_x = 0, max_error_y = 0;
    std::vector<std::string> warnings = {};  ///< one sentence per warning
};

/// Measures the error of any texture (its first level) against its source normal map. Errors: those of convertMapFile,
/// and countMismatch: different sizes. Thread-safe; the same result for any number of threads.
Result<TextureErrorReport> textureErrorFile(const std::string& texture, const std::string& source,
                                            const TextureErrorOptions& options = {});

}  // namespace tspace
