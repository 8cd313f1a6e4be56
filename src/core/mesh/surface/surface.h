// SPDX-License-Identifier: MIT
// Properties of single triangles: normal and area, where u grows on it, and on which side v lies.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/surface/position_rounding.h"
#include "core/mesh/surface/tangent_view.h"

namespace tspace {

struct SurfaceFrame {
    Vec3 normal = {};   ///< unit, by the right-hand rule; zero where the triangle has no area
    Vec3 tangent = {};  ///< unit dP/du; zero where the UVs have no area
    float area = 0;
    /// The sine of the angle by which rounding of the positions can have turned `tangent`, at most; from 1 on it can point
    /// anywhere.
    float tangent_error = 0;
    /// Sign of the UV determinant; 0 where the UVs have no area, or so little that rounding decides. In that last case
    /// `tangent` may as well point the other way.
    std::int8_t orientation = 0;
};

struct Surface {
    std::vector<SurfaceFrame> faces = {};   ///< one per triangle
    std::vector<double> vertex_areas = {};  ///< a third of each triangle around the vertex
    std::vector<double> known_areas = {};   ///< the same of triangles that have an orientation
    double area = 0;
    double known_area = 0;  ///< of triangles that have an orientation
    PositionRounding rounding = {};
};

/// Triangles that turn their back on N say nothing reliable of signs: methods differ in whether the sign looks at N.
bool facesNormal(const SurfaceFrame& face, const Vec3& normal);

/// One triangle; `uvs`: null where there are none. `position_error`: PositionRounding::error.
SurfaceFrame describeFace(const std::array<Vec3, 3>& positions, const std::array<Vec2, 3>* uvs,
                          double position_error = 0);

/// Positions, UVs (empty: no orientation anywhere) and corners of the view are looked at. Triangles that are not finite
/// have no area. Linear.
Surface describeSurface(const TangentView& mesh);

}  // namespace tspace
