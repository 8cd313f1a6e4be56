// SPDX-License-Identifier: MIT
#include "core/mesh/surface/surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "tspace/span.h"

namespace tspace {
namespace {

// -- decimal or integer lattice that positions were rounded to before conversion to float --

double valueAt(const Vec3& p, std::size_t axis) { return static_cast<double>(axis == 0 ? p.x : axis == 1 ? p.y : p.z); }

/// Returns the greatest common divisor of distances that have an error of `slack` each; 0 if there is none. The
/// distances are sorted first, so that each longer one refines the step before larger multiples of it occur.
double commonStep(std::vector<double>& distances, double slack, double least) {
    std::sort(distances.begin(), distances.end());
    double step = 0;
    for (const double distance : distances) {
        if (distance <= slack) continue;
        // Euclidean algorithm, where a remainder within rounding is 0.
        double a = distance, b = step;
        while (b != 0) {
            const double left = std::fabs(a - std::round(a / b) * b);
            a = b;
            b = left > slack ? left : 0;
        }
        if (a < least) return 0;
        step = distance / std::round(distance / a);
    }
    return step;
}

/// Returns the step of which all values of an axis are integer multiples, relative to one of them, except for float
/// rounding; 0 if there is none, or if it is close to that rounding. `axis`: 0 to 2. `far`: the largest magnitude of a
/// value. Linear.
double latticeStep(StridedSpan<const Vec3> positions, std::size_t axis, double far) {
    constexpr std::size_t kFew = 256, kMostTries = 16;
    constexpr double kSlack = 4, kLeast = 32;  // tolerance, and minimum step, in float spacings
    if (positions.count == 0 || far == 0) return 0;
    const double ulp = std::ldexp(1.0, std::ilogb(far) - 23), first = valueAt(positions[0], axis);
    std::vector<double> few;
    const std::size_t stride = positions.count / kFew + 1;
    for (std::size_t v = 0; v < positions.count; v += stride)
        few.push_back(std::fabs(valueAt(positions[v], axis) - first));
    for (std::size_t tries = 0; tries < kMostTries; ++tries) {
        const double step = commonStep(few, kSlack * ulp, kLeast * ulp);
        if (step == 0) return 0;
        std::size_t v = 0;
        for (; v < positions.count; ++v) {
            const double distance = std::fabs(valueAt(positions[v], axis) - first);
            if (std::fabs(distance - std::round(distance / step) * step) <= kSlack * ulp) continue;
            few.push_back(distance);
            break;
        }
        if (v == positions.count) return step;
    }
    return 0;
}

/// Direction of dP/du of a triangle, and the sine of its rotation by rounding (root mean square).
struct RotatedDirection {
    DVec3 direction = {};  ///< unit vector; zero if the direction was lost in rounding
    double size = 0;
    double sine = 0;  ///< sine of the rotation; 0: the triangle is not usable
};

RotatedDirection directionOf(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs, const std::uint32_t* v,
                             double error) {
    const Vec2 a = uvs[v[0]], b = uvs[v[1]], c = uvs[v[2]];
    const UvFrame frame = uvFrame(positions[v[0]], positions[v[1]], positions[v[2]], a, b, c);
    const double area = std::fabs(frame.determinant), length_of_tangent = length(frame.tangent);
    if (!(area > 0) || !std::isfinite(length_of_tangent)) return {};
    // dP/du is proportional to t2 (P1 - P0) - t1 (P2 - P0). Rounding errors of the corners perpendicular to it, in two
    // coordinates, rotate it. The mean square error of a coordinate is (step / 2)^2 / 3, and error^2 is 3 (step / 2)^2,
    // so it is error^2 / 9.
    const double t1 = double{b.y} - a.y, t2 = double{c.y} - a.y;
    const double off = std::sqrt(2.0 / 9 * (t1 * t1 + t2 * t2 + (t2 - t1) * (t2 - t1))) * error;
    RotatedDirection result{.size = length_of_tangent / area,
                            .sine = off < length_of_tangent ? off / length_of_tangent : 1};
    if (length_of_tangent > 0) result.direction = (frame.determinant < 0 ? -1 : 1) / length_of_tangent * frame.tangent;
    return result;
}

/// Returns whether dP/du scatters as after rounding: where rounding can rotate it by over 10 degrees, it differs
/// between neighboring triangles by about as much, in direction and length. The positions of models that were built on
/// a grid are multiples of a step too, but their UVs match these positions. This also applies to terrain, along axes
/// on which all edges have equal length (`may_be_raster`). `error`: as in PositionRounding. Returns false if too few
/// triangles are usable. O(n log n).
/// Temporary memory comes from the allocator, because vectors that grew between long-lived results fragmented the heap.
bool scattersByRounding(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                        std::span<const std::span<const std::uint32_t>> corner_lists, double error,
                        const std::array<bool, 3>& may_be_raster, const Allocator* allocator) {
    // Minimum values, as fractions of the expected ones. Lengths change less if all edges are about the same number of
    // steps long.
    constexpr double kLeastSine = 0.17, kLeastTurn = 0.25, kLeastStretch = 0.07;
    constexpr std::size_t kLeastCount = 32;
    std::size_t most = 0, told = 0;
    for (const std::span<const std::uint32_t> corners : corner_lists) most += corners.size() / 3;
    Buffer<RotatedDirection> triangles(allocator, most);
    Buffer<std::array<std::uint32_t, 3>> vertices(allocator, most);
    for (const std::span<const std::uint32_t> corners : corner_lists) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            const RotatedDirection triangle = directionOf(positions, uvs, corners.data() + i, error);
            if (!(triangle.sine > kLeastSine)) continue;
            triangles[told] = triangle;
            vertices[told++] = {corners[i], corners[i + 1], corners[i + 2]};
        }
    }
    std::size_t count = 0;
    double turned = 0, stretched = 0, wanted = 0;
    std::array<double, 3> along_axes = {};
    const auto compare = [&](const RotatedDirection& a, const RotatedDirection& b) {
        const DVec3 turn = a.direction - b.direction;
        const double sum = a.size + b.size, stretch = sum > 0 ? 2 * (a.size - b.size) / sum : 0;
        ++count;
        turned += dot(turn, turn);
        stretched += stretch * stretch;
        const DVec3 change = sum > 0 ? 2 / sum * (a.size * a.direction - b.size * b.direction) : DVec3{};
        along_axes[0] += change.x * change.x;
        along_axes[1] += change.y * change.y;
        along_axes[2] += change.z * change.z;
        wanted += std::min(1.0, a.sine * a.sine + b.sine * b.sine);
    };
    const auto forHalves = [&](const auto& add) {
        for (std::size_t triangle = 0; triangle < told; ++triangle) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(vertices[triangle][k], vertices[triangle][(k + 1) % 3]);
                add(low, high, static_cast<std::uint32_t>(triangle));
            }
        }
    };
    forEachEdge(positions.count, allocator, forHalves,
                [&](std::uint32_t, std::uint32_t, std::span<const HalfEdge> halves) {
                    for (std::size_t i = 0; i + 1 < halves.size(); ++i)
                        compare(triangles[cornerOf(halves[i])], triangles[cornerOf(halves[i + 1])]);
                });
    const auto isMuch = [&](double sum, double least) { return sum > least * least * wanted; };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (may_be_raster[axis] && !isMuch(along_axes[axis], kLeastTurn)) return false;
    }
    return count >= kLeastCount && isMuch(turned, kLeastTurn) && isMuch(stretched, kLeastStretch);
}

// -- spacing of floats --

/// Returns the exponent of the largest power of two that divides a float.
int lowestBit(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const int exponent = static_cast<int>(bits >> 23 & 0xff);
    const std::uint32_t digits = (bits & 0x7fffff) | (exponent != 0 ? 0x800000u : 0u);
    return std::max(exponent, 1) - 150 + std::countr_zero(digits);
}

/// Distribution of the positions along one axis.
struct Axis {
    float low = std::numeric_limits<float>::max(), high = -std::numeric_limits<float>::max();
    int lowest_bit = 128;
    bool is_finite = true, is_fine = false;
    double spacing = 0;  // the only nonzero distance along the axis between the ends of an edge
    bool is_even = true;
    std::uint64_t triangles = 0, flat = 0;

    /// Returns false if no further triangle can change the result of isRaster().
    bool addTriangle(float a, float b, float c) {
        if (!is_even) return false;
        ++triangles;
        flat += a == b && b == c ? 1U : 0U;
        for (const double distance : {std::fabs(double{b} - a), std::fabs(double{c} - b), std::fabs(double{a} - c)}) {
            if (!(distance > 0)) continue;
            if (spacing == 0) spacing = distance;
            is_even = is_even && distance == spacing;
        }
        return is_even;
    }
    /// Returns whether the axis is a raster axis: all triangles of terrain in steps of, for example, a meter have the
    /// same extent along it, except walls. Rounded gentle slopes also have edges of equal length, but many of their
    /// triangles are flat.
    [[nodiscard]] bool isRaster() const { return is_even && spacing > 0 && 10 * flat <= triangles; }
    void add(float value) {
        is_finite = is_finite && std::isfinite(value);
        if (!std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
        if (!is_fine && value != 0) lowest_bit = std::min(lowest_bit, lowestBit(value));
    }
    /// Determines whether the values so far use all bits of floats of their size: step() then does not depend on
    /// further lowest bits.
    void examineBits() { is_fine = high >= low && far() > 0 && lowest_bit <= std::ilogb(far()) - 23; }
    [[nodiscard]] double far() const { return std::max(std::fabs(double{low}), std::fabs(double{high})); }
    [[nodiscard]] double step() const {
        // Minimum magnitude for offsets from the origin: models near the origin may be on a grid by design, but not at
        // coordinates with this many bits.
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
                            std::span<const std::span<const std::uint32_t>> corner_lists, double stored_step,
                            const Allocator* allocator) {
    Axis axes[3];
    for (std::size_t v = 0; v < positions.count; ++v) {
        const Vec3 p = positions[v];
        axes[0].add(p.x);
        axes[1].add(p.y);
        axes[2].add(p.z);
        if (v % 256 != 255) continue;
        for (Axis& axis : axes) axis.examineBits();
    }
    for (const std::span<const std::uint32_t> corners : corner_lists) {
        bool is_open = true;
        for (std::size_t i = 0; is_open && i + 2 < corners.size(); i += 3) {
            const Vec3 a = positions[corners[i]], b = positions[corners[i + 1]], c = positions[corners[i + 2]];
            is_open = axes[0].addTriangle(a.x, b.x, c.x);
            is_open |= axes[1].addTriangle(a.y, b.y, c.y);
            is_open |= axes[2].addTriangle(a.z, b.z, c.z);
        }
    }
    std::array<double, 3> steps;
    for (std::size_t i = 0; i < 3; ++i) steps[i] = std::max(axes[i].step(), stored_step);
    const PositionRounding stored = roundingBy(steps, axes);
    if (stored_step > 0 || uvs.count == 0) return stored;
    for (std::size_t i = 0; i < 3; ++i)
        if (axes[i].is_finite) steps[i] = std::max(steps[i], latticeStep(positions, i, axes[i].far()));
    PositionRounding before = roundingBy(steps, axes);
    before.was_before = true;
    const std::array<bool, 3> may_be_raster{axes[0].isRaster(), axes[1].isRaster(), axes[2].isRaster()};
    const bool was_rounded = before.error > stored.error &&
                             scattersByRounding(positions, uvs, corner_lists, before.error, may_be_raster, allocator);
    return was_rounded ? before : stored;
}

RotatedTriangles rotatedBy(const PositionRounding& rounding, StridedSpan<const Vec3> positions,
                           std::span<const std::uint32_t> corners, double limit_deg) {
    RotatedTriangles turned;
    if (rounding.error == 0) return turned;
    double area = 0, whole = 0;
    for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
        const DVec3 a = toDouble(positions[corners[c]]);
        const DVec3 e = toDouble(positions[corners[c + 1]]) - a, f = toDouble(positions[corners[c + 2]]) - a;
        const double size = length(cross(e, f));
        if (!(size > 0) || !std::isfinite(size)) continue;
        ++turned.total;
        whole += size;
        // Root mean square values: each corner moves along N by a third of the maximum error. The relative movement of
        // two corners is sqrt(2) times as large; divided by the height of the triangle, it is the sine of the plane's
        // rotation.
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
