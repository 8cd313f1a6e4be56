// SPDX-License-Identifier: MIT
#include "core/mesh/surface/position_rounding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/angle.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/position_lattice.h"

namespace tspace {

namespace {

/// The power of two that a float is a whole multiple of.
int lowestBit(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const int exponent = static_cast<int>(bits >> 23 & 0xff);
    const std::uint32_t digits = (bits & 0x7fffff) | (exponent != 0 ? 0x800000u : 0u);
    return std::max(exponent, 1) - 150 + std::countr_zero(digits);
}

/// Steps along one axis.
struct Axis {
    float low = std::numeric_limits<float>::max(), high = -std::numeric_limits<float>::max();
    int lowest_bit = 128;
    double spacing = 0;  // the one distance that edges have along it, but for 0
    bool is_even = true;
    std::uint64_t triangles = 0, flat = 0;

    void addTriangle(float a, float b, float c) {
        ++triangles;
        flat += a == b && b == c ? 1U : 0U;
        for (const double distance : {std::fabs(double{b} - a), std::fabs(double{c} - b), std::fabs(double{a} - c)}) {
            if (!(distance > 0)) continue;
            if (spacing == 0) spacing = distance;
            is_even = is_even && distance == spacing;
        }
    }
    /// Terrain in steps of a metre, say: all its triangles but walls are as wide along the axis. Where a gentle slope was
    /// rounded edges are as long too, but many triangles are flat.
    [[nodiscard]] bool isRaster() const { return is_even && spacing > 0 && 10 * flat <= triangles; }
    void add(float value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
        if (value != 0) lowest_bit = std::min(lowest_bit, lowestBit(value));
    }
    [[nodiscard]] double far() const { return std::max(std::fabs(double{low}), std::fabs(double{high})); }
    [[nodiscard]] double step() const {
        // Models near the origin may lie on a grid on purpose. So many bits of an offset do not.
        constexpr double kFar = 1 << 18;
        if (!(high >= low) || far() == 0 || isRaster()) return 0;
        const double finest = std::ldexp(1.0, std::ilogb(far()) - 23), common = std::ldexp(1.0, lowest_bit);
        return far() >= kFar * common ? std::max(finest, common) : finest;
    }
};

PositionRounding roundingBy(const std::array<double, 3>& steps, const Axis (&axes)[3]) {
    constexpr double kManySteps = 1 << 16;
    PositionRounding rounding;
    double width = 0, squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Axis& axis = axes[i];
        rounding.step = std::max(rounding.step, steps[i]);
        rounding.far = std::max(rounding.far, axis.high >= axis.low ? axis.far() : 0);
        if (axis.high >= axis.low) width = std::max(width, double{axis.high} - axis.low);
        squares += 0.25 * steps[i] * steps[i];
    }
    if (width >= kManySteps * rounding.step) return {.far = rounding.far};
    rounding.error = std::sqrt(squares);
    return rounding;
}

}  // namespace

PositionRounding roundingOf(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                            std::span<const std::span<const std::uint32_t>> corner_lists, double stored_step) {
    Axis axes[3];
    for (std::size_t v = 0; v < positions.count; ++v) {
        const Vec3 p = positions[v];
        axes[0].add(p.x);
        axes[1].add(p.y);
        axes[2].add(p.z);
    }
    for (const std::span<const std::uint32_t> corners : corner_lists) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            const Vec3 a = positions[corners[i]], b = positions[corners[i + 1]], c = positions[corners[i + 2]];
            axes[0].addTriangle(a.x, b.x, c.x);
            axes[1].addTriangle(a.y, b.y, c.y);
            axes[2].addTriangle(a.z, b.z, c.z);
        }
    }
    std::array<double, 3> steps;
    for (std::size_t i = 0; i < 3; ++i) steps[i] = std::max(axes[i].step(), stored_step);
    const PositionRounding stored = roundingBy(steps, axes);
    if (stored_step > 0 || uvs.count == 0) return stored;
    for (std::size_t i = 0; i < 3; ++i) steps[i] = std::max(steps[i], latticeStep(positions, i));
    PositionRounding before = roundingBy(steps, axes);
    before.was_before = true;
    const std::array<bool, 3> may_be_raster{axes[0].isRaster(), axes[1].isRaster(), axes[2].isRaster()};
    const bool was_rounded =
        before.error > stored.error && scattersByRounding(positions, uvs, corner_lists, before.error, may_be_raster);
    return was_rounded ? before : stored;
}

TurnedTriangles turnedBy(const PositionRounding& rounding, StridedSpan<const Vec3> positions,
                         std::span<const std::uint32_t> corners, double limit_deg) {
    TurnedTriangles turned;
    if (rounding.error == 0) return turned;
    double area = 0, whole = 0;
    for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
        const DVec3 a = toDouble(positions[corners[c]]);
        const DVec3 e = toDouble(positions[corners[c + 1]]) - a, f = toDouble(positions[corners[c + 2]]) - a;
        const double size = length(cross(e, f));
        if (!(size > 0) || !std::isfinite(size)) continue;
        ++turned.total;
        whole += size;
        // A corner moves along N by a third of the largest error in the mean square, and the plane turns by that over the
        // height of the triangle; two corners move.
        const double longest = std::max({length(e), length(f), length(f - e)});
        const double sine = std::sqrt(2.0) / 3 * rounding.error * longest / size;
        const double deg = sine >= 1 ? 90 : polarAngle(std::sqrt(1 - sine * sine), sine) * 180 / kPi;
        if (!(deg > limit_deg)) continue;
        if (turned.count++ == 0) turned.first = corners[c];
        turned.worst_deg = std::max(turned.worst_deg, deg);
        area += size;
    }
    turned.share = whole > 0 ? area / whole : 0;
    return turned;
}

}  // namespace tspace
