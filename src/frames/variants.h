// SPDX-License-Identifier: MIT
// The variants of vertices: a vertex itself with its first corner, and the copies that later corners got.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/unique_index.h"
#include "tspace/split.h"

namespace tspace {

inline const float* cornerValues(const CornerAttribute& attribute, std::uint32_t corner) {
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(attribute.data) +
                                          corner * attribute.stride_bytes);
}

/// The rule of CornerAttribute::tolerance, for all attributes together.
bool equalCorners(std::span<const CornerAttribute> attributes, std::uint32_t corner, std::uint32_t other);

class Variants {
  public:
    /// `result` needs the first corner of each vertex in source_corners before prepare(). It gets the copies; its
    /// source_vertices serve as links between variants and are to be written when all corners are done.
    Variants(std::span<const CornerAttribute> attributes, SplitResult& result)
        : attributes_(attributes), corners_(result.source_corners), next_(result.source_vertices) {}

    void prepare();

    /// The new vertex for a corner of `vertex` that differs from its first corner: its earliest variant that equals
    /// the corner, made if there is none.
    std::uint32_t variantOf(std::uint32_t corner, std::uint32_t vertex);

  private:
    std::uint32_t append(std::uint32_t corner);

    // The index of later variants is a tree of which each node is known by a hash. The first level is the old vertex with
    // the bits of all exact attributes; then comes one level for each component of the others, by its cell on a line cut
    // into cells as wide as the tolerance. A leaf is a list, linked by next_, of variants that nearly always has one entry. A
    // look-up follows the three neighbouring cells on each level, as far as there are any; the number of variants that can lie
    // around one point is bounded, so the cost per corner is too.
    void findCells(std::uint32_t corner, std::uint32_t vertex);
    void addToIndex(std::uint32_t variant);
    [[nodiscard]] std::uint32_t findIndexed(std::uint32_t corner);

    std::span<const CornerAttribute> attributes_;
    std::vector<std::uint32_t>& corners_;  ///< of each variant
    /// The vertex's next variant among the scanned ones; the leaf's next one among the indexed ones.
    std::vector<std::uint32_t>& next_;
    UniqueIndex<std::uint64_t> nodes_;
    std::vector<std::uint32_t> firsts_;  ///< of each node, if it is a leaf, the variant that its list starts with
    std::uint64_t root_ = 0;             ///< of the corner that is looked up
    std::vector<std::uint64_t> cells_, reached_, further_;
};

}  // namespace tspace
