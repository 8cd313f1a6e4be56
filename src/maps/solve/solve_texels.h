// SPDX-License-Identifier: MIT
// Solves a TexelSystem for texels: real numbers or integers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"

namespace tspace {

/// Minimum width and height of an image whose texels are solved: in smaller images texels would be their own neighbors.
inline constexpr std::uint32_t kLeastSolved = 4;

// System of equations for the texels of a map: each sample of the bilinearly filtered map adds an equation, and the
// solution is by least squares, with one symmetric 3 x 3 block for each pair of texels that a sample mixes. The image
// repeats; samples of images that do not repeat mix no texels across the edge. Only texels that samples mix take
// memory.

/// Symmetric 3 x 3 matrix: xx, xy, xz, yy, yz, zz.
using SymmetricBlock = std::array<float, 6>;

inline Vec3 blockTimes(const SymmetricBlock& m, const Vec3& v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[1] * v.x + m[3] * v.y + m[4] * v.z,
            m[2] * v.x + m[4] * v.y + m[5] * v.z};
}

/// Row of the normal equations for one texel: its diagonal block, the blocks with its right, lower left, lower and
/// lower right neighbors (the blocks with the other four neighbors are stored in the rows of these), and the right-hand
/// side.
struct TexelRow {
    std::array<SymmetricBlock, 5> blocks = {};
    Vec3 side = {};
};

/// Sample: the filtered map should have the value `target` at a point between four texels; `metric` defines the error.
struct FitSample {
    SymmetricBlock metric = {};
    Vec3 side = {};  ///< metric times target
};

/// Role of a texel in the linear system.
enum class TexelRole : std::uint8_t {
    excluded,  ///< not in the system: samples that mix this texel are skipped
    fixed,     ///< fixed value, which samples mix with unknown texels
    unknown    ///< to be solved; samples that mix it with an excluded texel are skipped
};

class TexelSystem {
  public:
    /// Creates a system without samples. `roles`: one per texel.
    TexelSystem(const Allocator* allocator, std::uint32_t width, std::uint32_t height,
                std::span<const TexelRole> roles);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] std::uint32_t right(std::uint32_t x) const { return x + 1 < width_ ? x + 1 : 0; }
    [[nodiscard]] std::uint32_t left(std::uint32_t x) const { return x > 0 ? x - 1 : width_ - 1; }
    [[nodiscard]] std::uint32_t below(std::uint32_t y) const { return y + 1 < height_ ? y + 1 : 0; }
    [[nodiscard]] std::uint32_t above(std::uint32_t y) const { return y > 0 ? y - 1 : height_ - 1; }

    /// Returns the number of rows. Row 0 is zero, and shared by all texels that are not in the system.
    [[nodiscard]] std::size_t rowCount() const { return rows_.size(); }
    [[nodiscard]] std::uint32_t rowOf(std::uint32_t x, std::uint32_t y) const {
        return row_of_[std::size_t{y} * width_ + x];
    }
    [[nodiscard]] std::uint32_t rowOf(std::size_t texel) const { return row_of_[texel]; }
    [[nodiscard]] const TexelRow& row(std::size_t row) const { return rows_[row]; }
    [[nodiscard]] std::uint32_t texelOf(std::size_t row) const { return texel_of_[row]; }
    [[nodiscard]] bool isUnknown(std::size_t row) const { return is_unknown_[row]; }

    /// Adds a sample at the offset `fx`, `fy` (0 to 1) to the right of and below the center of a texel. Ignores a
    /// sample that interpolates a texel with the role `excluded`.
    void add(std::uint32_t x, std::uint32_t y, float fx, float fy, const FitSample& sample);

    /// Returns the row of a texel multiplied by its neighbors, given by `at(x, y)`, without the diagonal block.
    template <class At>
    [[nodiscard]] Vec3 aroundTexel(std::uint32_t x, std::uint32_t y, const At& at) const {
        const std::uint32_t left_x = left(x), right_x = right(x), above_y = above(y), below_y = below(y);
        const TexelRow& here = row(rowOf(x, y));
        Vec3 sum = blockTimes(here.blocks[1], at(right_x, y));
        sum = sum + blockTimes(here.blocks[2], at(left_x, below_y));
        sum = sum + blockTimes(here.blocks[3], at(x, below_y));
        sum = sum + blockTimes(here.blocks[4], at(right_x, below_y));
        sum = sum + blockTimes(row(rowOf(left_x, y)).blocks[1], at(left_x, y));
        sum = sum + blockTimes(row(rowOf(right_x, above_y)).blocks[2], at(right_x, above_y));
        sum = sum + blockTimes(row(rowOf(x, above_y)).blocks[3], at(x, above_y));
        return sum + blockTimes(row(rowOf(left_x, above_y)).blocks[4], at(left_x, above_y));
    }

  private:
    std::uint32_t width_ = 0, height_ = 0;
    Buffer<std::uint32_t> row_of_, texel_of_ = {};
    Buffer<bool> is_unknown_ = {};
    Buffer<TexelRow> rows_ = {};
};

/// Returns a sample that measures errors perpendicular to the unit vector `wanted`. Errors along it, which change only
/// the length, have the weight `along`.
FitSample acrossSample(const Vec3& wanted, float along, float wanted_length);
/// Returns a sample that measures errors of the vector (x, y, sqrt(1 - x^2 - y^2)), as decoded from two-channel maps.
FitSample twoChannelSample(const Vec3& wanted);

/// Adds samples of the cell between texel (x, y) and the texels to the right of and below it: sampleOf(mixed) for the
/// filtered values of `texels`, by two-point Gauss quadrature in each direction. It is exact for the integral over the
/// cell, whose integrand is a product of two bilinear filters.
template <class SampleOf>
void addCell(std::uint32_t x, std::uint32_t y, std::span<const Vec3> texels, const SampleOf& sampleOf,
             TexelSystem& system) {
    constexpr float kNear = 0.21132487F, kFar = 1 - kNear;
    const std::size_t here = std::size_t{y} * system.width(), below = std::size_t{system.below(y)} * system.width();
    const std::uint32_t right = system.right(x);
    for (const float fy : {kNear, kFar}) {
        const Vec3 left_side = (1 - fy) * texels[here + x] + fy * texels[below + x];
        const Vec3 right_side = (1 - fy) * texels[here + right] + fy * texels[below + right];
        for (const float fx : {kNear, kFar}) system.add(x, y, fx, fy, sampleOf((1 - fx) * left_side + fx * right_side));
    }
}

/// Weight that pulls texels to their initial values, relative to one sample at the texel center. It matters where
/// samples constrain almost nothing: at the rim of a chart.
inline constexpr float kHold = 0.004F;

/// Visits the elements of a ring such that adjacent ones are not processed at the same time. some(first, number)
/// processes `number` elements, every second one from `first` on; it is called for the even elements, then for the odd
/// ones, and then for the last one of an odd count.
template <class Some>
void forNonAdjacent(std::size_t count, const Some& some) {
    some(std::size_t{0}, count / 2);
    some(std::size_t{1}, count / 2);
    some(count - 1, count % 2);
}

/// Callback before step `done` of at most `total` steps. It may throw, which ends the call.
using StepCallback = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// Calls row(y) for all rows of an image that repeats; adjacent rows never run at the same time. The steps of
/// `report_step` are rows.
template <class Row>
void forNonAdjacentRows(Parallel& parallel, std::size_t height, const Row& row, const StepCallback& report_step = {}) {
    constexpr std::size_t kRowsPerReport = 128;
    std::uint64_t done = 0;
    forNonAdjacent(height, [&](std::size_t first, std::size_t number) {
        const std::size_t at_once = report_step ? kRowsPerReport : number;
        for (std::size_t from = 0; from < number; from += at_once) {
            if (report_step) report_step(done + from, height);
            parallel.forRanges(std::min(at_once, number - from), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) row(static_cast<std::uint32_t>(first + 2 * (from + i)));
            });
        }
        done += number;
    });
}

/// Solves the unknown `texels` (width * height) by least squares, with conjugate gradients. The result does not depend
/// on the number of threads.
void solveLeastSquares(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel,
                       const Allocator* allocator, const StepCallback& report_step = {});

/// Solves the unknown `texels` like solveLeastSquares, for vectors of at most unit length.
void solveTexels(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel, const Allocator* allocator,
                 const StepCallback& report_step = {});

/// Parameters for choosing vectors that integers represent: n from 0 to `most` represents 2 n / most - 1.
struct IntegerChoice {
    unsigned most = 255;
    float least_length = 0.7F, most_length = 1.1F;  ///< range of vector lengths; no component may exceed 1
    bool is_two_channel = false;                    ///< true: z is reconstructed from x and y (unit vectors)
    bool keeps_lengths = false;                     ///< true: a vector that is not unit keeps its length within 5 %
};

/// Replaces unknown `texels`, one after the other, by vectors that integers represent and that minimize the error of
/// the samples, while the surrounding texels are fixed; repeats this `rounds` times. Fixed texels are unchanged. The
/// result does not depend on the number of threads.
void chooseIntegers(const TexelSystem& system, const IntegerChoice& choice, std::span<Vec3> texels, unsigned rounds,
                    Parallel& parallel, const Allocator* allocator, const StepCallback& report_step = {});

struct TexelRounding {
    unsigned most = 65535;
    /// true: lengths are kept; false: they may change by 0.5 % for better directions
    bool keeps_lengths = false;
    std::span<const bool> keeps = {};  ///< texels that must not change; empty: none
};

/// Rounds each component of `texels` to a value that an integer from 0 to `most` represents, such that neighboring
/// texels compensate for rounding errors under filtering. Unlike chooseIntegers, it is for so many integers that all
/// errors have equal weight. The image repeats. The result does not depend on the number of threads.
void roundTexels(std::span<Vec3> texels, std::uint32_t width, const TexelRounding& rounding, Parallel& parallel,
                 const Allocator* allocator, const StepCallback& report_step = {});

}  // namespace tspace
