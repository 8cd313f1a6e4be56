// SPDX-License-Identifier: MIT
// Implements buffers as lists of pieces: appending, cutting, and generating lazy bytes.
#include "model/gltf/buffer_bytes.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

#include "model/io/file_error.h"

namespace tspace::gltf {

/// Bytes that are generated once, on first use, by the thread that needs them.
class BufferBytes::Later {
  public:
    explicit Later(std::shared_ptr<const ByteMaker> maker) : maker_(std::move(maker)) {}

    [[nodiscard]] std::span<std::uint8_t> bytes() {
        // An exception that leaves std::call_once() aborts the program if the C library cannot allocate memory to load
        // its unwinder.
        const std::lock_guard lock(mutex_);
        if (is_made_) return bytes_;
        bytes_ = Bytes(maker_->size());
        maker_->make(0, bytes_);
        is_made_ = true;
        maker_.reset();
        return bytes_;
    }
    /// Returns a piece for writing to a file: bytes not yet generated are generated block by block, and not kept.
    [[nodiscard]] OutputPiece piece() const { return is_made_ ? OutputPiece(bytes_) : OutputPiece(maker_); }

  private:
    std::shared_ptr<const ByteMaker> maker_;
    std::mutex mutex_;
    std::atomic<bool> is_made_ = false;
    Bytes bytes_;
};

std::span<std::uint8_t> BufferBytes::Piece::generatedBytes() const { return bytes.empty() ? later->bytes() : bytes; }

BufferBytes::BufferBytes(std::span<std::uint8_t> bytes) { addPiece({.count = bytes.size(), .bytes = bytes}); }

std::span<std::uint8_t> BufferBytes::range(std::size_t begin, std::size_t count) {
    if (count == 0) return {};
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), begin,
                                        [](std::size_t value, const Piece& piece) { return value < piece.begin; });
    if (after != pieces_.begin()) {
        const Piece& piece = *(after - 1);
        const std::size_t offset = begin - piece.begin;
        if (offset < piece.count && count <= piece.count - offset) return piece.generatedBytes().subspan(offset, count);
    }
    failFile(ErrorCode::internal, "internal error: a range of a buffer is not contiguous");
}

std::span<const std::uint8_t> BufferBytes::range(std::size_t begin, std::size_t count) const {
    return const_cast<BufferBytes*>(this)->range(begin, count);
}

Bytes BufferBytes::copy(std::size_t begin, std::size_t count) const {
    Bytes bytes;
    bytes.reserve(count);
    for (const Piece& piece : pieces_) {
        const std::size_t from = std::max(begin, piece.begin);
        const std::size_t to = std::min(begin + count, piece.begin + piece.count);
        if (from >= to) continue;
        const auto part = piece.generatedBytes().subspan(from - piece.begin, to - from);
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    return bytes;
}

void BufferBytes::pad(std::size_t alignment) {
    const std::size_t rest = size_ % alignment;
    if (rest == 0) return;
    const std::span<std::uint8_t> zeros = storage_.emplace_back(alignment - rest, std::uint8_t{0});
    addPiece({.count = zeros.size(), .bytes = zeros});
}

std::size_t BufferBytes::append(Bytes bytes, std::size_t alignment) {
    pad(alignment);
    const std::size_t begin = size_;
    const std::span<std::uint8_t> stored = storage_.emplace_back(std::move(bytes));
    addPiece({.count = stored.size(), .bytes = stored});
    return begin;
}

std::size_t BufferBytes::append(std::shared_ptr<const ByteMaker> maker, std::size_t alignment) {
    pad(alignment);
    const std::size_t begin = size_, count = maker->size();
    addPiece({.count = count, .later = std::make_shared<Later>(std::move(maker))});
    return begin;
}

void BufferBytes::makeAll() {
    for (; generated_count_ < pieces_.size(); ++generated_count_)
        static_cast<void>(pieces_[generated_count_].generatedBytes());
}

void BufferBytes::cut(std::span<const ByteCut> cuts) {
    const std::vector<Piece> old = std::exchange(pieces_, {});
    size_ = generated_count_ = 0;
    auto cut = cuts.begin();
    for (const Piece& piece : old) {
        const std::size_t end = piece.begin + piece.count;
        for (std::size_t at = piece.begin; at < end;) {
            while (cut != cuts.end() && cut->end <= at) ++cut;
            const bool is_cut = cut != cuts.end() && cut->begin <= at;
            const std::size_t stop = cut == cuts.end() ? end : std::min(end, is_cut ? cut->end : cut->begin);
            if (!is_cut && stop - at == piece.count) {
                addPiece(piece);
            } else if (!is_cut) {
                addPiece({.count = stop - at,
                          .bytes = piece.generatedBytes().subspan(at - piece.begin, stop - at),
                          .later = piece.later});
            }
            at = stop;
        }
    }
}

std::vector<OutputPiece> BufferBytes::pieces() const {
    std::vector<OutputPiece> all;
    for (const Piece& piece : pieces_)
        all.push_back(piece.bytes.empty() ? piece.later->piece()
                                          : OutputPiece(std::span<const std::uint8_t>(piece.bytes)));
    return all;
}

Bytes BufferBytes::joined() const {
    Bytes all;
    all.reserve(size_);
    for (const Piece& piece : pieces_) {
        const auto bytes = piece.generatedBytes();
        all.insert(all.end(), bytes.begin(), bytes.end());
    }
    return all;
}

void BufferBytes::addPiece(Piece piece) {
    if (piece.count == 0) return;
    piece.begin = size_;
    size_ += piece.count;
    pieces_.push_back(std::move(piece));
}

}  // namespace tspace::gltf
