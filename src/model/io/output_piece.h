// SPDX-License-Identifier: MIT
// Parts of an output file: existing bytes, or bytes that are made when they are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/base/numbers.h"
#include "model/io/file_io.h"

namespace tspace {

class ByteMaker {
  public:
    virtual ~ByteMaker() = default;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Fills `to` with the bytes from `begin` on. Must be thread-safe and deterministic.
    virtual void make(std::size_t begin, std::span<std::uint8_t> to) const = 0;
    /// All bytes, where they exist already; valid as long as this object. Else empty.
    [[nodiscard]] virtual std::span<const std::uint8_t> there() const { return {}; }
};

/// Owns a vector and serves its bytes without a copy. T: numbers of four bytes without padding.
template <class T>
class KeptBytes final : public ByteMaker {
  public:
    explicit KeptBytes(std::vector<T>&& values) : values_(std::move(values)) {
        turnLittleEndian({reinterpret_cast<std::uint8_t*>(values_.data()), size()}, 4);
    }

    [[nodiscard]] std::size_t size() const override { return values_.size() * sizeof(T); }
    void make(std::size_t begin, std::span<std::uint8_t> to) const override {
        if (!to.empty()) std::memcpy(to.data(), there().data() + begin, to.size());
    }
    [[nodiscard]] std::span<const std::uint8_t> there() const override {
        return {reinterpret_cast<const std::uint8_t*>(values_.data()), size()};
    }

  private:
    std::vector<T> values_;
};

struct OutputPiece {
    OutputPiece(std::span<const std::uint8_t> there) : bytes(there) {}
    OutputPiece(const Bytes& there) : bytes(there) {}
    OutputPiece(std::shared_ptr<const ByteMaker> made) : bytes(made->there()), maker(std::move(made)) {}

    [[nodiscard]] bool isThere() const { return !maker || !bytes.empty(); }

    [[nodiscard]] std::size_t size() const { return maker ? maker->size() : bytes.size(); }

    std::span<const std::uint8_t> bytes = {};
    std::shared_ptr<const ByteMaker> maker = {};  ///< owner or maker of the bytes
};

}  // namespace tspace
