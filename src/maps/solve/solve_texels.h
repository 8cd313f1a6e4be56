// SPDX-License-Identifier: MIT
// Texels that solve a TexelSystem: as real numbers, or as integers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/vec_math.h"

namespace tspace {

/// Least width and height of an image whose texels are solved for: texels of smaller images are their own neighbors.
inline constexpr std::uint32_t kLeastSolved = 4;

// The texels of a map as unknowns, and what samples ask of them under the bilinear filter: least squares, one symmetric 3 x 3
// block for each pair of texels that a sample mixes. The image repeats: samples of others mix no texels over its edge. Only texels that samples mix take memory.

/// xx, xy, xz, yy, yz, zz
using SymmetricBlock = std::array<float, 6>;

inline Vec3 blockTimes(const SymmetricBlock& m, const Vec3& v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[1] * v.x + m[3] * v.y + m[4] * v.z,
            m[2] * v.x + m[4] * v.y + m[5] * v.z};
}

/// The row of the normal equations of one texel: its diagonal block, its blocks with the neighbours right, left below,
/// below and right below (the other four are stored by those neighbours), and the right side.
struct TexelRow {
    std::array<SymmetricBlock, 5> blocks = {};
    Vec3 side = {};
};

/// A sample: the filtered map shall be `target` at a place between four texels, and errors count as `metric` says.
struct FitSample {
    SymmetricBlock metric = {};
    Vec3 side = {};  ///< metric times target
};

/// The part that a texel plays in the system.
enum class TexelRole : std::uint8_t {
    apart,   ///< samples ask nothing of it that is remembered
    fixed,   ///< samples mix it with others, which are unknown
    unknown  ///< is to be found. Of all samples that read it, all that they mix have a row
};

class TexelSystem {
  public:
    /// `roles`: one per texel.
    TexelSystem(const Allocator* allocator, std::uint32_t width, std::uint32_t height,
                std::span<const TexelRole> roles);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] std::uint32_t right(std::uint32_t x) const { return x + 1 < width_ ? x + 1 : 0; }
    [[nodiscard]] std::uint32_t left(std::uint32_t x) const { return x > 0 ? x - 1 : width_ - 1; }
    [[nodiscard]] std::uint32_t below(std::uint32_t y) const { return y + 1 < height_ ? y + 1 : 0; }
    [[nodiscard]] std::uint32_t above(std::uint32_t y) const { return y > 0 ? y - 1 : height_ - 1; }

    /// Row 0 is zero, and shared by all texels that take no part.
    [[nodiscard]] std::size_t rowCount() const { return rows_.size(); }
    [[nodiscard]] std::uint32_t rowOf(std::uint32_t x, std::uint32_t y) const {
        return row_of_[std::size_t{y} * width_ + x];
    }
    [[nodiscard]] std::uint32_t rowOf(std::size_t texel) const { return row_of_[texel]; }
    [[nodiscard]] const TexelRow& row(std::size_t row) const { return rows_[row]; }
    [[nodiscard]] std::uint32_t texelOf(std::size_t row) const { return texel_of_[row]; }
    [[nodiscard]] bool isUnknown(std::size_t row) const { return is_unknown_[row]; }

    /// Adds a sample that lies `fx`, `fy` (0 to 1) right of and below the centre of a texel. A sample that mixes a texel
    /// that is apart is left out.
    void add(std::uint32_t x, std::uint32_t y, float fx, float fy, const FitSample& sample);

    /// The row of a texel times its neighbours, whose values `at(x, y)` gives: all but the diagonal block.
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

/// Errors count across the unit vector `wanted`; along it, where only the length changes, by the part `along`.
FitSample acrossSample(const Vec3& wanted, float along, float wanted_length);
/// Errors of the vector (x, y, sqrt(1 - x^2 - y^2)), as two-channel maps are read.
FitSample twoChannelSample(const Vec3& wanted);

/// Weight that holds texels to their start values, relative to one sample at the texel's centre. It decides where
/// samples constrain next to nothing: at the rim of a chart.
inline constexpr float kHold = 0.004F;

/// Things in a ring, of which no two at the same time are beside each other: some(first, number) for every second one from
/// `first` on, of the even ones, then the odd ones, then the last of an odd number. False as soon as some() says so.
template <class Some>
void forApart(std::size_t count, const Some& some) {
    some(std::size_t{0}, count / 2);
    some(std::size_t{1}, count / 2);
    some(count - 1, count % 2);
}

/// row(y) for all rows of an image that repeats.
template <class Row>
void forRowsApart(Parallel& parallel, std::uint32_t height, const Row& row) {
    forApart(height, [&](std::size_t first, std::size_t number) {
        parallel.forRanges(number, 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) row(static_cast<std::uint32_t>(first + 2 * i));
        });
    });
}

/// Called before step `done` of at most `total` steps; may throw, which ends the call.
using TellStep = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// Moves the unknown ones of `texels` (width * height) to the least squares, by conjugate gradients. The same bits for any
/// number of threads.
void solveLeastSquares(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel,
                       const Allocator* allocator, const TellStep& tell = {});

/// Like the overload above, for vectors of at most unit length.
void solveTexels(const TexelSystem& system, std::span<Vec3> texels, Parallel& parallel, const Allocator* allocator,
                 const TellStep& tell = {});

/// The vectors that integers stand for: n from 0 to `most` is 2 n / most - 1.
struct IntegerChoice {
    unsigned most = 255;
    float least_length = 0.7F, most_length = 1.1F;  ///< range of vector lengths; no component may exceed 1
    bool is_two_channel = false;                    ///< z follows from x and y, whose vector is unit
    bool keeps_lengths = false;                     ///< a vector that is not unit keeps its length, within a twentieth
};

/// Makes of `texels` vectors that integers stand for, one after the other, such that what the samples ask is met as well as
/// it can be with those around; `rounds` times. Fixed ones stay. The same bits for any number of threads.
void chooseIntegers(const TexelSystem& system, const IntegerChoice& choice, std::span<Vec3> texels, unsigned rounds,
                    Parallel& parallel, const Allocator* allocator, const TellStep& tell = {});

struct TexelRounding {
    unsigned most = 65535;
    bool keeps_lengths = false;  ///< else vectors may become longer or shorter by half a hundredth, and point better
    std::span<const bool> keeps = {};  ///< texels that must not change; empty: none
};

/// Makes of each component of `texels` a number that an integer from 0 to `most` stands for, such that those around make good
/// under the filter what is rounded off: as chooseIntegers, where integers are so many that all count the same. The image
/// repeats. The same bits for any number of threads.
void roundTexels(std::span<Vec3> texels, std::uint32_t width, const TexelRounding& rounding, Parallel& parallel,
                 const Allocator* allocator);

}  // namespace tspace
