/* SPDX-License-Identifier: MIT */
/* Functions on single frames from C: each is called once, with values that can be checked by hand. */
#include "tspace/tspace.h"

#include "c_check.h"

static int isVec3(tspace_Vec3 v, float x, float y, float z) { return v.x == x && v.y == y && v.z == z; }

static float distance(float a, float b) { return a < b ? b - a : a - b; }

static void checkFaceFrames(void) {
    /* u runs along y, with 2 units of length per unit of u, and v runs along x, so the triangle is mirrored. */
    const tspace_Vec3 positions[3] = {{0, 0, 0}, {0, 2, 0}, {3, 0, 0}};
    const tspace_Vec2 uvs[3] = {{0, 0}, {1, 0}, {0, 1}};
    const tspace_FaceFrame both[2] = {tspace_faceFrame(positions, uvs), tspace_faceFrameFromPath(positions, uvs)};
    for (int i = 0; i < 2; ++i) {
        CHECK(isVec3(both[i].tangent, 0, 2, 0));
        CHECK(isVec3(both[i].bitangent, 3, 0, 0));
        CHECK(both[i].determinant == 1);
    }
}

static void checkMatrices(void) {
    const tspace_Frame skewed = {{2, 0, 0}, {1, 1, 0}, {0, 0, 4}};
    const tspace_Vec3 v = {3, 5, 7};
    CHECK(tspace_determinant(skewed) == 8);
    CHECK(tspace_frameSign(skewed) == 1);
    CHECK(isVec3(tspace_transform(tspace_tangentToObject(skewed), v), 11, 5, 28));
    CHECK(isVec3(tspace_toObjectSpace(skewed, v), 11, 5, 28));
    const tspace_Vec3 back = {11, 5, 28};
    CHECK(isVec3(tspace_toTangentSpace(skewed, back), 3, 5, 7));
    tspace_Mat3 inverse;
    CHECK(tspace_objectToTangent(skewed, &inverse) == 1);
    CHECK(isVec3(tspace_transform(inverse, back), 3, 5, 7));
    const tspace_Frame flat = {{1, 0, 0}, {2, 0, 0}, {0, 0, 1}};
    CHECK(tspace_objectToTangent(flat, &inverse) == 0);
    const tspace_Frame mirrored = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    CHECK(tspace_frameSign(mirrored) == -1);
    CHECK(isVec3(tspace_transform(tspace_objectToTangentOrthonormal(mirrored), v), 5, 3, 7));
}

static void checkOrthonormal(void) {
    const tspace_Frame skewed = {{2, 0, 0}, {1, -1, 0}, {0, 0, 4}};
    const tspace_Frame frame = tspace_orthonormalize(skewed);
    CHECK(isVec3(frame.tangent, 1, 0, 0) && isVec3(frame.bitangent, 0, -1, 0) && isVec3(frame.normal, 0, 0, 1));
    const tspace_Vec4 packed = tspace_packTangent(skewed);
    CHECK(packed.x == 1 && packed.y == 0 && packed.z == 0 && packed.w == -1);
    CHECK(isVec3(tspace_rebuildBitangent(frame.normal, packed), 0, -1, 0));
    const tspace_Vec3 up = {0, 0, 1};
    const tspace_Frame basis = tspace_basisFromNormal(up);
    CHECK(isVec3(basis.normal, 0, 0, 1) && tspace_determinant(basis) == 1);
}

static void checkShading(void) {
    const tspace_Vec3 texel = {0.5f, 1.0f, 0.5f};
    CHECK(isVec3(tspace_decodeNormal(texel, 1.0f, TSPACE_GREEN_UP), 0, 1, 0));
    CHECK(isVec3(tspace_decodeNormal(texel, 1.0f, TSPACE_GREEN_DOWN), 0, -1, 0));
    CHECK(isVec3(tspace_decodeNormal(texel, 0.0f, TSPACE_GREEN_UP), 0, 0, 1));
    const tspace_Vec2 uv = {0.5f, 0.25f};
    const tspace_Vec2 tiling = {3.0f, 2.0f};
    const tspace_Vec2 offset = {0.25f, 0.0f};
    const tspace_Vec2 tiled = tspace_tileUv(uv, tiling, offset);
    CHECK(tiled.x == 0.75f && tiled.y == 0.5f);

    const tspace_Frame frame = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const tspace_Vec3 normal = {0.6f, 0.0f, 0.8f};
    const tspace_Vec3 light = {0, 0, 1};
    CHECK(distance(tspace_lambert(frame, light, normal), 0.8f) < 1e-6f);
    CHECK(distance(tspace_objectNormal(frame, normal).x, 0.6f) < 1e-6f);
    const tspace_Vec4 tangent = {2, 0, 0, 1}; /* not unit, like interpolated tangents: must not be normalized */
    const tspace_Vec3 diagonal = {1, 0, 2};
    const tspace_Vec3 result = tspace_objectNormalMikktspace(light, tangent, diagonal);
    CHECK(distance(result.x, result.z) < 1e-6f && result.y == 0);
}

void checkFrameFunctions(void);
void checkFrameFunctions(void) {
    checkFaceFrames();
    checkMatrices();
    checkOrthonormal();
    checkShading();
}
