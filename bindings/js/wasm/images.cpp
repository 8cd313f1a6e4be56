// SPDX-License-Identifier: MIT
// Image pixels, decoded and encoded by functions that the caller passes in. The declared sizes of files are checked
// here first.
#include <cstdlib>
#include <memory>
#include <string_view>

#include "codecs.h"
#include "commands/flip_green/texture_png.h"
#include "images/codecs.h"
#include "images/flip_green.h"
#include "images/image.h"
#include "model/io/file_error.h"

using namespace tspace::js;

extern "C" {

/// Decodes pixels with the given number of channels and bytes per sample. Returns null, or a text with the reason of a
/// failure, which the caller frees.
TSPACE_JS_IMPORT(decodeImage)
char* tspace_js_decodeImage(const std::uint8_t* data, std::size_t bytes, const char* mime_type, std::uint32_t width,
                            std::uint32_t height, std::uint32_t channels, std::uint32_t sample_bytes, void* to);
/// Returns the encoded file, which the caller frees; sets its size.
TSPACE_JS_IMPORT(encodeImage)
std::uint8_t* tspace_js_encodeImage(const void* pixels, const char* mime_type, std::uint32_t width,
                                    std::uint32_t height, std::uint32_t channels, std::uint32_t sample_bytes,
                                    std::uint32_t quality, std::size_t* bytes);

}  // extern "C"

namespace tspace {

namespace {

/// Returns why decoding failed, or an empty string.
std::string decodeInto(ByteSpan bytes, ImageSize size, std::uint32_t channels, std::uint32_t sample_bytes, void* to) {
    const char* type = mimeType(imageFormat(bytes));
    const std::unique_ptr<char, decltype(&std::free)> why(
        tspace_js_decodeImage(bytes.data(), bytes.size(), type, size.width, size.height, channels, sample_bytes, to),
        &std::free);
    return why ? why.get() : "";
}

Result<std::vector<std::uint8_t>> encode(const void* pixels, ImageFormat format, ImageSize size, std::uint32_t channels,
                                         std::uint32_t sample_bytes, int quality) {
    if (tspace_js_hasCodec(Codec::imageEncoder) == 0)
        return Error{ErrorCode::unsupportedFile, "this needs the option encodeImage"};
    std::size_t count = 0;
    const std::unique_ptr<std::uint8_t, decltype(&std::free)> file(
        tspace_js_encodeImage(pixels, mimeType(format), size.width, size.height, channels, sample_bytes,
                              static_cast<std::uint32_t>(quality), &count),
        &std::free);
    std::vector<std::uint8_t> bytes(file.get(), file.get() + count);
    if (imageFormat(bytes) != format)
        return Error{ErrorCode::unsupportedFile, "encodeImage did not return a " + std::string(formatName(format))};
    return bytes;
}

/// Returns why the image cannot be decoded, or an empty string.
std::string faultOf(ByteSpan bytes, ImageSize size, std::uint64_t most_pixels) {
    std::string why;
    if (tspace_js_hasCodec(Codec::imageDecoder) == 0) return "this needs the option decodeImage";
    if (size.pixels() == 0) return std::string("the ") + formatName(imageFormat(bytes)) + " is damaged";
    constexpr std::uint64_t kMostBytes = 4 * sizeof(std::uint16_t);  // per pixel
    if (size.pixels() > SIZE_MAX / kMostBytes) return "the image has more pixels than the memory can hold";
    isTooLarge(size, bytes.size(), most_pixels, why);
    return why;
}

std::optional<RgbImage> decode(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    const ImageSize size = claimedSize(bytes);
    why = faultOf(bytes, size, most_pixels);
    if (!why.empty()) return {};
    RgbImage image{size.width, size.height, std::vector<std::uint8_t>(3 * size.pixels())};
    why = decodeInto(bytes, size, 3, 1, image.rgb.data());
    if (!why.empty()) return {};
    return image;
}

Result<ChannelImage> decodeChannels(ByteSpan bytes, unsigned channels) {
    const ImageSize size = claimedSize(bytes);
    std::string why = faultOf(bytes, size, ~std::uint64_t{0});
    ChannelImage image{size.width, size.height, channels, {}};
    if (why.empty()) {
        image.pixels.resize(channels * size.pixels());
        why = decodeInto(bytes, size, channels, 1, image.pixels.data());
    }
    if (!why.empty()) return Error{ErrorCode::unsupportedFile, why};
    return image;
}

/// First chunk of a WebP: its type, its size, and whether it has alpha or is animated.
struct WebpHead {
    ImageSize size = {};
    bool is_lossless = false, has_alpha = false, is_animated = false;
};

WebpHead webpHead(ByteSpan bytes) {
    constexpr std::size_t kChunkAt = 12, kHead = 8, kNeeded = 10;
    if (bytes.size() < kChunkAt + kHead + kNeeded) return {};
    const std::string_view type(reinterpret_cast<const char*>(bytes.data()) + kChunkAt, 4);
    const ByteSpan data = bytes.subspan(kChunkAt + kHead);
    const auto number = [&](std::size_t at, unsigned count) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < count; ++i) value |= std::uint32_t{data[at + i]} << (8 * i);
        return value;
    };
    constexpr std::uint32_t kSizeBits = 0x3fff;
    if (type == "VP8X") {
        constexpr std::uint32_t kAlpha = 0x10, kAnimation = 0x02;
        const std::uint32_t flags = data[0];
        return {{number(4, 3) + 1, number(7, 3) + 1}, false, (flags & kAlpha) != 0, (flags & kAnimation) != 0};
    }
    if (type == "VP8L") {
        const std::uint32_t bits = number(1, 4);
        return {{(bits & kSizeBits) + 1, (bits >> 14 & kSizeBits) + 1}, true, (bits >> 28 & 1) != 0, false};
    }
    if (type != "VP8 ") return {};
    return {{number(6, 2) & kSizeBits, number(8, 2) & kSizeBits}, false, false, false};
}

}  // namespace

ImageClaim claimOfWebp(ByteSpan bytes) {
    const WebpHead head = webpHead(bytes);
    return {head.size, (head.is_lossless || head.has_alpha ? 8 : 4) * head.size.pixels()};
}

std::optional<RgbImage> decodePng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    return decode(bytes, most_pixels, why);
}
std::vector<std::uint8_t> decodePngRgba(ByteSpan bytes) {
    constexpr std::size_t kColorAt = 25;
    const ImageSize size = claimedSize(bytes);
    if (bytes.size() <= kColorAt || (bytes[kColorAt] & PngHeader::kHasAlpha) == 0) return {};
    if (!faultOf(bytes, size, ~std::uint64_t{0}).empty()) return {};
    std::vector<std::uint8_t> pixels(4 * size.pixels());
    if (!decodeInto(bytes, size, 4, 1, pixels.data()).empty()) return {};
    return pixels;
}
std::optional<RgbImage> decodeJpeg(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    return decode(bytes, most_pixels, why);
}
std::optional<RgbImage> decodeWebp(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    if (!webpHead(bytes).is_animated) return decode(bytes, most_pixels, why);
    why = "the WebP is animated, which is not supported";
    return {};
}

Result<std::vector<std::uint8_t>> packInverted(ByteSpan bytes, const PngHeader& header) {
    const ImageSize size{header.width, header.height};
    if (header.bits != 8 && header.bits != 16) return brokenPng();
    if (std::string why = faultOf(bytes, size, ~std::uint64_t{0}); !why.empty())
        return Error{ErrorCode::unsupportedFile, why};
    const auto channels = static_cast<std::uint32_t>(header.channels());
    const std::size_t sample_bytes = header.bits / 8;
    std::vector<std::uint8_t> pixels(size.pixels() * channels * sample_bytes);
    if (std::string why = decodeInto(bytes, size, channels, static_cast<std::uint32_t>(sample_bytes), pixels.data());
        !why.empty())
        return Error{ErrorCode::unsupportedFile, why};
    invertGreenSamples(pixels, channels * sample_bytes, sample_bytes);
    Result<std::vector<std::uint8_t>> packed =
        encode(pixels.data(), ImageFormat::png, size, channels, static_cast<std::uint32_t>(sample_bytes), 100);
    constexpr std::size_t kHeaderAt = 16, kSame = 10;  // offset and size of width, height, bits and color type
    if (!packed) return packed;
    const bool is_same =
        packed->size() > kHeaderAt + kSame &&
        std::equal(packed->begin() + kHeaderAt, packed->begin() + kHeaderAt + kSame, bytes.begin() + kHeaderAt);
    if (!is_same) {
        return Error{ErrorCode::unsupportedFile,
                     "encodeImage returned a PNG whose size, channels or bits differ from its input"};
    }
    return packed;
}

Error checkPixels(ByteSpan bytes, const PngHeader&) {
    std::string why;
    return decode(bytes, ~std::uint64_t{0}, why) ? Error{ErrorCode::ok} : Error{ErrorCode::unsupportedFile, why};
}

Result<ChannelImage> readJpegPixels(ByteSpan bytes) { return decodeChannels(bytes, 3); }
Result<ChannelImage> readWebpPixels(ByteSpan bytes) {
    const WebpHead head = webpHead(bytes);
    if (head.is_animated) return Error{ErrorCode::unsupportedFile, "the WebP is animated, which is not supported"};
    return decodeChannels(bytes, head.has_alpha ? 4 : 3);
}

Result<std::vector<std::uint8_t>> writePng(const ChannelImage& image) {
    return encode(image.pixels.data(), ImageFormat::png, {image.width, image.height}, image.channels, 1, 100);
}
Result<std::vector<std::uint8_t>> writeJpeg(const ChannelImage& image, int quality, ByteSpan like) {
    const ImageSize size{image.width, image.height};
    Result<std::vector<std::uint8_t>> packed =
        encode(image.pixels.data(), ImageFormat::jpeg, size, image.channels, 1, quality);
    if (!packed) return packed;
    return joinJpeg(*packed, like);
}
Result<std::vector<std::uint8_t>> writeWebp(const ChannelImage& image) {
    return encode(image.pixels.data(), ImageFormat::webp, {image.width, image.height}, image.channels, 1, 100);
}

// The module has no decoders of texture files: callers provide decoders only for other images.
namespace {

std::string whyNoTexture(ByteSpan bytes) {
    return std::string("the image is ") + formatName(imageFormat(bytes)) + ", which is not supported";
}

}  // namespace

ImageClaim claimOfTexture(ByteSpan) { return {}; }
std::optional<RgbImage> decodeTexture(ByteSpan bytes, std::uint64_t, std::string& why, ImageUse) {
    why = whyNoTexture(bytes);
    return {};
}
std::vector<std::uint8_t> decodeTextureAlpha(ByteSpan) { return {}; }
std::optional<TextureFacts> textureFacts(ByteSpan) { return {}; }
Result<FlippedImage> flipTexture(ByteSpan bytes, ImageFileFormat) {
    return Error{ErrorCode::unsupportedFile, whyNoTexture(bytes)};
}
FlippedImage flippedTexturePng(ByteSpan bytes) { failFile(ErrorCode::unsupportedFile, whyNoTexture(bytes)); }

}  // namespace tspace
