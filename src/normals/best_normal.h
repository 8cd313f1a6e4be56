// SPDX-License-Identifier: MIT
// The normal of NormalWeighting::best.
#pragma once

#include <cstdint>

#include "core/memory.h"
#include "normals/smoothing.h"
#include "normals/topology.h"

namespace tspace {

/// The two means that it is made from, one of each per corner: all corners have theirs before the first bestNormal.
struct BestSource {
    const MeshView& mesh;
    const FaceTable& faces;
    const PointTable& points;
    const Vec3* robust;  ///< by angle * area
    const Vec3* sharp;   ///< by max; zero where either vanishes
};

/// The normal of the corners that share one at a point: those at the slots of links[0 .. count), or, where `links` is
/// null, at the slots from `first_slot`. Neither of their means has vanished. O(count). The result is unit and finite.
Vec3 bestNormal(const BestSource& source, const Link* links, std::uint32_t first_slot, std::uint32_t count);

}  // namespace tspace
