// SPDX-License-Identifier: MIT
// libspng unpacks and packs.
#include "images/png_pixels.h"

#include <cstdlib>
#include <memory>

#include "core/base/memory.h"
#include "images/flip_green.h"
#include "images/png_context.h"

namespace tspace {

namespace {

/// Thrown and caught in this file alone.
struct BrokenPng {};

void check(int result) {
    if (result == SPNG_EMEM) throw OutOfMemory{};
    if (result != 0) throw BrokenPng{};
}

/// What `body` gives, or the error of what libspng refused in it.
template <class Body>
auto orBroken(Body&& body) -> decltype(body()) {
    try {
        return body();
    } catch (const BrokenPng&) {
        return brokenPng();
    }
}

PngContext decoderOf(ByteSpan bytes) {
    constexpr std::size_t kMostChunkBytes = std::size_t{64} << 20;
    PngContext decoder(spng_ctx_new(0));
    if (!decoder) throw OutOfMemory{};
    check(spng_set_chunk_limits(decoder.get(), kMostChunkBytes, kMostChunkBytes));
    check(spng_set_png_buffer(decoder.get(), bytes.data(), bytes.size()));
    return decoder;
}

/// Packs rows into a PNG of its own.
class RowPacker {
  public:
    RowPacker(std::uint32_t width, std::uint32_t height, std::uint8_t bits, std::uint8_t color)
        : encoder_(spng_ctx_new(SPNG_CTX_ENCODER)) {
        if (!encoder_) throw OutOfMemory{};
        spng_ihdr header{};
        header.width = width;
        header.height = height;
        header.bit_depth = bits;
        header.color_type = color;
        check(spng_set_option(encoder_.get(), SPNG_ENCODE_TO_BUFFER, 1));
        check(spng_set_ihdr(encoder_.get(), &header));
        check(spng_encode_image(encoder_.get(), nullptr, 0, SPNG_FMT_RAW,
                                SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE));
    }
    void add(ByteSpan row) {
        const int result = spng_encode_row(encoder_.get(), row.data(), row.size());
        if (result != SPNG_EOI) check(result);
    }
    std::vector<std::uint8_t> finish() {
        std::size_t size = 0;
        int result = 0;
        const std::unique_ptr<void, decltype(&std::free)> file(spng_get_png_buffer(encoder_.get(), &size, &result),
                                                               &std::free);
        check(result);
        const auto* first = static_cast<const std::uint8_t*>(file.get());
        return {first, first + size};
    }

  private:
    PngContext encoder_;
};

std::vector<std::uint8_t> packRows(ByteSpan bytes, const PngHeader& header) {
    const PngContext decoder = decoderOf(bytes);
    spng_ihdr parsed{};
    check(spng_get_ihdr(decoder.get(), &parsed));  // which refuses heads that make no sense
    RowPacker packer(header.width, header.height, header.bits, header.color);
    const std::size_t row_bytes = header.rowBytes(), sample_bytes = header.bits / 8;
    std::vector<std::uint8_t> rows(header.is_interlaced ? row_bytes * header.height : row_bytes);
    if (header.is_interlaced) {
        check(spng_decode_image(decoder.get(), rows.data(), rows.size(), SPNG_FMT_RAW, 0));
    } else {
        check(spng_decode_image(decoder.get(), nullptr, 0, SPNG_FMT_RAW, SPNG_DECODE_PROGRESSIVE));
    }
    for (std::uint32_t y = 0; y < header.height; ++y) {
        const std::span<std::uint8_t> row =
            std::span(rows).subspan(header.is_interlaced ? y * row_bytes : 0, row_bytes);
        if (!header.is_interlaced) {
            const int result = spng_decode_row(decoder.get(), row.data(), row.size());
            if (result != SPNG_EOI || y + 1 != header.height) check(result);
        }
        invertGreenSamples(row, header.channels() * sample_bytes, sample_bytes);
        packer.add(row);
    }
    return packer.finish();
}

void readRows(ByteSpan bytes, const PngHeader& header) {
    const PngContext decoder = decoderOf(bytes);
    spng_ihdr parsed{};
    check(spng_get_ihdr(decoder.get(), &parsed));
    std::vector<std::uint8_t> row(std::size_t{4} * header.width);
    check(spng_decode_image(decoder.get(), nullptr, 0, SPNG_FMT_RAW, SPNG_DECODE_PROGRESSIVE));
    int result = 0;
    while (result == 0) {
        spng_row_info at{};
        if (spng_get_row_info(decoder.get(), &at) != 0) break;
        result = spng_decode_scanline(decoder.get(), row.data(), row.size());
    }
    if (result != SPNG_EOI) check(result);
}

}  // namespace

Result<std::vector<std::uint8_t>> packInverted(ByteSpan bytes, const PngHeader& header) {
    return orBroken([&]() -> Result<std::vector<std::uint8_t>> { return packRows(bytes, header); });
}

Error checkPixels(ByteSpan bytes, const PngHeader& header) {
    return orBroken([&] {
        readRows(bytes, header);
        return Error{ErrorCode::ok};
    });
}

Result<std::vector<std::uint8_t>> writePng(const ChannelImage& image) {
    const std::uint8_t color = image.channels == 4 ? PngHeader::kHasColor | PngHeader::kHasAlpha : PngHeader::kHasColor;
    const std::size_t row_bytes = std::size_t{image.channels} * image.width;
    return orBroken([&]() -> Result<std::vector<std::uint8_t>> {
        RowPacker packer(image.width, image.height, 8, color);
        for (std::size_t y = 0; y < image.height; ++y)
            packer.add(ByteSpan(image.pixels).subspan(y * row_bytes, row_bytes));
        return packer.finish();
    });
}

}  // namespace tspace
