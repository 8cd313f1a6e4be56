// SPDX-License-Identifier: MIT
// The module of the entry "tspace/textures": decodes texture files (KTX2, DDS) to pixels, and encodes normal maps as
// texture files. Functions of the caller decompress supercompressed KTX2.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>

#include "core/base/vec_math.h"
#include "exports.h"
#include "images/codecs.h"
#include "images/image.h"
#include "images/texture_vectors.h"
#include "images/textures/texture_file.h"
#include "textures/texture_levels.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// Returns whether the caller provided a decompressor for Zstandard (0) or zlib (1).
__attribute__((import_module("env"), import_name("canUnpack"))) int tspace_js_canUnpack(int zlib);
/// Decompresses to exactly `size` bytes; otherwise returns 0.
__attribute__((import_module("env"), import_name("unpack"))) int tspace_js_unpack(int zlib, const std::uint8_t* packed,
                                                                                  std::size_t bytes, std::uint8_t* to,
                                                                                  std::size_t size);
}

namespace tspace {

const char* whyNotUnpacked(Repacking repacking) {
    if (repacking == Repacking::zstd && tspace_js_canUnpack(0) == 0)
        return "the KTX2 uses Zstandard supercompression; use the option unzstd to decode it";
    if (repacking == Repacking::zlib && tspace_js_canUnpack(1) == 0)
        return "the KTX2 uses zlib supercompression; use the option unzlib to decode it";
    return nullptr;
}
bool unpackLevel(Repacking repacking, ByteSpan packed, std::span<std::uint8_t> out) {
    return tspace_js_unpack(repacking == Repacking::zlib ? 1 : 0, packed.data(), packed.size(), out.data(),
                            out.size()) != 0;
}

}  // namespace tspace

namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;  // the command-line tool's limit

/// Results of the last call, which JavaScript copies.
std::string text, format_name, container_name;
std::vector<std::uint8_t> made, made_roughness;

/// Result of readTexture in the layout that JavaScript reads.
struct TextureWords {
    std::uint32_t width, height, level_count, channels, bits, is_float, is_srgb, is_guessed, x, y, z;
    const char *format, *container, *how_read;
    const std::uint8_t* pixels;
    std::uint32_t number_kind;
};
TextureWords words;

/// Image in the layout that JavaScript writes. `bits`: bits of each channel of RGBA pixels, 8, 16 or 32 (floats); 0 if
/// `data` is a texture file of `size` bytes.
struct ImageWords {
    const std::uint8_t* data;
    std::size_t size;
    std::uint32_t width, height, bits;
};

std::uint32_t fail(ErrorCode code, std::string message) {
    error = Error{code, std::move(message)};
    return static_cast<std::uint32_t>(code);
}

bool isTextureFile(ByteSpan file) {
    const ImageFormat format = imageFormat(file);
    return format == ImageFormat::ktx2 || format == ImageFormat::dds;
}

/// Splits "BC5 in a DDS" into its two parts.
void splitName(const std::string& name) {
    constexpr std::string_view kBetween = " in a ";
    const std::size_t at = name.rfind(kBetween);
    format_name = name.substr(0, at);
    container_name = name.substr(at + kBetween.size());
}

template <class Number>
void putNumbers(const FloatImage& image, Number most) {
    made.resize(4 * sizeof(Number) * image.texels.size());
    auto* to = reinterpret_cast<Number*>(made.data());
    const auto put = [&](float part) {
        if constexpr (std::is_same_v<Number, float>) {
            *to++ = part;
        } else {
            const double scaled = static_cast<double>(part) * most + 0.5;  // rounded like a PNG
            *to++ = part > 0 ? static_cast<Number>(std::min<double>(scaled, most)) : Number{0};
        }
    };
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        for (const float part : {image.texels[i].x, image.texels[i].y, image.texels[i].z}) put(part);
        put(image.alpha.empty() ? 1 : image.alpha[i]);
    }
}

template <class Number>
void takeNumbers(const Number* from, float most, FloatImage& image) {
    bool is_opaque = true;
    image.alpha.resize(image.texels.size());
    for (std::size_t i = 0; i < image.texels.size(); ++i, from += 4) {
        const auto part = [&](std::size_t k) { return static_cast<float>(from[k]) / most; };
        image.texels[i] = {part(0), part(1), part(2)};
        image.alpha[i] = part(3);
        is_opaque = is_opaque && (part(3) == 1 || !std::isfinite(part(3)));
    }
    if (is_opaque) image.alpha.clear();
}

Result<FloatImage> imageOf(const ImageWords& given, ImageUse use) {
    if (given.bits == 0) {
        const ByteSpan file{given.data, given.size};
        if (!isTextureFile(file)) return Error{ErrorCode::unsupportedFile, "the image is neither KTX2 nor DDS"};
        std::string why;
        std::optional<FloatImage> image = decodeFloatTexture(file, kMostPixels, why, 0, use);
        if (!image) return Error{ErrorCode::invalidFile, why};
        return *std::move(image);
    }
    FloatImage image{given.width, given.height, given.bits, {}, {}};
    image.texels.resize(std::size_t{given.width} * given.height);
    if (given.bits == 8) takeNumbers(given.data, 255.0F, image);
    if (given.bits == 16) takeNumbers(reinterpret_cast<const std::uint16_t*>(given.data), 65535.0F, image);
    if (given.bits == 32) {
        takeNumbers(reinterpret_cast<const float*>(given.data), 1.0F, image);
        readFloats(use, image);
    }
    return image;
}

std::vector<std::uint8_t> fileOf(const Texture& texture, bool is_dds, DdsHeader header) {
    return is_dds ? ddsFileOf(texture, header) : *writeKtx2(texture);
}

/// Stores the report in the order of textures.js, with one warning per line.
void keepReport(const CompressMapFileReport& made_report) {
    const double numbers[] = {static_cast<double>(made_report.width),
                              static_cast<double>(made_report.height),
                              static_cast<double>(made_report.bits_before),
                              static_cast<double>(made_report.level_count),
                              static_cast<double>(made_report.output_bytes),
                              static_cast<double>(made_report.roughness_bytes),
                              made_report.mean_error_deg,
                              made_report.p99_error_deg,
                              made_report.max_error_deg,
                              made_report.max_error_x,
                              made_report.max_error_y,
                              static_cast<double>(made_report.below_horizon),
                              static_cast<double>(made_report.not_unit),
                              made_report.mean_roughness,
                              made_report.mean_widened_roughness};
    std::copy(std::begin(numbers), std::end(numbers), report);
    format_name = made_report.format;
    text.clear();
    for (const std::string& warning : made_report.warnings) text += warning + '\n';
}

}  // namespace

extern "C" {

/// Decodes a level of a texture file. `number_kind`: 0, 1 or 2 for 8 bits, 16 bits or floats; otherwise the precision
/// of the format. `makes_vectors`: decodes like commands for normal maps.
TSPACE_JS_EXPORT(readTexture)
std::uint32_t readTexture(const std::uint8_t* data, std::size_t size, std::size_t level, std::uint32_t number_kind,
                          bool makes_vectors) {
    const ByteSpan file{data, size};
    if (!isTextureFile(file)) return fail(ErrorCode::unsupportedFile, "the image is neither KTX2 nor DDS");
    std::string why;
    std::optional<FloatImage> image =
        decodeFloatTexture(file, kMostPixels, why, level, makes_vectors ? ImageUse::vectors : ImageUse::numbers);
    if (!image) return fail(ErrorCode::invalidFile, why);
    const TextureFile head = *readTextureHeader(file);
    const MapLayout layout = image->texture.layout;
    splitName(image->texture.name);
    words = {.width = image->width,
             .height = image->height,
             .level_count = static_cast<std::uint32_t>(head.levels.size()),
             .channels = head.format.channels,
             .bits = head.format.bits,
             .is_float = head.format.is_float,
             .is_srgb = head.is_srgb,
             .is_guessed = image->texture.is_guessed,
             .x = static_cast<std::uint32_t>(layout.x.channel),
             .y = static_cast<std::uint32_t>(layout.y.channel),
             .z = static_cast<std::uint32_t>(layout.z.channel),
             .format = format_name.c_str(),
             .container = container_name.c_str()};
    text.clear();
    if (makes_vectors) text = readTextureVectors(*image);
    words.how_read = text.c_str();
    // A reconstructed z has more than 8 bits, even in 8-bit formats.
    const bool is_byte = head.format.bits == 8 && text.empty();
    if (number_kind > 2) number_kind = head.format.is_float ? 2 : is_byte ? 0 : 1;
    if (number_kind == 0) putNumbers<std::uint8_t>(*image, 255);
    if (number_kind == 1) putNumbers<std::uint16_t>(*image, 65535);
    if (number_kind == 2) putNumbers<float>(*image, 1);
    words.number_kind = number_kind;
    words.pixels = made.data();
    return 0;
}

/// Converts a map as `tspace convert-map` does without a mesh. `channels`: the value of --channels, or null; `curve`:
/// the number of a MapCurve. The pixels are in textureWords(): 8 bits per channel if the only change to an 8-bit image
/// is an inverted green channel, otherwise 16.
TSPACE_JS_EXPORT(convertMap)
std::uint32_t convertMap(const ImageWords* given, const char* channels, std::uint32_t curve, bool flips_red,
                         bool flips_green) {
    Result<FloatImage> image = imageOf(*given, ImageUse::vectors);
    if (!image) return codeOf(image);
    MapLayout layout{.curve = static_cast<MapCurve>(curve)};
    if (channels != nullptr) {
        if (const std::string wrong = takeChannels(channels, layout); !wrong.empty())
            return fail(ErrorCode::invalidOption, "channels " + wrong);
    }
    if (flips_red) layout.x.is_inverted = !layout.x.is_inverted;
    text.clear();
    if (layout == MapLayout{}) {
        text = readTextureVectors(*image);
    } else {
        if (readsAlpha(layout) && image->alpha.empty())
            return fail(ErrorCode::invalidOption, "a channel is read from alpha, which the image does not have");
        readTexels(layout, *image);
    }
    if (flips_green) {
        for (Vec3& texel : image->texels) texel.y = 1 - texel.y;
    }
    const bool is_byte = image->bits == 8 && layout == MapLayout{} && text.empty();
    if (is_byte) putNumbers<std::uint8_t>(*image, 255);
    if (!is_byte) putNumbers<std::uint16_t>(*image, 65535);
    words = {.width = image->width, .height = image->height, .bits = image->bits};
    words.how_read = text.c_str();
    words.number_kind = is_byte ? 0 : 1;
    words.pixels = made.data();
    return 0;
}
TSPACE_JS_EXPORT(textureWords) const TextureWords* textureWords() { return &words; }

/// `roughness`: null, or the image whose levels are also computed. `format` and `quality`: numbers of the enumerations.
TSPACE_JS_EXPORT(compressMap)
std::uint32_t compressMap(const ImageWords* given, const ImageWords* roughness, std::uint32_t format,
                          std::uint32_t quality, bool is_signed, bool levels, double roughness_factor, bool is_dds,
                          std::uint32_t alpha, std::uint32_t dds_header) {
    const CompressMapFileOptions options{.format = static_cast<TextureFormat>(format),
                                         .quality = static_cast<TextureQuality>(quality),
                                         .is_signed = is_signed,
                                         .levels = levels,
                                         .roughness_factor = roughness_factor,
                                         .alpha = static_cast<MapAlpha>(alpha),
                                         .dds_header = static_cast<DdsHeader>(dds_header)};
    if (const std::optional<Error> fault = textureFault(options, is_dds)) return fail(fault->code, fault->message);
    Result<FloatImage> image = imageOf(*given, ImageUse::vectors);
    if (!image) return codeOf(image);
    CompressMapFileReport made_report;
    beginReport(*image, made_report);
    RoughnessLevel rough;
    if (roughness != nullptr) {
        Result<FloatImage> other = imageOf(*roughness, ImageUse::numbers);
        if (!other) return fail(other.error().code, "the roughness: " + other.error().message);
        rough = {other->width, other->height, std::move(other->texels)};
        if (const std::string why = whyGridsDiffer(rough, image->width, image->height); !why.empty())
            return fail(ErrorCode::invalidOption, "the roughness: " + why);
        if (!other->alpha.empty())
            made_report.warnings.emplace_back("the alpha channel of the roughness texture is ignored");
    }
    Parallel parallel({});
    MapLevels map = makeMapLevels(*std::move(image), options, roughness != nullptr, false, parallel, made_report);
    made_roughness = {};
    if (roughness != nullptr) {
        const std::vector<RoughnessLevel> all = makeRoughness(rough, options, map, parallel, made_report);
        made_roughness = fileOf(roughnessTexture(all), is_dds, options.dds_header);
        made_report.roughness_bytes = made_roughness.size();
    }
    if (!levels) map.levels.resize(1);
    made_report.level_count = static_cast<std::uint32_t>(map.levels.size());
    made = fileOf(*packLevels(map, options, parallel, made_report), is_dds, options.dds_header);
    made_report.output_bytes = made.size();
    keepReport(made_report);
    return 0;
}
TSPACE_JS_EXPORT(madeBytes) const std::uint8_t* madeBytes() { return made.data(); }
TSPACE_JS_EXPORT(madeRoughness) const std::uint8_t* madeRoughnessBytes() { return made_roughness.data(); }
TSPACE_JS_EXPORT(madeFormat) const char* madeFormat() { return format_name.c_str(); }
TSPACE_JS_EXPORT(madeWarnings) const char* madeWarnings() { return text.c_str(); }

}  // extern "C"
