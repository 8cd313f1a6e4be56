// SPDX-License-Identifier: MIT
// Contains all calls of libspng: decoding to bytes and floats, encoding, and recompressing a PNG with inverted green.
#include <spng.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "core/base/memory.h"
#include "images/codecs.h"
#include "images/flip_green.h"
#include "images/tracked_memory.h"

namespace tspace {
namespace {

constexpr std::size_t kMaxChunkBytes = std::size_t{64} << 20;

struct FreePngContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using PngContext = std::unique_ptr<spng_ctx, FreePngContext>;

/// Creates a decoder or encoder. Never null.
PngContext makeContext(int flags) {
    has_allocation_failed = false;
    spng_alloc memory{trackedMalloc, trackedRealloc, trackedCalloc, std::free};
    PngContext context(spng_ctx_new2(&memory, flags));
    if (!context) throw OutOfMemory{};
    return context;
}

/// Returns whether a call succeeded. Throws OutOfMemory if it failed for lack of memory, which libspng also reports as
/// corrupt data.
bool succeeds(int result) {
    if (result == SPNG_EMEM || (result != 0 && has_allocation_failed)) throw OutOfMemory{};
    return result == 0;
}

/// Opens a PNG for decoding. Returns false, with the reason in `why`, if it is corrupt or too large.
bool openPng(ByteSpan bytes, std::uint64_t most_pixels, PngContext& context, spng_ihdr& header, std::string& why) {
    why = "the PNG is damaged";
    context = makeContext(0);
    return succeeds(spng_set_chunk_limits(context.get(), kMaxChunkBytes, kMaxChunkBytes)) &&
           succeeds(spng_set_png_buffer(context.get(), bytes.data(), bytes.size())) &&
           succeeds(spng_get_ihdr(context.get(), &header)) &&
           !isTooLarge({header.width, header.height}, bytes.size(), most_pixels, why);
}

// -- samples to encode --

unsigned nearest(float part, unsigned largest) {
    if (!(part > 0)) return 0;
    const double scaled = static_cast<double>(part) * largest + 0.5;
    return scaled >= largest ? largest : static_cast<unsigned>(scaled);
}

/// Returns the samples of all channels in sequence; 16-bit samples in native byte order, which libspng converts.
std::vector<std::uint8_t> samplesOf(const FloatImage& image, unsigned bits) {
    const bool has_alpha = !image.alpha.empty();
    const std::size_t sample_bytes = bits / 8;
    std::vector<std::uint8_t> samples(image.texels.size() * (has_alpha ? 4 : 3) * sample_bytes);
    std::uint8_t* at = samples.data();
    const auto put = [&](float part) {
        const unsigned value = nearest(part, bits == 16 ? 65535 : 255);
        const auto word = static_cast<std::uint16_t>(value);
        if (bits == 16) {
            std::memcpy(at, &word, sizeof word);
        } else {
            *at = static_cast<std::uint8_t>(value);
        }
        at += sample_bytes;
    };
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        put(image.texels[i].x);
        put(image.texels[i].y);
        put(image.texels[i].z);
        if (has_alpha) put(image.alpha[i]);
    }
    return samples;
}

// -- streaming rows --

/// Exception for corrupt PNG data; thrown and caught in this file only.
struct BrokenPng {};

void check(int result) {
    if (!succeeds(result)) throw BrokenPng{};
}

/// Returns the result of `body`, or an error if libspng rejected the data.
template <class Body>
auto orBroken(Body&& body) -> decltype(body()) {
    try {
        return body();
    } catch (const BrokenPng&) {
        return brokenPng();
    }
}

PngContext decoderOf(ByteSpan bytes) {
    PngContext decoder = makeContext(0);
    check(spng_set_chunk_limits(decoder.get(), kMaxChunkBytes, kMaxChunkBytes));
    check(spng_set_png_buffer(decoder.get(), bytes.data(), bytes.size()));
    return decoder;
}

/// Compresses rows to a new PNG.
class RowPacker {
  public:
    /// `is_raw`: 16-bit samples are in the byte order of the file, and the filter of each row is chosen from all.
    /// Otherwise they are in native order, and all rows have one filter: trying all doubles the time and saves 1 % of
    /// the bytes.
    RowPacker(std::uint32_t width, std::uint32_t height, std::uint8_t bits, std::uint8_t color, bool is_raw)
        : encoder_(makeContext(SPNG_CTX_ENCODER)) {
        spng_ihdr header{};
        header.width = width;
        header.height = height;
        header.bit_depth = bits;
        header.color_type = color;
        check(spng_set_option(encoder_.get(), SPNG_ENCODE_TO_BUFFER, 1));
        if (!is_raw) {
            // The low byte of 16-bit samples is mostly noise: higher levels take four times as long and save 10 %.
            const int level = bits == 16 ? 1 : 6;  // 6: the default of zlib
            check(spng_set_option(encoder_.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_PAETH));
            check(spng_set_option(encoder_.get(), SPNG_IMG_COMPRESSION_LEVEL, level));
        }
        check(spng_set_ihdr(encoder_.get(), &header));
        check(spng_encode_image(encoder_.get(), nullptr, 0, is_raw ? SPNG_FMT_RAW : SPNG_FMT_PNG,
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

Result<std::vector<std::uint8_t>> packSamples(std::uint32_t width, std::uint32_t height, unsigned bits, bool has_alpha,
                                              ByteSpan samples, bool is_raw) {
    return orBroken([&]() -> Result<std::vector<std::uint8_t>> {
        RowPacker packer(width, height, static_cast<std::uint8_t>(bits),
                         has_alpha ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR, is_raw);
        const std::size_t row_bytes = samples.size() / height;
        for (std::size_t y = 0; y < height; ++y) packer.add(samples.subspan(y * row_bytes, row_bytes));
        return packer.finish();
    });
}

std::optional<std::vector<std::uint8_t>> ifMade(Result<std::vector<std::uint8_t>>&& made) {
    return made ? std::optional(*std::move(made)) : std::nullopt;
}

std::vector<std::uint8_t> packRows(ByteSpan bytes, const PngHeader& header) {
    const PngContext decoder = decoderOf(bytes);
    spng_ihdr parsed{};
    check(spng_get_ihdr(decoder.get(), &parsed));  // rejects invalid headers
    RowPacker packer(header.width, header.height, header.bits, header.color, true);
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

std::optional<RgbImage> decodePng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    PngContext context;
    spng_ihdr header{};
    if (!openPng(bytes, most_pixels, context, header, why)) return {};
    const ImageSize size{header.width, header.height};
    std::size_t byte_count = 0;
    if (spng_decoded_image_size(context.get(), SPNG_FMT_RGB8, &byte_count) != 0 || byte_count != 3 * size.pixels())
        return {};
    RgbImage image{size.width, size.height, std::vector<std::uint8_t>(byte_count)};
    if (!succeeds(spng_decode_image(context.get(), image.rgb.data(), byte_count, SPNG_FMT_RGB8, 0))) return {};
    return image;
}

std::vector<std::uint8_t> decodePngRgba(ByteSpan bytes) {
    const PngContext context = makeContext(0);
    spng_ihdr header{};
    spng_trns transparency{};
    std::size_t byte_count = 0;
    if (!succeeds(spng_set_png_buffer(context.get(), bytes.data(), bytes.size())) ||
        !succeeds(spng_get_ihdr(context.get(), &header)) ||
        ((header.color_type & 4) == 0 && !succeeds(spng_get_trns(context.get(), &transparency))) ||
        spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &byte_count) != 0) {
        return {};
    }
    std::vector<std::uint8_t> pixels(byte_count);
    if (!succeeds(spng_decode_image(context.get(), pixels.data(), byte_count, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS)))
        return {};
    return pixels;
}

/// Decodes to RGBA with 16 bits, which represents every PNG: samples of fewer bits are widened by repeating their bits,
/// which preserves the ratio to the largest value.
std::optional<FloatImage> decodeDeepPng(ByteSpan bytes, std::uint64_t most_pixels, std::string& why) {
    PngContext context;
    spng_ihdr header{};
    if (!openPng(bytes, most_pixels, context, header, why)) return {};
    const ImageSize size{header.width, header.height};
    std::size_t byte_count = 0;
    if (spng_decoded_image_size(context.get(), SPNG_FMT_RGBA16, &byte_count) != 0 || byte_count != 8 * size.pixels())
        return {};
    std::vector<std::uint16_t> words(4 * size.pixels());
    if (!succeeds(spng_decode_image(context.get(), words.data(), byte_count, SPNG_FMT_RGBA16, SPNG_DECODE_TRNS)))
        return {};
    FloatImage image{size.width, size.height, header.bit_depth == 16 ? 16u : 8u, std::vector<Vec3>(size.pixels()), {}};
    spng_trns transparency{};
    const bool has_alpha = (header.color_type & 4) != 0 || spng_get_trns(context.get(), &transparency) == 0;
    if (has_alpha) image.alpha.resize(image.texels.size());
    const auto part = [](std::uint16_t word) { return static_cast<float>(word) / 65535.0f; };
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        image.texels[i] = {part(words[4 * i]), part(words[4 * i + 1]), part(words[4 * i + 2])};
        if (has_alpha) image.alpha[i] = part(words[4 * i + 3]);
    }
    return image;
}

std::optional<std::vector<std::uint8_t>> encodePng(const FloatImage& image, unsigned bits) {
    return ifMade(packSamples(image.width, image.height, bits, !image.alpha.empty(), samplesOf(image, bits), false));
}

std::optional<std::vector<std::uint8_t>> encodePng(const RgbImage& image) {
    return ifMade(packSamples(image.width, image.height, 8, false, image.rgb, false));
}

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
    return packSamples(image.width, image.height, 8, image.channels == 4, image.pixels, true);
}

}  // namespace tspace
