// SPDX-License-Identifier: MIT
// UV islands, and their priority where they overlap.
#pragma once

#include "core/base/memory.h"
#include "tspace/maps.h"

namespace tspace {

/// Returns, for each triangle of a checked low poly, the rank of its UV island; rank 0 has the highest priority. An
/// island consists of triangles that share corners, in UVs and in space, and whose UVs have the same orientation:
/// mirrored halves are two islands, even if they share an edge. `overlap` determines the order: by first triangle, or
/// by decreasing surface area and then by first triangle. Returns an empty buffer for MapOverlap::mean. Time: O(n log
/// n).
Buffer<std::uint32_t> ranksOfPieces(const LowPoly& low, MapOverlap overlap, const Allocator* allocator);

}  // namespace tspace
