// SPDX-License-Identifier: MIT
// The methods that need no groups, lengyel, flat and basis: their plan, a function for each, and what these share.
#pragma once

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"
#include "core/tangents/method_kind.h"
#include "tspace/tangents.h"

namespace tspace {

// The plan of the methods that need no groups: lengyel, flat and basis.

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
    Buffer<std::uint32_t> cut_triangles;  ///< corner triangles after cutting, if faces are not all triangles
    Buffer<std::uint32_t> kept_vertices;  ///< storage of corner_vertices if the plan is kept
    Buffer<Vec2> kept_uvs;                ///< storage of uvs if the plan is kept
    TangentReport report;                 ///< counts that need no pose

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

// One function for each method that needs no groups, and what they share.

/// All outputs of one corner.
struct CornerFrame {
    Vec4 tangent;
    Vec3 bitangent;
    float magnitude_s = 0;
    float magnitude_t = 0;
    bool has_tangent = false;  ///< false: no face gives one
};

/// dP/du and dP/dv at a corner, before they are made into a frame. Zero: no face gave any.
struct Derivatives {
    DVec3 s, t;
};

/// Gram-Schmidt against N as given: T' = unit(T - N (N.T)), sign = dot(cross(N, T'), B) < 0 ? -1 : 1;
/// bitangent = unit(B), or that of sign * cross(N, T') where B is zero. Where T' has no length or is not
/// finite: (1, 0, 0), sign 1, bitangent (0, 1, 0), magnitudes 1. Sign and bitangent are multiplied with
/// `sign_factor`. Never gives a NaN.
CornerFrame makeCornerFrame(const Derivatives& derivatives, const Vec3& normal, float sign_factor);

/// The length of sum / count as a float, which a mean of floats can exceed only by its rounding.
float meanLength(const DVec3& sum, double count);

/// Write the requested outputs; writeExtras writes all but the tangent.
void writeFrame(const TangentOutput& out, std::size_t entry, const CornerFrame& frame);
void writeExtras(const TangentOutput& out, std::size_t entry, const CornerFrame& frame);

/// Each writes the used outputs and sets the counts of `report` that it knows and the plan does not.
void evaluateLengyel(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Execution& execution,
                     Parallel& parallel, TangentReport& report);
void evaluateFlat(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, Parallel& parallel,
                  TangentReport& report);
void evaluateBasis(const IndexedPlan& plan, const Pose& pose, const TangentOutput& out, const Allocator* allocator,
                   Parallel& parallel, TangentReport& report);

}  // namespace tspace
