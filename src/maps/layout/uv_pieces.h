// SPDX-License-Identifier: MIT
// Pieces of a UV map, and which of them goes before the others where they lie over each other.
#pragma once

#include "core/base/memory.h"
#include "tspace/maps.h"

namespace tspace {

/// Of each triangle of a checked low poly the rank of its piece: 0 goes before all others. A piece is triangles that share
/// corners, in UVs and in space, and whose UVs turn one way: mirrored halves are two, though they meet at their middle. By
/// `overlap`: in the order of their first triangles, or the larger surface first, and then that order. Empty with
/// MapOverlap::mean. Time: n log n.
Buffer<std::uint32_t> ranksOfPieces(const LowPoly& low, MapOverlap overlap, const Allocator* allocator);

}  // namespace tspace
