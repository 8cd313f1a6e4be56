// SPDX-License-Identifier: MIT
// Coordinates far from the origin: what rounding them to 32-bit floats does to a shape, and the offset without which it
// does nothing that matters.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/base/vec_math.h"

namespace tspace {

/// Calls back with both ends of every edge of every face; each corner of a face is `from` once. May be called several
/// times. Ends that are not finite are passed over.
using VisitEdges = std::function<void(const std::function<void(const DVec3& from, const DVec3& to)>&)>;

/// Counts the edges that rounding changes by more than a thousandth of their length along an axis. If many change, normals are
/// off by a tenth of a degree or more.
struct FloatLoss {
    std::uint64_t edge_count = 0;  ///< edges with a length above 0
    std::uint64_t changed_count = 0;
    std::array<std::uint64_t, 3> changed_along = {};  ///< x, y, z

    /// Whether `changed` of them are one in twenty or more.
    [[nodiscard]] bool isNoticeable(std::uint64_t changed) const { return changed > 0 && 20 * changed >= edge_count; }
    [[nodiscard]] bool isNoticeable() const { return isNoticeable(changed_count); }
};

/// The loss when positions minus `offset` are rounded. Linear.
FloatLoss floatLoss(const VisitEdges& edges, const DVec3& offset);

/// The middle of nine tenths of the corners along each axis (a twentieth, 1 / `parts`, is left out at both ends), rounded to
/// the largest power of ten that is no larger than they reach. Linear; 8 bytes per corner.
DVec3 roundMiddle(const VisitEdges& edges, std::size_t parts = 20);

/// The offset to subtract from positions before they become floats, along the axes where the loss is noticeable: the
/// middle of nine tenths of the corners, or else of half of them. Zero where the loss is not noticeable, or where
/// neither halves it. Linear.
DVec3 offsetForFloats(const VisitEdges& edges);

}  // namespace tspace
