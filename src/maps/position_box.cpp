// SPDX-License-Identifier: MIT
#include "maps/position_box.h"

#include <algorithm>
#include <cmath>

#include "core/base/numbers.h"

namespace tspace {

namespace {

/// Ratio of sizes from which two models are taken to have different units.
constexpr double kOtherUnit = 8;
/// Largest difference of sides, in parts of the diagonal, at which boxes fit, and least one at which they do not.
constexpr double kFits = 0.02, kFitsNot = 0.1;

/// The box of its corners, as `change` moves them.
template <class Change>
PositionBox changed(const PositionBox& box, const Change& change) {
    PositionBox result;
    result.add(change(box.least));
    result.add(change(box.most));
    return result;
}

std::string sizesApart(const PositionBox& low, const PositionBox& high) {
    const double factor = high.diagonal() / low.diagonal();
    const char* const larger = factor > 1 ? "high" : "low";
    const char* const smaller = factor > 1 ? "low" : "high";
    const std::string text = std::string("the ") + larger + " poly is " + shortNumber(std::max(factor, 1 / factor)) +
                             " times as large as the " + smaller + " poly";
    const PositionBox scaled = changed(high, [&](const DVec3& at) { return (1 / factor) * at; });
    if (scaled.difference(low) > kFitsNot * low.diagonal()) return text + ": are both in the same unit?";
    return text + ": scale the high poly by " + shortNumber(1 / factor) + ", and it lies on it";
}

}  // namespace

PositionBox::PositionBox(const StridedSpan<const Vec3>& points) {
    for (std::size_t i = 0; i < points.count; ++i) {
        if (isFinite(points[i])) add(toDouble(points[i]));
    }
}

void PositionBox::add(const DVec3& point) {
    least = {std::fmin(least.x, point.x), std::fmin(least.y, point.y), std::fmin(least.z, point.z)};
    most = {std::fmax(most.x, point.x), std::fmax(most.y, point.y), std::fmax(most.z, point.z)};
}

double PositionBox::difference(const PositionBox& other) const {
    const DVec3 a = least - other.least, b = most - other.most;
    return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z), std::fabs(b.x), std::fabs(b.y), std::fabs(b.z)});
}

bool PositionBox::meets(const PositionBox& other, double margin) const {
    return least.x - margin <= other.most.x && other.least.x - margin <= most.x && least.y - margin <= other.most.y &&
           other.least.y - margin <= most.y && least.z - margin <= other.most.z && other.least.z - margin <= most.z;
}

double reachBetween(const PositionBox& low, const PositionBox& high) {
    if (low.isEmpty() || high.isEmpty()) return 0;
    const double size = std::max(low.diagonal(), high.diagonal());
    const double most = size / 4, reach = std::max(size / 20, 1.5 * low.difference(high));
    return low.meets(high, size / 20) ? std::min(most, reach) : 0;
}

std::string misplacement(const PositionBox& low, const PositionBox& high) {
    const double size = low.diagonal(), other = high.diagonal();
    if (!(size > 0 && other > 0)) return {};
    if (other > kOtherUnit * size || size > kOtherUnit * other) return sizesApart(low, high);
    if (high.difference(low) <= kFitsNot * size) return {};
    const auto fits = [&](double sign) {
        const PositionBox turned = changed(high, [&](const DVec3& at) {
            return DVec3{at.x, sign * at.z, -sign * at.y};
        });
        return turned.difference(low) <= kFits * size;
    };
    for (const int sign : {1, -1}) {
        if (fits(sign))
            return std::string("another axis points up in the high poly: turn it by ") + (sign > 0 ? "-90" : "90") +
                   " degrees about x, and it lies on the low poly";
    }
    return {};
}

}  // namespace tspace
