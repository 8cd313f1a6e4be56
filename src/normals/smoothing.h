// SPDX-License-Identifier: MIT
// Which corners around a point share one normal.
#pragma once

#include <cstdint>
#include <span>

#include "normals/topology.h"
#include "tspace/normals.h"

namespace tspace {

/// What keeps faces from being smoothed together.
struct SmoothingRule {
    bool any_angle = true;                       ///< no crease: every pair of faces at a point may be connected
    double crease_rad = 0;                       ///< else only over edges that turn by no more than this
    std::span<const std::uint32_t> groups = {};  ///< one per face, or empty
    bool groups_are_masks = false;

    [[nodiscard]] bool connectsAll() const { return any_angle && groups.empty(); }
};

SmoothingRule makeSmoothingRule(const NormalOptions& options);

/// Sorted by component, then by slot. A slot is the place of a corner in PointTable::corners.
struct Link {
    std::uint32_t key, slot;
};

/// Finds the components around `point`, whose slots are [begin, end). Afterwards links[0 .. end - begin)
/// holds one entry per slot with its component as key, sorted. `links` has room for 2 * (end - begin)
/// entries; `parents` is indexed by slot. O(n log n) in the corners of the point, also when all faces share
/// one edge.
///
/// Below 180 degrees two faces are connected over a shared edge. Where more than two faces meet in an edge,
/// each is held against the next one of its smoothing group as they turn about it, which for flat faces
/// connects the same faces as holding each against each.
void findComponents(const MeshView& mesh, const FaceTable& faces, const PointTable& points, const SmoothingRule& rule,
                    std::uint32_t point, Link* links, std::uint32_t* parents);

}  // namespace tspace
