// SPDX-License-Identifier: MIT
// Step 3: what each triangle says on its own: degenerate or not, orientation, dP/du and dP/dv.
#pragma once

#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// Twice the signed UV area, and dP/du, dP/dv with their lengths.
struct TriangleShape {
    float area = 0;
    bool any = true;
    TriangleFrame frame;
};
TriangleShape triangleShape(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec2& uv0, const Vec2& uv1,
                            const Vec2& uv2);

/// What later planning steps need of triangles, besides the plan itself.
struct TrianglePass {
    Buffer<std::uint32_t> faces;  ///< one per good triangle; empty: triangle t is face t
    /// Corners that only a degenerate triangle has. `from` is a corner of the mesh, or kMark | node: the
    /// first good corner of that node.
    Growing<Copy> copies;
    std::size_t uv_degenerate_count = 0;

    explicit TrianglePass(const Allocator* allocator) : copies(allocator) {}
};

/// Fills the plan's nodes, slots, flags, triangle_count and report counts, and pose.frames; pose.positions
/// and plan.node_uv must be there.
TrianglePass passTriangles(const MeshView& mesh, const TriangleList& list, const Nodes& nodes,
                           GroupedPlan& plan, PoseData& pose, const Allocator* allocator, Parallel& parallel);

}  // namespace tspace::mikk
