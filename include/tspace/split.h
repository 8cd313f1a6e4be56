// SPDX-License-Identifier: MIT
// From results per corner to an indexed mesh: vertices whose corners disagree are duplicated.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/execution.h"
#include "tspace/mesh.h"

namespace tspace {

/// One attribute given per corner, as `component_count` floats.
struct CornerAttribute {
    const float* data = nullptr;
    std::size_t stride_bytes = 0;       ///< from corner to corner; at least 4 * component_count
    std::uint32_t component_count = 0;  ///< 1..16
    /// 0: corners are equal only when all bits are. Above 0: equal when every component differs by at most this
    /// from the first corner that got the vertex (so float noise does not split); NaN equals nothing but its own bits.
    float tolerance = 0.0f;
};

/// Views per-corner vectors as an attribute.
inline CornerAttribute cornerAttribute(const StridedSpan<const Vec3>& s, float tolerance = 0.0f) {
    return {s.data ? &s.data->x : nullptr, s.stride_bytes, 3, tolerance};
}
inline CornerAttribute cornerAttribute(const StridedSpan<const Vec4>& s, float tolerance = 0.0f) {
    return {s.data ? &s.data->x : nullptr, s.stride_bytes, 4, tolerance};
}

/// Marks a vertex that no corner uses.
inline constexpr std::uint32_t kNoCorner = 0xffffffffu;

/// The new index buffer and where each new vertex comes from.
struct SplitResult {
    std::vector<std::uint32_t> indices = {};  ///< one per corner: the new vertex
    /// One per new vertex: the old vertex that it copies. The first `old vertex count` entries are 0, 1, 2, ...:
    /// old vertices keep their place, copies are appended. Gather every vertex attribute, skin weight and morph
    /// target through it.
    std::vector<std::uint32_t> source_vertices = {};
    /// One per new vertex: the corner whose attribute values belong to it, or kNoCorner when no corner uses it.
    std::vector<std::uint32_t> source_corners = {};

    [[nodiscard]] std::size_t vertexCount() const { return source_vertices.size(); }
};

/// Splits vertices whose corners disagree in any of the attributes.
///
/// The first corner (in corner order) of an old vertex keeps the vertex; each corner that equals none of the
/// vertex's earlier variants gets a copy, appended in corner order. Deterministic.
///
/// indices       the old vertex of each corner (IndexType::none: corner c uses vertex c)
/// vertex_count  number of old vertices
/// corner_count  length of every attribute; equals the count of `indices` unless there are none
/// execution     threads; scratch memory is only needed where a vertex becomes more than 8
/// Errors: nullData, countMismatch, indexOutOfRange, strideTooSmall, tooLarge, invalidOption, outOfMemory.
/// O(corners) expected, exact or tolerant. Thread-safe; same result for any thread count.
Result<SplitResult> splitVertices(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count,
                                  std::span<const CornerAttribute> attributes, const Execution& execution = {});

}  // namespace tspace
