// SPDX-License-Identifier: MIT
// Coordinates far from the origin: precision loss of a shape when they are rounded to 32-bit floats, and an offset that
// avoids it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/base/vec_math.h"

namespace tspace {

/// Visits edges: calls back with both ends of every edge of every face; each corner of a face is `from` once. May be
/// called several times. Ends that are not finite are skipped.
using VisitEdges = std::function<void(const std::function<void(const DVec3& from, const DVec3& to)>&)>;

/// Counts edges that rounding changes by more than a thousandth of their length along an axis. If many change, normals
/// are off by 0.1 degrees or more.
struct FloatLoss {
    std::uint64_t edge_count = 0;  ///< number of edges with a length above 0
    std::uint64_t changed_count = 0;
    std::array<std::uint64_t, 3> changed_along = {};  ///< number of changed edges along x, y and z

    /// Returns whether `changed` is at least one in twenty of the edges.
    [[nodiscard]] bool isNoticeable(std::uint64_t changed) const { return changed > 0 && 20 * changed >= edge_count; }
    [[nodiscard]] bool isNoticeable() const { return isNoticeable(changed_count); }
};

/// Returns the loss from rounding positions minus `offset`. Linear.
FloatLoss floatLoss(const VisitEdges& edges, const DVec3& offset);

/// Returns the center of the corners along each axis, without the first and the last 1 / `parts` of them (by default,
/// the center of the middle 90 %). The result is rounded to a multiple of the largest power of ten that does not exceed
/// the extent of these corners. Linear; 8 bytes per corner.
DVec3 roundMiddle(const VisitEdges& edges, std::size_t parts = 20);

/// Returns the offset to subtract from positions before conversion to float, along axes with noticeable loss: the
/// center of the middle 90 % of the corners, or, if that does not halve the loss, of the middle 50 %. Zero if the loss
/// is not noticeable, or if neither center halves it. Linear.
DVec3 offsetForFloats(const VisitEdges& edges);

}  // namespace tspace
