// SPDX-License-Identifier: MIT
// Bytes of a buffer as a sequence of pieces, so that neither appending nor cutting copies existing bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/io/atomic_output.h"

namespace tspace::gltf {

/// A range of bytes to cut out.
struct ByteCut {
    std::size_t begin = 0, end = 0;
};

class BufferBytes {
  public:
    BufferBytes() = default;
    explicit BufferBytes(Bytes bytes) { append(std::move(bytes), 1); }
    /// Creates a view of bytes that the caller owns; they must outlive this object.
    explicit BufferBytes(std::span<std::uint8_t> bytes);
    BufferBytes(BufferBytes&&) = default;
    BufferBytes& operator=(BufferBytes&&) = default;

    [[nodiscard]] std::size_t size() const { return size_; }

    /// Returns `count` bytes, starting at `begin`, which must be in one piece. Bytes that were appended in one call are
    /// one piece, unless parts were cut.
    [[nodiscard]] std::span<const std::uint8_t> range(std::size_t begin, std::size_t count) const;
    [[nodiscard]] std::span<std::uint8_t> range(std::size_t begin, std::size_t count);

    /// Returns a copy of the range, which may span several pieces.
    [[nodiscard]] Bytes copy(std::size_t begin, std::size_t count) const;

    /// Appends the bytes at the next multiple of `alignment`, padding with zeros, and returns their offset.
    std::size_t append(Bytes bytes, std::size_t alignment);
    /// Appends bytes that are generated lazily: when they are written, or when range(), copy() or joined() reads them.
    std::size_t append(std::shared_ptr<const ByteMaker> maker, std::size_t alignment);
    /// Generates all lazy bytes.
    void makeAll();

    /// Removes ranges. They must be in order and disjoint.
    void cut(std::span<const ByteCut> cuts);

    /// Returns all bytes, as consecutive pieces.
    [[nodiscard]] std::vector<OutputPiece> pieces() const;
    [[nodiscard]] Bytes joined() const;

  private:
    class Later;
    struct Piece {
        std::size_t begin = 0, count = 0;
        std::span<std::uint8_t> bytes = {};  ///< bytes of the piece; empty if `later` provides them
        std::shared_ptr<Later> later = {};

        [[nodiscard]] std::span<std::uint8_t> generatedBytes() const;
    };
    void addPiece(Piece piece);
    void pad(std::size_t alignment);

    std::vector<Piece> pieces_;   ///< the pieces, none of them empty
    std::vector<Bytes> storage_;  ///< owns the bytes of all pieces except views
    std::size_t size_ = 0;
    std::size_t generated_count_ = 0;  ///< number of leading pieces whose bytes are known to be generated
};

}  // namespace tspace::gltf
