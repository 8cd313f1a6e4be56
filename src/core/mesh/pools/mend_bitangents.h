// SPDX-License-Identifier: MIT
// What sanitize means for bitangents.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/span.h"
#include "tspace/vec.h"

namespace tspace {

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
