// SPDX-License-Identifier: MIT
// Realistic defects of meshes: noisy positions, noisy UVs, and UVs that were welded by mistake.
#pragma once

#include "test_mesh.h"

namespace tspace::accuracy {

enum class Damage { none, position_noise, uv_noise, welded_uvs };

const char* nameOf(Damage damage);

/// Damages a mesh. Noise: every position (or UV) is moved by a normal distribution whose standard deviation is `share`
/// of the mean edge at the vertex, in space (or 0.915 of that in the texture). Welded UVs: for a `share` of the
/// triangles one vertex gets the UV of its neighbor. Normals are then estimated from the result, as a program that
/// reads such a mesh would.
void damage(TestMesh& mesh, Damage kind, double share, Random random);

}  // namespace tspace::accuracy
