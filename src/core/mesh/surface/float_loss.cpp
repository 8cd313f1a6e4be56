// SPDX-License-Identifier: MIT
#include "core/mesh/surface/float_loss.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tspace {
namespace {

using Coordinates = std::array<double, 3>;

Coordinates coordinatesOf(const DVec3& p) { return {p.x, p.y, p.z}; }
bool isFinite(const DVec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

/// Extent of the middle part of the corners along an axis.
struct Middle {
    double low = 0, high = 0;
};

/// Returns the extent along an axis, without the first and the last of `parts` equal parts of the sorted corners.
Middle middleOf(const VisitEdges& edges, std::size_t axis, std::size_t parts) {
    std::vector<double> values;
    edges([&](const DVec3& from, const DVec3&) {
        if (isFinite(from)) values.push_back(coordinatesOf(from)[axis]);
    });
    if (values.empty()) return {};
    const auto at = [&](std::size_t rank) {
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(values.begin(), place, values.end());
        return *place;
    };
    const std::size_t last = values.size() - 1;
    return {at(last / parts), at(last - last / parts)};
}

/// Rounds to a multiple of the largest power of ten that is at most `size`, without libm functions that round
/// differently on other systems.
double roundedBySize(double value, double size) {
    if (!(size > 0)) size = 1;
    double power = 1, divisor = 1;
    while (power * 10 <= size) power *= 10;
    while (size < 1 / divisor && divisor < 1e15) divisor *= 10;
    return divisor > 1 ? std::round(value * divisor) / divisor : std::round(value / power) * power;
}

}  // namespace

FloatLoss floatLoss(const VisitEdges& edges, const DVec3& offset) {
    constexpr double kNoticeable = 1e-3;
    FloatLoss loss;
    edges([&](const DVec3& from, const DVec3& to) {
        const DVec3 edge = to - from;
        const double noticeable = kNoticeable * length(edge);
        if (!(noticeable > 0) || !std::isfinite(noticeable)) return;
        const Coordinates a = coordinatesOf(from - offset), b = coordinatesOf(to - offset), e = coordinatesOf(edge);
        ++loss.edge_count;
        bool is_changed = false;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!(std::fabs(rounded(b[k]) - rounded(a[k]) - e[k]) > noticeable)) continue;
            ++loss.changed_along[k];
            is_changed = true;
        }
        loss.changed_count += is_changed;
    });
    return loss;
}

DVec3 roundMiddle(const VisitEdges& edges, std::size_t parts) {
    std::array<Middle, 3> middles;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        middles[k] = middleOf(edges, k, parts);
        size = std::max(size, middles[k].high - middles[k].low);
    }
    const auto middle = [&](std::size_t k) {
        // Adding +0 converts -0 to +0.
        return roundedBySize(middles[k].low + (middles[k].high - middles[k].low) / 2, size) + 0.0;
    };
    return {middle(0), middle(1), middle(2)};
}

DVec3 offsetForFloats(const VisitEdges& edges) {
    const FloatLoss before = floatLoss(edges, {});
    if (!before.isNoticeable()) return {};
    const auto isLost = [&](std::size_t k) { return before.isNoticeable(before.changed_along[k]); };
    // Excluding the ends makes the center robust against stray faces, and against a part that is far away from most
    // faces.
    for (const std::size_t parts : {20, 4}) {
        const DVec3 middle = roundMiddle(edges, parts);
        const DVec3 offset{isLost(0) ? middle.x : 0, isLost(1) ? middle.y : 0, isLost(2) ? middle.z : 0};
        if (floatLoss(edges, offset).changed_count <= before.changed_count / 2) return offset;
    }
    return {};
}

}  // namespace tspace
