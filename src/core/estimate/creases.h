// SPDX-License-Identifier: MIT
// NormalOptions::crease_auto: automatic detection of hard edges.
#pragma once

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/normals/normals_call.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"

namespace tspace {

struct Creases {
    float angle_deg = 180;
    bool are_all_soft = true;     ///< true: no edge is hard or has more than two faces
    Buffer<EdgeKind> edges = {};  ///< edge kind of each corner
};

/// Finds hard edges from the histogram of dihedral angles: the threshold is the middle of its widest gap, between the
/// many small angles and the few large ones. For noisy positions, uses faces whose normals were smoothed except across
/// edges. Then removes creases of one edge, and closes gaps of one edge. Requires a validated mesh and options.
/// Memory: that of NormalGroups (denoise.h), then 57 bytes per corner. O(n log n) for points with many edges, otherwise
/// linear. Throws OutOfMemory.
/// Based on: Zheng, Fu, Au & Tai, "Bilateral Normal Filtering for Mesh Denoising", 2011.
Creases findCreases(const MeshView& mesh, const NormalOptions& options, const Execution& execution, Parallel& parallel);

}  // namespace tspace
