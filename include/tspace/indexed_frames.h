// SPDX-License-Identifier: MIT
// Computes the normals and tangents of an indexed mesh in one call, and splits its vertices where needed.
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

// Conversion of per-corner results to an indexed mesh: vertices whose corners differ are duplicated.

/// Attribute given per corner, as `component_count` floats.
struct CornerAttribute {
    const float* data = nullptr;
    std::size_t stride_bytes = 0;       ///< distance between corners; at least 4 * component_count
    std::uint32_t component_count = 0;  ///< number of floats, 1 to 16
    /// 0: corners are equal only if all bits are. Above 0: equal if every component differs by at most this from the
    /// first corner of the vertex (so rounding noise does not split); NaN equals only its own bits.
    float tolerance = 0.0f;
};

/// Returns a view of per-corner vectors as an attribute.
inline CornerAttribute cornerAttribute(const StridedSpan<const Vec3>& s, float tolerance = 0.0f) {
    return {s.data ? &s.data->x : nullptr, s.stride_bytes, 3, tolerance};
}
inline CornerAttribute cornerAttribute(const StridedSpan<const Vec4>& s, float tolerance = 0.0f) {
    return {s.data ? &s.data->x : nullptr, s.stride_bytes, 4, tolerance};
}

/// Value for a vertex that no corner uses.
inline constexpr std::uint32_t kNoCorner = 0xffffffffu;

/// New index buffer, and the source of each new vertex.
struct SplitResult {
    std::vector<std::uint32_t> indices = {};  ///< one per corner: the new vertex
    /// One per new vertex: the old vertex that it copies. The first `old vertex count` entries are 0, 1, 2, ...: old
    /// vertices keep their indices, copies are appended. Gather every vertex attribute, skin weight and morph target
    /// through it.
    std::vector<std::uint32_t> source_vertices = {};
    /// One per new vertex: the corner whose attribute values belong to it, or kNoCorner when no corner uses it.
    std::vector<std::uint32_t> source_corners = {};

    [[nodiscard]] std::size_t vertexCount() const { return source_vertices.size(); }
};

/// Splits vertices whose corners differ in any of the attributes.
///
/// The first corner (in corner order) of an old vertex keeps the vertex; each corner that equals none of the vertex's
/// earlier variants gets a copy, appended in corner order. Deterministic.
///
/// indices       the old vertex of each corner (IndexType::none: corner c uses vertex c)
/// vertex_count  number of old vertices
/// corner_count  length of every attribute; equals the count of `indices`, if there are any
/// execution     threads; scratch memory is only needed for vertices with more than 8 variants
/// Errors: nullData, countMismatch, indexOutOfRange, strideTooSmall, tooLarge, invalidOption, outOfMemory.
/// O(corners) expected, with or without tolerance. Thread-safe; same result for any thread count.
Result<SplitResult> splitVertices(const IndexView& indices, std::size_t vertex_count, std::size_t corner_count,
                                  std::span<const CornerAttribute> attributes, const Execution& execution = {});

/// Options of makeIndexedFrames.
struct IndexedFramesOptions {
    /// Tangent options. The convention must be set; it also defines the outside of a face. Results are per corner
    /// (`domain`): the split turns them into vertices.
    TangentOptions tangents = {};
    /// Options for computed normals. Their convention is ignored; the convention of `tangents` is used.
    NormalOptions normals = {};
    bool make_normals = false;  ///< recompute existing normals; missing normals are always computed
    /// Repair tangents that contain NaN or infinity, are zero, do not have unit length, are parallel to N, or have
    /// different signs within a face.
    bool sanitize = true;
    bool orthogonalize_all = false;  ///< same meaning as SanitizeOptions::orthogonalize_all
    /// Further attributes, one entry per corner, that must not be shared: corners with different values get separate
    /// vertices. Only a mesh without indices needs them, for vertex attributes other than position, normal and UV.
    std::span<const CornerAttribute> keep_apart = {};
};

struct IndexedFramesReport {
    bool normals_made = false;
    NormalReport normals = {};
    TangentReport tangents = {};
    SanitizeReport sanitize = {};
};

/// Indexed mesh with the same faces as the input. Gather every other vertex attribute, skin weight and morph target
/// through source_vertices, and attributes with their own index list through the corner:
/// their_indices[source_corners[v]].
struct IndexedFrames {
    std::vector<std::uint32_t> indices = {};          ///< one per corner: the new vertex
    std::vector<std::uint32_t> source_vertices = {};  ///< one per new vertex: the entry of `positions` that it copies
    /// One per new vertex: the first corner that uses it, or kNoCorner if there is none.
    std::vector<std::uint32_t> source_corners = {};
    /// One per new vertex: normals of the mesh (see TangentOptions::normalize_normals), or computed ones.
    std::vector<Vec3> normals = {};
    std::vector<Vec4> tangents = {};  ///< one per new vertex: unit tangent and sign
    IndexedFramesReport report = {};

    [[nodiscard]] std::size_t vertexCount() const { return source_vertices.size(); }
};

/// Computes normals if they are missing or requested (generateNormals) and tangents (generateTangents), repairs invalid
/// tangents (sanitizeTangents), and splits vertices whose corners differ in either (splitVertices). The tangent of each
/// corner equals the result of these calls, bit for bit.
///
/// A mesh with one index list keeps its vertices and their order, including unused ones (which get a frame from their
/// normal); copies are appended. A mesh without indices, or with an index list per attribute, gets new vertices in the
/// order in which corners first use them: one for all corners with the same bits of position, normal, UV, tangent and
/// `keep_apart` (+0 and -0 of a position are equal, as for normals).
///
/// mesh       positions; normals or none; UVs (all methods but Method::basis)
/// execution  threads and memory of all steps; does not affect the result
/// Errors: those of the four calls. O(corners) expected. Thread-safe; same bits for any thread count.
Result<IndexedFrames> makeIndexedFrames(const MeshView& mesh, const IndexedFramesOptions& options,
                                        const Execution& execution = {});

}  // namespace tspace
