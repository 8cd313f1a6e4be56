// SPDX-License-Identifier: MIT
// The variants of vertices: a vertex itself with its first corner, and the copies that later corners got.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/memory.h"
#include "tspace/split.h"

namespace tspace {

inline const float* cornerValues(const CornerAttribute& attribute, std::uint32_t corner) {
    return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(attribute.data) +
                                          corner * attribute.stride_bytes);
}

/// The rule of CornerAttribute::tolerance, for all attributes together.
bool equalCorners(std::span<const CornerAttribute> attributes, std::uint32_t corner, std::uint32_t other);

/// An open-addressing table from (node, key) to a number.
class NodeTable {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    explicit NodeTable(const Allocator* allocator) : allocator_(allocator) {}

    /// The slot's value; kNone when there is no such entry.
    [[nodiscard]] std::uint32_t find(std::uint32_t node, std::uint64_t key) const;

    /// The entry's value, to be read and set; kNone when it was just made.
    std::uint32_t& at(std::uint32_t node, std::uint64_t key);

  private:
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t node = kNone;
        std::uint32_t value = kNone;
    };

    [[nodiscard]] std::size_t slotOf(std::uint32_t node, std::uint64_t key) const;
    void grow();

    const Allocator* allocator_;
    Buffer<Entry> entries_;
    std::size_t used_ = 0;
};

class Variants {
  public:
    /// `result` needs the first corner of each vertex in source_corners before prepare(). It gets the copies; its
    /// source_vertices serve as links between variants and are to be written when all corners are done.
    Variants(std::span<const CornerAttribute> attributes, SplitResult& result, const Allocator* allocator)
        : attributes_(attributes), corners_(result.source_corners), next_(result.source_vertices), edges_(allocator) {}

    void prepare();

    /// The new vertex for a corner of `vertex` that differs from its first corner: its earliest variant that equals
    /// the corner, made if there is none.
    std::uint32_t variantOf(std::uint32_t corner, std::uint32_t vertex);

  private:
    std::uint32_t append(std::uint32_t corner);

    // The index of later variants is a tree whose edges live in one table. The first level is the old vertex
    // with the bits of all exact attributes; then comes one level for each component of the others, keyed by
    // its cell on a line cut into cells as wide as the tolerance. A leaf is a list, linked by next_, of
    // variants that nearly always has one entry. A look-up follows the three neighbouring cells on each
    // level, as far as there are any; the number of variants that can lie around one point is bounded, so the
    // cost per corner is too.
    [[nodiscard]] std::uint64_t exactKey(std::uint32_t corner, std::uint32_t vertex) const;
    template <class Body>
    void forEachTolerant(std::uint32_t corner, Body&& body) const;
    void addToIndex(std::uint32_t corner, std::uint32_t vertex, std::uint32_t variant);
    [[nodiscard]] std::uint32_t findIndexed(std::uint32_t corner, std::uint32_t vertex);
    void follow(std::uint32_t node, float component, float tolerance);

    std::span<const CornerAttribute> attributes_;
    std::vector<std::uint32_t>& corners_;  ///< of each variant
    /// The vertex's next variant among the scanned ones; the leaf's next one among the indexed ones.
    std::vector<std::uint32_t>& next_;
    NodeTable edges_;
    std::uint32_t node_count_ = 0;  ///< the root is node 0
    std::vector<std::uint32_t> reached_, further_;
};

}  // namespace tspace
