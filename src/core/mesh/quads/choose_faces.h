// SPDX-License-Identifier: MIT
// The faces that tangents are computed on or compared with: triangles, or quads that these were cut from.
#pragma once

#include <span>

#include "core/mesh/quads/fit_quads.h"
#include "tspace/asset.h"
#include "tspace/triangulate.h"

namespace tspace {

/// The quads that are meant by `faces`; none (quad_count 0): the triangles. Where tangents are there and fit clearly
/// better to quads, those that they fit; else `quads` takes the pairs by shape, and so does `automatic` where Blender
/// wrote a mesh without tangents most of whose triangles meet as those do that it cuts quads into.
///
/// triangles    as fitQuads wants them
/// stored       one tangent per vertex, or empty
/// is_blenders  Blender wrote the file
///
/// Cost and errors: those of fitQuads.
Result<QuadFaces> chooseFaces(const MeshView& triangles, std::span<const Vec4> stored, bool is_blenders, Faces faces,
                              const Execution& execution);

/// Polygons as faces over their own triangles. Those with fewer than three corners are left out.
QuadFaces facesOfPolygons(std::span<const std::uint32_t> face_sizes, const Triangulation& triangles);

}  // namespace tspace
