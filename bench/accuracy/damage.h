// SPDX-License-Identifier: MIT
// Meshes as they come: noisy positions, noisy UVs, and UVs that were welded by mistake.
#pragma once

#include "test_mesh.h"

namespace tspace::accuracy {

enum class Damage { none, position_noise, uv_noise, welded_uvs };

const char* nameOf(Damage damage);

/// Noise: every position (or UV) is moved by a normal distribution whose deviation is `share` of the mean edge at the
/// vertex, in space (or 0.915 of that in the texture). Welded UVs: of a `share` of the triangles one vertex takes the
/// UV of its neighbour. All get normals estimated from what is left, as a program that reads such a mesh would.
void damage(TestMesh& mesh, Damage kind, double share, Random random);

}  // namespace tspace::accuracy
