// SPDX-License-Identifier: MIT
// Cosine-distributed directions over a hemisphere with low discrepancy, so that few samples suffice: the first two
// Sobol dimensions, scrambled per point, so that the errors of neighbors differ.
// Based on: Sobol, "On the distribution of points in a cube", 1967; Owen, "Randomly permuted (t,m,s)-nets", 1995;
// Shirley & Chiu, "A low distortion map between disk and square", 1997.
#pragma once

#include <bit>

#include "core/base/unique_index.h"
#include "core/base/vec_math.h"

namespace tspace {

/// Sequence of points in the unit square for one texel. Each cell of 2^-i x 2^-(k - i) contains exactly one of its
/// first 2^k points. Texels of one block use consecutive parts of one sequence, so that the points of a block, and of
/// each quarter of it, are as evenly distributed as those of a single texel: a filter averages the errors out. Also
/// based on: Ahmed & Wonka, "Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering
/// of pixels", 2020.
class ScrambledSobol {
  public:
    static constexpr int kBlockLevels = 2;  // log2 of the side of a block: 4 x 4 texels

    /// Selects the points of the texel at column x and row y. `count`: number of points that are used, 1 to 2^16.
    ScrambledSobol(std::uint32_t count, std::uint32_t x, std::uint32_t y) {
        const std::uint64_t seed = mixBits(std::uint64_t{y >> kBlockLevels} << 32 | x >> kBlockLevels);
        std::uint32_t place = 1;
        for (int level = kBlockLevels - 1; level >= 0; --level) {
            const std::uint32_t quarter = (x >> level & 1) | (y >> level & 1) << 1;
            place = place << 2 | (quarter ^ (mixBits(seed ^ place) & 3));
        }
        const int point_levels = std::bit_width(count - 1);
        first_ = (place & ((1u << 2 * kBlockLevels) - 1)) << point_levels;
        depth_ = point_levels + 2 * kBlockLevels;
        seeds_ = {mixBits(seed + 1), mixBits(seed + 2)};
    }

    /// Returns both coordinates of point i, in [0, 1).
    [[nodiscard]] std::array<double, 2> at(std::uint32_t i) const {
        i += first_;
        // The first dimension is i with its bits reversed; the matrix of the second one is Pascal's triangle modulo 2.
        std::uint32_t first = 0, second = 0, column = 0x80000000u;
        for (std::uint32_t bit = 0; i >> bit != 0; ++bit, column ^= column >> 1) {
            if ((i >> bit & 1) == 0) continue;
            first ^= 0x80000000u >> bit;
            second ^= column;
        }
        return {scrambled(first, seeds_[0]), scrambled(second, seeds_[1])};
    }

  private:
    /// Scrambles bits by Owen's method: flips each bit depending on the seed and on the higher bits, which swaps halves
    /// recursively. The bits below those that distinguish points are a hash of the seed and of all higher bits.
    [[nodiscard]] double scrambled(std::uint32_t bits, std::uint64_t seed) const {
        std::uint64_t above = 1, result = 0;
        for (int level = 0; level < depth_; ++level) {
            const std::uint64_t bit = bits >> (31 - level) & 1;
            result = result << 1 | (bit ^ (mixBits(seed ^ above) & 1));
            above = above << 1 | bit;
        }
        const auto rest = static_cast<double>(mixBits(seed ^ above) >> 32) * 0x1p-32;
        return (static_cast<double>(result) + rest) / static_cast<double>(std::uint64_t{1} << depth_);
    }

    std::uint32_t first_ = 0;
    int depth_ = 0;
    std::array<std::uint64_t, 2> seeds_ = {};
};

/// Maps a point of the unit square to a unit direction about the z axis, with a density proportional to z.
inline DVec3 cosineDirection(const std::array<double, 2>& square) {
    const double a = 2 * square[0] - 1, b = 2 * square[1] - 1;
    if (a == 0 && b == 0) return {0, 0, 1};
    const bool is_flat = a * a > b * b;
    const double radius = is_flat ? a : b;
    const SineCosine turn = sineCosine(0.25 * kPi * (is_flat ? b / a : a / b));
    const double along = radius * turn.cosine, across = radius * turn.sine;
    const double z = std::sqrt(std::max(0.0, 1 - radius * radius));
    return is_flat ? DVec3{along, across, z} : DVec3{across, along, z};
}

}  // namespace tspace
