// SPDX-License-Identifier: MIT
// Triangles that are wound against their neighbours.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/vec.h"

namespace tspace {

struct WindingCounts {
    /// Triangles are connected over edges that exactly two share; of those that are connected, the fewer that are wound one
    /// way. A whole part that is inside out has none.
    std::uint64_t turned_count = 0;
    /// Triangles of sheets with two sides: another triangle, or two of a flat quad, have the same positions and are wound the
    /// other way.
    std::uint64_t two_sided_count = 0;
};

/// `corners`: three per triangle. Positions are compared exactly, but -0 equals 0. O(n log n); 200 bytes per triangle and 20 per
/// vertex for a while.
WindingCounts countWinding(std::span<const Vec3> positions, std::span<const std::uint32_t> corners);

}  // namespace tspace
