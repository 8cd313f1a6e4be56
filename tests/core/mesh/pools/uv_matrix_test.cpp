// SPDX-License-Identifier: MIT
#include "core/mesh/surface/uvs.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/mesh/pools/primitive.h"

namespace tspace {
namespace {

TEST(UvMatrix, IsTheIdentityIfFramesAreUnchanged) {
    for (const double scale : {1.0, 0.5, 1e-30, 1e30, 0.0}) {
        EXPECT_TRUE(uvMatrix(0, scale, 3).isIdentity());
        EXPECT_TRUE(uvMatrix(0, 3, scale).isIdentity());
    }
    EXPECT_TRUE(uvMatrix(6.283185307179586, 1, 1).isIdentity());
    EXPECT_TRUE(uvMatrix(6.2831855f, 2, 2).isIdentity()) << "a float's full turn";
}

TEST(UvMatrix, HasOnlyOnesInQuarterTurnsAndMirrors) {
    EXPECT_EQ(uvMatrix(1.5707964f, 6, 2), (UvMatrix{0, 1, -1, 0}));
    EXPECT_EQ(uvMatrix(-1.5708, 1, 1), uvMatrix(-1.5708, 2, 2));
    EXPECT_EQ(uvMatrix(3.1415927f, 1, 1), (UvMatrix{-1, 0, 0, -1}));
    EXPECT_EQ(uvMatrix(0, -4, 1), (UvMatrix{-1, 0, 0, 1}));
    EXPECT_EQ(uvMatrix(0, 4, -1), (UvMatrix{1, 0, 0, -1}));
    EXPECT_TRUE(uvMatrix(0, 4, -1).mirrors());
    EXPECT_FALSE(uvMatrix(1, -4, -1).mirrors());
}

TEST(UvMatrix, IgnoresTheUniformScale) {
    const UvMatrix one = uvMatrix(0.7, 1, 1);
    EXPECT_EQ(uvMatrix(0.7, 1024, 1024), one);
    EXPECT_EQ(uvMatrix(0.7, 0.1, 0.1), one);
    EXPECT_NE(uvMatrix(0.7, 0.1, 0.2), one);
}

TEST(UvMatrix, KeepsTheDigitsOfUvsInQuarterTurns) {
    const std::vector<Vec2> uvs = {{0.1f, 0.7f}, {-3, 1e-20f}};
    const std::vector<Vec2> turned = transformUvs(uvs, uvMatrix(1.5707964f, 1, 1));
    EXPECT_EQ(turned[0], (Vec2{0.7f, -0.1f}));
    EXPECT_EQ(turned[1], (Vec2{1e-20f, 3}));
}

/// The UVs of the triangle are (u, v) = M (x, y), where M distorts little, so dP/du and dP/dv are the columns of the
/// inverse of M.
RC_GTEST_PROP(UvMatrix, GivesTheFrameThatTheTransformedUvsHaveByTheChainRule, ()) {
    const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) / 100.0; };
    const double angle = number(-700, 700);
    const double scale_u = number(10, 400) * (*rc::gen::arbitrary<bool>() ? 1 : -1);
    const double scale_v = number(10, 400) * (*rc::gen::arbitrary<bool>() ? 1 : -1);
    const OwnedMesh mesh = {
        .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .normals = {3, Vec3{0, 0, 1}}, .uvs = {{0, 0}, {1, 0}, {0, 1}}};
    PoolView pool(mesh);
    pool.uv_matrix = uvMatrix(angle, scale_u, scale_v);
    FramesOptions options;
    options.tangents.convention = conventions::opengl;  // v and sign unchanged
    const PrimitiveGeometry triangle = {.indices = {0, 1, 2}};
    FramesReport report;
    const Result<PoolFrames> frames = computeFrames(pool, {&triangle, 1}, options, {&report, 1});
    RC_ASSERT(frames.ok());
    // u' = c su u + s sv v and v' = -s su u + c sv v, so du/du' = c / su and dv/du' = s / sv; here P = (u, v, 0).
    const double x = std::cos(angle) / scale_u, y = std::sin(angle) / scale_v, length = std::sqrt(x * x + y * y);
    for (const Vec4& tangent : frames->tangents) {
        RC_ASSERT(std::fabs(tangent.x - x / length) < 1e-4);
        RC_ASSERT(std::fabs(tangent.y - y / length) < 1e-4);
        RC_ASSERT(tangent.w == (scale_u * scale_v < 0 ? -1.0f : 1.0f));
    }
}

RC_GTEST_PROP(UvMatrix, MakesNoDifferenceToAPoolThatIsUsedInParts, ()) {
    const int size = *rc::gen::inRange(1, 5);
    OwnedMesh mesh;
    PrimitiveGeometry whole;
    for (int y = 0; y <= size; ++y) {
        for (int x = 0; x <= size; ++x) {
            const auto u = static_cast<float>(*rc::gen::inRange(-3, 4)),
                       v = static_cast<float>(*rc::gen::inRange(-3, 4));
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
            mesh.normals.push_back({0, 0, 1});
            mesh.uvs.push_back({u, v});
            if (x == size || y == size) continue;
            const auto a = static_cast<std::uint32_t>(y * (size + 1) + x), b = a + static_cast<std::uint32_t>(size) + 1;
            whole.indices.insert(whole.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
        }
    }
    PoolView pool(mesh);
    pool.uv_matrix = uvMatrix(1.1, 2, -1);
    OwnedMesh turned = mesh;
    turned.uvs = transformUvs(pool.uvs, pool.uv_matrix);
    const PrimitiveGeometry part = {.indices = {whole.indices.begin(), whole.indices.begin() + 3}};
    for (const std::vector<PrimitiveGeometry>& geometries :
         {std::vector{whole}, std::vector{part}, std::vector{whole, part}}) {
        std::vector<FramesReport> reports(geometries.size());
        const auto a = computeFrames(pool, geometries, {}, reports), b = computeFrames(turned, geometries, {}, reports);
        RC_ASSERT(a.ok() && b.ok());
        RC_ASSERT(a->tangents == b->tangents);
        RC_ASSERT(a->indices == b->indices);
    }
}

}  // namespace
}  // namespace tspace
