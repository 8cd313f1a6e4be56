// SPDX-License-Identifier: MIT
// Number of mirrored triangles in a convention, derived from the counts of triangles by UV orientation.
#pragma once

#include <cstdint>

#include "core/tangents/method_kind.h"
#include "tspace/tangents.h"

namespace tspace {

/// Returns whether triangles with positive UV area show the image mirrored, as seen from outside. This does not depend
/// on handedness, because the winding is the visible order of corners.
constexpr bool positiveUvsAreMirrored(const Convention& convention) {
    return (convention.v_axis == VAxis::down) != (convention.winding == Winding::clockwise);
}

/// Returns the number of triangles with UV area that are not in `report.mirrored_count`. Methods with groups do not
/// examine the UVs of degenerate triangles, and `basis` examines none.
inline std::uint64_t notMirroredCount(const TangentReport& report, Method method) {
    if (!isGrouped(method) && method != Method::lengyel && method != Method::flat) return 0;
    const std::uint64_t not_examined = isGrouped(method) ? report.degenerate_triangle_count : 0;
    return report.triangle_count - not_examined - report.degenerate_uv_count - report.mirrored_count;
}

}  // namespace tspace
