// SPDX-License-Identifier: MIT
// PNG by libspng.
#include <memory>

#include "images/codecs.h"
#include "images/png_context.h"

namespace tspace {

std::optional<RgbImage> decodePng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    constexpr std::size_t kMostChunkBytes = std::size_t{64} << 20;
    const PngContext context(spng_ctx_new(0));
    spng_ihdr header{};
    why = "it is a broken PNG";
    if (!context || spng_set_chunk_limits(context.get(), kMostChunkBytes, kMostChunkBytes) != 0 ||
        spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) != 0 ||
        spng_get_ihdr(context.get(), &header) != 0) {
        return {};
    }
    const ImageSize size{header.width, header.height};
    if (isTooLarge(size, bytes.size(), most_pixels, why)) return {};
    std::size_t byte_count = 0;
    if (spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &byte_count) != 0 || byte_count != 3 * size.pixels()) {
        return {};
    }
    RgbImage image{size.width, size.height, std::vector<std::uint8_t>(byte_count)};
    if (spng_decode_image(context.get(), image.rgb.data(), byte_count, SPNG_FMT_RGB8, 0) != 0) return {};
    return image;
}

std::vector<std::uint8_t> decodePngRgba(ByteSpan bytes) {
    const PngContext context(spng_ctx_new(0));
    spng_ihdr header{};
    spng_trns transparency{};
    std::size_t byte_count = 0;
    if (!context || spng_set_png_buffer(context.get(), bytes.data(), bytes.size()) != 0 ||
        spng_get_ihdr(context.get(), &header) != 0 ||
        ((header.color_type & 4) == 0 && spng_get_trns(context.get(), &transparency) != 0) ||
        spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &byte_count) != 0) {
        return {};
    }
    std::vector<std::uint8_t> pixels(byte_count);
    if (spng_decode_image(context.get(), pixels.data(), byte_count, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS) != 0) return {};
    return pixels;
}

}  // namespace tspace
