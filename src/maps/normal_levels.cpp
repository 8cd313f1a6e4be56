// SPDX-License-Identifier: MIT
#include "maps/normal_levels.h"

#include <algorithm>
#include <cmath>

namespace tspace {

namespace {

struct MeanLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> means = {};  ///< not unit
};

/// What a texel of the smaller row covers of the larger one: texels from `begin` on, with weights.
struct Cover {
    std::size_t begin = 0;
    std::vector<double> weights = {};
};

std::vector<Cover> coversOf(std::uint32_t from, std::uint32_t to) {
    std::vector<Cover> covers(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        // In units of 1 / to of a texel, so that edges are whole numbers.
        const std::uint64_t begin = std::uint64_t{i} * from, end = begin + from;
        covers[i].begin = static_cast<std::size_t>(begin / to);
        for (std::uint64_t texel = begin / to; texel * to < end; ++texel) {
            const std::uint64_t first = std::max(begin, texel * to), last = std::min(end, (texel + 1) * to);
            covers[i].weights.push_back(static_cast<double>(last - first) / static_cast<double>(from));
        }
    }
    return covers;
}

MeanLevel shrink(const MeanLevel& from, std::uint32_t width, std::uint32_t height, Parallel& parallel) {
    const std::vector<Cover> across = coversOf(from.width, width), down = coversOf(from.height, height);
    MeanLevel to{width, height, std::vector<Vec3>(std::size_t{width} * height)};
    parallel.forRanges(height, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                DVec3 sum{};
                for (std::size_t j = 0; j < down[y].weights.size(); ++j) {
                    const Vec3* const row = &from.means[(down[y].begin + j) * from.width + across[x].begin];
                    for (std::size_t i = 0; i < across[x].weights.size(); ++i)
                        sum = sum + down[y].weights[j] * across[x].weights[i] * toDouble(row[i]);
                }
                to.means[y * width + x] = toFloat(sum);
            }
        }
    });
    return to;
}

NormalLevel unitOf(const MeanLevel& level) {
    NormalLevel unit{level.width, level.height, level.means};
    for (Vec3& normal : unit.normals) {
        const DVec3 mean = toDouble(normal);
        const double size = length(mean);
        normal = size > 1e-6 ? toFloat((1 / size) * mean) : Vec3{0, 0, 1};
    }
    return unit;
}

}  // namespace

std::vector<NormalLevel> makeNormalLevels(NormalLevel first, Parallel& parallel) {
    std::vector<NormalLevel> levels;
    const MeanLevel whole{first.width, first.height, first.normals};
    levels.push_back(std::move(first));
    MeanLevel last;
    while (levels.back().width > 1 || levels.back().height > 1) {
        const std::uint32_t width = std::max(levels.back().width / 2, 1U);
        const std::uint32_t height = std::max(levels.back().height / 2, 1U);
        // Means of the last level's means are those of the first where no edge cuts a texel of either.
        const bool is_even = !last.means.empty() && whole.width % last.width == 0 && whole.height % last.height == 0 &&
                             last.width % width == 0 && last.height % height == 0;
        last = shrink(is_even ? last : whole, width, height, parallel);
        levels.push_back(unitOf(last));
    }
    return levels;
}

}  // namespace tspace
