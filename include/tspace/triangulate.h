// SPDX-License-Identifier: MIT
// Cuts quads and n-gons into triangles by one stated rule, so that whoever bakes and whoever renders agree.
#pragma once

#include <cstdint>
#include <vector>

#include "tspace/mesh.h"

namespace tspace {

/// Triangles of a polygon mesh, as corners of the original mesh (not vertices), so that results per corner carry over.
struct Triangulation {
    std::vector<std::uint32_t> corners = {};  ///< three per triangle, winding kept
    std::vector<std::uint32_t> faces = {};    ///< one per triangle: the face it was cut from
};

/// Cuts every face with 4 or more corners.
///
/// Quads: the diagonal that MikkTSpace takes: the shorter one in UV space; if equal (or without UVs) 1-3 only when
/// it is strictly shorter in space, else 0-2.
/// n-gons: ears are clipped, the ear with the shortest diagonal first (squared length in space; ties by the diagonal
/// in UV space, then by the coordinates of its end points), ears seen in the plane of Newell's normal. The cut
/// depends on the polygon's geometry, not on the vertex it starts with. Where no ear is left (polygon not simple),
/// the shortest diagonal is cut anyway. Above 1024 corners the test that an ear is empty is left out.
/// Faces with fewer than 3 corners give nothing. Triangles come in face order.
/// Errors: those of validate(); outOfMemory. O(corners) for triangles and quads, O(n^2) at most for an n-gon.
Result<Triangulation> triangulate(const MeshView& mesh);

}  // namespace tspace
