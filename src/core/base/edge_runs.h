// SPDX-License-Identifier: MIT
// Half-edges, an edge at a time: listed by their lower point, so that all halves of an edge lie together in a short list.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/sort.h"

namespace tspace {

/// The higher point of an edge, and the corner of the face at which this half of it begins.
using HalfEdge = std::uint64_t;
inline std::uint32_t cornerOf(HalfEdge half) { return static_cast<std::uint32_t>(half); }

/// body(low, high, halves) for each edge between two points below `point_count`, in ascending order, with its halves by
/// their corners. forHalves(add) calls add(low, high, corner) for all halves, and is called twice. Takes 8 bytes for each half
/// and 4 for each point. O(n log n) for points with many edges, else linear.
template <class ForHalves, class Body>
void forEachEdge(std::size_t point_count, const Allocator* allocator, const ForHalves& forHalves, const Body& body) {
    Buffer<std::uint32_t> ends(allocator, point_count + 1, 0);
    forHalves([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++ends[low + 1]; });
    for (std::size_t p = 0; p < point_count; ++p) ends[p + 1] += ends[p];
    Buffer<HalfEdge> halves(allocator, ends[point_count]);
    // Afterwards ends[p] is where the list of p ends.
    forHalves([&](std::uint32_t low, std::uint32_t high, std::uint32_t corner) {
        halves[ends[low]++] = std::uint64_t{high} << 32 | corner;
    });
    for (std::size_t p = 0, begin = 0; p < point_count; begin = ends[p++]) {
        sortList(halves.data() + begin, halves.data() + ends[p]);
        for (std::size_t i = begin, past = begin; i < ends[p]; i = past) {
            while (past < ends[p] && halves[past] >> 32 == halves[i] >> 32) ++past;
            body(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(halves[i] >> 32),
                 std::span<const HalfEdge>(halves.data() + i, past - i));
        }
    }
}

}  // namespace tspace
