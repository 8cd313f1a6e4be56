// SPDX-License-Identifier: MIT
// Steps that generateTangents and plans share: checks of a call, the symmetric frame, and reports.
#pragma once

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/unit_normals.h"
#include "core/base/vec_math.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mirrored_count.h"
#include "tspace/tangents.h"

namespace tspace {

/// Checks the options and the mesh of a call.
Error checkInput(const MeshView& mesh, const TangentOptions& options, Parallel& parallel);
/// Checks the domain for a mesh with several index lists. Its vertices are combinations that the caller does not know,
/// so results per vertex are not possible.
Error checkDomain(const TangentOptions& options);
Error checkOutput(const TangentOutput& out, std::size_t output_count);
/// Initializes has_tangent to 1: methods clear the entries of outputs without a contributing face.
void startHasTangent(const TangentOutput& out, Parallel& parallel);

inline std::size_t outputCount(const MeshView& mesh, const TangentOptions& options) {
    return options.domain == OutputDomain::vertex ? mesh.vertexCount() : mesh.cornerCount();
}

inline MeshView withNormals(MeshView mesh, const UnitNormals& normals) {
    mesh.normals = normals.view();
    return mesh;
}

/// Adapts the report to the convention: methods count triangles with negative UV area as mirrored.
inline TangentReport inConvention(TangentReport report, Method method, bool positive_is_mirrored) {
    if (positive_is_mirrored) report.mirrored_count = notMirroredCount(report, method);
    return report;
}

/// FrameShape::symmetric: the orthonormal frame closest to dP/du and dP/dv, with equal weights. Returns the tangent of
/// that frame, or `tangent` if one of the three vectors has no direction.
/// Based on: Löwdin, "On the Non-Orthogonality Problem", 1950 (symmetric orthogonalization), here for two unit vectors.
inline Vec3 symmetricTangent(const Vec3& tangent, const Vec3& bitangent, const Vec3& normal) {
    DVec3 n = toDouble(normal);
    if (!normalize(n)) return tangent;
    const auto across = [&](const Vec3& v) { return toDouble(v) - dot(n, toDouble(v)) * n; };
    DVec3 t = across(tangent), b = across(bitangent);
    if (!normalize(t) || !normalize(b)) return tangent;
    // This is perpendicular to the bitangent, on the tangent's side: the opposite direction would belong to the
    // opposite orientation of the UVs or of N.
    DVec3 p = cross(b, n);
    if (dot(p, t) < 0) p = -1.0 * p;
    DVec3 sum = t + p;
    return normalize(sum) ? toFloat(sum) : tangent;
}

/// Rotates each tangent, in the plane perpendicular to its normal, half of the way to the direction perpendicular to
/// the bitangent: cross(N, T) and T then both deviate by half of the UVs' shear, while T alone was exact before.
/// normalOf(i): the normal of entry i. An entry without tangent, bitangent or normal is unchanged.
template <class NormalOf>
void makeSymmetric(const StridedSpan<Vec4>& tangents, const StridedSpan<Vec3>& bitangents, const NormalOf& normalOf,
                   Parallel& parallel) {
    parallel.forRanges(tangents.count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec4& tangent = tangents[i];
            const Vec3 turned = symmetricTangent(xyz(tangent), bitangents[i], normalOf(i));
            tangent = {turned.x, turned.y, turned.z, tangent.w};
        }
    });
}

/// Memory for bitangents that the caller did not request, but that the symmetric frame needs.
struct NeededBitangents {
    Buffer<Vec3> own;
    TangentOutput out;

    NeededBitangents(const TangentOutput& wanted, const Allocator* allocator) : out(wanted) {
        if (!wanted.bitangents.empty()) return;
        own = Buffer<Vec3>(allocator, wanted.tangents.count);
        out.bitangents = {own.data(), own.size()};
    }
};

}  // namespace tspace
