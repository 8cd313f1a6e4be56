// SPDX-License-Identifier: MIT
// The plan of the methods that need no groups: lengyel, flat and basis.
#pragma once

#include "core/base/call.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/method_kind.h"
#include "tspace/tangents.h"

namespace tspace {

/// The plan is a view of what the methods read, and the arrays that no mesh has. A plan that is kept also
/// owns copies of indices and UVs; one that is used up within a call looks at the mesh itself.
struct IndexedPlan {
    Method method = Method::lengyel;
    OutputDomain domain = OutputDomain::corner;
    float sign_factor = 1.0f;  ///< signFactor(convention)
    std::size_t vertex_count = 0;
    std::size_t face_count = 0;
    IndexView corner_vertices;          ///< one per corner of the mesh
    IndexView triangle_vertices;        ///< three per triangle, after cutting faces; face order
    StridedSpan<const Vec2> uvs;        ///< one per vertex; empty for basis
    Buffer<std::uint32_t> face_begins;  ///< first corner of each face and one past the last; empty: all are triangles
    Buffer<std::uint8_t> corner_used;   ///< one per corner: 1 when its face is used, else outputs are 0; empty: all are
    Buffer<std::uint32_t> cut_triangles;  ///< behind triangle_vertices when there are other faces than triangles
    Buffer<std::uint32_t> kept_vertices;  ///< behind corner_vertices when the plan is kept
    Buffer<Vec2> kept_uvs;                ///< behind uvs when the plan is kept
    TangentReport report;                 ///< what can be counted without a pose

    [[nodiscard]] std::size_t cornerCount() const { return corner_vertices.count; }
    [[nodiscard]] std::size_t triangleCount() const { return triangle_vertices.count / 3; }
    /// Entries of every output.
    [[nodiscard]] std::size_t outputCount() const {
        return domain == OutputDomain::vertex ? vertex_count : cornerCount();
    }
    [[nodiscard]] bool isUsed(std::size_t corner) const { return corner_used.empty() || corner_used[corner] != 0; }
    [[nodiscard]] std::uint32_t faceBegin(std::size_t face) const {
        return face_begins.empty() ? static_cast<std::uint32_t>(3 * face) : face_begins[face];
    }
    [[nodiscard]] std::size_t memoryBytes() const;
};

/// Makes the plan; the mesh has been validated and has the attributes that the method needs. With
/// PlanUse::once it holds 0 bytes for a mesh of triangles. Throws OutOfMemory.
IndexedPlan planIndexed(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel,
                        PlanUse use = PlanUse::kept);

/// Evaluates one pose into checked outputs; returns the plan's report with the counts that depend on the pose
/// added. Throws OutOfMemory.
TangentReport evaluateIndexed(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Execution& execution, Parallel& parallel);

}  // namespace tspace
