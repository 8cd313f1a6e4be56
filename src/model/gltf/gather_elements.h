// SPDX-License-Identifier: MIT
// Copies of an accessor's elements in new numbers, to be stored anew.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/gltf/editor.h"
#include "model/io/output_piece.h"

namespace tspace::gltf {

/// The old vertex of each new one: the first `kept` keep their numbers, the others are `copies`.
struct SplitSources {
    std::size_t kept = 0;
    std::shared_ptr<const std::vector<std::uint32_t>> copies = {};

    [[nodiscard]] std::size_t size() const { return kept + copies->size(); }
};

/// Elements of split vertices, copied when they are written.
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

/// Element i is a copy of old element sources[i]. Bounds stay, because copies change none; the elements are to be
/// stored in the form that the accessor's have.
ElementData gatherElements(const Document& document, const Accessor& accessor, std::span<const std::uint32_t> sources);

/// gatherElements for split vertices. Elements that lie in the model file's own bytes are copied when they are written.
ElementData gatherSplit(const Document& document, const Accessor& accessor, const SplitSources& sources);

/// Brings min and max of float vectors up to date, where there are any; both go when an element is not finite, because
/// JSON has no such number.
void renewBounds(ElementData& data);

/// Keeps only the elements that are not zero, with their places, where most are zero and the file becomes smaller.
void makeSparseWhereSmaller(ElementData& data);

}  // namespace tspace::gltf
