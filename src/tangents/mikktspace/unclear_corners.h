// SPDX-License-Identifier: MIT
// The corners of chosen nodes, node by node, with all that grouping and summing them needs: what
// node_walk.cpp works on.
#pragma once

#include <span>

#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// More flags of a triangle, beside TriangleFlag.
inline constexpr std::uint8_t kContested = 0x40, kDegenerate = 0x80;

/// In UnclearCorner::common, beside marks: the orientation of the triangle.
inline constexpr std::uint32_t kIsUp = 0x10000, kIsDown = 0x20000;

/// A corner at a chosen node. All of it is in one cache line, and those of a node lie side by side. What one
/// of a triangle without UV area adds is nothing.
struct alignas(64) UnclearCorner {
    float s[4], t[4];  ///< rows of corner_terms.h
    float length_t;
    std::uint32_t next, previous;  ///< nodes
    std::uint32_t triangle;        ///< as a number in `found`
    std::uint32_t slot;            ///< corner of the mesh
    std::uint32_t place;           ///< number of the node in `chosen`
    std::uint32_t common;          ///< marks, and kIsUp or kIsDown; all bits for a triangle without UV area
    std::uint32_t flags;           ///< of the triangle, as it was read
};

struct UnclearCorners {
    // One per triangle around a chosen node.
    Buffer<std::uint32_t> found;  ///< their numbers in the mesh, ascending; empty: all
    Buffer<std::uint8_t> flags;
    // Three per triangle.
    Buffer<std::uint32_t> nodes;
    Buffer<std::uint32_t> at;  ///< where the corner is in `corners`; kNone: not at a chosen node
    std::uint64_t degenerate_count = 0, no_uv_area_count = 0, mirrored_count = 0;

    Buffer<UnclearCorner> corners;  ///< node by node, ascending by triangle
    // One per chosen node: its range of `corners`.
    Buffer<std::uint32_t> begin, end;
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

    [[nodiscard]] std::span<const UnclearCorner> around(std::size_t place) const {
        return {corners.data() + begin[place], end[place] - begin[place]};
    }
    /// Takes the corners of degenerate triangles out of a node's range, in which they are at first.
    void dropDegenerate(std::size_t place);

    [[nodiscard]] std::uint32_t triangleOf(std::size_t t) const {
        return found.empty() ? static_cast<std::uint32_t>(t) : found[t];
    }
};

/// What the corners are read from.
struct CornerReading {
    const MeshView& mesh;
    const TriangleList& triangles;
    const Nodes& nodes;
    std::span<const std::uint32_t> chosen;  ///< nodes, ascending
    CornerSource source;                    ///< tangents_only: neither t nor length_t
    CornerTermsFunction terms = nullptr;
    NodeSums* sums;  ///< the places of second paths are used; null: `chosen` are all nodes
    const Allocator* allocator = nullptr;
    Parallel& parallel;
};
UnclearCorners readCorners(const CornerReading& reading);

}  // namespace tspace::mikk
