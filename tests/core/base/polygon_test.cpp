// SPDX-License-Identifier: MIT
#include "core/frames/face_cutter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

namespace tspace {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles cut(const std::vector<Vec3>& positions, const std::vector<Vec2>& uvs = {}) {
    MeshView mesh;
    mesh.positions = positions;
    mesh.uvs = uvs;
    Triangles triangles(positions.size() - 2);
    FaceCutter(mesh).cut(0, static_cast<std::uint32_t>(positions.size()), triangles.front().data());
    return triangles;
}

double areaAlongZ(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * ((double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x));
}

double areaAlongZ(const std::vector<Vec3>& polygon) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < polygon.size(); ++i) {
        sum += areaAlongZ(polygon[0], polygon[i + 1], polygon[i + 2]);
    }
    return sum;
}

/// Returns a star around the origin with these radii. It is simple, counter-clockwise, and usually not convex.
std::vector<Vec3> star(const std::vector<int>& radii) {
    std::vector<Vec3> polygon;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(radii.size());
        polygon.push_back(
            {static_cast<float>(radii[i] * std::cos(angle)), static_cast<float>(radii[i] * std::sin(angle)), 0});
    }
    return polygon;
}

rc::Gen<std::vector<Vec3>> anyStar() {
    return rc::gen::map(rc::gen::mapcat(rc::gen::inRange(5, 40),
                                        [](int n) {
                                            return rc::gen::container<std::vector<int>>(static_cast<std::size_t>(n),
                                                                                        rc::gen::inRange(1, 30));
                                        }),
                        star);
}

/// Returns the triangles as coordinates, which do not depend on the numbering of the polygon's vertices.
std::vector<std::array<float, 9>> geometry(const std::vector<Vec3>& positions, const Triangles& triangles) {
    std::vector<std::array<float, 9>> result;
    for (const auto& t : triangles) {
        std::array<float, 9> values{};
        for (std::size_t k = 0; k < 3; ++k) std::memcpy(&values[3 * k], &positions[t[k]], sizeof(Vec3));
        result.push_back(values);
    }
    return result;
}

TEST(Polygon, LeavesATriangleAlone) { EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (Triangles{{0, 1, 2}})); }

TEST(Polygon, CutsAQuadAlongItsShorterDiagonalInUvSpace) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Triangles along_02{{0, 1, 2}, {0, 2, 3}};
    const Triangles along_13{{0, 1, 3}, {1, 2, 3}};
    EXPECT_EQ(cut(square, {{0, 0}, {1, 0}, {0.5f, 0.5f}, {0, 1}}), along_02);
    EXPECT_EQ(cut(square, {{0, 0}, {0.6f, 0.5f}, {1, 1}, {0.5f, 0.5f}}), along_13);
}

TEST(Polygon, CutsAQuadWithEqualUvDiagonalsByItsShapeAndPrefers02) {
    const Triangles along_02{{0, 1, 2}, {0, 2, 3}};
    const Triangles along_13{{0, 1, 3}, {1, 2, 3}};
    const std::vector<Vec2> unit{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, unit), along_02);
    EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {3, 3, 0}, {0, 1, 0}}, unit), along_13);
    EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {3, 3, 0}, {0, 1, 0}}), along_13);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(cut({{nan, 0, 0}, {1, 0, 0}, {3, 3, 0}, {0, 1, 0}}, unit), along_02);
}

TEST(Polygon, CutsTheEarWithTheShortestDiagonalFirst) {
    // A regular hexagon with one corner moved inward, which shortens the diagonals that end at it.
    std::vector<Vec3> hexagon = star({10, 10, 10, 8, 10, 10});
    const Triangles triangles = cut(hexagon);
    const auto length2 = [&](std::uint32_t a, std::uint32_t b) {
        const float dx = hexagon[a].x - hexagon[b].x;
        const float dy = hexagon[a].y - hexagon[b].y;
        return dx * dx + dy * dy;
    };
    float shortest = std::numeric_limits<float>::max();
    for (std::uint32_t i = 0; i < 6; ++i) shortest = std::min(shortest, length2(i, (i + 2) % 6));
    EXPECT_EQ(length2(triangles[0][0], triangles[0][2]), shortest);
}

RC_GTEST_PROP(Polygon, CoversASimplePolygonOnceWithItsWinding, ()) {
    const std::vector<Vec3> polygon = *anyStar();
    double sum = 0;
    for (const auto& t : cut(polygon)) {
        const double area = areaAlongZ(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
        RC_ASSERT(area > -1e-3);
        sum += area;
    }
    RC_ASSERT(std::abs(sum - areaAlongZ(polygon)) < 1e-3 * std::abs(sum));
}

RC_GTEST_PROP(Polygon, UsesEachEdgeOfThePolygonOnceAndEachDiagonalBothWays, ()) {
    const std::vector<Vec3> polygon = *anyStar();
    const auto n = static_cast<std::uint32_t>(polygon.size());
    std::vector<int> uses(std::size_t{n} * n, 0);
    for (const auto& t : cut(polygon)) {
        for (std::size_t k = 0; k < 3; ++k) ++uses[std::size_t{t[k]} * n + t[(k + 1) % 3]];
    }
    for (std::uint32_t a = 0; a < n; ++a) {
        for (std::uint32_t b = 0; b < n; ++b) {
            const int forward = uses[std::size_t{a} * n + b];
            const int backward = uses[std::size_t{b} * n + a];
            if (b == (a + 1) % n) {
                RC_ASSERT(forward == 1 && backward == 0);
            } else if (a != (b + 1) % n) {
                RC_ASSERT(forward == backward && forward <= 1);
            }
        }
    }
}

RC_GTEST_PROP(Polygon, GivesTheSameTrianglesFromAnyStartingVertex, ()) {
    // Choose from few coordinates, so that ties and self-intersections are common.
    const auto count = *rc::gen::inRange<std::size_t>(5, 12);
    std::vector<Vec3> polygon;
    for (std::size_t i = 0; i < count; ++i) {
        const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(-2, 3)) * 0.37f; };
        polygon.push_back({coordinate(), coordinate(), coordinate()});
    }
    std::vector<Vec3> rotated = polygon;
    const auto start = *rc::gen::inRange<std::size_t>(0, count);
    std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(start), rotated.end());
    RC_ASSERT(geometry(polygon, cut(polygon)) == geometry(rotated, cut(rotated)));
}

/// Triangulates a polygon whose vertices are all ears and whose diagonals all have different lengths: cuts off the
/// vertex with the shortest diagonal while at least five vertices are left.
Triangles cutShortestFirst(const std::vector<Vec3>& positions) {
    std::vector<std::uint32_t> left(positions.size());
    std::iota(left.begin(), left.end(), 0u);
    Triangles triangles;
    while (left.size() > 4) {
        const auto at = [&](std::size_t i) { return left[i % left.size()]; };
        const auto diagonal = [&](std::size_t i) {
            const Vec3 &a = positions[at(i + left.size() - 1)], &b = positions[at(i + 1)];
            return std::hypot(double{b.x} - a.x, double{b.y} - a.y);
        };
        std::size_t best = 0;
        for (std::size_t i = 1; i < left.size(); ++i) best = diagonal(i) < diagonal(best) ? i : best;
        triangles.push_back({at(best + left.size() - 1), at(best), at(best + 1)});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return triangles;
}

RC_GTEST_PROP(Polygon, CutsTheShortestDiagonalOfAConvexPolygonFirst, ()) {
    // All vertices are on less than half of a rotated ellipse, so that no two chords have equal lengths.
    std::vector<int> steps =
        *rc::gen::unique<std::vector<int>>(*rc::gen::inRange<std::size_t>(5, 150), rc::gen::inRange(0, 700));
    std::sort(steps.begin(), steps.end());
    std::vector<Vec3> positions;
    for (const int step : steps) {
        const double angle = 3.14159265358979 / 720 * step, x = 3.7 * std::cos(angle);
        positions.push_back({static_cast<float>(x), static_cast<float>(std::sin(angle) + 0.37 * x), 0});
    }
    Triangles triangles = cut(positions);
    triangles.resize(triangles.size() - 2);  // not compared: each diagonal of a quad cuts off two vertices
    RC_ASSERT(triangles == cutShortestFirst(positions));
}

TEST(Polygon, MakesNoFlatTriangleOfVerticesOnALine) {
    const std::vector<Vec3> polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
    for (const auto& t : cut(polygon)) EXPECT_GT(areaAlongZ(polygon[t[0]], polygon[t[1]], polygon[t[2]]), 0.1);
}

TEST(Polygon, TriangulatesAPolygonWithABridgeToItsHole) {
    const std::vector<Vec3> polygon{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                    {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
    double sum = 0;
    for (const auto& t : cut(polygon)) {
        const double area = areaAlongZ(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
        EXPECT_GE(area, 0.0);
        sum += area;
    }
    EXPECT_DOUBLE_EQ(sum, 8.0);
}

TEST(Polygon, CutsPolygonsThatFaceAnyDirection) {
    const std::vector<Vec3> flat = star({10, 4, 10, 4, 10, 4, 10});
    const auto reference = cut(flat);
    std::vector<Vec3> turned;
    for (const Vec3& p : flat) turned.push_back({p.y, -p.x, 0});
    EXPECT_EQ(cut(turned).size(), reference.size());
    for (const auto& [ax, ay] : {std::array{0.6f, 0.8f}, std::array{-0.8f, 0.6f}}) {
        std::vector<Vec3> tilted;
        for (const Vec3& p : flat) tilted.push_back({p.x, ax * p.y, ay * p.y});
        double cover = 0;
        for (const auto& t : cut(tilted)) {
            const double area = areaAlongZ(flat[t[0]], flat[t[1]], flat[t[2]]);
            EXPECT_GT(area, 0.0);
            cover += area;
        }
        EXPECT_NEAR(cover, areaAlongZ(flat), 1e-3);
    }
}

RC_GTEST_PROP(Polygon, GivesValidTrianglesForGarbage, ()) {
    const auto count = *rc::gen::inRange<std::size_t>(5, 30);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const auto value = [&] {
        return *rc::gen::element(0.0f, -0.0f, 1.0f, -1.0f, 3e38f, -3e38f, 1e-45f, nan, inf, -inf);
    };
    std::vector<Vec3> positions;
    std::vector<Vec2> uvs;
    for (std::size_t i = 0; i < count; ++i) {
        positions.push_back({value(), value(), value()});
        uvs.push_back({value(), value()});
    }
    std::vector<int> uses(count, 0);
    for (const auto& t : cut(positions, uvs)) {
        for (const std::uint32_t v : t) {
            RC_ASSERT(v < count);
            ++uses[v];
        }
        RC_ASSERT(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    for (const int n : uses) RC_ASSERT(n > 0);
}

TEST(Polygon, CutsALargePolygonWithoutQuadraticTime) {
    std::vector<int> radii(300000);
    for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = 1000 + static_cast<int>(i % 3);
    EXPECT_EQ(cut(star(radii)).size(), radii.size() - 2);
}

}  // namespace
}  // namespace tspace
