// SPDX-License-Identifier: MIT
// Methods without groups (lengyel, flat and basis): their plan, one function each, and shared code.
#pragma once

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "core/tangents/method_kind.h"
#include "tspace/tangents.h"

namespace tspace {

// Plan of the methods that do not group corners: lengyel, flat and basis.

/// View of the data that the methods read, and derived arrays. A plan that is kept also owns copies of indices and UVs;
/// a plan that is used within a single call refers to the mesh itself.
struct IndexedPlan {
    Method method = Method::lengyel;
    OutputDomain domain = OutputDomain::corner;
    float sign_factor = 1.0f;  ///< signFactor(convention)
    std::size_t vertex_count = 0;
    std::size_t face_count = 0;
    IndexView corner_vertices;    ///< vertex of each corner of the mesh
    IndexView triangle_vertices;  ///< three vertices per triangle, after triangulation; in face order
    StridedSpan<const Vec2> uvs;  ///< one per vertex; empty for basis
    /// First corner of each face, and the corner after the last face; empty: all faces are triangles.
    Buffer<std::uint32_t> face_begins;
    /// One per corner: 1 if its face is used; outputs of other corners are 0. Empty: all are used.
    Buffer<std::uint8_t> corner_used;
    Buffer<std::uint32_t> cut_triangles;  ///< corners of the triangles, if not all faces are triangles
    Buffer<std::uint32_t> kept_vertices;  ///< storage of corner_vertices if the plan is kept
    Buffer<Vec2> kept_uvs;                ///< storage of uvs if the plan is kept
    TangentReport report;                 ///< counts of the report that do not depend on the pose

    [[nodiscard]] std::size_t cornerCount() const { return corner_vertices.count; }
    [[nodiscard]] std::size_t triangleCount() const { return triangle_vertices.count / 3; }
    /// Returns the number of entries of every output.
    [[nodiscard]] std::size_t outputCount() const {
        return domain == OutputDomain::vertex ? vertex_count : cornerCount();
    }
    [[nodiscard]] bool isUsed(std::size_t corner) const { return corner_used.empty() || corner_used[corner] != 0; }
    [[nodiscard]] std::uint32_t faceBegin(std::size_t face) const {
        return face_begins.empty() ? static_cast<std::uint32_t>(3 * face) : face_begins[face];
    }
    [[nodiscard]] std::size_t memoryBytes() const;
};

/// Creates the plan. Requires a validated mesh with the attributes that the method needs. With PlanUse::once it uses no
/// memory for a triangle mesh. Throws OutOfMemory.
IndexedPlan planIndexed(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel,
                        PlanUse use = PlanUse::kept);

/// Evaluates one pose into validated outputs, and returns the plan's report with the counts that depend on the pose.
/// Throws OutOfMemory.
TangentReport evaluateIndexed(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out,
                              const Execution& execution, Parallel& parallel);

// Functions of the methods that do not group corners, and code that they share.

/// All outputs for one corner.
struct CornerFrame {
    Vec4 tangent;
    Vec3 bitangent;
    float magnitude_s = 0;
    float magnitude_t = 0;
    bool has_tangent = false;  ///< false: no face contributes to it
};

/// Values of dP/du and dP/dv at a corner, before their conversion to a frame. Zero: no face contributes.
struct Derivatives {
    DVec3 s, t;
};

/// Creates a frame by Gram-Schmidt against N as given: T' = unit(T - N (N.T)), sign = dot(cross(N, T'), B) < 0 ? -1 :
/// 1; bitangent = unit(B), or the direction of sign * cross(N, T') if B is zero. If T' has no length or is not finite:
/// (1, 0, 0), sign 1, bitangent (0, 1, 0), magnitudes 1. Sign and bitangent are multiplied by `sign_factor`. Never
/// returns NaN.
CornerFrame makeCornerFrame(const Derivatives& derivatives, const Vec3& normal, float sign_factor);

/// Returns the length of sum / count, limited to the largest float, which the mean length of float vectors exceeds at
/// most by rounding.
float meanLength(const DVec3& sum, double count);

/// Write the requested outputs; writeExtras writes all of them except the tangent.
void writeFrame(const TangentOutput& out, std::size_t entry, const CornerFrame& frame);
void writeExtras(const TangentOutput& out, std::size_t entry, const CornerFrame& frame);

/// Evaluate a method: write the used outputs, and set the counts of `report` that depend on the pose.
void evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Execution& execution,
                     Parallel& parallel, TangentReport& report);
void evaluateFlat(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, Parallel& parallel,
                  TangentReport& report);
void evaluateBasis(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Allocator* allocator,
                   Parallel& parallel, TangentReport& report);

}  // namespace tspace
