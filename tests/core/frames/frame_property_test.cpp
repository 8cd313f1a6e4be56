// SPDX-License-Identifier: MIT
#include "tspace/frame.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/random_values.h"

namespace tspace {
namespace {

using test::dot;
using test::isUnit;
using test::norm;
using test::randomFloat;
using test::randomGarbageVec3;
using test::randomInt;
using test::randomUnit;
using test::randomVec2;
using test::randomVec3;

double distance(const Vec3& a, const Vec3& b) { return norm({a.x - b.x, a.y - b.y, a.z - b.z}); }

struct Triangle {
    Vec3 positions[3];
    Vec2 uvs[3];
};

Triangle randomTriangle() {
    Triangle t;
    for (Vec3& p : t.positions) p = randomVec3();
    for (Vec2& uv : t.uvs) uv = randomVec2();
    RC_PRE(std::fabs(faceFrame(t.positions, t.uvs).determinant) > 0.05f);
    return t;
}

Frame randomFrame() {
    const Vec3 t = randomVec3(), b = randomVec3();
    return {t, b, randomVec3()};
}

Frame randomSoundFrame() {
    const Frame f = randomFrame();
    RC_PRE(std::fabs(determinant(f)) > 0.05f);
    return f;
}

RC_GTEST_PROP(FaceFrameProperty, BothEdgeFormsAgree, ()) {
    const Triangle t = randomTriangle();
    const FaceFrame a = faceFrame(t.positions, t.uvs);
    const FaceFrame b = faceFrameFromPath(t.positions, t.uvs);
    RC_ASSERT(distance(a.tangent, b.tangent) <= 1e-6 * std::max(1.0, norm(a.tangent)));
    RC_ASSERT(distance(a.bitangent, b.bitangent) <= 1e-6 * std::max(1.0, norm(a.bitangent)));
    RC_ASSERT(std::fabs(a.determinant - b.determinant) <= 1e-6);
}

RC_GTEST_PROP(FaceFrameProperty, RebuildsTheEdgesFromTheUvDifferences, ()) {
    const Triangle t = randomTriangle();
    const FaceFrame f = faceFrame(t.positions, t.uvs);
    for (int k = 1; k < 3; ++k) {
        const float s = t.uvs[k].x - t.uvs[0].x, v = t.uvs[k].y - t.uvs[0].y;
        const Vec3 edge{s * f.tangent.x + v * f.bitangent.x, s * f.tangent.y + v * f.bitangent.y,
                        s * f.tangent.z + v * f.bitangent.z};
        const Vec3 wanted{t.positions[k].x - t.positions[0].x, t.positions[k].y - t.positions[0].y,
                          t.positions[k].z - t.positions[0].z};
        RC_ASSERT(distance(edge, wanted) < 1e-4);
    }
}

RC_GTEST_PROP(FaceFrameProperty, FollowsLinearMapsBeforeOrthogonalization, ()) {
    Triangle t = randomTriangle();
    const Mat3 map{{randomVec3(), randomVec3(), randomVec3()}};
    const FaceFrame before = faceFrame(t.positions, t.uvs);
    for (Vec3& p : t.positions) p = transform(map, p);
    const FaceFrame after = faceFrame(t.positions, t.uvs);
    RC_ASSERT(distance(after.tangent, transform(map, before.tangent)) < 2e-5);
    RC_ASSERT(distance(after.bitangent, transform(map, before.bitangent)) < 2e-5);
}

void assertOrthonormal(const Frame& f) {
    for (const Vec3& v : {f.tangent, f.bitangent, f.normal}) RC_ASSERT(isUnit(v, 3e-7));
    RC_ASSERT(std::fabs(dot(f.tangent, f.bitangent)) < 3e-7);
    RC_ASSERT(std::fabs(dot(f.tangent, f.normal)) < 3e-7);
    RC_ASSERT(std::fabs(dot(f.bitangent, f.normal)) < 3e-7);
}

RC_GTEST_PROP(OrthonormalizeProperty, GivesAnOrthonormalFrameForAnyInput, ()) {
    const Vec3 t = randomGarbageVec3(), b = randomGarbageVec3();
    assertOrthonormal(orthonormalize({t, b, randomGarbageVec3()}));
}

RC_GTEST_PROP(OrthonormalizeProperty, GivesAnOrthonormalFrameNearTheLimits, ()) {
    const Vec3 n = randomUnit();
    const float scale = std::ldexp(1.0f, randomInt(-120, 120));
    const float off = std::ldexp(1.0f, randomInt(-40, 0));
    const Vec3 t{scale * (n.x + off), scale * n.y, scale * n.z};
    assertOrthonormal(orthonormalize({t, {t.x, t.y + scale * off, t.z}, n}));
}

RC_GTEST_PROP(OrthonormalizeProperty, IsGramSchmidtInThatOrder, ()) {
    const Frame f = randomSoundFrame();
    const Frame o = orthonormalize(f);
    RC_ASSERT(frameSign(o) == frameSign(f));
    // T stays in the plane of T and N, on the same side of N. B stays on the same side of that plane.
    RC_ASSERT(std::fabs(dot(f.tangent, o.bitangent)) < 1e-6);
    RC_ASSERT(dot(f.tangent, o.tangent) > 0);
    RC_ASSERT(dot(f.bitangent, o.bitangent) > 0);
    RC_ASSERT(packTangent(f).w == frameSign(f));
    const Vec3 rebuilt = rebuildBitangent(o.normal, packTangent(f));
    RC_ASSERT(distance(rebuilt, o.bitangent) < 1e-6);
}

RC_GTEST_PROP(BasisProperty, IsRightHandedAndOrthonormal, ()) {
    Vec3 n = randomUnit();
    if (randomInt(0, 2) == 0) {
        // Normals near the south pole, where the published formula of 2012 loses precision.
        const float tilt = std::ldexp(1.0f, randomInt(-30, -8));
        n = {tilt, -tilt, -std::sqrt(1 - 2 * tilt * tilt)};
    }
    const Frame f = basisFromNormal(n);
    RC_ASSERT(f.normal == n);
    assertOrthonormal(f);
    RC_ASSERT(frameSign(f) == 1);
}

RC_GTEST_PROP(MatrixProperty, InversesUndoEachOther, ()) {
    const Frame f = randomSoundFrame();
    const Vec3 v = randomVec3();
    RC_ASSERT(distance(toTangentSpace(f, toObjectSpace(f, v)), v) < 1e-4);
    RC_ASSERT(distance(toObjectSpace(f, toTangentSpace(f, v)), v) < 1e-4);
    RC_ASSERT(distance(transform(tangentToObject(f), v), toObjectSpace(f, v)) < 1e-6);
}

RC_GTEST_PROP(MatrixProperty, TheTransposeInvertsOrthonormalFrames, ()) {
    const Frame o = orthonormalize(randomSoundFrame());
    const Vec3 v = randomVec3();
    RC_ASSERT(distance(transform(objectToTangentOrthonormal(o), v), toTangentSpace(o, v)) < 1e-6);
    RC_ASSERT(distance(transform(tangentToObject(o), transform(objectToTangentOrthonormal(o), v)), v) < 1e-6);
}

RC_GTEST_PROP(ShadingProperty, TangentSpaceLambertIsObjectSpaceLambert, ()) {
    const Frame f = randomSoundFrame();
    const Vec3 light = randomUnit();
    const Vec3 texel = decodeNormal(randomVec3(0, 1));
    const double in_object_space = std::max(0.0, dot(objectNormal(f, texel), light));
    RC_ASSERT(std::fabs(lambert(f, light, texel) - in_object_space) < 1e-6);
}

RC_GTEST_PROP(ShadingProperty, BothConventionsAgreeOnUnitOrthogonalInterpolants, ()) {
    const Frame o = orthonormalize(randomSoundFrame());
    const Vec3 texel = decodeNormal(randomVec3(0, 1));
    RC_ASSERT(distance(objectNormal(o, texel), objectNormalMikktspace(o.normal, packTangent(o), texel)) < 2e-6);
}

RC_GTEST_PROP(ShadingProperty, DecodedTexelsAreUnit, ()) {
    const Vec3 texel = randomGarbageVec3();
    RC_ASSERT(isUnit(decodeNormal(texel, {.scale = randomFloat(0, 4)})));
}

RC_GTEST_PROP(ShadingProperty, TiledUvsLieInTheUnitSquare, ()) {
    const Vec2 uv{test::randomGarbage(), test::randomGarbage()};
    const Vec2 tiled = tileUv(uv, randomVec2(-8, 8), randomVec2(-8, 8));
    RC_ASSERT(tiled.x >= 0 && tiled.x < 1 && tiled.y >= 0 && tiled.y < 1);
}

}  // namespace
}  // namespace tspace
