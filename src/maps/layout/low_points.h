// SPDX-License-Identifier: MIT
// Points on the triangles of a low poly, whose attributes have three values per triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "tspace/maps.h"
#include "tspace/span.h"

namespace tspace {

/// Point on a triangle of the low poly.
struct LowPoint {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights = {};
};

/// Interpolates an attribute at a point of a triangle.
template <class T>
DVec3 mixedAt(const StridedSpan<const T>& values, std::size_t triangle, const std::array<double, 3>& weights) {
    DVec3 sum{};
    for (std::size_t i = 0; i < 3; ++i) sum = sum + weights[i] * toDouble(values[3 * triangle + i]);
    return sum;
}
inline Vec2 mixedAt(const StridedSpan<const Vec2>& uvs, std::size_t triangle, const std::array<double, 3>& weights) {
    double u = 0, v = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        u += weights[i] * uvs[3 * triangle + i].x;
        v += weights[i] * uvs[3 * triangle + i].y;
    }
    return {static_cast<float>(u), static_cast<float>(v)};
}

/// Returns a vector along the normal of a triangle whose length is twice the area.
inline DVec3 faceVector(const StridedSpan<const Vec3>& positions, std::size_t triangle) {
    const DVec3 first = toDouble(positions[3 * triangle]);
    return cross(toDouble(positions[3 * triangle + 1]) - first, toDouble(positions[3 * triangle + 2]) - first);
}
/// Returns twice the area of a triangle; 0 if it is not finite.
inline double faceSize(const StridedSpan<const Vec3>& positions, std::size_t triangle) {
    const double size = length(faceVector(positions, triangle));
    return std::isfinite(size) ? size : 0;
}

/// Returns equal hashes for corners with equal positions and UVs; -0 equals 0.
inline std::uint64_t hashCorner(const LowPoly& low, std::size_t corner) {
    return foldHash(hashPosition(low.positions[corner]), uvBits(low.uvs[corner]));
}

/// Points distributed evenly over the area of triangles. The position of a point in its triangle comes from a hash of
/// its number.
class AreaPoints {
  public:
    /// `sizeOf`: returns twice the area of a triangle, or 0 for triangles without points.
    template <class SizeOf>
    AreaPoints(std::size_t triangle_count, const SizeOf& sizeOf) : ends_(triangle_count) {
        for (std::size_t i = 0; i < ends_.size(); ++i) ends_[i] = total_ += sizeOf(i);
    }

    [[nodiscard]] bool empty() const { return !(total_ > 0); }
    /// Returns point `number` of `count`; requires !empty().
    [[nodiscard]] LowPoint at(std::size_t number, std::size_t count) const {
        const double end = total_ * (static_cast<double>(number) + 0.5) / static_cast<double>(count);
        const auto triangle = std::upper_bound(ends_.begin(), ends_.end(), end) - ends_.begin();
        const std::uint64_t bits = mixBits(number + 1);
        double s = static_cast<double>(bits >> 40) / 16777216.0, t = static_cast<double>(bits & 0xffffff) / 16777216.0;
        if (s + t > 1) {
            s = 1 - s;
            t = 1 - t;
        }
        return {static_cast<std::uint32_t>(std::min(triangle, std::ssize(ends_) - 1)), {1 - s - t, s, t}};
    }

  private:
    std::vector<double> ends_;
    double total_ = 0;
};

}  // namespace tspace
