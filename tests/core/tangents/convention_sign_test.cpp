// SPDX-License-Identifier: MIT
// The stored sign has the same meaning for every method, in any convention of the mesh.
#include <gtest/gtest.h>

#include <vector>

#include "core/base/vec_math.h"
#include "tspace/normals.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

/// Two squares that meet at x = 0; u is mirrored on the left one.
struct MirroredStrip {
    std::vector<Vec3> positions{{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}};
    std::vector<Vec2> uvs{{1, 0}, {0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}};
    std::vector<std::uint32_t> indices{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    std::vector<Vec3> normals{6};

    /// Sets normals that point outward according to the convention.
    explicit MirroredStrip(const Convention& convention) {
        for (Vec3& n : normals) n = {0, 0, normalFactor(convention)};
    }
    [[nodiscard]] MeshView view() const {
        return {.positions = positions,
                .normals = normals,
                .uvs = uvs,
                .indices = IndexView(std::span<const std::uint32_t>(indices))};
    }
};

/// Returns the bitangent that the convention requires. dP/dv is (0, 1, 0) on the whole strip, so only v_axis and green
/// matter.
Vec3 wantedBitangent(const Convention& c) {
    return {0, (c.v_axis == VAxis::down) == (c.green == Green::down) ? 1.0f : -1.0f, 0};
}

TEST(Conventions, GiveEveryMethodTheSignThatRebuildsTheWantedBitangent) {
    for (const char* preset : {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot"}) {
        const Convention convention = *findConvention(preset);
        const MirroredStrip strip(convention);
        for (const Method method : {Method::mikktspace, Method::uniform, Method::angle, Method::area, Method::flat,
                                    Method::fast, Method::best}) {
            std::vector<Vec4> tangents(strip.indices.size());
            ASSERT_TRUE(
                generateTangents(strip.view(), {.method = method, .convention = convention}, {.tangents = tangents}));
            for (std::size_t c = 0; c < tangents.size(); ++c) {
                const Vec3 rebuilt = tangents[c].w * cross(strip.normals[strip.indices[c]], xyz(tangents[c]));
                EXPECT_GT(dot(rebuilt, wantedBitangent(convention)), 0.999f)
                    << preset << ", method " << static_cast<int>(method) << ", corner " << c;
            }
        }
    }
}

TEST(Conventions, DecideWhichTrianglesAreCountedAsMirrored) {
    // The left square has negative UV area. With v up, the left square is mirrored; with v down, the right one is.
    // Clockwise winding (seen from outside) exchanges them. One additional triangle has two corners at one vertex, and
    // another one repeats a triangle of the left square.
    const std::vector<std::uint32_t> left{0, 1, 4};
    for (const char* preset : {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot"}) {
        const Convention convention = *findConvention(preset);
        MirroredStrip strip(convention);
        for (const std::uint32_t corner : {1u, 4u, 4u}) strip.indices.push_back(corner);
        for (const std::uint32_t corner : left) strip.indices.push_back(corner);
        const bool left_is_mirrored =
            (convention.v_axis == VAxis::up) == (convention.winding == Winding::counterClockwise);
        for (const Method method : {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                                    Method::flat, Method::fast, Method::best}) {
            std::vector<Vec4> tangents(strip.indices.size());
            const TangentOptions options{.method = method, .convention = convention};
            const Result<TangentReport> report = generateTangents(strip.view(), options, {.tangents = tangents});
            ASSERT_TRUE(report) << preset;
            EXPECT_EQ(report->mirrored_count, left_is_mirrored ? 3u : 2u) << preset << ' ' << methodName(method);
            const Result<TangentPlan> plan = planTangents(strip.view(), options);
            ASSERT_TRUE(plan) << preset;
            const Result<TangentReport> posed =
                evaluateTangents(*plan, {strip.positions, strip.normals}, {.tangents = tangents});
            ASSERT_TRUE(posed) << preset;
            EXPECT_EQ(posed->mirrored_count, report->mirrored_count) << preset << ' ' << methodName(method);
        }
    }
}

}  // namespace
}  // namespace tspace
