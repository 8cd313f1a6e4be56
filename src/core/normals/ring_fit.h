// SPDX-License-Identifier: MIT
// The quadratic z(x, y) through the groups around one, by sums that grow ring by ring.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/normals/normal_groups.h"

namespace tspace {

/// A point's own axes: z along a unit normal.
struct RingFrame {
    Float4 x, y, z;

    explicit RingFrame(Float4 normal) : z(normal) {
        const Float4 size = abs4(normal);
        const Float4 least = size[0] <= size[1] && size[0] <= size[2] ? Float4{1, 0, 0, 0}
                             : size[1] <= size[2]                     ? Float4{0, 1, 0, 0}
                                                                      : Float4{0, 0, 1, 0};
        x = crossed(normal, least);
        x *= splat(1 / std::sqrt(dotted(x, x)));
        y = crossed(normal, x);
    }
};

/// Sums over points of products of x, y, z, for the least squares of
///     z = a xx + b xy + c yy + d x + e y + f.
class RingSums {
  public:
    /// Adds the groups of a walk from `begin` on. The centre is the origin.
    void add(const NormalGroups& groups, const RingFrame& frame, RingWalk& walk, std::size_t begin) {
        std::uint32_t* const list = walk.list();
        const std::size_t end = walk.size();
        const Float4 origin = groups.position(list[0]);
        count_ += end - begin;
        for (std::size_t i = end; i < end + 3; ++i) list[i] = list[0];  // which adds zeros
        for (std::size_t i = begin; i < end; i += 4) {
            const Float4 a = groups.position(list[i]) - origin, b = groups.position(list[i + 1]) - origin;
            const Float4 c = groups.position(list[i + 2]) - origin, d = groups.position(list[i + 3]) - origin;
            const Float4 ab = __builtin_shufflevector(a, b, 0, 1, 4, 5), cd = __builtin_shufflevector(c, d, 0, 1, 4, 5);
            const Float4 px = __builtin_shufflevector(ab, cd, 0, 2, 4, 6),
                         py = __builtin_shufflevector(ab, cd, 1, 3, 5, 7);
            const Float4 ab_z = __builtin_shufflevector(a, b, 2, 2, 6, 6),
                         cd_z = __builtin_shufflevector(c, d, 2, 2, 6, 6);
            const Float4 pz = __builtin_shufflevector(ab_z, cd_z, 0, 2, 4, 6);
            const auto along = [&](Float4 axis) {
                return splat(axis[0]) * px + splat(axis[1]) * py + splat(axis[2]) * pz;
            };
            addProducts(along(frame.x), along(frame.y), along(frame.z));
        }
    }

    /// What elimination leaves of the equations for the last unknowns.
    struct Rest {
        double matrix[2][2], right[2];
        bool is_sound = false;
    };
    /// For d and e.
    [[nodiscard]] Rest slopes() const { return eliminate<false>(); }
    /// For f, in matrix[1][1] and right[1].
    [[nodiscard]] Rest height() const { return eliminate<true>(); }

  private:
    enum Product {
        x,
        y,
        xx,
        xy,
        yy,
        xxx,
        xxy,
        xyy,
        yyy,
        xxxx,
        xxxy,
        xxyy,
        xyyy,
        yyyy,
        z,
        zx,
        zy,
        zxx,
        zxy,
        zyy,
        kProducts
    };

    void addProducts(Float4 px, Float4 py, Float4 pz) {
        const Float4 pxx = px * px, pxy = px * py, pyy = py * py;
        sums_[x] += px, sums_[y] += py;
        sums_[xx] += pxx, sums_[xy] += pxy, sums_[yy] += pyy;
        sums_[xxx] += pxx * px, sums_[xxy] += pxx * py, sums_[xyy] += px * pyy, sums_[yyy] += pyy * py;
        sums_[xxxx] += pxx * pxx, sums_[xxxy] += pxx * pxy, sums_[xxyy] += pxx * pyy;
        sums_[xyyy] += pxy * pyy, sums_[yyyy] += pyy * pyy;
        sums_[z] += pz, sums_[zx] += pz * px, sums_[zy] += pz * py;
        sums_[zxx] += pz * pxx, sums_[zxy] += pz * pxy, sums_[zyy] += pz * pyy;
    }

    [[nodiscard]] double sum(Product p) const {
        return (double{sums_[p][0]} + sums_[p][1]) + (double{sums_[p][2]} + sums_[p][3]);
    }

    template <bool kHeightLast>
    [[nodiscard]] Rest eliminate() const;

    Float4 sums_[kProducts] = {};
    std::size_t count_ = 0;
};

/// Gauss without pivots, for the matrix is positive definite. A pivot below this part of its diagonal means that the points
/// do not determine the surface: sums in single precision are good to 1e-6 of it.
template <bool kHeightLast>
RingSums::Rest RingSums::eliminate() const {
    constexpr double kLeastPivot = 1e-4;
    constexpr std::size_t kSize = 6, kLast = 4;
    constexpr std::size_t f = kHeightLast ? 5 : 3, d = kHeightLast ? 3 : 4, e = kHeightLast ? 4 : 5;
    double m[kSize][kSize + 1];  // the upper half, and the right sides
    const auto set = [&](std::size_t row, std::size_t column, double value) {
        m[row < column ? row : column][row < column ? column : row] = value;
    };
    m[0][0] = sum(xxxx), m[0][1] = sum(xxxy), m[0][2] = sum(xxyy), m[1][1] = m[0][2], m[1][2] = sum(xyyy);
    m[2][2] = sum(yyyy);
    const double s_xx = sum(xx), s_xy = sum(xy), s_yy = sum(yy);
    const double s_xxx = sum(xxx), s_xxy = sum(xxy), s_xyy = sum(xyy), s_yyy = sum(yyy);
    set(0, d, s_xxx), set(0, e, s_xxy), set(0, f, s_xx);
    set(1, d, s_xxy), set(1, e, s_xyy), set(1, f, s_xy);
    set(2, d, s_xyy), set(2, e, s_yyy), set(2, f, s_yy);
    set(d, d, s_xx), set(d, e, s_xy), set(d, f, sum(x)), set(e, e, s_yy), set(e, f, sum(y));
    set(f, f, static_cast<double>(count_));
    m[0][kSize] = sum(zxx), m[1][kSize] = sum(zxy), m[2][kSize] = sum(zyy);
    m[d][kSize] = sum(zx), m[e][kSize] = sum(zy), m[f][kSize] = sum(z);

    Rest rest;
    double diagonal[kSize];
    for (std::size_t i = 0; i < kSize; ++i) diagonal[i] = m[i][i];
    constexpr std::size_t kSteps = kHeightLast ? kSize - 1 : kLast;
    for (std::size_t k = 0; k < kSteps; ++k) {
        if (!(m[k][k] > kLeastPivot * diagonal[k])) return rest;
        const double inverse = 1 / m[k][k];
        for (std::size_t i = k + 1; i < kSize; ++i) {
            const double factor = inverse * m[k][i];
            for (std::size_t j = i; j <= kSize; ++j) m[i][j] -= factor * m[k][j];
        }
    }
    rest.matrix[0][0] = m[4][4], rest.matrix[0][1] = rest.matrix[1][0] = m[4][5], rest.matrix[1][1] = m[5][5];
    rest.right[0] = m[4][kSize], rest.right[1] = m[5][kSize];
    rest.is_sound = m[5][5] > kLeastPivot * diagonal[5] && std::isfinite(rest.right[0]) && std::isfinite(rest.right[1]);
    if (!kHeightLast) {
        const double det = m[4][4] * m[5][5] - m[4][5] * m[4][5];
        rest.is_sound =
            rest.is_sound && m[4][4] > kLeastPivot * diagonal[4] && det > kLeastPivot * m[4][4] * diagonal[5];
    }
    return rest;
}

}  // namespace tspace
