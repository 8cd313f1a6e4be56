// SPDX-License-Identifier: MIT
// A correct primitive, to which tests add one fault: two square halves of a bent surface that meet at a seam.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "commands/check/primitive_checks.h"
#include "commands/check/remedy.h"
#include "core/base/vec_math.h"
#include "tspace/tangents.h"

namespace tspace::test {

/// Relation of the UVs of the second half to those of the first.
enum class Seam {
    none,      ///< the second half uses the texels of the first, mirrored
    mirrored,  ///< mirrored texels
    turned     ///< a separate island, rotated by 90 degrees
};

inline constexpr std::size_t kSide = 9;              ///< vertices along each side of a half
inline constexpr std::size_t kHalf = kSide * kSide;  ///< vertices of a half

/// Returns a vertex of the seam. `half`: 0 or 1; `row`: 0 to kSide - 1. The vertices of both halves in a row have the
/// same position and normal.
inline std::uint32_t seamVertex(std::size_t half, std::size_t row) {
    return static_cast<std::uint32_t>(half * kHalf + row * kSide + (half == 0 ? kSide - 1 : 0));
}

inline TangentView viewOf(const ScenePrimitive& primitive) {
    return {.positions = primitive.positions.span(),
            .normals = primitive.normals.span(),
            .tangents = primitive.tangents.span(),
            .uvs = primitive.uv_sets.empty() ? std::span<const Vec2>{} : primitive.uv_sets[0].span(),
            .corners = primitive.corners.span()};
}

/// Returns tangents of a method, one per vertex. This is possible because no vertex of a patch needs two tangents.
inline std::vector<Vec4> tangentsOf(const ScenePrimitive& primitive, Method method = Method::mikktspace) {
    const MeshView mesh = primitive.view(primitive.uv_sets[0].span());
    std::vector<Vec4> corners(primitive.corners.size()), tangents(primitive.positions.size());
    (void)generateTangents(mesh, {.method = method, .convention = conventions::gltf}, {.tangents = corners});
    for (std::size_t c = 0; c < corners.size(); ++c) tangents[primitive.corners[c]] = corners[c];
    return tangents;
}

/// Returns a part of a torus without any fault, with MikkTSpace's tangents and a material that has a normal map.
inline ScenePrimitive goodPatch(Seam seam = Seam::none) {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> corners;
    for (std::size_t half = 0; half < 2; ++half) {
        for (std::size_t row = 0; row < kSide; ++row) {
            for (std::size_t column = 0; column < kSide; ++column) {
                const double a = static_cast<double>(column + half * (kSide - 1)) / (kSide - 1) - 1;  // -1 to 1
                const double b = static_cast<double>(row) / (kSide - 1);
                // Both halves compute the same bits at the seam.
                const DVec3 n{std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)};
                const DVec3 ring{2 * std::sin(a), 0, 2 * std::cos(a)};
                positions.push_back(toFloat(ring + n));
                normals.push_back(toFloat(n));
                const auto u = static_cast<float>(a), v = static_cast<float>(-b);
                const bool second = half == 1;
                uvs.push_back(seam == Seam::mirrored           ? Vec2{-std::fabs(u), v}
                              : seam == Seam::turned && second ? Vec2{v + 4, -u}
                                                               : Vec2{u, v});
            }
        }
        for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
            for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
                const auto first = static_cast<std::uint32_t>(half * kHalf + row * kSide + column);
                const auto up = static_cast<std::uint32_t>(first + kSide);
                corners.insert(corners.end(), {first, first + 1, up + 1, first, up + 1, up});
            }
        }
    }
    ScenePrimitive patch;
    patch.place = "/meshes/0/primitives/0";
    patch.mode = "triangles";
    patch.corners = std::move(corners);
    patch.positions = std::move(positions);
    patch.normals = std::move(normals);
    patch.uv_sets = {SharedArray<Vec2>(std::move(uvs))};
    patch.uses = {{.needed_by = "normalTexture", .place = "/materials/0/normalTexture"}};
    patch.tangents = tangentsOf(patch);
    return patch;
}

/// Changes a shared array by replacing it.
template <class T, class Change>
void edit(SharedArray<T>& array, Change&& change) {
    std::vector<T> values(array.begin(), array.end());
    change(values);
    array = std::move(values);
}

/// Returns a tangent that is rotated about its normal.
inline Vec4 turned(const Vec4& tangent, const Vec3& normal, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const DVec3 t = toDouble(xyz(tangent)), n = toDouble(normal);
    const Vec3 result = toFloat(std::cos(angle) * t + std::sin(angle) * cross(n, t));
    return {result.x, result.y, result.z, tangent.w};
}

inline std::vector<Finding> findingsOf(const ScenePrimitive& primitive, const CheckOptions& options = {}) {
    std::vector<Finding> findings = judgePrimitive(primitive, options, true).findings;
    formatRemedies(findings);
    return findings;
}

inline const Finding& only(const std::vector<Finding>& findings, FindingCode code) {
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.code == code; });
    EXPECT_NE(found, findings.end()) << findingName(code);
    return *found;
}

/// Functions for property tests: they return an integer from low to high, or a double in this range.
inline int anyInt(int low, int high) { return *rc::gen::inRange(low, high + 1); }
inline double anyNumber(double low, double high) { return low + (high - low) * anyInt(0, 1 << 20) / (1 << 20); }

/// Returns the severities and names of all findings, such as "error signsInverted".
inline std::set<std::string> codesOf(const ScenePrimitive& primitive, const CheckOptions& options = {}) {
    std::set<std::string> codes;
    for (const Finding& finding : findingsOf(primitive, options)) {
        codes.insert(std::string(severityName(finding.severity)) + " " + findingName(finding.code));
    }
    return codes;
}

}  // namespace tspace::test
