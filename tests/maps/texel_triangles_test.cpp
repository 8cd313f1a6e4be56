// SPDX-License-Identifier: MIT
// Finding the triangle that covers each texel.
#include "maps/layout/texel_triangles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

namespace tspace::test {
namespace {

struct UvMap {
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> corners = {};
    TextureWrap wrap = TextureWrap::repeat;

    [[nodiscard]] UvTriangles triangles() const { return {corners, uvs, wrap, wrap}; }
};

UvMap mapOf(std::vector<Vec2> uvs, TextureWrap wrap = TextureWrap::repeat) {
    UvMap map{std::move(uvs), {}, wrap};
    map.corners.resize(map.uvs.size());
    std::iota(map.corners.begin(), map.corners.end(), 0U);
    return map;
}

TexelTriangles find(const UvMap& map, std::uint32_t width, std::uint32_t height, std::uint32_t padding,
                    std::uint32_t threads = 1) {
    Parallel parallel(Execution{.thread_count = threads});
    auto found = findTexelTriangles(map.triangles(), width, height, padding, parallel);
    EXPECT_TRUE(found.has_value());
    return std::move(*found);
}

float coordinate(int least, int most) { return static_cast<float>(*rc::gen::inRange(least, most)) / 1000.0f; }

UvMap randomMap(int least = -1200, int most = 1900) {
    std::vector<Vec2> uvs;
    const auto wrap = static_cast<TextureWrap>(*rc::gen::inRange(0, 3));
    const int count = *rc::gen::inRange(1, 8);
    for (int i = 0; i < 3 * count; ++i) uvs.push_back({coordinate(least, most), coordinate(least, most)});
    return mapOf(uvs, wrap);
}

/// Checks that the stored weights give the point of the UV plane at the texel's center.
void expectCenter(const UvMap& map, const TexelTriangles& found, std::size_t texel) {
    const TexelPlace& place = found.places[texel];
    const auto uvs = map.triangles()[place.triangle];
    const auto weights = weightsAt(map.triangles(), found.shape, place);
    RC_ASSERT(std::fabs(weights[0] + weights[1] + weights[2] - 1) < 1e-9);
    double u = 0, v = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        u += weights[i] * uvs[i].x;
        v += weights[i] * uvs[i].y;
    }
    const auto column = static_cast<std::int64_t>(std::floor(u * found.shape.width));
    const auto row = static_cast<std::int64_t>(std::floor(v * found.shape.height));
    RC_ASSERT(wrappedTexel(column, found.shape.width, map.wrap) == texel % found.shape.width);
    RC_ASSERT(wrappedTexel(row, found.shape.height, map.wrap) == texel / found.shape.width);
    RC_ASSERT(std::fabs(u * found.shape.width - (static_cast<double>(column) + 0.5)) < 1e-3);
    RC_ASSERT(std::fabs(v * found.shape.height - (static_cast<double>(row) + 0.5)) < 1e-3);
}

RC_GTEST_PROP(TexelTriangles, AreInsideWhereTheCoverageSays, ()) {
    const UvMap map = randomMap();
    const auto width = *rc::gen::inRange<std::uint32_t>(1, 40), height = *rc::gen::inRange<std::uint32_t>(1, 150);
    TexelMask mask(width, height);
    std::uint64_t steps = kCoverSteps;
    RC_ASSERT(coverTexels(map.triangles(), mask, steps));
    const TexelTriangles found = find(map, width, height, 0);
    for (std::size_t texel = 0; texel < found.kinds.size(); ++texel) {
        const bool has_area = found.counts.without_area == 0;
        const bool is_inside = found.kinds[texel] == TexelCoverage::inside;
        if (has_area)
            RC_ASSERT(is_inside ==
                      mask.has(static_cast<std::uint32_t>(texel % width), static_cast<std::uint32_t>(texel / width)));
        RC_ASSERT(is_inside == (found.places[texel].triangle != kNoTriangle));
    }
}

RC_GTEST_PROP(TexelTriangles, GiveTheCenterOfEachTexel, ()) {
    const UvMap map = randomMap();
    const TexelTriangles found =
        find(map, *rc::gen::inRange<std::uint32_t>(4, 40), *rc::gen::inRange<std::uint32_t>(4, 90), 2);
    for (std::size_t texel = 0; texel < found.kinds.size(); ++texel) {
        if (found.kinds[texel] == TexelCoverage::none) continue;
        const auto weights = weightsAt(map.triangles(), found.shape, found.places[texel]);
        const double least = std::min({weights[0], weights[1], weights[2]});
        if (least > -0.999) expectCenter(map, found, texel);
        RC_ASSERT(least >= -1.000001);
    }
}

/// Returns the distance from a texel's center to the nearest triangle, in any repetition of the image.
double nearestOf(const UvMap& map, const TextureShape& shape, std::size_t texel) {
    double least = INFINITY;
    for (std::size_t i = 0; i < map.corners.size() / 3; ++i) {
        const auto uvs = map.triangles()[i];
        PlacedTriangle placed;
        if (placed.place(uvs, shape) != UvPlacing::placed || placed.doubleArea() == 0) continue;
        const ExactTriangle exact(uvs, placed, shape);
        for (int ty = -5; ty <= 5; ++ty) {
            for (int tx = -5; tx <= 5; ++tx) {
                if (map.wrap == TextureWrap::clamp && (tx != 0 || ty != 0)) continue;
                const auto along = [&](std::size_t at, std::uint32_t size, int tile) {
                    const double inside = static_cast<double>(at) + 0.5;
                    const bool flipped = map.wrap == TextureWrap::mirror && tile % 2 != 0;
                    return tile * static_cast<double>(size) + (flipped ? size - inside : inside);
                };
                least = std::min(least, exact.squaredDistance(along(texel % shape.width, shape.width, tx),
                                                              along(texel / shape.width, shape.height, ty)));
            }
        }
    }
    return std::sqrt(least);
}

RC_GTEST_PROP(TexelTriangles, UseTheNearestTriangleInThePadding, ()) {
    UvMap map = randomMap();
    // Triangles beyond the edge of a clamped image do not extend into it.
    if (map.wrap == TextureWrap::clamp) map.wrap = TextureWrap::repeat;
    const auto padding = *rc::gen::inRange<std::uint32_t>(1, 7);
    const TexelTriangles found = find(map, 14, 11, padding);
    for (std::size_t texel = 0; texel < found.kinds.size(); ++texel) {
        if (found.kinds[texel] == TexelCoverage::inside) continue;
        const double nearest = nearestOf(map, found.shape, texel);
        if (found.kinds[texel] == TexelCoverage::none) {
            RC_ASSERT(nearest > std::min<double>(padding, 1.5) - 1e-4);
            RC_ASSERT(nearest > padding - 1.0);
            continue;
        }
        const TexelPlace& place = found.places[texel];
        const auto uvs = map.triangles()[place.triangle];
        PlacedTriangle placed;
        placed.place(uvs, found.shape);
        const double distance =
            std::sqrt(ExactTriangle(uvs, placed, found.shape).squaredDistance(place.x + 0.5, place.y + 0.5));
        RC_ASSERT(distance <= padding + 1e-4);
        RC_ASSERT(distance <= nearest + (nearest < 1.5 ? 1e-4 : 1.0));
    }
}

RC_GTEST_PROP(TexelTriangles, HaveATriangleEverywhereWithAllAsPadding, ()) {
    const UvMap map = randomMap(0, 1000);
    const TexelTriangles found = find(map, 33, 70, kAllTexels);
    RC_PRE(found.counts.without_area < map.corners.size() / 3);
    RC_ASSERT(found.counts.inside + found.counts.beside == 33u * 70u);
}

RC_GTEST_PROP(TexelTriangles, AreTheSameForAnyNumberOfThreads, ()) {
    const UvMap map = randomMap();
    const TexelTriangles one = find(map, 50, 200, 20), four = find(map, 50, 200, 20, 4);
    for (std::size_t texel = 0; texel < one.kinds.size(); ++texel) {
        RC_ASSERT(one.kinds[texel] == four.kinds[texel]);
        RC_ASSERT(one.overlaps[texel] == four.overlaps[texel]);
        RC_ASSERT(one.places[texel].triangle == four.places[texel].triangle);
        RC_ASSERT(one.places[texel].x == four.places[texel].x && one.places[texel].y == four.places[texel].y);
    }
}

TEST(TexelTriangles, CountOverlappingTexels) {
    const std::vector<Vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    EXPECT_EQ(find(mapOf(square), 8, 8, 0).counts.overlapping, 0u) << "centers on the diagonal are no overlap";
    std::vector<Vec2> halves = square;
    for (const Vec2& uv : square) halves.push_back({uv.x, uv.y * 0.5f});
    const TexelTriangles found = find(mapOf(halves), 8, 8, 0);
    EXPECT_EQ(found.counts.overlapping, 32u);
    for (std::size_t texel = 0; texel < 64; ++texel) EXPECT_LT(found.places[texel].triangle, 2u) << "the first wins";
}

TEST(TexelTriangles, CountIgnoredTriangles) {
    const TexelTriangles found = find(mapOf({{0, 0},
                                             {1, 0},
                                             {0.5f, 0},  //
                                             {0, 0},
                                             {NAN, 0},
                                             {0.5f, 1},  //
                                             {0, 0},
                                             {500, 0},
                                             {0.5f, 1},  //
                                             {0, 0},
                                             {1, 0},
                                             {0.5f, INFINITY}}),  //
                                      8, 8, 4);
    EXPECT_EQ(found.counts.without_area, 1u);
    EXPECT_EQ(found.counts.not_finite, 2u);
    EXPECT_EQ(found.counts.too_far, 1u);
    EXPECT_EQ(found.counts.inside + found.counts.beside, 0u);
}

TEST(TexelTriangles, EndSoonForHostileMaps) {
    UvMap map = mapOf({});
    for (int i = 0; i < 200000; ++i) {
        const float shift = static_cast<float>(i) * 1e-4f;
        map.uvs.insert(map.uvs.end(), {{shift, 0}, {60 + shift, 0}, {shift, 60}});
    }
    map.corners.resize(map.uvs.size());
    std::iota(map.corners.begin(), map.corners.end(), 0U);
    Parallel parallel(Execution{});
    EXPECT_FALSE(findTexelTriangles(map.triangles(), 4096, 4096, 2, parallel).has_value());
    for (Vec2& uv : map.uvs) uv = {uv.x < 59 ? 0.0f : 0.9f, uv.y < 59 ? 0.0f : 0.9f};
    const auto found = findTexelTriangles(map.triangles(), 256, 256, 0, parallel);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->counts.repeated, 200000u - 2);
}

RC_GTEST_PROP(TexelTriangles, VisitEachPointOfAGridOnce, ()) {
    const Vec2 a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1}, middle{coordinate(10, 990), coordinate(10, 990)};
    const TextureShape shape{7, 5};
    const auto n = *rc::gen::inRange<std::uint32_t>(1, 4);
    std::vector<int> seen(std::size_t{shape.width} * n * shape.height * n);
    const std::vector<std::array<Vec2, 3>> fan = {{a, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}};
    for (const std::array<Vec2, 3>& uvs : fan) {
        forEachSample(uvs, shape, n, [&](const UvSample& sample) {
            double u = 0, v = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                u += sample.weights[i] * uvs[i].x;
                v += sample.weights[i] * uvs[i].y;
            }
            RC_ASSERT(std::fabs(u * shape.width - sample.x) < 1e-4);
            RC_ASSERT(std::fabs(v * shape.height - sample.y) < 1e-4);
            const auto column = static_cast<std::size_t>(sample.x * n), row = static_cast<std::size_t>(sample.y * n);
            ++seen[row * shape.width * n + column];
        });
    }
    std::size_t twice = 0;
    for (const int count : seen) {
        RC_ASSERT(count >= 1);
        twice += count > 1 ? 1 : 0;
    }
    RC_ASSERT(twice <= seen.size() / 3);
}

}  // namespace
}  // namespace tspace::test
