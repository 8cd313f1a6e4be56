// SPDX-License-Identifier: MIT
// The texels of a map as unknowns, and what samples ask of them under the bilinear filter: least squares, one symmetric 3 x 3
// block for each pair of texels that a sample mixes. The image repeats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/memory.h"
#include "core/vec_math.h"

namespace tspace {

/// xx, xy, xz, yy, yz, zz
using SymmetricBlock = std::array<float, 6>;

inline Vec3 blockTimes(const SymmetricBlock& m, const Vec3& v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[1] * v.x + m[3] * v.y + m[4] * v.z,
            m[2] * v.x + m[4] * v.y + m[5] * v.z};
}

/// What the samples ask of one texel: its block with itself and those with the neighbours right, left below, below and
/// right below; the other four are theirs. And the right side.
struct TexelRow {
    std::array<SymmetricBlock, 5> blocks = {};
    Vec3 side = {};

    void add(const TexelRow& other);
};

/// A sample: the filtered map shall be `target` at a place between four texels, and errors count as `metric` says.
struct FitSample {
    SymmetricBlock metric = {};
    Vec3 side = {};  ///< metric times target
};

class TexelSystem {
  public:
    TexelSystem(const Allocator* allocator, std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), rows_(allocator, std::size_t{width} * height, TexelRow{}) {}

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    TexelRow* row(std::uint32_t y) { return rows_.data() + std::size_t{y} * width_; }
    [[nodiscard]] const TexelRow* row(std::uint32_t y) const { return rows_.data() + std::size_t{y} * width_; }
    [[nodiscard]] std::uint32_t right(std::uint32_t x) const { return x + 1 < width_ ? x + 1 : 0; }
    [[nodiscard]] std::uint32_t left(std::uint32_t x) const { return x > 0 ? x - 1 : width_ - 1; }
    [[nodiscard]] std::uint32_t below(std::uint32_t y) const { return y + 1 < height_ ? y + 1 : 0; }
    [[nodiscard]] std::uint32_t above(std::uint32_t y) const { return y > 0 ? y - 1 : height_ - 1; }

    /// What the samples ask of a texel, times the texels around it: all but its block with itself.
    [[nodiscard]] Vec3 aroundTexel(const Vec3* texels, std::uint32_t x, std::uint32_t y) const;

  private:
    std::uint32_t width_ = 0, height_ = 0;
    Buffer<TexelRow> rows_;
};

/// Adds a sample that lies `fx`, `fy` (0 to 1) right of and below the centre of texel `x` of `here`; `next` is the row below.
void addSample(TexelRow* here, TexelRow* next, std::uint32_t x, std::uint32_t right, float fx, float fy,
               const FitSample& sample);

/// Errors count across the unit vector `wanted`; along it, where only the length changes, by the part `along`.
FitSample acrossSample(const Vec3& wanted, float along, float wanted_length);
/// Errors of the vector (x, y, sqrt(1 - x^2 - y^2)), as two-channel maps are read.
FitSample twoChannelSample(const Vec3& wanted);

}  // namespace tspace
