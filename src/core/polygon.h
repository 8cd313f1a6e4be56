// SPDX-License-Identifier: MIT
// Cutting one polygon into triangles: the rule that triangulate.h states, shared by every part that cuts faces.
#pragma once

#include <cstdint>
#include <vector>

#include "tspace/vec.h"

namespace tspace {

/// True when the quad is cut along 1-3, false for 0-2 (also when a comparison meets a NaN). `uvs` may be null.
/// MikkTSpace's rule: the shorter diagonal in UV space; if equal, 1-3 only when strictly shorter in space.
bool quadCutsAlong13(const Vec3 positions[4], const Vec2* uvs);

/// Memory that cutPolygon reuses from call to call.
struct PolygonScratch {
    std::vector<std::uint32_t> previous, next;
    std::vector<std::uint64_t> heap;
    std::vector<double> plane;
};

/// Cuts a polygon of `count` >= 3 vertices into count - 2 triangles: writes 3 * (count - 2) local vertex numbers, winding
/// kept. `uvs` may be null. Quads by quadCutsAlong13: 0-2 gives (0,1,2),(0,2,3); 1-3 gives (0,1,3),(1,2,3).
void cutPolygon(const Vec3* positions, const Vec2* uvs, std::uint32_t count, std::uint32_t* triangles,
                PolygonScratch& scratch);

}  // namespace tspace
