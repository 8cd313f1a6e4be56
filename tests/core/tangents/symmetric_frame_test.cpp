// SPDX-License-Identifier: MIT
// The symmetric frame distributes the shear equally between both axes.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"

namespace tspace::test {
namespace {

constexpr std::array kMethods{Method::lengyel, Method::uniform, Method::angle, Method::area,
                              Method::flat,    Method::fast,    Method::best};

/// Returns a plane on which dP/du is the x axis and dP/dv is sheared by `shear_deg`.
SimpleMesh leaningPlane(double shear_deg, bool mirrored) {
    SimpleMesh shape = grid(4);
    const double lean = std::tan(shear_deg * std::numbers::pi / 180);
    for (std::size_t v = 0; v < shape.positions.size(); ++v) {
        const Vec2 uv = shape.uvs[v];
        const float along = mirrored ? -uv.x : uv.x;
        shape.positions[v] = {along + static_cast<float>(lean) * uv.y, uv.y, 0};
    }
    if (mirrored) {
        for (std::size_t i = 0; i < shape.indices.size(); i += 3) std::swap(shape.indices[i + 1], shape.indices[i + 2]);
    }
    return shape;
}

Outputs generate(const SimpleMesh& shape, const TangentOptions& options) {
    Outputs outputs(shape.cornerCount());
    const auto report = generateTangents(shape.view(), options, outputs.view());
    EXPECT_TRUE(report) << (report ? "" : report.error().message);
    return outputs;
}

TEST(SymmetricFrame, RotatesTheTangentByHalfOfTheShear) {
    for (const bool mirrored : {false, true}) {
        for (const double shear : {-60.0, 20.0, 45.0}) {
            const SimpleMesh shape = leaningPlane(shear, mirrored);
            const double half = -shear / 2 * std::numbers::pi / 180, side = mirrored ? -1 : 1;
            for (const Method method : kMethods) {
                const Outputs got = generate(
                    shape, {.method = method, .convention = conventions::opengl, .frame = FrameShape::symmetric});
                for (const Vec4& t : got.tangents) {
                    EXPECT_NEAR(t.x, side * std::cos(half), 1e-5);
                    EXPECT_NEAR(t.y, side * std::sin(half), 1e-5);
                    EXPECT_EQ(t.w, static_cast<float>(side));
                }
            }
        }
    }
}

TEST(SymmetricFrame, DoesNotChangeOrthogonalUvs) {
    const SimpleMesh shape = leaningPlane(0, false);
    for (const Method method : kMethods) {
        const Outputs got =
            generate(shape, {.method = method, .convention = conventions::opengl, .frame = FrameShape::symmetric});
        for (const Vec4& t : got.tangents) EXPECT_NEAR(t.x, 1, 1e-6);
    }
}

TEST(SymmetricFrame, KeepsSignsAndTheOtherOutputs) {
    SimpleMesh shape = grid(12);
    for (std::size_t v = 0; v < shape.uvs.size(); ++v)
        shape.uvs[v].x = std::fabs(shape.uvs[v].x + 0.3f * shape.uvs[v].y - 0.5f);
    for (const Method method : kMethods) {
        const Outputs plain = generate(shape, {.method = method, .convention = conventions::opengl});
        Outputs got =
            generate(shape, {.method = method, .convention = conventions::opengl, .frame = FrameShape::symmetric});
        for (std::size_t c = 0; c < got.tangents.size(); ++c) EXPECT_EQ(got.tangents[c].w, plain.tangents[c].w);
        got.tangents = plain.tangents;
        EXPECT_TRUE(sameBits(plain, got));
    }
}

TEST(SymmetricFrame, PlanAndEvaluateEqualTheOneCallWithoutBitangents) {
    const SimpleMesh shape = leaningPlane(50, false);
    for (const Method method : kMethods) {
        const TangentOptions options{
            .method = method, .convention = conventions::opengl, .frame = FrameShape::symmetric};
        const Outputs want = generate(shape, options);
        const auto plan = planTangents(shape.view(), options);
        ASSERT_TRUE(plan);
        std::vector<Vec4> tangents(shape.cornerCount());
        ASSERT_TRUE(evaluateTangents(*plan, {shape.positions, shape.normals}, {.tangents = tangents}));
        for (std::size_t c = 0; c < tangents.size(); ++c) EXPECT_TRUE(sameBits(tangents[c], want.tangents[c]));
    }
}

TEST(SymmetricFrame, HasAnEntryPerVertexToo) {
    const SimpleMesh shape = leaningPlane(50, false);
    const TangentOptions per_corner{
        .method = Method::lengyel, .convention = conventions::opengl, .frame = FrameShape::symmetric};
    TangentOptions per_vertex = per_corner;
    per_vertex.domain = OutputDomain::vertex;
    const Outputs want = generate(shape, per_corner);
    std::vector<Vec4> tangents(shape.positions.size());
    ASSERT_TRUE(generateTangents(shape.view(), per_vertex, {.tangents = tangents}));
    const auto plan = planTangents(shape.view(), per_vertex);
    ASSERT_TRUE(plan);
    std::vector<Vec4> evaluated(shape.positions.size());
    ASSERT_TRUE(evaluateTangents(*plan, {shape.positions, shape.normals}, {.tangents = evaluated}));
    for (std::size_t c = 0; c < shape.cornerCount(); ++c) {
        EXPECT_TRUE(sameBits(tangents[shape.indices[c]], want.tangents[c]));
        EXPECT_TRUE(sameBits(evaluated[shape.indices[c]], want.tangents[c]));
    }
}

TEST(SymmetricFrame, KeepsTangentsThatHaveNoBitangentOrNormal) {
    SimpleMesh shape = leaningPlane(30, false);
    const auto tangentsWith = [&](const Vec3& normal, FrameShape frame) {
        for (Vec3& n : shape.normals) n = normal;
        return generate(shape, {.method = Method::angle, .convention = conventions::opengl, .frame = frame}).tangents;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Vec3& normal : {Vec3{0, 0, 0}, Vec3{nan, 0, 1}}) {
        const auto plain = tangentsWith(normal, FrameShape::gramSchmidt);
        const auto got = tangentsWith(normal, FrameShape::symmetric);
        for (std::size_t c = 0; c < got.size(); ++c) EXPECT_TRUE(sameBits(plain[c], got[c]));
    }
}

TEST(SymmetricFrame, IsRejectedForMethodsWithoutUvs) {
    const SimpleMesh shape = grid(2);
    std::vector<Vec4> tangents(shape.cornerCount());
    const auto codeOf = [&](const TangentOptions& options) {
        const auto result = generateTangents(shape.view(), options, {.tangents = tangents});
        return result ? ErrorCode::ok : result.error().code;
    };
    EXPECT_EQ(codeOf({.method = Method::mikktspace, .frame = FrameShape::symmetric}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.method = Method::basis, .frame = FrameShape::symmetric}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.method = Method::best, .frame = static_cast<FrameShape>(2)}), ErrorCode::invalidOption);
}

}  // namespace
}  // namespace tspace::test
