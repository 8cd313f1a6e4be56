// SPDX-License-Identifier: MIT
// NormalOptions::weld_distance and WindingOptions::weld_distance: positions that are equal except for rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/near_positions.h"
#include "support/simple_mesh.h"
#include "tspace/normals.h"
#include "tspace/winding.h"

namespace tspace::test {
namespace {

/// Returns a grid over u and v from 0 to 1. Its last row and column have vertices of their own, as at a UV seam.
SimpleMesh sweep(std::uint32_t columns, std::uint32_t rows, const std::function<Vec3(double, double)>& at) {
    SimpleMesh mesh;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column)
            mesh.positions.push_back(at(double(column) / columns, double(row) / rows));
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * (columns + 1) + column, b = a + columns + 1;
            mesh.addTriangle(a, a + 1, b + 1);
            mesh.addTriangle(a, b + 1, b);
        }
    }
    return mesh;
}

Vec3 point(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// Returns a torus as many programs compute it: sin(2 pi) is not exactly 0, so it is closed only up to rounding.
/// `offset`: added before rounding to floats.
SimpleMesh torus(double scale = 1, const Vec3& offset = {}) {
    return sweep(32, 16, [&](double u, double v) {
        const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, ring = 1 + 0.4 * std::cos(b);
        return point(offset.x + scale * ring * std::cos(a), offset.y + scale * ring * std::sin(a),
                     offset.z + scale * 0.4 * std::sin(b));
    });
}

/// Returns the torus with the last row and column moved exactly to the first ones.
SimpleMesh closedTorus() {
    SimpleMesh mesh = torus();
    for (std::size_t row = 0; row <= 16; ++row) mesh.positions[33 * row + 32] = mesh.positions[33 * row];
    for (std::size_t column = 0; column <= 32; ++column) mesh.positions[33 * 16 + column] = mesh.positions[column];
    return mesh;
}

/// Returns a sphere whose poles are computed with sin(pi), which is not exactly 0: the vertices of the last row differ
/// by less than the spacing of floats near 1.
SimpleMesh sphere() {
    return sweep(24, 12, [](double u, double v) {
        const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * v;
        return point(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
    });
}

std::vector<Vec3> normalsOf(const SimpleMesh& mesh, NormalOptions options, unsigned threads = 1) {
    std::vector<Vec3> normals(mesh.cornerCount());
    EXPECT_TRUE(generateNormals(mesh.view(), options, normals, {.thread_count = threads}));
    return normals;
}

/// Returns the angle between unit vectors in degrees. It is accurate for small angles.
double degrees(const Vec3& a, const Vec3& b) {
    const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
    return 2 * std::asin(std::min(1.0, std::sqrt(x * x + y * y + z * z) / 2)) * 180 / std::numbers::pi;
}

double worstDegrees(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double worst = 0;
    for (std::size_t c = 0; c < a.size(); ++c) worst = std::max(worst, degrees(a[c], b[c]));
    return worst;
}

constexpr NormalWeighting kSmooth[] = {NormalWeighting::uniform,   NormalWeighting::area, NormalWeighting::angle,
                                       NormalWeighting::angleArea, NormalWeighting::max,  NormalWeighting::best};

TEST(WeldDistance, ClosesASeamOfRoundingUnderEveryWeighting) {
    const SimpleMesh mesh = torus(), exact = closedTorus();
    for (const NormalWeighting weighting : kSmooth) {
        const std::vector<Vec3> wanted = normalsOf(exact, {.weighting = weighting});
        EXPECT_GT(worstDegrees(normalsOf(mesh, {.weighting = weighting}), wanted), 4);
        for (const float crease : {180.0f, 60.0f, NormalOptions::crease_auto}) {
            NormalOptions options{.weighting = weighting, .crease_angle_deg = crease};
            options.weld_distance = NormalOptions::weld_auto;
            EXPECT_LT(worstDegrees(normalsOf(mesh, options), wanted), 0.01) << crease;
            options.weld_distance = 1e-6f;
            EXPECT_LT(worstDegrees(normalsOf(mesh, options), wanted), 0.01) << crease;
        }
    }
}

TEST(WeldDistance, MakesOneNormalOfAPole) {
    const SimpleMesh mesh = sphere();
    const std::vector<Vec3> normals =
        normalsOf(mesh, {.weighting = NormalWeighting::angle, .weld_distance = NormalOptions::weld_auto});
    for (std::size_t c = 0; c < normals.size(); ++c)
        EXPECT_LT(degrees(normals[c], mesh.positions[mesh.indices[c]]), 2) << c;
}

TEST(WeldDistance, KeepsTheBitsWhereNoPositionsAreNear) {
    const SimpleMesh mesh = closedTorus();
    for (const NormalWeighting weighting : kSmooth) {
        EXPECT_EQ(normalsOf(mesh, {.weighting = weighting, .weld_distance = NormalOptions::weld_auto}),
                  normalsOf(mesh, {.weighting = weighting}));
    }
}

TEST(WeldDistance, GivesTheSameBitsForAnyNumberOfThreads) {
    const SimpleMesh mesh = torus();
    const NormalOptions options{.weighting = NormalWeighting::best, .weld_distance = NormalOptions::weld_auto};
    EXPECT_EQ(normalsOf(mesh, options, 1), normalsOf(mesh, options, 3));
}

/// The edges are only a few float spacings long, but the shape that remains must be preserved.
TEST(WeldDistance, KeepsSmallMeshesFarFromTheOrigin) {
    const SimpleMesh mesh = torus(0.01, {4096, 0, 0});
    Parallel parallel({});
    EXPECT_TRUE(NearPositions(mesh.view(), NormalOptions::weld_auto, nullptr, parallel).empty());
}

/// One large triangle must not affect a small part near the origin, where floats are precise.
TEST(WeldDistance, KeepsFineDetailNextToALargeTriangle) {
    SimpleMesh mesh = torus(1e-4);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{-1e4f, -1e4f, 0}, {1e4f, -1e4f, 0}, {0, 1e4f, 0}});
    mesh.addTriangle(first, first + 1, first + 2);
    const std::vector<Vec3> with = normalsOf(mesh, {.weld_distance = NormalOptions::weld_auto});
    EXPECT_EQ(with, normalsOf(mesh, {}));
}

TEST(WeldDistance, DoesNotWeldChains) {
    SimpleMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.push_back({static_cast<float>(i), 0, 0});
    Parallel parallel({});
    const NearMesh near(mesh.view(), 1.5f, nullptr, parallel);
    std::vector<float> x;
    for (std::size_t v = 0; v < 8; ++v) x.push_back(near.view().positions[v].x);
    EXPECT_EQ(x, (std::vector<float>{0, 0, 2, 2, 4, 4, 6, 6}));
}

TEST(WeldDistance, WeldsEqualPositionsToOneVertex) {
    SimpleMesh mesh;
    mesh.positions = {{1, 0, 0}, {1.5f, 0, 0}, {2, 0, 0}, {1.5f, 0, 0}, {2, 0, 0}, {-0.0f, 0, 0}, {0.0f, 0, 0}};
    Parallel parallel({});
    const NearMesh near(mesh.view(), 0.6f, nullptr, parallel);
    const auto& at = near.view().positions;
    EXPECT_EQ(at[1], at[0]);
    EXPECT_EQ(at[3], at[0]);
    EXPECT_EQ(at[2], (Vec3{2, 0, 0}));
    EXPECT_EQ(at[4], at[2]);
    EXPECT_EQ(at[5], at[6]);
}

TEST(WeldDistance, RejectsInvalidDistances) {
    const SimpleMesh mesh = torus();
    std::vector<Vec3> normals(mesh.cornerCount());
    std::vector<std::uint8_t> turned(mesh.cornerCount() / 3);
    for (const float wrong : {-2.0f, -0.5f, NAN, INFINITY}) {
        EXPECT_EQ(generateNormals(mesh.view(), {.weld_distance = wrong}, normals).error().code,
                  ErrorCode::invalidOption);
        EXPECT_EQ(mendWinding(mesh.view(), {.weld_distance = wrong}, turned).error().code, ErrorCode::invalidOption);
    }
}

/// The faces next to the seam are flipped. With the seam welded, the torus is closed, and its volume determines the
/// winding.
TEST(WeldDistance, JoinsTheFacesOfASeamForWinding) {
    SimpleMesh mesh = torus();
    const std::size_t faces = mesh.cornerCount() / 3;
    std::vector<std::uint8_t> turned(faces);
    for (std::size_t f = 0; f < faces; ++f) {
        if (f / 2 % 32 == 31) std::swap(mesh.indices[3 * f + 1], mesh.indices[3 * f + 2]);
    }
    const auto report = mendWinding(mesh.view(), {.weld_distance = NormalOptions::weld_auto}, turned);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->component_count, 1u);
    EXPECT_EQ(report->by_volume_count, 1u);
    for (std::size_t f = 0; f < faces; ++f) EXPECT_EQ(turned[f], f / 2 % 32 == 31 ? 1 : 0) << f;
}

}  // namespace
}  // namespace tspace::test
