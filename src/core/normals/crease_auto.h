// SPDX-License-Identifier: MIT
// NormalOptions::crease_auto: which edges are hard, by the mesh.
#pragma once

#include <cstdint>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

/// Of the edge from a corner to the next one on its face.
enum class EdgeKind : std::uint8_t {
    byAngle,  ///< it has other than two faces
    soft,
    hard,
};

struct Creases {
    float angle_deg = 180;
    bool are_all_soft = true;     ///< no edge is hard, nor has more than two faces
    Buffer<EdgeKind> edges = {};  ///< of each corner
};

/// By the histogram of the angles of edges: in the widest gap between those that most have and those that few have. Where
/// positions are noisy, by faces whose normals were smoothed over what is no edge. Then without what is one edge long, and
/// with what one edge interrupts. The mesh and its options have been checked.
/// Takes normal_groups.h, then 57 bytes per corner. O(n log n) for points with many edges, else linear. Throws OutOfMemory.
/// Based on: Zheng, Fu, Au & Tai, "Bilateral Normal Filtering for Mesh Denoising", 2011.
Creases findCreases(const MeshView& mesh, const NormalOptions& options, const Execution& execution, Parallel& parallel);

}  // namespace tspace
