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
TrianglePass passTriangles(const MeshView& mesh, const TriangleList& list, const Nodes& nodes, GroupedPlan& plan,
                           PoseData& pose, const Allocator* allocator, Parallel& parallel);

/// Which triangle of a face gives all of them its orientation. In a quad that is the first, unless the second
/// has a usable UV area and the first's is not at least as large; in an n-gon it is the largest that has a
/// usable one. `uvArea` is without sign.
template <class IsAny, class UvArea>
std::size_t orientingTriangle(std::size_t first, std::size_t end, const IsAny& isAny, const UvArea& uvArea) {
    if (end - first == 2) return !isAny(first + 1) && !(uvArea(first) >= uvArea(first + 1)) ? first + 1 : first;
    std::size_t chosen = first;
    for (std::size_t t = first + 1; t < end; ++t) {
        if (isAny(t)) continue;
        if (isAny(chosen) || uvArea(t) > uvArea(chosen)) chosen = t;
    }
    return chosen;
}

}  // namespace tspace::mikk
