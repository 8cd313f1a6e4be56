// SPDX-License-Identifier: MIT
// PNG by libspng; JPEG in jpeg.cpp.
#include "check/image.h"

#include <algorithm>
#include <memory>
#include <string_view>

#ifdef TSPACE_HAS_IMAGES
#include <spng.h>
#endif

namespace tspace {

namespace {

constexpr std::string_view kPngHead = "\x89PNG\r\n\x1a\n", kJpegHead = "\xff\xd8\xff";

bool startsWith(std::span<const std::uint8_t> bytes, std::string_view head) {
    return bytes.size() >= head.size() &&
           std::equal(head.begin(), head.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

#ifdef TSPACE_HAS_IMAGES

/// A few bytes may claim any number of pixels. What is honest is rarely more than 64 times as large as its file.
bool isTooLarge(std::uint64_t pixels, std::size_t byte_count, std::uint64_t most_pixels, std::string& why) {
    constexpr std::uint64_t kAlwaysAllowed = std::uint64_t{1} << 24;
    if (pixels > most_pixels) {
        why = "it has more pixels than are looked at";
    } else if (pixels > kAlwaysAllowed && pixels / 64 > byte_count) {
        why = "it claims far more pixels than its bytes can hold";
    } else {
        return false;
    }
    return true;
}

/// What libjpeg-turbo holds: pixels; and the coefficients of all components where these come in several scans.
std::uint64_t jpegWorkBytes(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kHeadBytes = 4, kFrameBytes = 8;
    constexpr unsigned kProgressive = 2;  // the last two bits of a frame's marker
    std::uint64_t pixels = 0, components = 0;
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
            const std::uint64_t height = std::uint64_t{data[1]} << 8 | data[2],
                                width = std::uint64_t{data[3]} << 8 | data[4];
            pixels = width * height;
            components = std::min<std::uint64_t>(data[5], 4);
        }
        const bool in_scans = is_frame ? (marker & 3) == kProgressive : is_scan && data[0] < components;
        if (in_scans) return pixels * (3 + 2 * components);
        if (is_scan) break;
        at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
    return 3 * pixels;
}

struct FreeContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};

std::optional<RgbImage> decodePng(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels, std::string& why) {
    constexpr std::size_t kMostChunkBytes = std::size_t{64} << 20;
    const std::unique_ptr<spng_ctx, FreeContext> context(spng_ctx_new(0));
    spng_ihdr header{};
    why = "it is a broken PNG";
    if (!context || spng_set_chunk_limits(context.get(), kMostChunkBytes, kMostChunkBytes) != 0 ||
        spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) != 0 ||
        spng_get_ihdr(context.get(), &header) != 0) {
        return {};
    }
    if (isTooLarge(std::uint64_t{header.width} * header.height, bytes.size(), most_pixels, why)) return {};
    RgbImage image{header.width, header.height, {}};
    std::size_t size = 0;
    if (spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &size) != 0 ||
        size != std::size_t{3} * header.width * header.height) {
        return {};
    }
    image.rgb.resize(size);
    if (spng_decode_image(context.get(), image.rgb.data(), size, SPNG_FMT_RGB8, 0) != 0) return {};
    return image;
}

#endif

}  // namespace

std::uint64_t imageWorkBytes(std::span<const std::uint8_t> bytes) {
#ifdef TSPACE_HAS_IMAGES
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20;  // of the header chunk, which is the first
    const auto number = [&](std::size_t at) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[at + i];
        return std::min(value, std::uint64_t{1} << 30);  // no product overflows
    };
    if (startsWith(bytes, kPngHead)) {
        return bytes.size() < kHeightAt + 4 ? 0 : 3 * number(kWidthAt) * number(kHeightAt) + 64 * number(kWidthAt);
    }
    if (startsWith(bytes, kJpegHead)) return jpegWorkBytes(bytes);
#else
    (void)bytes;
#endif
    return 0;
}

std::optional<RgbImage> decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels, std::string& why) {
    const bool is_png = startsWith(bytes, kPngHead);
    if (!is_png && !startsWith(bytes, kJpegHead)) {
        why = "it is neither PNG nor JPEG";
        return {};
    }
#ifdef TSPACE_HAS_IMAGES
    if (is_png) return decodePng(bytes, most_pixels, why);
    std::uint32_t width = 0, height = 0;
    why = "it is a broken JPEG";
    if (!readJpegSize(bytes, width, height)) return {};
    if (isTooLarge(std::uint64_t{width} * height, bytes.size(), most_pixels, why)) return {};
    return decodeJpeg(bytes, width, height);
#else
    (void)most_pixels;
    why = "tspace was built without decoders for images";
    return {};
#endif
}

}  // namespace tspace
