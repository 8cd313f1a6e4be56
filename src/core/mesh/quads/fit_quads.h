// SPDX-License-Identifier: MIT
// Whether tangents were made by MikkTSpace on quads that were cut into triangles later, as Blender does, and which
// pairs of triangles those quads were.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/quads/quad_pairs.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

/// Whether quads explain clearly more corners than triangles do. Pairs are chosen by the corners that they explain,
/// which explains a few more of any mesh; so quads must explain a part of the unexplained corners, and a least number.
bool quadsWin(std::uint64_t corner_count, std::uint64_t near_on_triangles, std::uint64_t near_on_quads);

struct QuadFit {
    QuadFaces faces = {};
    std::vector<Vec4> tangents = {};  ///< what mikktspace gives on the faces: one per corner of the triangle list
    std::uint64_t corner_count = 0;   ///< corners that vote
    std::uint64_t near_on_triangles = 0, near_on_quads = 0;  ///< those whose tangent is explained

    [[nodiscard]] bool wins() const { return quadsWin(corner_count, near_on_triangles, near_on_quads); }
};

/// Finds the pairs of triangles that explain most. The first choice is that by shape; then each pair is weighed by how
/// near the stored tangents of its six corners are to those of mikktspace with the pair and without, which is known
/// after the pairs by shape, these turned, and those they exclude were computed once each; then again with the better
/// neighbours, as long as that explains more.
///
/// triangles      valid; three corners a face; with normals and UVs. Those whose UVs say nothing (uvVotes) fit nowhere
/// stored         one tangent per vertex
/// tolerance_deg  tangents nearer than this are the same
/// on_triangles   what mikktspace gives on the triangles as they are, one per corner; empty: it is computed here
///
/// Eight runs of mikktspace at most, and none where there are no two consecutive triangles with a common edge, or the
/// triangles leave too little unexplained for quads to win: then no face is a quad. Otherwise linear, with about 60
/// bytes per corner. Fails where generateTangents does.
Result<QuadFit> fitQuads(const MeshView& triangles, std::span<const Vec4> stored, const Execution& execution,
                         double tolerance_deg = 1, std::span<const Vec4> on_triangles = {});

/// mikktspace on these faces, one tangent per corner of the triangle list, with the raw sign.
Result<std::vector<Vec4>> tangentsOnFaces(const MeshView& triangles, const QuadFaces& faces,
                                          const Execution& execution);

}  // namespace tspace
