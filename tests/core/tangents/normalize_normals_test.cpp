// SPDX-License-Identifier: MIT
// TangentOptions::normalize_normals: normals of any length, in one call, in plans and in makeIndexedFrames.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shapes.h"
#include "support/same_bits.h"
#include "tspace/indexed_frames.h"

namespace tspace::test {
namespace {

constexpr Method kMethods[] = {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                               Method::flat,       Method::basis,   Method::fast,    Method::best};

SimpleMesh bentGrid(float length) {
    SimpleMesh mesh = grid(8);
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        const Vec3& p = mesh.positions[v];
        const float dx = -0.3f * std::cos(p.x * 0.3f) * std::cos(p.y * 0.2f),
                    dy = 0.2f * std::sin(p.x * 0.3f) * std::sin(p.y * 0.2f);
        const float scale = length / std::sqrt(dx * dx + dy * dy + 1);
        mesh.normals[v] = {dx * scale, dy * scale, scale};
    }
    return mesh;
}

TangentOptions optionsOf(Method method, bool normalizes) {
    return {.method = method, .convention = conventions::opengl, .normalize_normals = normalizes};
}

std::vector<Vec4> tangentsOf(const SimpleMesh& mesh, const TangentOptions& options) {
    std::vector<Vec4> tangents(mesh.cornerCount());
    EXPECT_TRUE(generateTangents(mesh.view(), options, {.tangents = tangents}));
    return tangents;
}

std::vector<Vec4> plannedTangents(const SimpleMesh& mesh, const TangentOptions& options) {
    std::vector<Vec4> tangents(mesh.cornerCount());
    const Result<TangentPlan> plan = planTangents(mesh.view(), options);
    EXPECT_TRUE(plan);
    EXPECT_TRUE(evaluateTangents(*plan, {mesh.view().positions, mesh.view().normals}, {.tangents = tangents}));
    return tangents;
}

float apart(const Vec4& a, const Vec4& b) {
    return std::fabs(a.x - b.x) + std::fabs(a.y - b.y) + std::fabs(a.z - b.z) + std::fabs(a.w - b.w);
}

TEST(NormalizeNormals, GivesTheTangentsOfUnitNormals) {
    for (const Method method : kMethods) {
        const std::vector<Vec4> wanted = tangentsOf(bentGrid(1), optionsOf(method, false));
        for (const float length : {0.5f, 2.0f, 127.0f, 1e-5f, 1e20f}) {
            const std::vector<Vec4> made = tangentsOf(bentGrid(length), optionsOf(method, true));
            for (std::size_t c = 0; c < made.size(); ++c)
                ASSERT_LT(apart(made[c], wanted[c]), 1e-4f) << methodName(method) << " " << length;
        }
    }
}

TEST(NormalizeNormals, HasTheSameBitsInAPlan) {
    for (const Method method : kMethods) {
        const TangentOptions options = optionsOf(method, true);
        const SimpleMesh mesh = bentGrid(3);
        EXPECT_EQ(tangentsOf(mesh, options), plannedTangents(mesh, options)) << methodName(method);
        SimpleMesh listed = mesh;
        MeshView view = listed.view();
        view.normal_indices = view.indices;
        std::vector<Vec4> made(view.cornerCount()), planned(view.cornerCount());
        ASSERT_TRUE(generateTangents(view, options, {.tangents = made}));
        const Result<TangentPlan> plan = planTangents(view, options);
        ASSERT_TRUE(plan);
        ASSERT_TRUE(evaluateTangents(*plan, {view.positions, view.normals}, {.tangents = planned}));
        EXPECT_EQ(made, planned) << methodName(method);
    }
}

TEST(NormalizeNormals, KeepsTheBitsWhereNormalsAreUnitWithinRounding) {
    for (const float length : {1.0f, 0.9935f, 1.0065f}) {
        const SimpleMesh mesh = bentGrid(length);
        for (const Method method : kMethods)
            EXPECT_EQ(tangentsOf(mesh, optionsOf(method, true)), tangentsOf(mesh, optionsOf(method, false)));
    }
}

TEST(NormalizeNormals, LeavesNormalsWithoutADirectionAsTheyAre) {
    SimpleMesh mesh = bentGrid(1);
    mesh.normals[3] = {};
    mesh.normals[20] = {std::numeric_limits<float>::quiet_NaN(), 0, 1};
    mesh.normals[30] = {std::numeric_limits<float>::infinity(), 0, 1};
    const std::vector<Vec4> with = tangentsOf(mesh, optionsOf(Method::mikktspace, true)),
                            without = tangentsOf(mesh, optionsOf(Method::mikktspace, false));
    EXPECT_TRUE(sameBits(with, without));
}

TEST(NormalizeNormals, GivesIndexedFramesUnitNormals) {
    const SimpleMesh mesh = bentGrid(5);
    const Result<IndexedFrames> frames =
        makeIndexedFrames(mesh.view(), {.tangents = optionsOf(Method::mikktspace, true)});
    ASSERT_TRUE(frames);
    for (std::size_t v = 0; v < frames->vertexCount(); ++v) {
        const Vec3& n = frames->normals[v];
        const Vec4& t = frames->tangents[v];
        EXPECT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-5);
        EXPECT_NEAR(n.x * t.x + n.y * t.y + n.z * t.z, 0, 1e-5);
    }
}

}  // namespace
}  // namespace tspace::test
