// SPDX-License-Identifier: MIT
// Counting.
#include "core/mesh/pools/surface_faults.h"

#include "core/base/vec_math.h"
#include "core/mesh/surface/winding.h"

namespace tspace {

void countFaults(std::span<const Vec3> positions, std::span<const Vec3> normals, std::span<const std::uint32_t> corners,
                 bool counts_winding, PrimitiveReport& report) {
    for (std::size_t c = 0; !normals.empty() && c + 2 < corners.size(); c += 3) {
        const DVec3 first = toDouble(positions[corners[c]]);
        const DVec3 face =
            cross(toDouble(positions[corners[c + 1]]) - first, toDouble(positions[corners[c + 2]]) - first);
        for (std::size_t k = 0; k < 3; ++k)
            report.normals_behind_count += dot(face, toDouble(normals[corners[c + k]])) < 0 ? 1U : 0U;
    }
    if (!counts_winding) return;
    const WindingCounts winding = countWinding(positions, corners);
    report.turned_triangle_count = winding.turned_count;
    report.two_sided_triangle_count = winding.two_sided_count;
}

}  // namespace tspace
