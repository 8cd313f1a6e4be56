// SPDX-License-Identifier: MIT
#include "textures/blocks/roughness_levels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tspace {
namespace {

/// Returns rows of texels that are tilted left and right in alternation, by `slope`.
NormalLevel corrugated(std::uint32_t width, std::uint32_t height, double slope) {
    NormalLevel level{width, height, {}, {}};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const DVec3 normal{i / width % 2 == 0 ? slope : -slope, 0, 1};
        level.normals.push_back(toFloat((1 / length(normal)) * normal));
    }
    return level;
}

RoughnessLevel evenRoughness(std::uint32_t width, std::uint32_t height, float roughness) {
    return {width, height, std::vector<Vec3>(std::size_t{width} * height, Vec3{1, roughness, 0.25F})};
}

std::vector<RoughnessLevel> levelsOf(const NormalLevel& normals, const RoughnessLevel& roughness, float factor = 1) {
    Parallel parallel(Execution{.thread_count = 2});
    return makeRoughnessLevels(roughness, factor, makeNormalLevels(normals, parallel, true), parallel);
}

TEST(RoughnessLevels, AreWiderByTheSpreadOfTheNormalsOfTheSameTexels) {
    const double slope = 0.3, spread = slope * slope / (1 + slope * slope);
    const std::vector<RoughnessLevel> levels = levelsOf(corrugated(8, 8, slope), evenRoughness(8, 8, 0.4F));
    ASSERT_EQ(levels.size(), 4u);
    for (const Vec3& texel : levels[0].texels) EXPECT_NEAR(texel.y, 0.4, 1e-6);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        for (const Vec3& texel : levels[i].texels) {
            EXPECT_NEAR(texel.y, std::pow(std::pow(0.4, 4) + spread, 0.25), 1e-5);
            EXPECT_EQ(texel.x, 1);
            EXPECT_EQ(texel.z, 0.25F);
        }
    }
}

TEST(RoughnessLevels, StayPlainMeansWhereTheMapIsFlat) {
    RoughnessLevel roughness = evenRoughness(6, 4, 0);
    for (std::size_t i = 0; i < roughness.texels.size(); ++i) roughness.texels[i].y = i % 2 == 0 ? 0.2F : 0.6F;
    const std::vector<RoughnessLevel> levels =
        levelsOf({6, 4, std::vector<Vec3>(24, Vec3{0, 0, 1}), {}}, roughness, 0.5F);
    EXPECT_NEAR(levels[0].texels[1].y, 0.3, 1e-6);
    for (std::size_t i = 1; i < levels.size(); ++i) {
        for (const Vec3& texel : levels[i].texels) EXPECT_NEAR(texel.y, 0.2, 1e-6);
    }
}

TEST(RoughnessLevels, OfSmallerTexturesHoldTheSpreadFromTheFirstLevelOn) {
    const std::vector<RoughnessLevel> small = levelsOf(corrugated(8, 8, 0.3), evenRoughness(4, 4, 0.4F));
    EXPECT_GT(small[0].texels[0].y, 0.5);
    const std::vector<RoughnessLevel> large = levelsOf(corrugated(8, 8, 0.3), evenRoughness(16, 16, 0.4F));
    EXPECT_NEAR(large[1].texels[0].y, 0.4, 1e-6);
    EXPECT_GT(large[2].texels[0].y, 0.5);
}

TEST(RoughnessLevels, AreMeansOfCoveredTexels) {
    NormalLevel normals{8, 8, std::vector<Vec3>(64, Vec3{0, 0, 1}), {}, std::vector<float>(64, 1.0F)};
    RoughnessLevel roughness = evenRoughness(8, 8, 0.5F);
    for (std::size_t i = 0; i < 64; ++i) {
        if (i % 8 < 3) continue;
        normals.coverage[i] = 0;
        roughness.texels[i] = {};
    }
    const std::vector<RoughnessLevel> levels = levelsOf(normals, roughness);
    EXPECT_EQ(levels[1].texels[1], (Vec3{1, 0.5F, 0.25F}));
    EXPECT_EQ(levels[3].texels[0], (Vec3{1, 0.5F, 0.25F}));
}

TEST(RoughnessLevels, AreRejectedForMismatchingSizes) {
    EXPECT_EQ(whyGridsDiffer(evenRoughness(8, 8, 0), 8, 8), "");
    EXPECT_EQ(whyGridsDiffer(evenRoughness(6, 3, 0), 24, 12), "");
    EXPECT_EQ(whyGridsDiffer(evenRoughness(24, 12, 0), 6, 3), "");
    for (const auto& [width, height] : {std::pair(16U, 8U), {12U, 12U}, {8U, 4U}, {7U, 7U}})
        EXPECT_NE(whyGridsDiffer(evenRoughness(8, 8, 0), width, height), "");
}

}  // namespace
}  // namespace tspace
