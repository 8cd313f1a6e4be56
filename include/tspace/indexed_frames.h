// SPDX-License-Identifier: MIT
// The usual case in one call: an indexed mesh in, an indexed mesh with normals and tangents out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/sanitize.h"
#include "tspace/split.h"
#include "tspace/tangents.h"

namespace tspace {

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
    bool orthogonalize_all = false;  ///< as SanitizeOptions::orthogonalize_all
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
