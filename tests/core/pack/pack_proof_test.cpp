// SPDX-License-Identifier: MIT
// Proof of the bounds of pack.h by computation: upper bounds of the errors of all frames, instead of the errors of
// random frames. docs/concepts/pack.md explains the reasoning.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/pack/frame_list.h"

namespace tspace::test {
namespace {

constexpr double kDegree = 57.295779513082321;

// ---- frame32

struct Interval {
    double low = 0, high = 0;
};

Interval operator*(const Interval& a, const Interval& b) {
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {low, high};
}

/// Returns the minimum and maximum of x * x.
Interval squared(const Interval& x) {
    const double a = x.low * x.low, b = x.high * x.high;
    return {x.low <= 0 && x.high >= 0 ? 0 : std::min(a, b), std::max(a, b)};
}

using Box = std::array<Interval, 3>;

/// A set of matrices: each element is within `radius` of the one of `center`.
struct Matrix {
    double center[3][3], radius[3][3];
};

/// Returns how far the frame rotates, in its own axes, per lattice step along x, y and z, anywhere in a box of the
/// chart: r = 2 (dp - p x dp) / (1 + p.p), with p_i = t u_i (1 + 0.065 (u_i^2 - 1)).
Matrix turnsPerStep(const Box& box) {
    constexpr double kEdge = 0.41421356237309503, kWarp = 0.065;
    constexpr double kSteps[3] = {1.0 / 226, 2.0 / 435, 1.0 / 226};
    const auto warped = [](double u) { return kEdge * u * (1 + kWarp * (u * u - 1)); };
    Interval p[3], slope[3], square;
    for (int i = 0; i < 3; ++i) {
        p[i] = {warped(box[i].low), warped(box[i].high)};
        const Interval u2 = squared(box[i]), p2 = squared(p[i]);
        slope[i] = {kSteps[i] * kEdge * (1 - kWarp + 3 * kWarp * u2.low),
                    kSteps[i] * kEdge * (1 - kWarp + 3 * kWarp * u2.high)};
        square = {square.low + p2.low, square.high + p2.high};
    }
    const Interval scale{2 / (1 + square.high), 2 / (1 + square.low)};
    const auto minus = [](const Interval& x) { return Interval{-x.high, -x.low}; };
    const Interval one{1, 1};
    const Interval turn[3][3] = {{one, p[2], minus(p[1])}, {minus(p[2]), one, p[0]}, {p[1], minus(p[0]), one}};
    Matrix m;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Interval e = scale * turn[i][j] * slope[j];
            m.center[i][j] = (e.low + e.high) / 2;
            m.radius[i][j] = (e.high - e.low) / 2;
        }
    }
    return m;
}

using Point3 = std::array<double, 3>;

/// Returns whether N and T rotate by at most `reach` radians between `code` and any point that is within `half` of
/// `middle`.
bool isWithin(const Matrix& m, const Point3& middle, const Point3& half, const Point3& code, double reach) {
    double r[3];
    for (int i = 0; i < 3; ++i) {
        double turn = 0, more = 0;
        for (int j = 0; j < 3; ++j) {
            const double way = middle[j] - code[j];
            turn += m.center[i][j] * way;
            more += std::fabs(m.center[i][j]) * half[j] + m.radius[i][j] * (std::fabs(way) + half[j]);
        }
        r[i] = std::fabs(turn) + more;
    }
    const double square = reach * reach;
    return r[0] * r[0] + r[1] * r[1] <= square && r[1] * r[1] + r[2] * r[2] <= square;
}

/// Returns whether each point of this part of a cell has a code within `reach`. If no code is near enough for the whole
/// part, its halves are tested.
bool isCovered(const Matrix& m, const Point3& middle, const Point3& half, const std::vector<Point3>& codes,
               double reach, int depth = 0) {
    for (const Point3& code : codes) {
        if (isWithin(m, middle, half, code, reach)) return true;
    }
    if (depth == 21) return false;
    const int axis = depth % 3;
    for (const double side : {-0.5, 0.5}) {
        Point3 part = middle, part_half = half;
        part[axis] += side * half[axis];
        part_half[axis] /= 2;
        if (!isCovered(m, part, part_half, codes, reach, depth + 1)) return false;
    }
    return true;
}

/// Returns whether all cells of a lattice with this matrix are covered by the codes that the encoder tries at least:
/// those of four columns, two of which are shifted by half a step. The lower and the upper half of the cell are tested
/// separately. At the upper face of a chart only the lower half exists, and the next row of the unshifted columns is
/// missing.
bool isCellCovered(const Matrix& m, bool is_upper_face, double reach) {
    const Point3 half{0.5, 0.25, 0.5};
    std::vector<Point3> lower{{0, 0, 0}, {1, 0, 1}, {1, -0.5, 0}, {1, 0.5, 0}, {0, -0.5, 1}, {0, 0.5, 1}};
    if (is_upper_face) return isCovered(m, {0.5, 0.25, 0.5}, half, lower, reach);
    lower.insert(lower.end(), {{0, 1, 0}, {1, 1, 1}});
    const std::vector<Point3> upper{{0, 0, 0},   {1, 0, 1},   {0, 1, 0},   {1, 1, 1},
                                    {1, 0.5, 0}, {1, 1.5, 0}, {0, 0.5, 1}, {0, 1.5, 1}};
    return isCovered(m, {0.5, 0.25, 0.5}, half, lower, reach) && isCovered(m, {0.5, 0.75, 0.5}, half, upper, reach);
}

/// Halves the box along its longest side until each part is covered. Returns false if a part of a hundredth of a side
/// is not covered.
bool isChartCovered(const Box& box, bool is_upper_face, double reach, long& parts) {
    // A code may be at most one cell outside the box.
    Box wide = box;
    for (int i = 0; i < 3; ++i) wide[i] = {box[i].low - 2.0 / 226, box[i].high + 2.0 / 226};
    ++parts;
    if (isCellCovered(turnsPerStep(wide), is_upper_face, reach)) return true;
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (box[i].high - box[i].low > box[axis].high - box[axis].low) axis = i;
    }
    if (box[axis].high - box[axis].low < 0.01) return false;
    const double middle = (box[axis].low + box[axis].high) / 2;
    Box first = box, second = box;
    first[axis].high = second[axis].low = middle;
    return isChartCovered(first, is_upper_face, reach, parts) && isChartCovered(second, is_upper_face, reach, parts);
}

TEST(Frame32, CoversAllRotationsWithinItsBound) {
    // All charts are alike, and changing two signs of (u, v, w) has no effect, so a quarter of one chart is enough.
    // `reach` is the promised bound, less float rounding and less 0.2 %, because the encoder may miss the best code by
    // that much.
    const double reach = (0.998 * frameErrorBound(FrameFormat::frame32).normal_deg - 0.00005) / kDegree;
    long parts = 0;
    EXPECT_TRUE(isChartCovered({{{-1, 1}, {0, 1}, {0, 1}}}, false, reach, parts));
    EXPECT_TRUE(isChartCovered({{{-1, 1}, {0.99, 1}, {0, 1}}}, true, reach, parts));
    std::printf("%ld parts\n", parts);
    EXPECT_FALSE(isChartCovered({{{-0.1, 0.1}, {0, 0.1}, {0, 0.1}}}, false, 0.9 * reach, parts)) << "proves anything";
}

// ---- N and an angle

struct AngleFormat {
    FrameFormat format;
    std::uint64_t width, quarter;
    unsigned angle_bits;

    [[nodiscard]] std::uint64_t word(std::uint64_t i, std::uint64_t j, std::uint64_t k) const {
        const std::uint64_t ij = format == FrameFormat::frame48 ? i * width + j : i * (width + 1) + j;
        return (ij << angle_bits | k) << 1;
    }
    [[nodiscard]] FrameList read(const std::vector<std::uint64_t>& words) const {
        std::vector<std::byte> bytes;
        for (const std::uint64_t word : words) {
            for (std::size_t b = 0; b < frameBytes(format); ++b)
                bytes.push_back(static_cast<std::byte>(word >> 8 * b & 0xff));
        }
        return unpacked(format, bytes);
    }
};

constexpr AngleFormat kAngleFormats[] = {{FrameFormat::oct32, 1023, 512, 11},
                                         {FrameFormat::frame48, 46339, 16384, 16},
                                         {FrameFormat::frame64, 2097151, 524288, 21}};

/// Returns the circumradius of three points on the sphere, in degrees: no point between them is farther from all three.
double circumradiusDeg(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double x = angleDeg(a, b) / kDegree, y = angleDeg(b, c) / kDegree, z = angleDeg(c, a) / kDegree;
    const double s = (x + y + z) / 2, area = std::sqrt(std::max(s * (s - x) * (s - y) * (s - z), 0.0));
    return area > 0 ? x * y * z / (4 * area) * kDegree : 0;
}

/// Returns the maximum circumradius over all cells, or those in every `stride`th row and column. Each cell is divided
/// along its shorter diagonal.
double worstCellDeg(const AngleFormat& format, std::uint64_t stride) {
    double worst = 0;
    for (std::uint64_t i = 0; i + 1 < format.width; i += stride) {
        std::vector<std::uint64_t> words;
        for (std::uint64_t j = 0; j + 1 < format.width; j += stride) {
            for (const std::uint64_t corner : {0, 1, 2, 3})
                words.push_back(format.word(i + corner / 2, j + corner % 2, 0));
        }
        const std::vector<Vec3> n = format.read(words).normals;
        for (std::size_t c = 0; c < n.size(); c += 4) {
            const bool is_along = angleDeg(n[c], n[c + 3]) < angleDeg(n[c + 1], n[c + 2]);
            const Vec3 &a = is_along ? n[c] : n[c + 1], &b = is_along ? n[c + 3] : n[c + 2];
            const Vec3 &p = is_along ? n[c + 1] : n[c], &q = is_along ? n[c + 2] : n[c + 3];
            worst = std::max({worst, circumradiusDeg(a, b, p), circumradiusDeg(a, b, q)});
        }
    }
    return worst;
}

double worstStepDeg(const AngleFormat& format) {
    std::vector<std::uint64_t> words;
    for (std::uint64_t k = 0; k <= format.quarter; ++k)
        words.push_back(format.word(format.width / 2, format.width / 2, k));
    const FrameList frames = format.read(words);
    double worst = 0;
    for (std::size_t k = 1; k < frames.size(); ++k) {
        worst = std::max(worst, angleDeg(xyz(frames.tangents[k - 1]), xyz(frames.tangents[k])));
    }
    return worst;
}

TEST(PackBounds, AnglesFollowFromTheGrid) {
    for (const AngleFormat& format : kAngleFormats) {
        const double normal = worstCellDeg(format, (format.width + 1022) / 1023), step = worstStepDeg(format);
        const double tangent = std::acos(std::cos(normal / kDegree) * std::cos(step / 2 / kDegree)) * kDegree;
        const FrameErrorBound bound = frameErrorBound(format.format);
        std::printf("%s N %.6f, angle step %.6f, T %.6f\n", nameOf(format.format).c_str(), normal, step, tangent);
        EXPECT_LE(normal, 0.99 * bound.normal_deg);
        EXPECT_LE(tangent, 0.99 * bound.tangent_deg);
    }
}

}  // namespace
}  // namespace tspace::test
