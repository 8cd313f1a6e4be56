// SPDX-License-Identifier: MIT
// Keeping pieces in order.
#include "asset/gltf/buffer_bytes.h"

#include <algorithm>
#include <utility>

#include "asset/file_error.h"

namespace tspace::gltf {

BufferBytes::BufferBytes(std::span<std::uint8_t> bytes) { addPiece(bytes); }

std::span<std::uint8_t> BufferBytes::range(std::size_t begin, std::size_t count) {
    if (count == 0) return {};
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), begin,
                                        [](std::size_t value, const Piece& piece) { return value < piece.begin; });
    if (after != pieces_.begin()) {
        const Piece& piece = *(after - 1);
        const std::size_t offset = begin - piece.begin;
        if (offset < piece.bytes.size() && count <= piece.bytes.size() - offset) return piece.bytes.subspan(offset, count);
    }
    failFile(ErrorCode::internal, "a range of a buffer does not lie in one piece");
}

std::span<const std::uint8_t> BufferBytes::range(std::size_t begin, std::size_t count) const {
    return const_cast<BufferBytes*>(this)->range(begin, count);
}

Bytes BufferBytes::copy(std::size_t begin, std::size_t count) const {
    Bytes bytes;
    bytes.reserve(count);
    for (const Piece& piece : pieces_) {
        const std::size_t from = std::max(begin, piece.begin);
        const std::size_t to = std::min(begin + count, piece.begin + piece.bytes.size());
        if (from >= to) continue;
        const auto part = piece.bytes.subspan(from - piece.begin, to - from);
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    return bytes;
}

std::size_t BufferBytes::append(Bytes bytes, std::size_t alignment) {
    if (const std::size_t rest = size_ % alignment; rest != 0) {
        addPiece(storage_.emplace_back(alignment - rest, std::uint8_t{0}));
    }
    const std::size_t begin = size_;
    addPiece(storage_.emplace_back(std::move(bytes)));
    return begin;
}

void BufferBytes::cut(std::span<const ByteCut> cuts) {
    const std::vector<Piece> old = std::exchange(pieces_, {});
    size_ = 0;
    auto cut = cuts.begin();
    for (const Piece& piece : old) {
        const std::size_t end = piece.begin + piece.bytes.size();
        for (std::size_t at = piece.begin; at < end;) {
            while (cut != cuts.end() && cut->end <= at) ++cut;
            const bool is_cut = cut != cuts.end() && cut->begin <= at;
            const std::size_t stop = cut == cuts.end() ? end : std::min(end, is_cut ? cut->end : cut->begin);
            if (!is_cut) addPiece(piece.bytes.subspan(at - piece.begin, stop - at));
            at = stop;
        }
    }
}

std::vector<std::span<const std::uint8_t>> BufferBytes::pieces() const {
    std::vector<std::span<const std::uint8_t>> all;
    for (const Piece& piece : pieces_) all.emplace_back(piece.bytes);
    return all;
}

Bytes BufferBytes::joined() const {
    Bytes all;
    all.reserve(size_);
    for (const Piece& piece : pieces_) all.insert(all.end(), piece.bytes.begin(), piece.bytes.end());
    return all;
}

void BufferBytes::addPiece(std::span<std::uint8_t> bytes) {
    if (bytes.empty()) return;
    pieces_.push_back({size_, bytes});
    size_ += bytes.size();
}

}  // namespace tspace::gltf
