// SPDX-License-Identifier: MIT
// PNG in and out with all of its chunks. libspng unpacks and packs the pixels; chunks are copied as they are.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "asset/file_error.h"
#include "maps/codecs.h"
#include "maps/flip_green.h"
#include "maps/png_context.h"

namespace tspace {

namespace {

constexpr std::size_t kSignatureBytes = 8;
/// Colour types of the header.
constexpr std::uint8_t kPalette = 3, kHasColor = 2, kHasAlpha = 4;

[[noreturn]] void failBroken() { failFile(ErrorCode::invalidFile, "it is a broken PNG"); }

void check(int result) {
    if (result == SPNG_EMEM) throw OutOfMemory{};
    if (result != 0) failBroken();
}

std::uint32_t numberAt(ByteSpan bytes, std::size_t at) {
    return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
           bytes[at + 3];
}

struct Chunk {
    std::string_view type = {};
    ByteSpan data = {};
    ByteSpan whole = {};  ///< with length, type and checksum
};

/// All chunks up to the end mark, the header first.
std::vector<Chunk> readChunks(ByteSpan bytes) {
    std::vector<Chunk> chunks;
    for (std::size_t at = kSignatureBytes; chunks.empty() || chunks.back().type != "IEND";) {
        constexpr std::size_t kAround = 12;
        if (bytes.size() < at + kAround) failBroken();
        const std::size_t length = numberAt(bytes, at);
        if (length > bytes.size() - at - kAround) failBroken();
        chunks.push_back({.type = {reinterpret_cast<const char*>(bytes.data()) + at + 4, 4},
                          .data = bytes.subspan(at + 8, length),
                          .whole = bytes.subspan(at, length + kAround)});
        at += length + kAround;
    }
    constexpr std::size_t kHeaderBytes = 13;
    if (chunks.front().type != "IHDR" || chunks.front().data.size() != kHeaderBytes) failBroken();
    return chunks;
}

struct Header {
    explicit Header(ByteSpan data)
        : width(numberAt(data, 0)),
          height(numberAt(data, 4)),
          bits(data[8]),
          color(data[9]),
          is_interlaced(data[12] != 0) {}

    std::uint32_t width, height;
    std::uint8_t bits, color;
    bool is_interlaced;

    [[nodiscard]] std::size_t channels() const { return (color & kHasAlpha) != 0 ? 4 : 3; }
    [[nodiscard]] std::size_t rowBytes() const { return channels() * (bits / 8) * width; }
};

/// The checksum of ISO 3309, which ends each chunk.
std::uint32_t checksum(ByteSpan bytes) {
    std::uint32_t sum = ~std::uint32_t{0};
    for (const std::uint8_t byte : bytes) {
        sum ^= byte;
        for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xedb88320U : 0U);
    }
    return ~sum;
}

void append(std::vector<std::uint8_t>& out, ByteSpan bytes) {
    const std::size_t begin = out.size();
    out.resize(begin + bytes.size());
    std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(begin));
}

/// A chunk whose data `change` has changed.
template <class Change>
void appendChanged(std::vector<std::uint8_t>& out, const Chunk& chunk, const Change& change) {
    const std::size_t begin = out.size();
    append(out, chunk.whole);
    const std::span<std::uint8_t> data = std::span(out).subspan(begin + 8, chunk.data.size());
    change(data);
    const std::uint32_t sum = checksum(std::span(out).subspan(begin + 4, chunk.data.size() + 4));
    for (std::size_t i = 0; i < 4; ++i) out[out.size() - 4 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
}

/// 255 - x and 65535 - x are x with all bits inverted. `step`: bytes from one green to the next.
void invertGreen(std::span<std::uint8_t> bytes, std::size_t step, std::size_t sample_bytes) {
    for (std::size_t at = sample_bytes; at + sample_bytes <= bytes.size(); at += step) {
        for (std::size_t i = 0; i < sample_bytes; ++i) bytes[at + i] ^= 0xff;
    }
}

/// A colour of three numbers of 16 bits, of which 8 count where the image has so many.
void invertColor(std::span<std::uint8_t> data, std::uint8_t bits) {
    constexpr std::size_t kGreenAt = 2;
    if (data.size() != 6) return;
    if (bits == 16) data[kGreenAt] ^= 0xff;
    data[kGreenAt + 1] ^= 0xff;
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

/// The pixels once more, green inverted, as a PNG without any other chunk.
std::vector<std::uint8_t> repack(ByteSpan bytes, const Header& header) {
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
        invertGreen(row, header.channels() * sample_bytes, sample_bytes);
        packer.add(row);
    }
    return packer.finish();
}

/// The chunks of the input; of pixels, header and colours, those that were changed.
std::vector<std::uint8_t> joinChunks(ByteSpan bytes, const std::vector<Chunk>& chunks, const Header& header,
                                     const std::vector<Chunk>& packed) {
    std::vector<std::uint8_t> out;
    append(out, bytes.first(kSignatureBytes));
    bool has_pixels = false;
    for (const Chunk& chunk : chunks) {
        if (chunk.type == "IHDR" && !packed.empty()) {
            append(out, packed.front().whole);
        } else if (chunk.type == "IDAT" && !packed.empty()) {
            for (const Chunk& part : packed) {
                if (part.type == "IDAT" && !has_pixels) append(out, part.whole);
            }
            has_pixels = true;
        } else if (chunk.type == "PLTE") {
            appendChanged(out, chunk, [](std::span<std::uint8_t> data) { invertGreen(data, 3, 1); });
        } else if ((chunk.type == "tRNS" || chunk.type == "bKGD") && header.color != kPalette) {
            appendChanged(out, chunk, [&](std::span<std::uint8_t> data) { invertColor(data, header.bits); });
        } else {
            append(out, chunk.whole);
        }
    }
    return out;
}

}  // namespace

FlippedPng flipPng(ByteSpan bytes) {
    const std::vector<Chunk> chunks = readChunks(bytes);
    const Header header(chunks.front().data);
    if ((header.color & kHasColor) == 0) {
        failFile(ErrorCode::unsupportedFile, "it is a grey PNG, which has no green channel of its own");
    }
    if (std::any_of(chunks.begin(), chunks.end(), [](const Chunk& chunk) { return chunk.type == "acTL"; })) {
        failFile(ErrorCode::unsupportedFile, "it is an animated PNG");
    }
    if (header.color == kPalette) {
        // Its pixels are numbers of colours, and stay. They are unpacked to see whether the file is sound.
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
        return {joinChunks(bytes, chunks, header, {}), 8};
    }
    const std::vector<std::uint8_t> packed = repack(bytes, header);
    return {joinChunks(bytes, chunks, header, readChunks(packed)), header.bits};
}

std::vector<std::uint8_t> writePng(const ChannelImage& image) {
    const std::uint8_t color = image.channels == 4 ? kHasColor | kHasAlpha : kHasColor;
    RowPacker packer(image.width, image.height, 8, color);
    const std::size_t row_bytes = std::size_t{image.channels} * image.width;
    for (std::size_t y = 0; y < image.height; ++y) packer.add(ByteSpan(image.pixels).subspan(y * row_bytes, row_bytes));
    return packer.finish();
}

}  // namespace tspace
