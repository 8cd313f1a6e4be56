// SPDX-License-Identifier: MIT
// Elements of split vertices that nobody has copied yet.
#pragma once

#include <memory>
#include <vector>

#include "model/io/output_piece.h"

namespace tspace::gltf {

/// Where new vertices come from: the first `kept` from themselves.
struct SplitSources {
    std::size_t kept = 0;
    std::shared_ptr<const std::vector<std::uint32_t>> copies = {};

    [[nodiscard]] std::size_t size() const { return kept + copies->size(); }
};

class GatheredBytes final : public ByteMaker {
  public:
    /// Elements at `data`, `stride` apart. They must outlive this and stay as they are.
    GatheredBytes(const std::uint8_t* data, std::size_t stride, std::size_t element_bytes, SplitSources sources)
        : data_(data), stride_(stride), element_bytes_(element_bytes), sources_(std::move(sources)) {}

    [[nodiscard]] std::size_t size() const override { return sources_.size() * element_bytes_; }
    void make(std::size_t begin, std::span<std::uint8_t> to) const override;

  private:
    [[nodiscard]] const std::uint8_t* at(std::size_t element) const {
        return data_ + stride_ * (element < sources_.kept ? element : (*sources_.copies)[element - sources_.kept]);
    }

    const std::uint8_t* data_;
    std::size_t stride_, element_bytes_;
    SplitSources sources_;
};

}  // namespace tspace::gltf
