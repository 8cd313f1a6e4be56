/* SPDX-License-Identifier: MIT */
/* The mathematics of one frame (T, B, N), after Lengyel, "Foundations of Game Engine Development 2", 2019, ch. 7.
 * All functions are pure, O(1), use no memory, cannot fail, and may be called from any thread. Results are finite
 * for finite sound input. Vectors need not be unit unless a function says so.
 * In C: part of tspace/tspace.h, which includes it. */
#ifndef TSPACE_TSPACE_FRAME_H
#define TSPACE_TSPACE_FRAME_H

#include "tspace/tspace_tangents.h"

#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

typedef struct tspace_Vec2 {
    float x, y;
} tspace_Vec2;

typedef struct tspace_Vec3 {
    float x, y, z;
} tspace_Vec3;

/* A tangent with its sign: x, y, z is the tangent, w the sign (+1 or -1). */
typedef struct tspace_Vec4 {
    float x, y, z, w;
} tspace_Vec4;

/* T, B and N in object space. Columns of the matrix that takes tangent space to object space. */
typedef struct tspace_Frame {
    tspace_Vec3 tangent, bitangent, normal;
} tspace_Frame;

/* Row-major 3x3. */
typedef struct tspace_Mat3 {
    tspace_Vec3 rows[3];
} tspace_Mat3;

/* Unnormalised dP/du and dP/dv of a triangle and the UV determinant s1 t2 - s2 t1 (twice the signed UV area). */
typedef struct tspace_FaceFrame {
    tspace_Vec3 tangent;   /* (t2 E1 - t1 E2) / determinant; zero when the determinant is zero */
    tspace_Vec3 bitangent; /* (s1 E2 - s2 E1) / determinant; zero when the determinant is zero */
    float determinant;
} tspace_FaceFrame;

/* From the edges P1-P0 and P2-P0. Divides by nothing when the determinant is zero or not finite.
 * In C: positions and uvs are 3 each. */
tspace_FaceFrame tspace_faceFrame(const tspace_Vec3* positions, const tspace_Vec2* uvs) TSPACE_NOEXCEPT;
/* tspace_faceFrame from the edges P1-P0 and P2-P1: equal up to rounding.
 * In C: positions and uvs are 3 each. */
tspace_FaceFrame tspace_faceFrameFromPath(const tspace_Vec3* positions, const tspace_Vec2* uvs) TSPACE_NOEXCEPT;

/* Determinant of the matrix with columns T, B, N. */
float tspace_determinant(tspace_Frame frame) TSPACE_NOEXCEPT;
/* +1 or -1: the sign of tspace_determinant(frame); +1 when it is zero. */
float tspace_frameSign(tspace_Frame frame) TSPACE_NOEXCEPT;

/* B = sign * cross(N, T). `tangent.w` is the sign. */
tspace_Vec3 tspace_rebuildBitangent(tspace_Vec3 normal, tspace_Vec4 tangent) TSPACE_NOEXCEPT;

/* Orthonormal frame by Gram-Schmidt: N' = N/|N|; T' = T - N'(N'.T); B' = B - N'(N'.B) - T'(T'.B)/(T'.T'); each
 * normalised. Where T is (nearly) parallel to N, or zero, T' comes from tspace_basisFromNormal; where B' vanishes,
 * it is cross(N', T'). N zero or not finite is taken as (0, 0, 1). The result is always finite, unit and orthogonal. */
tspace_Frame tspace_orthonormalize(tspace_Frame frame) TSPACE_NOEXCEPT;

/* The packed form of an orthonormalised frame: T' and the sign of the original frame. */
tspace_Vec4 tspace_packTangent(tspace_Frame frame) TSPACE_NOEXCEPT;

/* Right-handed orthonormal frame with the given unit normal: Duff et al., "Building an Orthonormal Basis,
 * Revisited", JCGT 6(1), 2017. Continuous except where n.z changes sign. */
tspace_Frame tspace_basisFromNormal(tspace_Vec3 unit_normal) TSPACE_NOEXCEPT;

/* Columns T, B, N: takes tangent space to object space. */
tspace_Mat3 tspace_tangentToObject(tspace_Frame frame) TSPACE_NOEXCEPT;
/* Rows T, B, N: the inverse of tspace_tangentToObject for an orthonormal frame only. */
tspace_Mat3 tspace_objectToTangentOrthonormal(tspace_Frame frame) TSPACE_NOEXCEPT;
/* The inverse of tspace_tangentToObject for any frame. Returns 0, and writes nothing, when the determinant is zero
 * or not finite.
 * In C: else returns 1. */
int tspace_objectToTangent(tspace_Frame frame, tspace_Mat3* out) TSPACE_NOEXCEPT;

/* m * v. */
tspace_Vec3 tspace_transform(tspace_Mat3 m, tspace_Vec3 v) TSPACE_NOEXCEPT;

/* Direction to tangent space and back, for any frame (general inverse). Not normalised. tspace_toTangentSpace
 * returns (0, 0, 0) for a singular frame. */
tspace_Vec3 tspace_toTangentSpace(tspace_Frame frame, tspace_Vec3 direction) TSPACE_NOEXCEPT;
tspace_Vec3 tspace_toObjectSpace(tspace_Frame frame, tspace_Vec3 direction) TSPACE_NOEXCEPT;

/* A normal-map texel, each channel in [0, 1], decoded to a unit tangent-space normal: 2c - 1, x and y times `scale`
 * (usually 1; glTF normalTexture.scale), y negated for TSPACE_GREEN_DOWN, normalised. (0, 0, 1) when the result has
 * no length. */
tspace_Vec3 tspace_decodeNormal(tspace_Vec3 texel, float scale, tspace_Green green) TSPACE_NOEXCEPT;

/* uv * tiling + offset, then taken into [0, 1) per component: where a tiled texture is sampled. */
tspace_Vec2 tspace_tileUv(tspace_Vec2 uv, tspace_Vec2 tiling, tspace_Vec2 offset) TSPACE_NOEXCEPT;

/* Lambert's cosine in tangent space: max(0, n.l) with n the decoded texel and l the object-space direction towards
 * the light taken to tangent space by the orthonormalised frame. The CPU reference for shaders. */
float tspace_lambert(tspace_Frame frame, tspace_Vec3 light_direction, tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* Object-space normal for a decoded texel: unit(T x + B y + N z) with the frame orthonormalised first. */
tspace_Vec3 tspace_objectNormal(tspace_Frame frame, tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

/* tspace_objectNormal in MikkTSpace's convention, which bakers assume: T and N as interpolated, not normalised, B =
 * sign * cross(N, T) from them; only the result is normalised. */
tspace_Vec3 tspace_objectNormalMikktspace(tspace_Vec3 interpolated_normal, tspace_Vec4 interpolated_tangent,
                                          tspace_Vec3 tangent_space_normal) TSPACE_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__) && !defined(_WIN32)
#pragma GCC visibility pop
#endif

#endif
