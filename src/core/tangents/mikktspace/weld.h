// SPDX-License-Identifier: MIT
// Triangulates faces and welds equal vertices.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/mikktspace/welded_mesh.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

TriangleList cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator);

/// Welds equal vertices. Uses as much memory as findRoots (core/base/weld.h); up to 4 bytes per vertex remain
/// allocated. `transient` allocates temporary memory; null: `allocator`.
Nodes weld(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator, Parallel& parallel,
           const Allocator* transient = nullptr);

/// Fills nodes.vertices, if necessary, so that nodes.vertex() is valid.
void listVertices(Nodes& nodes, const Allocator* allocator);

}  // namespace tspace::mikk
