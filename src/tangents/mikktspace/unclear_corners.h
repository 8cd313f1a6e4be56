// SPDX-License-Identifier: MIT
// The corners of chosen nodes, with all that grouping and summing them needs: what node_walk.cpp works on.
#pragma once

#include <span>

#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// More flags of a triangle, beside TriangleFlag.
inline constexpr std::uint32_t kContested = 0x40, kDegenerate = 0x80;

/// A triangle around a chosen node.
struct alignas(16) FoundTriangle {
    std::uint32_t nodes[3];
    std::uint32_t flags;
};

/// Rows of corner_terms.h.
struct alignas(16) Row {
    float at[4] = {0, 0, 0, 0};
};
struct alignas(32) Directions {
    Row s, t;
};

/// A corner is written as 4 * found triangle + k.
struct UnclearCorners {
    Buffer<std::uint32_t> found;  ///< the triangles, as numbers in the mesh; ascending
    Buffer<FoundTriangle> triangles;
    // Three per triangle: see row().
    Buffer<std::uint32_t> places;  ///< number of the node in `chosen`; kNone: not chosen
    Buffer<std::uint16_t> marks;
    Buffer<Directions> directions;
    Buffer<float> lengths_t;  ///< empty when the caller has no use for them

    Buffer<std::uint32_t> begin;  ///< one more than chosen nodes: ranges of `list`
    Buffer<std::uint32_t> list;   ///< corners node by node, ascending; without degenerate triangles
    /// One per chosen node; empty: all 0. Whether some corner copies one of the same node that may not be
    /// the first of its list, or a corner of another node.
    Marks entangled;
    static constexpr std::uint8_t kSameNode = 1, kOtherNode = 2;
    /// Corners of degenerate triangles, as corners of the mesh, with the corners that they copy; kMark | the
    /// node's number in `chosen`: the first of its list. And the number of the node itself.
    struct PlannedCopy {
        Copy copy;
        std::uint32_t place;
    };
    Growing<PlannedCopy> copies;

    explicit UnclearCorners(const Allocator* allocator) : copies(allocator) {}

    [[nodiscard]] static std::size_t row(std::uint32_t corner) { return corner - (corner >> 2); }
    [[nodiscard]] std::uint32_t count(std::size_t place) const { return begin[place + 1] - begin[place]; }
    [[nodiscard]] std::uint32_t flags(std::uint32_t corner) const { return triangles[corner >> 2].flags; }
    [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
        return triangles[corner >> 2].nodes[kNext[corner & 3]];
    }
    [[nodiscard]] std::uint32_t previous(std::uint32_t corner) const {
        return triangles[corner >> 2].nodes[kPrevious[corner & 3]];
    }
    /// Its corner of the mesh.
    [[nodiscard]] std::uint32_t slot(const TriangleList& all, std::uint32_t corner) const {
        return all.corner(3 * std::size_t{found[corner >> 2]} + (corner & 3));
    }

  private:
    static constexpr std::uint8_t kNext[4] = {1, 2, 0, 0}, kPrevious[4] = {2, 0, 1, 0};
};

/// What the corners are read from.
struct CornerReading {
    const MeshView& mesh;
    const TriangleList& triangles;
    const Nodes& nodes;
    std::span<const std::uint32_t> chosen;  ///< nodes, ascending
    CornerSource source;                    ///< tangents_only: neither t nor lengths_t
    bool with_lengths = false;
    CornerTermsFunction terms = nullptr;
    NodeSums* sums;  ///< the places of second paths are used; null: `chosen` are all nodes
    const Allocator* allocator = nullptr;
    Parallel& parallel;
};
UnclearCorners readCorners(const CornerReading& reading);

}  // namespace tspace::mikk
