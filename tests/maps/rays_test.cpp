// SPDX-License-Identifier: MIT
// Rays compared with a test of every triangle.
#include "maps/rays/rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/vec_math.h"

namespace tspace::test {
namespace {

struct Soup {
    std::vector<Vec3> positions = {};
    std::vector<std::uint32_t> corners = {};
};

Soup randomSoup(std::mt19937& random, float scale, float offset) {
    std::uniform_real_distribution<float> place(-1, 1);
    Soup soup;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const Vec3 middle{place(random), place(random), place(random)};
        for (int k = 0; k < 3; ++k) {
            const Vec3 from{place(random), place(random), place(random)};
            const Vec3 at = middle + 0.3F * from;
            soup.positions.push_back({scale * at.x + offset, scale * at.y, scale * at.z});
            soup.corners.push_back(3 * i + static_cast<std::uint32_t>(k));
        }
    }
    return soup;
}

/// Returns the distances along a line to all triangles whose fronts face `outward`.
std::vector<double> frontsByHand(const Soup& soup, const DVec3& from, const DVec3& outward) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
        const DVec3 a = toDouble(soup.positions[soup.corners[i]]), b = toDouble(soup.positions[soup.corners[i + 1]]),
                    c = toDouble(soup.positions[soup.corners[i + 2]]);
        const DVec3 normal = cross(b - a, c - a);
        const double slope = dot(normal, outward);
        if (!(slope > 0)) continue;
        const double distance = dot(normal, a - from) / slope;
        const DVec3 at = from + distance * outward;
        const bool inside = dot(normal, cross(b - a, at - a)) >= 0 && dot(normal, cross(c - b, at - b)) >= 0 &&
                            dot(normal, cross(a - c, at - c)) >= 0;
        if (inside) distances.push_back(distance);
    }
    return distances;
}

/// Returns the distance to the nearest front-facing triangle within `reach` in both directions, or infinity.
double nearestByHand(const Soup& soup, const DVec3& from, const DVec3& outward, double reach) {
    double best = INFINITY;
    for (const double distance : frontsByHand(soup, from, outward)) {
        if (std::fabs(distance) <= reach && std::fabs(distance) < std::fabs(best)) best = distance;
    }
    return best;
}

TEST(Rays, FindTheNearestFrontFacingTriangleOnBothSides) {
    std::mt19937 random(7);
    std::normal_distribution<double> direction(0, 1);
    for (const auto& [scale, offset] : {std::pair(1.0F, 0.0F), {1e-12F, 0.0F}, {1e12F, 0.0F}, {1.0F, 1000.0F}}) {
        const Soup soup = randomSoup(random, scale, offset);
        Parallel parallel({.thread_count = 2});
        const auto rays = RaySurface::make(soup.positions, soup.corners, {}, parallel);
        if (!rays) GTEST_SKIP() << rays.error().message;
        int hits = 0, misses = 0;
        double guess = 0;
        for (int i = 0; i < 2000; ++i) {
            DVec3 outward{direction(random), direction(random), direction(random)};
            normalize(outward);
            const DVec3 from{scale * direction(random) * 0.5 + offset, scale * direction(random) * 0.5,
                             scale * direction(random) * 0.5};
            const double reach = scale * 0.7, expected = nearestByHand(soup, from, outward, reach);
            RayHit hit;
            const bool is_hit = (*rays)->nearest(from, outward, reach, 0, guess, hit);
            // Exactly on an edge Embree may report the adjacent triangle.
            if (is_hit != std::isfinite(expected)) {
                ++misses;
                continue;
            }
            if (!is_hit) continue;
            ++hits;
            if (std::fabs(hit.distance - expected) > 1e-4 * scale) ++misses;
            EXPECT_NEAR(hit.weights[0] + hit.weights[1] + hit.weights[2], 1, 1e-9);
        }
        EXPECT_GT(hits, 300);
        EXPECT_LE(misses, 3);
    }
}

TEST(Rays, FindTheOutermostAndTheInnermostFront) {
    std::mt19937 random(11);
    std::normal_distribution<double> direction(0, 1);
    const Soup soup = randomSoup(random, 1, 0);
    Parallel parallel({.thread_count = 2});
    const auto rays = RaySurface::make(soup.positions, soup.corners, {}, parallel);
    if (!rays) GTEST_SKIP() << rays.error().message;
    int wrong = 0, hits = 0;
    for (int i = 0; i < 1000; ++i) {
        DVec3 outward{direction(random), direction(random), direction(random)};
        normalize(outward);
        const DVec3 from{0.5 * direction(random), 0.5 * direction(random), 0.5 * direction(random)};
        const auto [fronts, backs] =
            std::pair(frontsByHand(soup, from, outward), frontsByHand(soup, from, -1.0 * outward));
        std::vector<double> in_reach, backs_in_reach;
        for (const double at : fronts) {
            if (at >= -0.4 && at <= 0.7) in_reach.push_back(at);
        }
        for (const double at : backs) {
            if (-at >= -0.4 && -at <= 0.7) backs_in_reach.push_back(at);
        }
        RayHit outer, inner;
        const bool is_hit = (*rays)->outermost({from, outward, -0.4, 0.7}, outer);
        EXPECT_EQ((*rays)->innermost({from, outward, -0.4, 0.7}, inner), is_hit);
        const RayCrossings crossings = (*rays)->crossings({from, outward, -0.4, 0.7});
        // Exactly on an edge Embree may report the adjacent triangle.
        wrong += crossings.fronts != in_reach.size() || crossings.backs != backs_in_reach.size() ? 1 : 0;
        if (in_reach.empty() || !is_hit) {
            wrong += is_hit != !in_reach.empty() ? 1 : 0;
            continue;
        }
        ++hits;
        wrong += std::fabs(outer.distance - *std::max_element(in_reach.begin(), in_reach.end())) > 1e-4 ? 1 : 0;
        wrong += std::fabs(inner.distance - *std::min_element(in_reach.begin(), in_reach.end())) > 1e-4 ? 1 : 0;
    }
    EXPECT_GT(hits, 300);
    EXPECT_LE(wrong, 6);
}

/// Returns lines that are traced together: some are close to each other, some are at random positions in a soup, and
/// one ends before it begins.
std::vector<RayLine> linesTogether(std::mt19937& random, std::size_t count) {
    std::normal_distribution<double> direction(0, 1);
    const auto anywhere = [&] { return DVec3{direction(random), direction(random), direction(random)}; };
    const DVec3 from = 0.5 * anywhere();
    DVec3 outward = anywhere();
    normalize(outward);
    std::vector<RayLine> lines;
    for (std::size_t i = 0; i < count; ++i) {
        DVec3 other = anywhere();
        normalize(other);
        const bool is_beside = i % 4 != 3;
        lines.push_back({.from = is_beside ? from + 0.01 * other : 0.5 * anywhere(),
                         .outward = is_beside ? outward : other,
                         .begin = i == 5 ? 0.8 : -0.4,
                         .end = 0.7});
    }
    return lines;
}

TEST(Rays, HitTheSameTogetherAsOneByOne) {
    std::mt19937 random(13);
    const Soup soup = randomSoup(random, 1, 0);
    Parallel parallel({});
    const auto rays = RaySurface::make(soup.positions, soup.corners, {}, parallel);
    if (!rays) GTEST_SKIP() << rays.error().message;
    int hits = 0, others = 0;
    for (std::size_t round = 0; round < 400; ++round) {
        const std::vector<RayLine> lines = linesTogether(random, round % (kLinesAtOnce + 1));
        std::array<RayHit, kLinesAtOnce> together;
        const std::uint32_t met = (*rays)->outermost(lines, together);
        EXPECT_EQ(met >> lines.size(), 0U) << "there are no other lines";
        for (std::size_t i = 0; i < lines.size(); ++i) {
            RayHit alone;
            const RayLine& line = lines[i];
            const bool is_hit = (*rays)->outermost(line, alone);
            hits += is_hit ? 1 : 0;
            // Exactly on an edge Embree may report the adjacent triangle.
            const bool is_same =
                is_hit == ((met >> i & 1) != 0) &&
                (!is_hit || (alone.triangle == together[i].triangle && alone.distance == together[i].distance &&
                             alone.weights == together[i].weights));
            others += is_same ? 0 : 1;
        }
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(others, 3);
}

TEST(Rays, DoNotPassThroughEdgesAndVertices) {
    // Rays along the normals of a grid, through its vertices and its edges.
    Soup soup;
    constexpr std::uint32_t kSide = 9;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x)
            soup.positions.push_back({0.37F * static_cast<float>(x), 0.53F * static_cast<float>(y), 0});
    }
    for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
        for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
            const std::uint32_t a = y * kSide + x;
            for (const std::uint32_t vertex : {a, a + 1, a + kSide + 1, a, a + kSide + 1, a + kSide})
                soup.corners.push_back(vertex);
        }
    }
    Parallel parallel({});
    const auto rays = RaySurface::make(soup.positions, soup.corners, {}, parallel);
    if (!rays) GTEST_SKIP() << rays.error().message;
    double guess = 0;
    RayHit hit;
    for (std::uint32_t y = 2; y < 4 * (kSide - 1) - 1; ++y) {
        for (std::uint32_t x = 2; x < 4 * (kSide - 1) - 1; ++x) {
            const DVec3 from{0.37 * x / 4, 0.53 * y / 4, 0.2};
            ASSERT_TRUE((*rays)->nearest(from, {0, 0, 1}, 1, 0, guess, hit)) << x << ' ' << y;
            EXPECT_NEAR(hit.distance, -0.2, 1e-6);
            EXPECT_FALSE((*rays)->nearest(from, {0, 0, -1}, 1, 0, guess, hit)) << "seen from behind";
        }
    }
    for (std::uint32_t y = 2; y < 4 * (kSide - 1) - 1; ++y) {
        std::array<RayLine, kLinesAtOnce> lines;
        std::array<RayHit, kLinesAtOnce> hits;
        for (std::uint32_t x = 0; x < kLinesAtOnce; ++x)
            lines[x] = {.from = {0.37 * (x + 2) / 4, 0.53 * y / 4, 0.2}, .outward = {0, 0, 1}, .begin = -1, .end = 1};
        EXPECT_EQ((*rays)->outermost(lines, hits), 0xffffU) << y;
    }
}

TEST(Rays, BeginAndEndAnywhere) {
    // Embree terminates the process if a ray starts beyond 1.844e18, in units of the surface.
    for (const float size : {1.0F, 1e-30F, 1e30F}) {
        const std::vector<Vec3> positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        const std::vector<std::uint32_t> corners = {0, 1, 2};
        Parallel parallel({});
        const auto rays = RaySurface::make(positions, corners, {}, parallel);
        if (!rays) GTEST_SKIP() << rays.error().message;
        const double unit = static_cast<double>(size), inside = unit / 4;
        for (const double far : {0.0, 1.0, 1e10, 1e18, 1.9e18, 1e19, 1e30, 1e100}) {
            for (const double reach : {2e19, 1e38, 1e300}) {
                double guess = 0;
                RayHit hit;
                const bool is_near = far * unit <= reach;
                EXPECT_EQ((*rays)->nearest({inside, inside, far * unit}, {0, 0, 1}, reach, 0, guess, hit), is_near);
                if (is_near) {
                    EXPECT_NEAR(hit.distance, -far * unit, 1e-12 * far * unit);
                }
                guess = 0;
                EXPECT_FALSE((*rays)->nearest({2 * unit, inside, far * unit}, {0, 0, 1}, reach, 0, guess, hit));
                EXPECT_FALSE((*rays)->nearest({far * unit, inside, unit}, {1, 0, 0}, reach, 0, guess, hit));
                EXPECT_EQ((*rays)->first({inside, inside, far * unit}, {0, 0, -1}, reach, 0, hit), is_near);
                EXPECT_FALSE((*rays)->first({2 * unit, inside, far * unit}, {0, 0, -1}, reach, 0, hit));
            }
        }
        double guess = 0;
        RayHit hit;
        EXPECT_TRUE((*rays)->nearest({inside, inside, 0}, {0, 0, 1}, 1e-322, 0, guess, hit)) << "hardly more than 0";
    }
}

}  // namespace
}  // namespace tspace::test
