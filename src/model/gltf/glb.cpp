// SPDX-License-Identifier: MIT
// Reading and writing the GLB container (glTF 2.0 specification, section 4.4).
#include "model/gltf/glb.h"

#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t kJsonType = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinType = 0x004E4942;   // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeadBytes = 8;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes[at] | std::uint32_t{bytes[at + 1]} << 8 | std::uint32_t{bytes[at + 2]} << 16 |
           std::uint32_t{bytes[at + 3]} << 24;
}

void putWord(Bytes& bytes, std::uint64_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void putChunkHead(Bytes& bytes, std::size_t length, std::uint32_t type) {
    putWord(bytes, length);
    putWord(bytes, type);
}

std::size_t paddingOf(std::size_t length) { return (4 - length % 4) % 4; }

[[noreturn]] void failGlb(std::string message, std::size_t at) {
    failFile(ErrorCode::invalidFile, std::move(message), "byte " + std::to_string(at));
}

}  // namespace

bool isGlb(std::span<const std::uint8_t> file) { return file.size() >= 4 && word(file, 0) == kMagic; }

GlbChunks readGlb(std::span<const std::uint8_t> file) {
    if (file.size() < kHeaderBytes) failGlb("the GLB header is cut short", file.size());
    if (word(file, 4) != 2) {
        failFile(ErrorCode::unsupportedFile,
                 "the GLB container has version " + std::to_string(word(file, 4)) + ", not 2", "byte 4");
    }
    const std::size_t stated = word(file, 8);
    if (stated > file.size()) {
        failGlb(
            "the GLB header says " + std::to_string(stated) + " bytes, but the file has " + std::to_string(file.size()),
            8);
    }
    if (stated <= kHeaderBytes) {
        failGlb("the GLB header says " + std::to_string(stated) + " bytes, in which no JSON chunk has room", 8);
    }
    GlbChunks chunks;
    const std::span<const std::uint8_t> whole = file;
    chunks.ignored_bytes = file.size() - stated;
    file = file.first(stated);
    std::size_t at = kHeaderBytes;
    for (std::size_t number = 0; at < file.size(); ++number) {
        if (whole.size() - at < kChunkHeadBytes) failGlb("the head of a GLB chunk is cut short", at);
        const std::size_t length = word(whole, at);
        const std::uint32_t type = word(whole, at + 4);
        if (file.size() - at < kChunkHeadBytes || length > file.size() - at - kChunkHeadBytes)
            failGlb("a GLB chunk is longer than the rest of the GLB", at);
        const auto bytes = file.subspan(at + kChunkHeadBytes, length);
        if ((number == 0) != (type == kJsonType)) {
            failGlb(number == 0 ? "the first GLB chunk is not JSON" : "the GLB has a second JSON chunk", at);
        }
        if (type == kBinType) {
            if (chunks.bin) failGlb("the GLB has a second BIN chunk", at);
            if (number != 1) failGlb("the BIN chunk is not the second chunk", at);
            chunks.bin = bytes;
        } else if (number == 0) {
            chunks.json = bytes;
        } else {
            chunks.extra.push_back({type, Bytes(bytes.begin(), bytes.end())});
        }
        at += kChunkHeadBytes + length;
    }
    if (chunks.json.data() == nullptr) failGlb("the GLB has no JSON chunk", at);
    return chunks;
}

GlbFrame frameGlb(const std::string& json, std::optional<std::size_t> bin_bytes, std::span<const ExtraChunk> extra) {
    const std::size_t json_bytes = json.size() + paddingOf(json.size());
    std::uint64_t total = kHeaderBytes + kChunkHeadBytes + json_bytes;
    if (bin_bytes) total += kChunkHeadBytes + *bin_bytes + paddingOf(*bin_bytes);
    for (const ExtraChunk& chunk : extra) total += kChunkHeadBytes + chunk.bytes.size() + paddingOf(chunk.bytes.size());
    if (total > 0xffffffffu) {
        failFile(
            ErrorCode::cannotWrite,
            "the GLB would be larger than the 4 GiB that the format allows; write .gltf, which has its data in a .bin");
    }
    GlbFrame frame;
    frame.head.reserve(kHeaderBytes + 2 * kChunkHeadBytes + json_bytes);
    putWord(frame.head, kMagic);
    putWord(frame.head, 2);
    putWord(frame.head, total);
    putChunkHead(frame.head, json_bytes, kJsonType);
    frame.head.insert(frame.head.end(), json.begin(), json.end());
    frame.head.insert(frame.head.end(), paddingOf(json.size()), ' ');
    if (bin_bytes) {
        putChunkHead(frame.head, *bin_bytes + paddingOf(*bin_bytes), kBinType);
        frame.tail.insert(frame.tail.end(), paddingOf(*bin_bytes), 0);
    }
    for (const ExtraChunk& chunk : extra) {
        putChunkHead(frame.tail, chunk.bytes.size() + paddingOf(chunk.bytes.size()), chunk.type);
        frame.tail.insert(frame.tail.end(), chunk.bytes.begin(), chunk.bytes.end());
        frame.tail.insert(frame.tail.end(), paddingOf(chunk.bytes.size()), 0);
    }
    return frame;
}

}  // namespace tspace::gltf
