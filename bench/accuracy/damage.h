// SPDX-License-Identifier: MIT
// Realistic defects of meshes: noisy positions, noisy UVs, and UVs that were welded by mistake.
#pragma once

#include "test_mesh.h"

namespace tspace::accuracy {

enum class Damage { none, position_noise, uv_noise, welded_uvs };

const char* nameOf(Damage damage);

/// Damages a mesh. Noise: moves every position (or UV) by a normally distributed vector, whose standard deviation per
/// axis is `share` times the mean edge length at the vertex (for UVs: 0.915 times that, with lengths in UV space).
/// Welded UVs: in a `share` of the triangles, one vertex gets the UV of the next vertex. Finally estimates normals from
/// the result, as a program that loads such a mesh would.
void damage(TestMesh& mesh, Damage kind, double share, Random random);

}  // namespace tspace::accuracy
