// SPDX-License-Identifier: MIT
// The usual case in one call: an indexed mesh in, an indexed mesh with normals and tangents out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace {

// From results per corner to an indexed mesh: vertices whose corners disagree are duplicated.

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

/// How makeIndexedFrames works.
struct IndexedFramesOptions {
    /// Its convention must be set; it also says which side of a face is out.
    /// Results are per corner (`domain`): the split makes vertices of them.
    TangentOptions tangents = {};
    /// Where normals are made. Its convention is not looked at: that of `tangents` counts.
    NormalOptions normals = {};
    bool make_normals = false;  ///< also where the mesh has normals; they are made anyway where it has none
    /// Mend tangents that are not finite, zero, not unit, parallel to N, or of mixed sign inside a face.
    bool sanitize = true;
    bool orthogonalize_all = false;  ///< like SanitizeOptions::orthogonalize_all
    /// Further attributes, one entry per corner, that must not be shared: corners that disagree get a vertex each.
    /// Only a mesh without indices needs it, for what hangs on its vertices beside position, normal and UV.
    std::span<const CornerAttribute> keep_apart = {};
};

struct IndexedFramesReport {
    bool normals_made = false;
    NormalReport normals = {};
    TangentReport tangents = {};
    SanitizeReport sanitize = {};
};

/// A mesh with the faces of the given one. Gather every other vertex attribute, skin weight and morph target through
/// source_vertices, and attributes that have an index list of their own through the corner:
/// their_indices[source_corners[v]].
struct IndexedFrames {
    std::vector<std::uint32_t> indices = {};          ///< one per corner: the new vertex
    std::vector<std::uint32_t> source_vertices = {};  ///< one per new vertex: the entry of `positions` that it copies
    /// One per new vertex: the first corner that uses it, or kNoCorner where none does.
    std::vector<std::uint32_t> source_corners = {};
    std::vector<Vec3> normals =
        {};  ///< one per new vertex: those of the mesh (see TangentOptions::normalize_normals), or the ones made
    std::vector<Vec4> tangents = {};  ///< one per new vertex: unit tangent and sign
    IndexedFramesReport report = {};

    [[nodiscard]] std::size_t vertexCount() const { return source_vertices.size(); }
};

/// Makes normals where they are missing or asked for (generateNormals), tangents (generateTangents), mends those that
/// are broken (sanitizeTangents), and splits vertices whose corners disagree in either (splitVertices). Each corner has
/// the tangent that these calls give it, bit for bit.
///
/// A mesh with one index list keeps its vertices in their places, also those that no corner uses (which get a frame from
/// their normal), and copies come behind them. A mesh without indices, or with an index list per attribute, gets new
/// vertices in the order in which corners first use them, one for all corners with the same bits of position, normal, UV,
/// tangent and `keep_apart` (the zeros of a position are equal, as they are for normals).
///
/// mesh       positions; normals or none; UVs (all methods but `basis`)
/// execution  threads and memory of all steps; changes no bit
/// Errors: those of the four calls. O(corners) expected. Thread-safe; same bits for any thread count.
Result<IndexedFrames> makeIndexedFrames(const MeshView& mesh, const IndexedFramesOptions& options,
                                        const Execution& execution = {});

}  // namespace tspace
