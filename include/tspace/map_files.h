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

// Images of normal maps: their formats, their channels, and the inversion of green. CMake target tspace::asset. Reads PNG (8
// and 16 bits), JPEG and WebP, detected by content, if tspace was built with their libraries; KTX2, DDS and TGA (which becomes
// a PNG) always.
//
// All functions are thread-safe, and give the same bytes each time.

// Layout of a normal map's vectors in an image, if it is not x, y and z in red, green and blue.

/// A channel of an image.
enum class MapChannel : std::uint32_t {
    red = 0,
    green = 1,
    blue = 2,
    alpha = 3,
    none = 4  ///< for z only: it is sqrt(1 - x^2 - y^2)
};

/// The curve that was applied to the numbers of an image that was taken for a picture.
enum class MapCurve : std::uint32_t {
    none = 0,
    srgb = 1,       ///< the sRGB curve was put on: a flat texel is (188, 188, 255)
    linearised = 2  ///< it was taken off: a flat texel is (55, 55, 255)
};

struct MapComponent {
    MapChannel channel = MapChannel::red;
    bool is_inverted = false;  ///< it holds 1 - c

    friend bool operator==(const MapComponent&, const MapComponent&) = default;
};

/// The default is what glTF has.
struct MapLayout {
    MapComponent x{MapChannel::red}, y{MapChannel::green}, z{MapChannel::blue};
    MapCurve curve = MapCurve::none;  ///< encoding of red, green and blue; alpha is always linear

    friend bool operator==(const MapLayout&, const MapLayout&) = default;
};

/// The texel (x, y, z), each from 0 to 1 as in a normal map, of an image with that layout. Where z is to be made of x and y
/// and these are longer than 1, z is 0.5. Thread-safe.
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
    /// Format of the output: that of the input, or PNG. Others are rejected (unsupportedFile), because they would lose bits or
    /// depth.
    ImageFileFormat format = ImageFileFormat::sameAsInput;
    /// JPEG quality, 1 to 100. The default adds a smaller error than rounding to 8 bits.
    int jpeg_quality = 98;
    /// Like FileOptions::memory_limit_bytes.
    std::uint64_t memory_limit_bytes = 0;

    // For flipGreenFile.

    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    /// Like GenerateOptions::sink: receives the bytes instead of the file `output`.
    Sink sink = {};
    bool dry_run = false;  ///< everything but writing
    bool sync = true;      ///< like FileOptions::sync
};

struct FlipGreenReport {
    ImageFileFormat format = ImageFileFormat::png;  ///< format of the output; never sameAsInput
    std::uint32_t width = 0, height = 0;
    std::uint32_t bits = 8;  ///< bits per channel
    /// Every texel has exactly 255 - G (65535 - G with 16 bits), and all other channels are as they were. false: a JPEG was
    /// written, whose texels are rounded again, or a PNG of a KTX2 or DDS that has numbers between the integers.
    bool is_exact = true;
    std::vector<std::string> warnings = {};  ///< one sentence each
};

struct FlippedImage {
    std::vector<std::uint8_t> bytes = {};  ///< the image file
    FlipGreenReport report = {};
};

/// Inverts the green channel of an image: makes a normal map for OpenGL of one for DirectX, and back.
///
/// PNG keeps its colour type, bits, alpha, palette, and every chunk; rows come one after the other (interlaced files no
/// longer are). Of a transparent or background colour green is inverted too. JPEG is compressed once more, without
/// subsampling, and keeps its Exif data, profile and comments. WebP is written without loss, without metadata. KTX2
/// and DDS keep their blocks, of which green is inverted exactly in all levels: uncompressed integers and BC5; others, and KTX2
/// packed by Zstandard or zlib, are refused (unsupportedFile), but can be written as PNG: x, y and z, where z is made if there
/// are two channels. Whatever a file says
/// about its colour space stays as it is, and nothing is added: glTF takes normal maps as numbers.
///
/// Errors: unsupportedFile (not an image that this build reads; grey, so that there is no green channel; animated; a
/// format that cannot be written), invalidFile (broken), invalidOption, tooLarge, outOfMemory. Time and memory: linear in the
/// pixels; a PNG that is not interlaced needs a few rows and the size of its file. tooLarge also for a PNG that claims to
/// unpack to more than 16 times the memory limit, 1 GB and more by default.
Result<FlippedImage> flipGreen(std::span<const std::uint8_t> image, const FlipGreenOptions& options = {});

/// The same from file to file; `output` may be `input`. Where no format is asked for, the name of the output decides: .png, .jpg,
/// .jpeg, .webp, .ktx2 or .dds. The output appears at once, or not at all. Errors also: cannotRead, cannotWrite; unsupportedFile for
/// another extension. Returns what was done.
Result<FlipGreenReport> flipGreenFile(const std::string& input, const std::string& output,
                                      const FlipGreenOptions& options = {});

// Conversion of normal maps from file to file, with the frames of model files.

/// The space of the vectors of a map in a file.
enum class MapFileSpace : std::uint32_t {
    tangent = 0,
    object = 1,  ///< the coordinates of the mesh, as the model file has them
    world = 2    ///< axes of the scene: the mesh's nodes, which must agree, rotate and scale the vectors
};

/// The meaning of the alpha channel of a normal map from which smaller mip levels are made.
enum class MapAlpha : std::uint32_t {
    automatic = 0,  ///< coverage where texels with alpha 0 hold no unit vectors and nearly all others do; else data
    coverage =
        1,    ///< fraction of a texel that is surface, as in sprites and foliage: mip levels are alpha-weighted means
    data = 2  ///< anything else, such as heights: it is left out
};

/// The header of a DDS.
enum class DdsHeader : std::uint32_t {
    dx10 = 0,    ///< Direct3D 10, with a DXGI number: the only one that names every format
    legacy = 1,  ///< Direct3D 9: BC5 as FourCC ATI2 (signed: BC5S), plain texels by masks
    bc5u = 2     ///< like legacy, but BC5 as FourCC BC5U
};

struct ConvertMapFileOptions {
    std::string mesh = {};     ///< the model that the map was made for; empty: none is needed
    std::string to_mesh = {};  ///< the model that it is to be shown on: the same surface and UVs; empty: `mesh`
    /// Takes the primitives of the material with this name. Empty: those whose material names an image of the map's name,
    /// else all that have UVs.
    std::string material = {};
    std::uint32_t tile = 0;  ///< takes the triangles of this UDIM tile, whose file the map is: 1001 and on; 0: all
    MapFileSpace from = MapFileSpace::tangent, to = MapFileSpace::tangent;
    MapReading from_reading = {}, to_reading = {};
    /// Of the side that is in object or world space, where the other is in tangent space. Nothing: those of the mesh, or, where a
    /// map that is read looks as if z pointed up in it, those of Blender (a warning says so).
    std::optional<MapAxes> axes = {};
    /// Where `input` keeps its vectors: it is read by this first. The output always has x, y and z in red, green and blue,
    /// and alpha only where that was none of them.
    MapLayout layout = {};
    /// Bits of a channel: 8 or 16 in a PNG; 16 (half) or 32 (float) in an EXR. 0: the most that the format has.
    unsigned bits = 0;
    TexelLengths lengths = TexelLengths::even;  ///< ConvertMapOptions::lengths
    std::uint32_t padding = 0;                  ///< ConvertMapOptions::padding
    /// For meshes without tangents, which get them as generateFile gives them.
    TangentOptions tangents{.convention = conventions::gltf};
    /// How models and the image are read. A limit on memory counts for the image too; without one, images of up to 2^24
    /// pixels are read whatever their files weigh.
    FileOptions file = {};
    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    Sink sink = {};                              ///< takes the output in place of a file
    bool dry_run = false;                        ///< everything but writing
    Execution execution = {};
    Progress progress = {};
    MapAlpha alpha = MapAlpha::automatic;    ///< alpha of `input`, if the output has mip levels (KTX2, DDS)
    DdsHeader dds_header = DdsHeader::dx10;  ///< header of an output in DDS
};

/// The part of a model file that was used.
struct MapMeshReport {
    std::uint32_t primitive_count = 0;
    std::uint64_t triangle_count = 0;
    std::vector<std::string> materials = {};  ///< names, each once
    bool tangents_made = false;               ///< tangents were computed by `tangents`, for some of them at least
    double scale = 1;                         ///< factor of x and y of the map in their materials
};

struct ConvertMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8,
             bits = 16;                ///< bits per channel in the files: integers of 8 or 16, or floats of 16 or 32
    MapMeshReport from = {}, to = {};  ///< empty where there is no mesh
    ConvertMapReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Converts the image `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA) into `output` (.png or .exr), which appears at once, or not at all. Alpha stays. The
/// output has no word on colours. In tangent space the scale that a model's material gives the map counts on its side.
///
/// Errors: those of convertMap and of readers of models; cannotRead, cannotWrite, unsupportedFile, invalidFile (an image that
/// is broken; a model without what is needed, or whose primitives need a map each), invalidOption, tooLarge, outOfMemory. Thread-safe.
Result<ConvertMapFileReport> convertMapFile(const std::string& input, const std::string& output,
                                            const ConvertMapFileOptions& options = {});

// From heights to normals, from file to file.

/// How an image stores heights.
enum class HeightEncoding : std::uint32_t {
    gray = 0,  ///< from 0 (black) to 1 (white)
    terrainRgb =
        1,         ///< meters, as Mapbox's tiles have them: -10000 + (65536 R + 256 G + B) / 10, with bytes R, G and B
    terrarium = 2  ///< meters, as Mapzen's tiles have them: 256 R + G + B / 256 - 32768
};

struct HeightToNormalFileOptions {
    /// Factor of the heights. Of gray images: the height of white above black, with `mesh` in units of the model, else in the unit of
    /// texel_size. Of heights in meters: 1 keeps them, 2 makes slopes twice as steep.
    double strength = 1;
    std::string mesh = {};      ///< the model that shows the map; empty: none
    std::string material = {};  ///< like ConvertMapFileOptions::material
    Green green = Green::up;    ///< direction of green in the output
    bool clamp = false;  ///< the image ends at its borders; else it repeats, or does what the mesh's texture does
    unsigned bits = 16;  ///< bits per channel of the output: 8 or 16
    TangentOptions tangents{.convention = conventions::gltf};  ///< like ConvertMapFileOptions::tangents
    FileOptions file = {};                                     ///< like ConvertMapFileOptions::file
    std::span<const std::uint8_t> content = {};                ///< the image, in place of the file `input`
    Sink sink = {};                                            ///< takes the output in place of a file
    bool dry_run = false;                                      ///< everything but writing
    Execution execution = {};
    HeightEncoding encoding = HeightEncoding::gray;
    /// Width and height of a texel without `mesh`, in the unit of the heights: meters for terrain. Above 0. A tile of 256 texels of Web
    /// Mercator has 156543.03 m * cos(latitude) / 2^zoom.
    double texel_size = 1;
};

struct HeightToNormalFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8, bits = 16;  ///< bits per channel
    MapMeshReport mesh = {};              ///< empty where there is none
    HeightToNormalReport texels = {};
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// Makes a normal map, `output` (.png), of the height map `input` (PNG, JPEG, WebP, EXR, KTX2, DDS, TGA; of colors the mean counts,
/// unless `encoding` says otherwise).
/// Errors: those of heightToNormal and of convertMapFile. Thread-safe.
Result<HeightToNormalFileReport> heightToNormalFile(const std::string& input, const std::string& output,
                                                    const HeightToNormalFileOptions& options = {});

// Normal maps as compressed textures for engines, with all their levels.

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
    unsigned bits = 16;           ///< bits per channel of the PNGs of normals: 8 or 16
    /// Limits for the image: as ConvertMapFileOptions::file.
    FileOptions file = {};
    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    Sink sink = {};                              ///< takes the output, a KTX2, in place of a file; without roughness
    bool dry_run = false;                        ///< everything but writing
    Execution execution = {};
    MapAlpha alpha = MapAlpha::automatic;    ///< alpha of `input`
    DdsHeader dds_header = DdsHeader::dx10;  ///< header of outputs in DDS
};

struct CompressMapFileReport {
    std::uint32_t width = 0, height = 0;
    unsigned bits_before = 8;        ///< bits per channel of the input
    std::string format = {};         ///< what was written: "BC5", "BC5 signed", "PNG"
    std::uint32_t level_count = 1;   ///< in the output
    std::uint64_t output_bytes = 0;  ///< size of the normal map
    std::uint64_t roughness_bytes = 0;
    /// Between the map as three channels of full depth and as the texture, of the first level: bilinear, then unit, at 3 x 3
    /// points a texel (of some rows, where it is large). What rebuilding z after the filter costs is in it, and what looks below
    /// the horizon.
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;
    double max_error_x = 0, max_error_y = 0;  ///< position of the maximum, in texels from the top left corner
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
    double mean_error_deg = 0, p99_error_deg = 0, max_error_deg = 0;  ///< as in CompressMapFileReport
    double max_error_x = 0, max_error_y = 0;
    std::vector<std::string> warnings = {};  ///< one sentence each
};

/// How far anybody's texture (its first level) is from the normal map that it was made of. Errors: those of convertMapFile, and countMismatch: of
/// other sizes. Thread-safe; the same for any number of threads.
Result<TextureErrorReport> textureErrorFile(const std::string& texture, const std::string& source,
                                            const TextureErrorOptions& options = {});

}  // namespace tspace
