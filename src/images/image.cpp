// SPDX-License-Identifier: MIT
// Detects formats by their first bytes, and selects the decoders.
#include "images/image.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "core/base/numbers.h"
#include "images/codecs.h"

namespace tspace {

// Headers of PNG and JPEG files, read without a library.

namespace {

/// Appends application segments (Exif, color profile) and comments, except JFIF and Adobe, which describe the storage
/// of the pixels.
void appendMetadata(ByteSpan jpeg, std::vector<std::uint8_t>& out) {
    constexpr unsigned kJfif = 0xe0, kAdobe = 0xee, kLastApplication = 0xef, kComment = 0xfe, kScan = 0xda;
    for (std::size_t at = 2; at + 4 <= jpeg.size() && jpeg[at] == 0xff && jpeg[at + 1] != kScan;) {
        const unsigned marker = jpeg[at + 1];
        const std::size_t count = 2 + (std::size_t{jpeg[at + 2]} << 8 | jpeg[at + 3]);
        if (count > jpeg.size() - at) return;
        const bool is_wanted = marker == kComment || (marker > kJfif && marker <= kLastApplication && marker != kAdobe);
        const ByteSpan segment = jpeg.subspan(at, count);
        if (is_wanted) out.insert(out.end(), segment.begin(), segment.end());
        at += count;
    }
}

}  // namespace

ImageClaim claimOfPng(ByteSpan bytes) {
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20;  // offsets in the file; the header is its first chunk
    if (bytes.size() < kHeightAt + 4) return {};
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
        return std::min(value, std::uint32_t{1} << 30);  // prevents overflow of products
    };
    const ImageSize size{number(kWidthAt), number(kHeightAt)};
    return {size, 3 * size.pixels() + 64 * std::uint64_t{size.width}};
}

/// Returns the declared size of a JPEG and the memory for decoding it. libjpeg-turbo stores the pixels, and also the
/// coefficients of all components if the components are split into several scans.
ImageClaim claimOfJpeg(ByteSpan bytes) {
    constexpr std::size_t kHeadBytes = 4, kFrameBytes = 8;
    constexpr unsigned kProgressive = 2;  // lowest two bits of the frame marker of a progressive JPEG
    ImageSize size;
    std::uint64_t components = 0;
    for (std::size_t at = 2; at + kHeadBytes + kFrameBytes < bytes.size();) {
        if (bytes[at] != 0xff || bytes[at + 1] == 0xff) {
            ++at;
            continue;
        }
        const unsigned marker = bytes[at + 1];
        const std::uint8_t* data = bytes.data() + at + kHeadBytes;
        const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        const bool is_scan = marker == 0xda;
        if (is_frame) {
            size = {std::uint32_t{data[3]} << 8 | data[4], std::uint32_t{data[1]} << 8 | data[2]};
            components = std::min<std::uint64_t>(data[5], 4);
        }
        const bool in_scans = is_frame ? (marker & 3) == kProgressive : is_scan && data[0] < components;
        if (in_scans) return {size, size.pixels() * (3 + 2 * components)};
        if (is_scan) break;
        at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
    return {size, 3 * size.pixels()};
}

std::vector<std::uint8_t> joinJpeg(ByteSpan packed, ByteSpan like) {
    // Offsets of the JFIF marker, which follows the start marker, and of its size field.
    constexpr std::size_t kMark = 2, kSizeAt = 4;
    const bool has_jfif = packed.size() > kSizeAt + 1 && packed[kMark] == 0xff && packed[kMark + 1] == 0xe0;
    const std::size_t count = has_jfif ? kMark + (std::size_t{packed[kSizeAt]} << 8 | packed[kSizeAt + 1]) : 0;
    const std::size_t head = std::min(packed.size(), kMark + count);
    std::vector<std::uint8_t> out(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(head));
    appendMetadata(like, out);
    out.insert(out.end(), packed.begin() + static_cast<std::ptrdiff_t>(head), packed.end());
    return out;
}

namespace {

bool has(ByteSpan bytes, std::size_t at, std::string_view text) {
    return bytes.size() >= at + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Names of a format, and the decoder of this build for it.
struct Codec {
    const char* name = "";
    const char* mime_type = "";
    const char* why_not = nullptr;  ///< a clause; null if the build has a decoder
    ImageClaim (*claim)(ByteSpan) = nullptr;
    std::optional<RgbImage> (*decode)(ByteSpan, std::uint64_t, std::string&, ImageUse) = nullptr;
};

/// Decodes a format that stores only integers.
template <std::optional<RgbImage> (*decode)(ByteSpan, std::uint64_t, std::string&)>
std::optional<RgbImage> decodeIntegers(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse) {
    return decode(bytes, most_pixels, why);
}

#ifdef TSPACE_HAS_OPENEXR
std::optional<RgbImage> decodeRoundedExr(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use) {
    const std::optional<FloatImage> image = decodeExr(bytes, most_pixels, why, use);
    if (!image) return {};
    return roundedImage(*image);
}
#endif

Codec exrCodec() {
    constexpr const char* kName = "EXR";
    constexpr const char* kMimeType = "image/x-exr";
#ifdef TSPACE_HAS_OPENEXR
    if (hasOpenExr()) return {kName, kMimeType, nullptr, claimOfExr, decodeRoundedExr};
    return {kName, kMimeType,
            "reading an EXR image needs the library OpenEXR (" TSPACE_OPENEXR_LIBRARY "), which is not installed"};
#else
    return {kName, kMimeType, "the image is EXR, which this build of tspace does not support"};
#endif
}

/// Why an image of an unknown format is not read: it has none of the formats that this build reads.
constexpr const char* kUnknown =
    "the image is neither "
#ifdef TSPACE_HAS_IMAGES
    "PNG, JPEG, "
#endif
#ifdef TSPACE_HAS_WEBP
    "WebP, "
#endif
#ifdef TSPACE_HAS_OPENEXR
    "EXR, "
#endif
#ifdef TSPACE_SMALL
    "KTX2 nor DDS";
#else
    "KTX2, DDS nor TGA";
#endif

Codec codecOf(ImageFormat format) {
#ifdef TSPACE_HAS_IMAGES
    const Codec png{"PNG", "image/png", nullptr, claimOfPng, decodeIntegers<decodePng>};
    const Codec jpeg{"JPEG", "image/jpeg", nullptr, claimOfJpeg, decodeIntegers<decodeJpeg>};
#else
    const Codec png{"PNG", "image/png", "this build of tspace cannot decode images"};
    const Codec jpeg{"JPEG", "image/jpeg", "this build of tspace cannot decode images"};
#endif
#ifdef TSPACE_HAS_WEBP
    const Codec webp{"WebP", "image/webp", nullptr, claimOfWebp, decodeIntegers<decodeWebp>};
#else
    const Codec webp{"WebP", "image/webp", "the image is WebP, which this build of tspace does not support"};
#endif
    switch (format) {
        case ImageFormat::png: return png;
        case ImageFormat::jpeg: return jpeg;
        case ImageFormat::webp: return webp;
        case ImageFormat::ktx2: return {"KTX2", "image/ktx2", nullptr, claimOfTexture, decodeTexture};
        case ImageFormat::basis:
            return {"Basis Universal", "image/basis",
                    "the image is a Basis Universal file (.basis), which is not supported"};
        case ImageFormat::dds: return {"DDS", "image/vnd-ms.dds", nullptr, claimOfTexture, decodeTexture};
        case ImageFormat::avif: return {"AVIF", "image/avif", "the image is AVIF, which is not supported"};
        case ImageFormat::exr: return exrCodec();
        case ImageFormat::tga:
#ifndef TSPACE_SMALL
            return {"TGA", "", nullptr, claimOfTga, decodeIntegers<decodeTga>};
#endif
        case ImageFormat::unknown: break;
    }
    return {"", "", kUnknown};
}

}  // namespace

ImageFormat imageFormat(ByteSpan bytes) {
    if (has(bytes, 0, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
    if (has(bytes, 0, "\xff\xd8\xff")) return ImageFormat::jpeg;
    if (has(bytes, 0, "RIFF") && has(bytes, 8, "WEBP")) return ImageFormat::webp;
    if (has(bytes, 0, "\xabKTX 20")) return ImageFormat::ktx2;
    if (has(bytes, 0, "sB") && bytes.size() > 3 && bytes[2] >> 4 == 1 && bytes[3] == 0) return ImageFormat::basis;
    if (has(bytes, 0, "DDS ")) return ImageFormat::dds;
    if (has(bytes, 0, "\x76\x2f\x31\x01")) return ImageFormat::exr;
    if (has(bytes, 4, "ftypavif")) return ImageFormat::avif;
#ifndef TSPACE_SMALL
    if (isTga(bytes)) return ImageFormat::tga;
#endif
    return ImageFormat::unknown;
}

const char* formatName(ImageFormat format) { return codecOf(format).name; }
const char* mimeType(ImageFormat format) { return codecOf(format).mime_type; }
const char* whyNotRead(ImageFormat format) { return codecOf(format).why_not; }

bool isTooLarge(ImageSize size, std::size_t byte_count, std::uint64_t most_pixels, std::string& why) {
    constexpr std::uint64_t kAlwaysAllowed = std::uint64_t{1} << 24;
    if (size.pixels() > most_pixels) {
        why = "the image has more pixels than tspace supports";
    } else if (size.pixels() > kAlwaysAllowed && size.pixels() / 64 > byte_count) {
        why = "the header of the image declares far more pixels than its data can contain";
    } else {
        return false;
    }
    return true;
}

ImageClaim claimOf(ByteSpan bytes) {
    const Codec codec = codecOf(imageFormat(bytes));
    return codec.claim == nullptr ? ImageClaim{} : codec.claim(bytes);
}

std::uint64_t imageWorkBytes(ByteSpan bytes) { return claimOf(bytes).work_bytes; }

ImageSize claimedSize(ByteSpan bytes) { return claimOf(bytes).size; }

std::optional<RgbImage> decodeImage(ByteSpan bytes, std::uint64_t most_pixels, std::string& why, ImageUse use) {
    const Codec codec = codecOf(imageFormat(bytes));
    if (codec.decode != nullptr) return codec.decode(bytes, most_pixels, why, use);
    why = codec.why_not;
    return {};
}

std::vector<std::uint8_t> decodeAlpha([[maybe_unused]] ByteSpan bytes) {
    const ImageFormat format = imageFormat(bytes);
    if (format == ImageFormat::ktx2 || format == ImageFormat::dds) return decodeTextureAlpha(bytes);
#ifdef TSPACE_HAS_OPENEXR
    if (format == ImageFormat::exr && hasOpenExr()) {
        std::string why;
        const std::optional<FloatImage> image = decodeExr(bytes, ~std::uint64_t{0}, why, ImageUse::vectors);
        std::vector<std::uint8_t> alpha;
        if (image) std::transform(image->alpha.begin(), image->alpha.end(), std::back_inserter(alpha), roundedChannel);
        return alpha;
    }
#endif
#ifndef TSPACE_SMALL
    if (format == ImageFormat::tga) {
        std::string why;
        std::optional<TgaImage> image = decodeTgaPixels(bytes, ~std::uint64_t{0}, why);
        return image ? std::move(image->alpha) : std::vector<std::uint8_t>();
    }
#endif
    std::vector<std::uint8_t> pixels;
#ifdef TSPACE_HAS_IMAGES
    if (format == ImageFormat::png) pixels = decodePngRgba(bytes);
#endif
#ifdef TSPACE_HAS_WEBP
    if (format == ImageFormat::webp) {
        Result<ChannelImage> image = readWebpPixels(bytes);
        if (image && image->channels == 4) pixels = std::move(image->pixels);
    }
#endif
    // The conversion works in place, because byte i is written after byte 4 i + 3 was read.
    for (std::size_t i = 0; 4 * i < pixels.size(); ++i) pixels[i] = pixels[4 * i + 3];
    pixels.resize(pixels.size() / 4);
    return pixels;
}

bool isLossyWebp(ByteSpan bytes) {
    if (imageFormat(bytes) != ImageFormat::webp) return false;
    constexpr std::size_t kHead = 12, kChunkHead = 8;
    for (std::size_t at = kHead; at + kChunkHead <= bytes.size();) {
        const std::string_view name(reinterpret_cast<const char*>(bytes.data()) + at, 4);
        if (name == "VP8 ") return true;
        if (name == "VP8L") return false;
        const std::uint64_t count = loadLittleEndian<std::uint32_t>(bytes.data() + at + 4);
        at += static_cast<std::size_t>(std::min<std::uint64_t>(kChunkHead + count + count % 2, bytes.size() - at));
    }
    return false;
}

}  // namespace tspace
