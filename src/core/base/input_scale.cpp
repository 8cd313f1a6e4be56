// SPDX-License-Identifier: MIT
#include "core/base/input_scale.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace tspace {

namespace {

constexpr std::size_t kMostSamples = 1024;

float largestOf(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }
float largestOf(const Vec2& p) { return std::max(std::fabs(p.x), std::fabs(p.y)); }

/// The mean size of some numbers, by their exponents: so one wild vertex hardly moves it.
class MeanSize {
  public:
    void count(float size) {
        if (!(size > 0) || !(size <= FLT_MAX)) return;
        exponents_ += std::ilogb(size);
        ++count_;
    }

    /// The factor that brings the mean size near 1. Its exponent is even, so that its square root is a power of two as
    /// well.
    [[nodiscard]] float scale() const {
        return count_ == 0 ? 1.0f : std::ldexp(1.0f, std::clamp(-exponents_ / count_, -126, 126) / 2 * 2);
    }

  private:
    int exponents_ = 0, count_ = 0;
};

}  // namespace

InputScale inputScale(const TriangleGroups& triangles, const StridedSpan<const Vec3>& positions,
                      const StridedSpan<const Vec2>& uvs) {
    MeanSize of_positions, of_uvs;
    const std::size_t samples = std::min(triangles.count, kMostSamples);
    for (std::size_t i = 0; i < samples; ++i) {
        std::uint32_t vertices[3], groups[3];
        triangles.read(triangles.count * i / samples, 1, vertices, groups);
        const Vec3 &a = positions[vertices[0]], &b = positions[vertices[1]], &c = positions[vertices[2]];
        if (a == b || b == c || c == a) continue;  // plans leave them out
        for (const std::uint32_t v : vertices) {
            of_positions.count(largestOf(positions[v]));
            if (!uvs.empty()) of_uvs.count(largestOf(uvs[v]));
        }
    }
    return {of_positions.scale(), of_uvs.scale()};
}

}  // namespace tspace
