// SPDX-License-Identifier: MIT
// The texels of a map as unknowns, and what samples ask of them under the bilinear filter: least squares, one symmetric 3 x 3
// block for each pair of texels that a sample mixes. The image repeats: samples of others mix no texels over its edge. Only texels that samples mix take memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/memory.h"
#include "core/base/vec_math.h"

namespace tspace {

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

}  // namespace tspace
