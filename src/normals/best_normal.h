// SPDX-License-Identifier: MIT
// The normal of NormalWeighting::best.
#pragma once

#include <cstdint>

#include "normals/smoothing.h"

namespace tspace {

/// The two means that it is made from, one of each per corner: all corners have theirs before the first bestNormal.
struct BestSource {
    const MeshView& mesh;
    const Faces& faces;
    const FaceRow* rows;
    const Vec3* robust;  ///< by angle * area
    const Vec3* sharp;   ///< by max; zero where either vanishes
};

/// The normal of the corners that share one at a point: those at links[0 .. count). Neither of their means has vanished.
/// O(count). The result is unit and finite.
Vec3 bestNormal(const BestSource& source, const PointCorners& at, const Link* links, std::uint32_t count);

}  // namespace tspace
