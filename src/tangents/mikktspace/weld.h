// SPDX-License-Identifier: MIT
// Step 2: welding. Corners with equal position, normal and UV become one node.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"

namespace tspace::mikk {

struct Nodes {
    std::size_t count = 0;
    Buffer<std::uint32_t> of_corner;  ///< one per corner of the mesh; kNone for corners of skipped faces
    /// One per node: a corner of it. The corner that the reference keeps as the "representative" where that
    /// matters for the bits of node data (nodes that mix -0 and +0), else the first one.
    Buffer<std::uint32_t> corner;
    bool exact = false;  ///< `corner` is the reference's representative for every node
};

Nodes weld(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator,
           Parallel& parallel);

}  // namespace tspace::mikk
