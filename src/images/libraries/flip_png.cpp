// SPDX-License-Identifier: MIT
// Reads and writes PNG with all of its chunks, which are copied unchanged; pixels are compressed again.
#include <algorithm>
#include <string_view>

#include "images/codecs.h"
#include "images/flip_green.h"

namespace tspace {
namespace {

constexpr std::size_t kSignatureBytes = 8;
struct Chunk {
    std::string_view type = {};
    ByteSpan data = {};
    ByteSpan whole = {};  ///< including length, type and checksum
};

/// Returns all chunks up to the end chunk, starting with the header.
Result<std::vector<Chunk>> readChunks(ByteSpan bytes) {
    std::vector<Chunk> chunks;
    for (std::size_t at = kSignatureBytes; chunks.empty() || chunks.back().type != "IEND";) {
        constexpr std::size_t kAround = 12;
        if (bytes.size() < at + kAround) return brokenPng();
        const std::size_t length = pngNumber(bytes, at);
        if (length > bytes.size() - at - kAround) return brokenPng();
        chunks.push_back({.type = {reinterpret_cast<const char*>(bytes.data()) + at + 4, 4},
                          .data = bytes.subspan(at + 8, length),
                          .whole = bytes.subspan(at, length + kAround)});
        at += length + kAround;
    }
    constexpr std::size_t kHeaderBytes = 13;
    if (chunks.front().type != "IHDR" || chunks.front().data.size() != kHeaderBytes) return brokenPng();
    return chunks;
}

/// Returns the CRC (ISO 3309) that ends each chunk.
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

/// Appends a chunk with its data modified by `change`.
template <class Change>
void appendChanged(std::vector<std::uint8_t>& out, const Chunk& chunk, const Change& change) {
    const std::size_t begin = out.size();
    append(out, chunk.whole);
    const std::span<std::uint8_t> data = std::span(out).subspan(begin + 8, chunk.data.size());
    change(data);
    const std::uint32_t sum = checksum(std::span(out).subspan(begin + 4, chunk.data.size() + 4));
    for (std::size_t i = 0; i < 4; ++i) out[out.size() - 4 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
}

/// Inverts the green of a color of three 16-bit numbers. 8-bit images use only the low byte of each number.
void invertColor(std::span<std::uint8_t> data, std::uint8_t bits) {
    constexpr std::size_t kGreenAt = 2;
    if (data.size() != 6) return;
    if (bits == 16) data[kGreenAt] ^= 0xff;
    data[kGreenAt + 1] ^= 0xff;
}

/// Returns the file with inverted green: pixel data and header are taken from `packed` (if it is not empty), the
/// palette and the colors of tRNS and bKGD are inverted, and all other chunks are copied.
std::vector<std::uint8_t> joinChunks(ByteSpan bytes, const std::vector<Chunk>& chunks, const PngHeader& header,
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
            appendChanged(out, chunk, [](std::span<std::uint8_t> data) { invertGreenSamples(data, 3, 1); });
        } else if ((chunk.type == "tRNS" || chunk.type == "bKGD") && header.color != PngHeader::kPalette) {
            appendChanged(out, chunk, [&](std::span<std::uint8_t> data) { invertColor(data, header.bits); });
        } else {
            append(out, chunk.whole);
        }
    }
    return out;
}

PngHeader pngHeader(ByteSpan data) {
    PngHeader header;
    header.width = pngNumber(data, 0);
    header.height = pngNumber(data, 4);
    header.bits = data[8];
    header.color = data[9];
    header.is_interlaced = data[12] != 0;
    return header;
}

}  // namespace

Error brokenPng() { return Error{ErrorCode::invalidFile, "the PNG is damaged"}; }

std::uint32_t pngNumber(ByteSpan bytes, std::size_t at) {
    return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
           bytes[at + 3];
}

void invertGreenSamples(std::span<std::uint8_t> bytes, std::size_t step, std::size_t sample_bytes) {
    for (std::size_t at = sample_bytes; at + sample_bytes <= bytes.size(); at += step) {
        for (std::size_t i = 0; i < sample_bytes; ++i) bytes[at + i] ^= 0xff;
    }
}

Result<FlippedPng> flipPng(ByteSpan bytes) {
    const Result<std::vector<Chunk>> read = readChunks(bytes);
    if (!read) return read.error();
    const std::vector<Chunk>& chunks = *read;
    const PngHeader header = pngHeader(chunks.front().data);
    if ((header.color & PngHeader::kHasColor) == 0)
        return Error{ErrorCode::unsupportedFile, "the PNG is gray, so it has no separate green channel"};
    if (std::any_of(chunks.begin(), chunks.end(), [](const Chunk& chunk) { return chunk.type == "acTL"; }))
        return Error{ErrorCode::unsupportedFile, "the PNG is animated, which is not supported"};
    if (header.color == PngHeader::kPalette) {
        // The samples of an image with a palette are indices and stay unchanged; the palette is inverted.
        if (Error error = checkPixels(bytes, header); error.code != ErrorCode::ok) return error;
        return FlippedPng{joinChunks(bytes, chunks, header, {}), 8};
    }
    const Result<std::vector<std::uint8_t>> packed = packInverted(bytes, header);
    if (!packed) return packed.error();
    const Result<std::vector<Chunk>> packed_chunks = readChunks(*packed);
    if (!packed_chunks) return packed_chunks.error();
    return FlippedPng{joinChunks(bytes, chunks, header, *packed_chunks), header.bits};
}

}  // namespace tspace
