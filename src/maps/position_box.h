// SPDX-License-Identifier: MIT
// The bounding box of points, and why two meshes that should coincide do not.
#pragma once

#include <string>

#include "core/base/vec_math.h"
#include "tspace/span.h"

namespace tspace {

struct PositionBox {
    DVec3 least{INFINITY, INFINITY, INFINITY}, most{-INFINITY, -INFINITY, -INFINITY};

    PositionBox() = default;
    /// Points that are not finite are left out.
    explicit PositionBox(const StridedSpan<const Vec3>& points);

    void add(const DVec3& point);
    [[nodiscard]] bool isEmpty() const { return !(least.x <= most.x); }
    [[nodiscard]] double diagonal() const { return isEmpty() ? 0 : length(most - least); }
    /// How far a side of one lies from that of the other, at most.
    [[nodiscard]] double difference(const PositionBox& other) const;
    [[nodiscard]] bool meets(const PositionBox& other, double margin) const;
};

/// chosenReach of meshes in these boxes.
double reachBetween(const PositionBox& low, const PositionBox& high);

/// The likely reason why a high poly does not lie on its low poly: another unit, or another axis that points up; one
/// sentence. Empty where none shows.
std::string misplacement(const PositionBox& low, const PositionBox& high);

}  // namespace tspace
