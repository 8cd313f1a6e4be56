// SPDX-License-Identifier: MIT
#include "textures/blocks/normal_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "maps/texels/shading.h"

namespace tspace {
namespace {

NormalLevel noiseLevel(std::uint32_t width, std::uint32_t height) {
    NormalLevel level{width, height, {}, {}};
    std::uint32_t state = 11;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8) / 8388608.0 - 1;
    };
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const DVec3 vector{next(), next(), 1.2 + next()};
        level.normals.push_back(toFloat((1 / length(vector)) * vector));
    }
    return level;
}

/// Returns the mean of part(normal) over a texel of a mip level: a weighted sum over the texels of the first level.
template <class Part>
auto meanOver(const NormalLevel& first, const NormalLevel& level, std::uint32_t x, std::uint32_t y, const Part& part) {
    decltype(part(DVec3{})) sum{};
    const double wide = static_cast<double>(first.width) / level.width,
                 high = static_cast<double>(first.height) / level.height;
    for (std::uint32_t row = 0; row < first.height; ++row) {
        const double down = std::min(row + 1.0, (y + 1) * high) - std::max<double>(row, y * high);
        for (std::uint32_t column = 0; column < first.width && down > 0; ++column) {
            const double across = std::min(column + 1.0, (x + 1) * wide) - std::max<double>(column, x * wide);
            if (across > 0)
                sum = sum + down * across / (wide * high) *
                                part(toDouble(first.normals[std::size_t{row} * first.width + column]));
        }
    }
    return sum;
}

DVec3 meanOf(const NormalLevel& first, const NormalLevel& level, std::uint32_t x, std::uint32_t y) {
    const DVec3 mean = meanOver(first, level, x, y, [](const DVec3& normal) { return normal; });
    return (1 / length(mean)) * mean;
}

TEST(NormalLevels, AreTheUnitMeansOfWhatTheyCoverWhateverTheSize) {
    for (const auto& [width, height] : {std::pair(32U, 16U), {33U, 17U}, {7U, 1U}, {24U, 36U}, {1U, 1U}}) {
        const NormalLevel first = noiseLevel(width, height);
        Parallel parallel(Execution{.thread_count = 2});
        const std::vector<NormalLevel> levels = makeNormalLevels(first, parallel);
        EXPECT_EQ(levels.back().normals.size(), 1u);
        std::uint32_t w = width, h = height;
        for (const NormalLevel& level : levels) {
            ASSERT_EQ(level.width, w);
            ASSERT_EQ(level.height, h);
            for (std::uint32_t y = 0; y < h; ++y) {
                for (std::uint32_t x = 0; x < w; ++x)
                    ASSERT_LT(
                        degreesBetween(toDouble(level.normals[std::size_t{y} * w + x]), meanOf(first, level, x, y)),
                        0.001);
            }
            w = std::max(w / 2, 1U);
            h = std::max(h / 2, 1U);
        }
    }
}

TEST(NormalLevels, StoreTheSpreadOfTheirNormals) {
    for (const auto& [width, height] : {std::pair(32U, 16U), {33U, 17U}, {7U, 1U}}) {
        const NormalLevel first = noiseLevel(width, height);
        Parallel parallel(Execution{.thread_count = 2});
        const std::vector<NormalLevel> levels = makeNormalLevels(first, parallel, true);
        for (const NormalLevel& level : levels) {
            for (std::uint32_t i = 0; i < level.width * level.height; ++i) {
                const DVec3 own = toDouble(level.normals[i]);
                const double mean = meanOver(first, level, i % level.width, i / level.width, [&](const DVec3& normal) {
                    const double along = dot(normal, own);
                    return along * along;
                });
                ASSERT_NEAR(level.spreads[i], 1 - mean, 1e-6);
            }
        }
    }
}

/// Texels have a coverage of 0, a quarter or 1. Those with 0 contain an unrelated direction, which must not affect the
/// means.
TEST(NormalLevels, AreMeansOfCoveredTexels) {
    NormalLevel first = noiseLevel(13, 8);
    NormalLevel foreign = first;
    for (std::size_t i = 0; i < first.normals.size(); ++i) {
        const std::size_t x = i % first.width;
        first.coverage.push_back(x < 4 ? 0.0F : x == 4 ? 0.25F : 1.0F);
        if (x < 4) foreign.normals[i] = {-1, 0, 0};
    }
    foreign.coverage = first.coverage;
    Parallel parallel({});
    const auto levels = makeNormalLevels(first, parallel, true), same = makeNormalLevels(foreign, parallel, true);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        EXPECT_EQ(levels[level].normals, same[level].normals) << level;
        EXPECT_EQ(levels[level].spreads, same[level].spreads) << level;
    }
    DVec3 mean{};
    for (std::size_t i = 0; i < first.normals.size(); ++i)
        mean = mean + static_cast<double>(first.coverage[i]) * toDouble(first.normals[i]);
    ASSERT_TRUE(normalize(mean));
    EXPECT_LT(length(toDouble(levels.back().normals.front()) - mean), 1e-5);
    // Uncovered texels get the direction of the next level.
    EXPECT_EQ(levels[0].normals[0], levels[1].normals[0]);
    EXPECT_EQ(levels[0].normals[5], first.normals[5]);
    // With full coverage, the result is the same as without coverage.
    first.coverage.assign(first.normals.size(), 1.0F);
    const auto all = makeNormalLevels(first, parallel);
    first.coverage.clear();
    const auto none = makeNormalLevels(first, parallel);
    for (std::size_t level = 0; level < all.size(); ++level) EXPECT_EQ(all[level].normals, none[level].normals);
}

}  // namespace
}  // namespace tspace
