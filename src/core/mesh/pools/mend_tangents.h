// SPDX-License-Identifier: MIT
// Repair: what is wrong is mended, and all else keeps its bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "core/mesh/surface/tangent_view.h"
#include "tspace/vec.h"

namespace tspace {

/// The kept tangent with sound values (surface/tangent_values.h): a length that is off is made unit, w becomes +1 or -1,
/// and `instead`, which is sound, has the direction where there is none. What is sound keeps its bits.
Vec4 withSoundValues(const Vec4& kept, const Vec4& instead, const Vec3& normal);

/// Unit and perpendicular to N.
Vec4 tangentFromNormal(const Vec3& normal, float sign);

/// The same for all vertices of a mesh whose tangents stay, used by triangles or not: what has no direction gets that of
/// a sound corner of its triangles, or at its position, else one from N. UVs are not looked at; there may be no
/// normals, and no triangles. `along_normals`: a tangent along N is a direction too.
Result<Done> mendValues(const TangentView& mesh, bool along_normals, std::span<Vec4> tangents);

/// Puts the tangents that a pool keeps in place of those computed for a primitive, but where they are to be mended.
///
/// corners    the pool's vertex of each corner, three per triangle
/// tangents   one per corner: in, what was computed; out, what is written
///
/// Returns one entry per corner: whether what morph targets add is to be new there, too. Near-linear.
std::vector<bool> mendCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Mends& mends,
                              std::span<Vec4> tangents);

}  // namespace tspace
