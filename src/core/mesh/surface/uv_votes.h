// SPDX-License-Identifier: MIT
// Which triangles say by their UVs where a tangent points.
#pragma once

#include <cstdint>
#include <vector>

#include "tspace/mesh.h"

namespace tspace {

/// One byte per triangle: 1 where its UVs have an orientation; 0 where they have no area, or so little that rounding
/// decides, or where the triangle itself has none. Normals are not looked at. Linear.
std::vector<std::uint8_t> uvVotes(const MeshView& triangles);

}  // namespace tspace
