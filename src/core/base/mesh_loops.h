// SPDX-License-Identifier: MIT
// Loops over all faces, over all indices (whose type is dispatched once per loop, not per corner), and over all edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/sort.h"
#include "tspace/mesh.h"

namespace tspace {

/// Calls body(vertexOf), where vertexOf(c) is view[c]. Specialized for 32-bit indices.
template <class Body>
decltype(auto) withIndices(const IndexView& view, Body&& body) {
#ifdef TSPACE_SMALL  // this build has 32-bit indices only
    const auto* data = view.type == IndexType::none ? nullptr : static_cast<const std::uint32_t*>(view.data);
    return body([data](std::size_t c) { return data == nullptr ? static_cast<std::uint32_t>(c) : data[c]; });
#endif
    if (view.type == IndexType::u32)
        return body([data = static_cast<const std::uint32_t*>(view.data)](std::size_t c) { return data[c]; });
    return body([view](std::size_t c) { return view[c]; });
}

/// Converts the indices [first, first + count), which are not 32-bit, to 32-bit integers in `buffer`, and returns it.
const std::uint32_t* widenIndices(const IndexView& view, std::size_t first, std::size_t count, std::uint32_t* buffer);

/// Returns the indices [first, first + count) as 32-bit integers: in place, or in `buffer`.
inline const std::uint32_t* readIndices(const IndexView& view, std::size_t first, std::size_t count,
                                        std::uint32_t* buffer) {
    if (view.type == IndexType::u32) return static_cast<const std::uint32_t*>(view.data) + first;
    return widenIndices(view, first, count, buffer);
}

inline std::uint32_t faceSize(const MeshView& mesh, std::size_t face) {
    return mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[face];
}

/// Calls body(face, first_corner, corner_count) for each face in order.
template <class Body>
void forEachFace(const MeshView& mesh, Body&& body) {
    const std::size_t faces = mesh.faceCount();
    // Local copies: unlike the members of `mesh`, they cannot be changed by stores of the body, so the compiler keeps
    // them in registers.
    const std::uint32_t* const sizes = mesh.face_sizes.data();
    const bool one_size = mesh.face_sizes.empty();
    const std::uint32_t same_size = mesh.face_size;
    std::size_t corner = 0;
    for (std::size_t face = 0; face < faces; ++face) {
        const std::uint32_t size = one_size ? same_size : sizes[face];
        body(face, corner, size);
        corner += size;
    }
}

// Half-edges grouped by edge. Each is in the list of the edge's point with the lower index, so that all half-edges of
// an edge are in one short list.

/// The edge's point with the higher index, in the upper 32 bits, and the corner at which the half-edge starts, in the
/// lower ones.
using HalfEdge = std::uint64_t;
inline std::uint32_t cornerOf(HalfEdge half) { return static_cast<std::uint32_t>(half); }

/// Calls body(low, high, halves) for each edge between two points below `point_count`, in ascending order; its halves
/// are sorted by corner. forHalves(add) calls add(low, high, corner) for all halves, and is called twice. Uses 8 bytes
/// per half and 4 per point. O(n log n) for points with many edges, otherwise linear.
template <class ForHalves, class Body>
void forEachEdge(std::size_t point_count, const Allocator* allocator, const ForHalves& forHalves, const Body& body) {
    Buffer<std::uint32_t> ends(allocator, point_count + 1, 0);
    forHalves([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++ends[low + 1]; });
    for (std::size_t p = 0; p < point_count; ++p) ends[p + 1] += ends[p];
    Buffer<HalfEdge> halves(allocator, ends[point_count]);
    // Afterwards ends[p] is the end of the list of p.
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
