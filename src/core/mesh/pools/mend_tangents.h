// SPDX-License-Identifier: MIT
// Repair of tangents and bitangents: values that are wrong are mended, and all others keep their bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/pools/primitive.h"
#include "core/mesh/surface/tangent_view.h"
#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

/// The kept tangent with sound values (surface/tangent_values.h): a length that is off is made unit, w becomes +1 or -1,
/// and `instead`, which is sound, has the direction where there is none. What is sound keeps its bits.
Vec4 withSoundValues(const Vec4& kept, const Vec4& instead, const Vec3& normal);

/// Unit and perpendicular to N.
Vec4 tangentFromNormal(const Vec3& normal, float sign);

/// withSoundValues for all vertices of a mesh whose tangents stay, used by triangles or not: a tangent without
/// direction gets that of a sound corner of its triangles, or at its position, else one from N. UVs are not read; there
/// may be no normals, and no triangles. `along_normals`: a tangent along N counts as a direction too.
Result<Done> mendValues(const TangentView& mesh, bool along_normals, std::span<Vec4> tangents);

/// Puts the tangents that a pool keeps in place of those computed for a primitive, but where they are to be mended.
///
/// corners    the pool's vertex of each corner, three per triangle
/// tangents   one per corner: in, what was computed; out, what is written
///
/// Returns one entry per corner: whether what morph targets add is to be new there, too. Near-linear.
std::vector<bool> mendCorners(const PoolView& pool, std::span<const std::uint32_t> corners, const Mends& mends,
                              std::span<Vec4> tangents);

/// sign * cross(N, T), unit. Where N has no direction: a unit vector across T.
Vec3 bitangentOf(const Vec4& tangent, const Vec3& normal);

/// A bitangent stays, bit for bit, when it and its tangent are sound: it is unit, within 3 degrees of the plane across
/// N, and on the side of sign * cross(N, T), and sanitize left the tangent where it was (within 8 degrees). Others
/// become bitangentOf the mended tangent.
///
/// normals     one per vertex; `indices` has one per corner, as all the others
/// computed    the tangents before sanitize
/// mended      the same after it
void mendBitangents(StridedSpan<const Vec3> normals, std::span<const std::uint32_t> indices,
                    std::span<const Vec4> computed, std::span<const Vec4> mended, std::span<Vec3> bitangents);

}  // namespace tspace
