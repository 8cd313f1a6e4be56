// SPDX-License-Identifier: MIT
#include "textures/blocks/normal_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tspace {
namespace {

/// Means of xx, xy, xz, yy and yz of unit normals; the mean of zz follows from them.
using Moments = std::array<float, 5>;

struct MeanLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3> means = {};       ///< mean normals, not normalized, each multiplied by the coverage
    std::vector<Moments> moments = {};  ///< moments, each multiplied by the coverage
    std::vector<float> coverage = {};   ///< fraction of each texel that is surface; empty: fully covered
};

}  // namespace

std::vector<Cover> coversOf(std::uint32_t from, std::uint32_t to) {
    std::vector<Cover> covers(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        // Edges of texel i in units of 1 / to of a source texel, so that they are integers.
        const std::uint64_t begin = std::uint64_t{i} * from, end = begin + from;
        covers[i].begin = static_cast<std::size_t>(begin / to);
        for (std::uint64_t texel = begin / to; texel * to < end; ++texel) {
            const std::uint64_t first = std::max(begin, texel * to), last = std::min(end, (texel + 1) * to);
            covers[i].weights.push_back(static_cast<double>(last - first) / static_cast<double>(from));
        }
    }
    return covers;
}

namespace {

Moments momentsOf(const Vec3& n) { return {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z}; }

MeanLevel shrink(const MeanLevel& from, std::uint32_t width, std::uint32_t height, Parallel& parallel) {
    const std::vector<Cover> across = coversOf(from.width, width), down = coversOf(from.height, height);
    const std::size_t count = std::size_t{width} * height;
    MeanLevel to{width, height, std::vector<Vec3>(count), {}, {}};
    to.moments.resize(from.moments.empty() ? 0 : count);
    to.coverage.resize(from.coverage.empty() ? 0 : count);
    parallel.forRanges(height, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin * width; at < end * width; ++at) {
            const Cover &columns = across[at % width], &rows = down[at / width];
            DVec3 sum{};
            forCovered(from.width, columns, rows,
                       [&](std::size_t texel, double weight) { sum = sum + weight * toDouble(from.means[texel]); });
            to.means[at] = toFloat(sum);
            if (!to.coverage.empty()) {
                double covered = 0;
                forCovered(from.width, columns, rows, [&](std::size_t texel, double weight) {
                    covered += weight * static_cast<double>(from.coverage[texel]);
                });
                to.coverage[at] = static_cast<float>(covered);
            }
            if (to.moments.empty()) continue;
            std::array<double, 5> moments{};
            forCovered(from.width, columns, rows, [&](std::size_t texel, double weight) {
                for (std::size_t k = 0; k < 5; ++k) moments[k] += weight * static_cast<double>(from.moments[texel][k]);
            });
            for (std::size_t k = 0; k < 5; ++k) to.moments[at][k] = static_cast<float>(moments[k]);
        }
    });
    return to;
}

/// Returns the spread of normals around a direction: 1 - mean((n . along)^2).
float spreadOf(const Moments& m, const Vec3& along) {
    const DVec3 a = toDouble(along);
    const auto of = [&](std::size_t i) { return static_cast<double>(m[i]); };
    const double zz = 1 - of(0) - of(3);
    const double mean = of(0) * a.x * a.x + of(3) * a.y * a.y + zz * a.z * a.z +
                        2 * (of(1) * a.x * a.y + of(2) * a.x * a.z + of(4) * a.y * a.z);
    return static_cast<float>(std::clamp(1 - mean, 0.0, 1.0));
}

NormalLevel unitOf(const MeanLevel& level) {
    NormalLevel unit{level.width, level.height, level.means, {}, level.coverage};
    unit.spreads.reserve(level.moments.size());
    for (std::size_t i = 0; i < unit.normals.size(); ++i) {
        const float covered = level.coverage.empty() ? 1.0F : level.coverage[i];
        const DVec3 mean = toDouble(unit.normals[i]);
        const double size = length(mean);
        unit.normals[i] = size > 1e-6 * static_cast<double>(covered) ? toFloat((1 / size) * mean) : Vec3{0, 0, 1};
        if (level.moments.empty()) continue;
        Moments moments = level.moments[i];
        if (covered != 1) {
            for (float& moment : moments) moment = covered > 0 ? moment / covered : 0;
        }
        unit.spreads.push_back(covered > 0 ? spreadOf(moments, unit.normals[i]) : 0.0F);
    }
    return unit;
}

/// Sets the normal of texels without coverage to that of the smaller level.
void fillUncovered(const NormalLevel& smaller, NormalLevel& level) {
    for (std::size_t i = 0; i < level.normals.size(); ++i) {
        if (level.coverage[i] > 0) continue;
        const std::size_t x = i % level.width * smaller.width / level.width;
        const std::size_t y = i / level.width * smaller.height / level.height;
        level.normals[i] = smaller.normals[y * smaller.width + x];
    }
}

}  // namespace

std::vector<NormalLevel> makeNormalLevels(NormalLevel first, Parallel& parallel, bool with_spreads) {
    std::vector<NormalLevel> levels;
    MeanLevel whole{first.width, first.height, first.normals, {}, first.coverage};
    if (with_spreads) {
        whole.moments.reserve(first.normals.size());
        for (const Vec3& normal : first.normals) whole.moments.push_back(momentsOf(normal));
        first.spreads.assign(first.normals.size(), 0.0F);
    }
    for (std::size_t i = 0; i < whole.coverage.size(); ++i) {
        whole.means[i] = whole.coverage[i] * whole.means[i];
        if (!with_spreads) continue;
        for (float& moment : whole.moments[i]) moment *= whole.coverage[i];
    }
    levels.push_back(std::move(first));
    MeanLevel last;
    while (levels.back().width > 1 || levels.back().height > 1) {
        const std::uint32_t width = std::max(levels.back().width / 2, 1U);
        const std::uint32_t height = std::max(levels.back().height / 2, 1U);
        // The last level can replace the first level as the source only if the means are then equal: the edges of the
        // last level's texels must cut no texel of the first level, and the edges of the new level's texels no texel of
        // the last level.
        const bool is_even = !last.means.empty() && whole.width % last.width == 0 && whole.height % last.height == 0 &&
                             last.width % width == 0 && last.height % height == 0;
        last = shrink(is_even ? last : whole, width, height, parallel);
        levels.push_back(unitOf(last));
    }
    for (std::size_t i = levels.size() - 1; i > 0 && !levels.front().coverage.empty(); --i)
        fillUncovered(levels[i], levels[i - 1]);
    return levels;
}

}  // namespace tspace
