// SPDX-License-Identifier: MIT
// Coverage of texels by triangles.
#include "maps/layout/uv_coverage.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <numeric>

namespace tspace::test {
namespace {

TexelMask cover(const std::vector<Vec2>& uvs, std::uint32_t width, std::uint32_t height,
                TextureWrap wrap = TextureWrap::repeat) {
    std::vector<std::uint32_t> corners(uvs.size() / 3 * 3);
    std::iota(corners.begin(), corners.end(), 0U);
    TexelMask mask(width, height);
    std::uint64_t steps = 1 << 20;
    coverTexels({corners, uvs, wrap, wrap}, mask, steps);
    return mask;
}

std::uint64_t count(const TexelMask& mask) { return mask.count({0, 0, mask.width(), mask.height()}); }

std::string picture(const TexelMask& mask) {
    std::string text;
    for (std::uint32_t y = 0; y < mask.height(); ++y) {
        for (std::uint32_t x = 0; x < mask.width(); ++x) text += mask.has(x, y) ? '#' : '.';
        text += '\n';
    }
    return text;
}

TEST(UvCoverage, ContainsTexelsWhoseCenterIsInside) {
    EXPECT_EQ(picture(cover({{0, 0}, {1, 0}, {0, 1}}, 4, 4)),
              "####\n"
              "###.\n"
              "##..\n"
              "#...\n");
    EXPECT_EQ(count(cover({{0, 0}, {0.1f, 0}, {0, 0.1f}}, 4, 4)), 0u) << "no center";
}

TEST(UvCoverage, RepeatsMirrorsOrClampsOutsideOfTheImage) {
    const std::vector<Vec2> right = {{1, 0}, {1.5f, 0}, {1, 1}};
    EXPECT_EQ(picture(cover(right, 4, 2)), "##..\n#...\n");
    EXPECT_EQ(picture(cover(right, 4, 2, TextureWrap::mirror)), "..##\n...#\n");
    EXPECT_EQ(picture(cover(right, 4, 2, TextureWrap::clamp)), "....\n....\n");
    const std::vector<Vec2> far = {{-7, 12}, {-6.5f, 12}, {-7, 13}};
    EXPECT_EQ(picture(cover(far, 4, 2)), "##..\n#...\n");
    EXPECT_EQ(picture(cover({{0.5f, 0}, {1.5f, 0}, {0.5f, 1}}, 4, 2)), "#.##\n..#.\n") << "over the border";
}

TEST(UvCoverage, LeavesNoGapBetweenTrianglesThatShareAnEdge) {
    EXPECT_TRUE(rc::check([] {
        const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(0, 1000)) / 999.0f; };
        const Vec2 a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1}, middle{coordinate(), coordinate()};
        const auto size = *rc::gen::inRange<std::uint32_t>(1, 90);
        const TexelMask mask = cover({a, b, middle, b, c, middle, c, d, middle, d, a, middle}, size, size);
        RC_ASSERT(count(mask) == std::uint64_t{size} * size);
    }));
}

TEST(UvCoverage, ContainsNothingThatIsClearlyOutside) {
    EXPECT_TRUE(rc::check([] {
        const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(-3000, 3000)) / 1000.0f; };
        std::array<Vec2, 3> uv;
        for (Vec2& point : uv) point = {coordinate(), coordinate()};
        constexpr int kSize = 16;
        const TexelMask mask = cover({uv.begin(), uv.end()}, kSize, kSize);
        // Returns the signed distance of a point to an edge of the triangle, in texels.
        const auto edge = [&](int i, double x, double y) {
            const Vec2 &a = uv[i], &b = uv[(i + 1) % 3];
            const double dx = double{b.x} - a.x, dy = double{b.y} - a.y, length = std::hypot(dx, dy);
            return length == 0 ? 0.0 : (dx * (y - a.y) - dy * (x - a.x)) / length * kSize;
        };
        const double area = (double{uv[1].x} - uv[0].x) * (double{uv[2].y} - uv[0].y) -
                            (double{uv[1].y} - uv[0].y) * (double{uv[2].x} - uv[0].x);
        RC_PRE(std::fabs(area) > 0.01);
        constexpr double kRounding = 0.02;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                double best = -1e9;  // largest distance inside the triangle
                for (int tile_y = -4; tile_y < 4; ++tile_y) {
                    for (int tile_x = -4; tile_x < 4; ++tile_x) {
                        const double u = tile_x + (x + 0.5) / kSize, v = tile_y + (y + 0.5) / kSize;
                        double inside = 1e9;
                        for (int i = 0; i < 3; ++i) inside = std::min(inside, edge(i, u, v) * (area > 0 ? 1 : -1));
                        best = std::max(best, inside);
                    }
                }
                if (best > kRounding) RC_ASSERT(mask.has(x, y));
                if (best < -kRounding) RC_ASSERT(!mask.has(x, y));
            }
        }
    }));
}

TEST(UvCoverage, IgnoresInvalidUvs) {
    for (const float bad : {NAN, INFINITY, 1e30f}) {
        EXPECT_EQ(count(cover({{0, 0}, {bad, 0}, {0, 1}}, 8, 8)), 0u);
        EXPECT_EQ(count(cover({{0, 0}, {1, 0}, {0, -bad}}, 8, 8)), 0u);
    }
    EXPECT_EQ(count(cover({{0, 0}, {1, 0}, {0, 1}}, 0, 0)), 0u);
}

TEST(UvCoverage, EndsSoonOnHostileUvs) {
    // Slivers that cross all of the 64 repetitions that are examined. None of them fills a row.
    std::vector<Vec2> uvs;
    for (int i = 0; i < 20000; ++i) {
        const float u = static_cast<float>(i) * 1e-4f;
        uvs.insert(uvs.end(), {{u, 0}, {u + 1e-5f, 0}, {u, 63.9f}});
    }
    EXPECT_TRUE(cover(uvs, 8192, 8192).isWhole()) << "the limit on work was not met, or not kept";
    EXPECT_FALSE(cover({uvs.begin(), uvs.begin() + 3}, 8192, 8192).isWhole());
}

TEST(TexelMask, CountsAndAddsAndClears) {
    TexelMask mask(200, 3), other = mask;
    mask.fill(1, 60, 130);
    other.fill(2, 0, 200);
    mask.add(other);
    EXPECT_EQ(mask.count({0, 0, 200, 3}), 270u);
    EXPECT_EQ(mask.count({63, 1, 129, 3}), 132u);
    EXPECT_TRUE(mask.isWhole(2));
    EXPECT_FALSE(mask.isWhole());
    mask.clear();
    EXPECT_EQ(mask.count({0, 0, 200, 3}), 0u);
    EXPECT_FALSE(mask.isWhole(2));
    mask.fillAll();
    EXPECT_TRUE(mask.isWhole());
}

}  // namespace
}  // namespace tspace::test
