// SPDX-License-Identifier: MIT
// Normal maps on nodes with nonuniform scale.
#include <gtest/gtest.h>

#include <array>

#include "commands/shared/picture/draw_surfaces.h"

namespace tspace::test {
namespace {

/// An inclined triangle whose frames differ at its corners.
struct Leaning {
    std::array<std::uint32_t, 3> corners = {0, 1, 2};
    std::array<Vec3, 3> normals = {{{0.48F, 0.6F, 0.64F}, {0.6F, 0.48F, 0.64F}, {0, 0.6F, 0.8F}}};
    std::array<Vec4, 3> tangents = {{{0.8F, 0, -0.6F, 1}, {0.8F, -0.36F, -0.48F, 1}, {1, 0, 0, 1}}};
    std::array<Vec2, 3> uvs = {{{0, 0}, {1, 0}, {0, 1}}};
    PictureTexture map = {.width = 1, .height = 1, .texels = {{0.74F, 0.68F, 0.9F}}};

    [[nodiscard]] ShownSurface shown() const {
        return {.corners = corners,
                .normals = {.values = normals},
                .tangents = {.values = tangents},
                .normal_map = {.shape = {.width = 1, .height = 1}, .image = &map, .uvs = uvs}};
    }
};

DVec3 unit(DVec3 v) {
    normalize(v);
    return v;
}

/// Returns the shading normal as the shaders of three.js and of Khronos' viewer compute it: N is transformed by the
/// inverse transpose and T by the matrix; both are normalized at each vertex and interpolated; B = w cross(N, T).
DVec3 shaderNormal(const Leaning& mesh, const DVec3& scale, const std::array<double, 3>& weights) {
    DVec3 normal{}, tangent{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 n = mesh.normals[i];
        const Vec4 t = mesh.tangents[i];
        normal = normal + weights[i] * unit({n.x / scale.x, n.y / scale.y, n.z / scale.z});
        tangent = tangent + weights[i] * unit({t.x * scale.x, t.y * scale.y, t.z * scale.z});
    }
    return unit(0.48 * tangent + 0.36 * cross(normal, tangent) + 0.8 * normal);
}

TEST(NodeScale, AMapIsShadedAsThreeJsAndTheViewerOfKhronosDo) {
    const Leaning mesh;
    const std::array<double, 3> weights{0.5, 0.3, 0.2};
    for (const DVec3& scale : {DVec3{1, 2.5, 0.6}, DVec3{3, 1, 1}, DVec3{1, 1, 1}, DVec3{2, 2, 2}}) {
        const Affine place{{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}, {}};
        const DVec3 shaded = mappedNormal(mesh.shown(), place, {.triangle = 0, .weights = weights});
        EXPECT_LT(degreesBetween(shaded, shaderNormal(mesh, scale, weights)), 1e-4) << scale.x << " " << scale.y;
    }
}

TEST(NodeScale, TangentsOfAnyLengthAreShadedAsUnitOnes) {
    const Leaning mesh;
    Leaning longer = mesh;
    const std::array<float, 3> lengths{0.25F, 1, 3};
    for (std::size_t i = 0; i < 3; ++i) {
        Vec4& t = longer.tangents[i];
        t = {lengths[i] * t.x, lengths[i] * t.y, lengths[i] * t.z, t.w};
    }
    const SurfacePoint point{.triangle = 0, .weights = {0.5, 0.3, 0.2}};
    for (const Affine& place : {Affine{}, Affine{{1, 0, 0}, {0, 2.5, 0}, {0, 0, 0.6}, {}}}) {
        const DVec3 expected = mappedNormal(mesh.shown(), place, point);
        EXPECT_LT(degreesBetween(mappedNormal(longer.shown(), place, point), expected), 1e-4);
    }
}

TEST(NodeScale, BakingAndRenderingUseTheSameFrame) {
    const Leaning mesh;
    const std::array<double, 3> weights{0.2, 0.2, 0.6};
    const Affine place{{0.9, 0.3, 0}, {-0.5, 2.1, 0.2}, {0, 0.4, 0.6}, {}};
    CornerFrames frames{mesh.normals, mesh.tangents};
    for (Vec3& normal : frames.normals) normal = normalAt(place, normal);
    for (Vec4& tangent : frames.tangents) tangent = tangentAt(place, tangent);
    const DVec3 baked = shadedNormal(shadingFrame(frames, weights, {}), {0.48, 0.36, 0.8});
    EXPECT_LT(degreesBetween(mappedNormal(mesh.shown(), place, {.triangle = 0, .weights = weights}), baked), 1e-4);
}

TEST(NodeScale, FlipsNormalsOfBackFaces) {
    const Leaning mesh;
    const Affine place{{1, 0, 0}, {0, 2.5, 0}, {0, 0, 0.6}, {}};
    SurfacePoint point{.triangle = 0, .weights = {0.5, 0.3, 0.2}};
    const DVec3 front = mappedNormal(mesh.shown(), place, point);
    point.is_back = true;
    EXPECT_LT(degreesBetween(front, -1.0 * mappedNormal(mesh.shown(), place, point)), 1e-6);
}

}  // namespace
}  // namespace tspace::test
