// SPDX-License-Identifier: MIT
// Images of normal maps: their formats, their channels, and the inversion of green. CMake target tspace::asset. Reads PNG (8
// and 16 bits), JPEG and WebP, detected by content, if tspace was built with their libraries; KTX2, DDS and TGA (which becomes
// a PNG) always.
//
// All functions are thread-safe, and give the same bytes each time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tspace/callbacks.h"
#include "tspace/result.h"
#include "tspace/vec.h"

namespace tspace {

// Where an image keeps the vectors of a normal map, when that is not x, y and z in red, green and blue.

/// A channel of an image.
enum class MapChannel : std::uint32_t {
    red = 0,
    green = 1,
    blue = 2,
    alpha = 3,
    none = 4  ///< of z only: it is the root of 1 - x^2 - y^2
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
    MapCurve curve = MapCurve::none;  ///< of red, green and blue; alpha never has one

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
    /// Of the output: that of the input, or PNG. Others are refused (unsupportedFile): they would lose bits or depth.
    ImageFileFormat format = ImageFileFormat::sameAsInput;
    /// Where a JPEG is written: 1 to 100. The default adds less than the rounding to 8 bits did.
    int jpeg_quality = 98;
    /// As FileOptions::memory_limit_bytes.
    std::uint64_t memory_limit_bytes = 0;

    // For flipGreenFile.

    std::span<const std::uint8_t> content = {};  ///< the image, in place of the file `input`; must stay while it runs
    /// As GenerateOptions::sink: gets the bytes in place of the file `output`, of which nothing is asked then.
    Sink sink = {};
    bool dry_run = false;  ///< everything but writing
    bool sync = true;      ///< as FileOptions::sync
};

struct FlipGreenReport {
    ImageFileFormat format = ImageFileFormat::png;  ///< of the output; never sameAsInput
    std::uint32_t width = 0, height = 0;
    std::uint32_t bits = 8;  ///< of a channel
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

}  // namespace tspace
