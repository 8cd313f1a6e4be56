// SPDX-License-Identifier: MIT
// Mirrored triangles in a convention, out of the counts of triangles by the sign of their UV area.
#pragma once

#include <cstdint>

#include "core/tangents/method_kind.h"
#include "tspace/tangents.h"

namespace tspace {

/// Whether triangles with positive UV area show the image mirrored, as seen from outside. Handedness does not matter: the
/// winding is the order of corners that is seen.
constexpr bool positiveUvsAreMirrored(const Convention& convention) {
    return (convention.v_axis == VAxis::down) != (convention.winding == Winding::clockwise);
}

/// Number of triangles that have UV area and are not in `report.mirrored_count`. The grouping methods do not look at the UVs of
/// degenerate triangles, and `basis` not at any.
inline std::uint64_t notMirroredCount(const TangentReport& report, Method method) {
    if (!isGrouped(method) && method != Method::lengyel && method != Method::flat) return 0;
    const std::uint64_t not_examined = isGrouped(method) ? report.degenerate_triangle_count : 0;
    return report.triangle_count - not_examined - report.degenerate_uv_count - report.mirrored_count;
}

}  // namespace tspace
