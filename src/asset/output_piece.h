// SPDX-License-Identifier: MIT
// Parts of an output file: bytes that are there, or that are made when they are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "asset/file_io.h"

namespace tspace {

class ByteMaker {
  public:
    virtual ~ByteMaker() = default;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Writes the bytes from `begin` on. By several threads at the same time; the same bytes each time.
    virtual void make(std::size_t begin, std::span<std::uint8_t> to) const = 0;
};

struct OutputPiece {
    OutputPiece(std::span<const std::uint8_t> there) : bytes(there) {}
    OutputPiece(const Bytes& there) : bytes(there) {}
    OutputPiece(std::shared_ptr<const ByteMaker> made) : maker(std::move(made)) {}

    [[nodiscard]] std::size_t size() const { return maker ? maker->size() : bytes.size(); }

    std::span<const std::uint8_t> bytes = {};
    std::shared_ptr<const ByteMaker> maker = {};  ///< in their place
};

}  // namespace tspace
