// SPDX-License-Identifier: MIT
// The axes of normal maps in object and world space. CMake target tspace::maps.
#pragma once

#include "tspace/vec.h"

namespace tspace {

/// Where x, y and z of a map in object space point, in the coordinates of the meshes. The default is those coordinates.
struct MapAxes {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    friend bool operator==(const MapAxes&, const MapAxes&) = default;
};

/// Maps of programs in which z points up (Blender, 3ds Max), for meshes of which y does: those have x, -z, y.
inline constexpr MapAxes kMapAxesZUp{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};

}  // namespace tspace
