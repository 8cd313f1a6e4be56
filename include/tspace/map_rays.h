// SPDX-License-Identifier: MIT
// How rays go from a low poly to its high poly. CMake target tspace::maps.
#pragma once

#include <cstdint>

#include "tspace/map_image.h"

namespace tspace {

/// Which front face of the high poly a point of the low poly stands for, of those that its ray meets.
enum class RayTarget : std::uint32_t {
    /// The first one from the cage inwards, and so what is seen from outside: bolts on a plate, and not the plate below.
    /// Where there is none, the nearest one beyond the cage.
    outermost = 0,
    /// The one nearest to the low poly, on either side: for fingers, and parts thinner than the cage is far.
    nearest = 1,
};

/// Where rays point.
enum class RayDirections : std::uint32_t {
    /// Straight at flat faces, and averaged near edges where faces meet at over 30 degrees: nothing leans in the middle of
    /// a face, and nothing is cut at its edges. Averaged where there are no such edges. The field calls it skew
    /// correction.
    automatic = 0,
    /// The mean of the normals at each position, by the angles of the triangles: no gaps at split normals, but what
    /// stands on flat faces between averaged normals leans.
    averaged = 1,
    normals = 2,  ///< the low poly's normals as stored: gaps and overlaps at hard edges
};

/// Not for a low poly with a cage of its own, whose rays go from the cage to the low poly and on (LowPoly::cage).
struct RayOptions {
    RayTarget target = RayTarget::outermost;
    RayDirections directions = RayDirections::automatic;
    /// How far the cage is from the low poly's faces, where rays begin; `nearest` only judges by it. 0: as the reach.
    double cage_offset = 0;
    /// In place of `directions`: its first channel, by the low poly's UVs, is 0 where rays are averaged and 1 where they
    /// are at right angles to the triangle. Without texels: none.
    MapImage skew = {};
};

}  // namespace tspace
