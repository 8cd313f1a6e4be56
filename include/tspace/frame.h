// SPDX-License-Identifier: MIT
// The mathematics of one frame (T, B, N), after Lengyel, "Foundations of Game Engine Development 2", 2019, ch. 7.
// All functions are pure, O(1), use no memory, cannot fail, and may be called from any thread. Results are finite for
// finite sound input. Vectors need not be unit unless a function says so.
#pragma once

#include "tspace/convention.h"
#include "tspace/span.h"

namespace tspace {

/// T, B and N in object space. Columns of the matrix that takes tangent space to object space.
struct Frame {
    Vec3 tangent{1, 0, 0};
    Vec3 bitangent{0, 1, 0};
    Vec3 normal{0, 0, 1};
};

/// Row-major 3x3.
struct Mat3 {
    Vec3 rows[3];
};

/// Unnormalised dP/du and dP/dv of a triangle and the UV determinant s1 t2 - s2 t1 (twice the signed UV area).
struct FaceFrame {
    Vec3 tangent;    ///< (t2 E1 - t1 E2) / determinant; zero when the determinant is zero
    Vec3 bitangent;  ///< (s1 E2 - s2 E1) / determinant; zero when the determinant is zero
    float determinant = 0;
};

/// From the edges P1-P0 and P2-P0. Divides by nothing when the determinant is zero or not finite.
FaceFrame faceFrame(const Vec3 positions[3], const Vec2 uvs[3]);
/// faceFrame from the edges P1-P0 and P2-P1: equal up to rounding.
FaceFrame faceFrameFromPath(const Vec3 positions[3], const Vec2 uvs[3]);

/// Determinant of the matrix with columns T, B, N.
float determinant(const Frame& frame);

/// +1 or -1: the sign of determinant(frame); +1 when it is zero.
float frameSign(const Frame& frame);

/// B = sign * cross(N, T). `tangent.w` is the sign.
Vec3 rebuildBitangent(const Vec3& normal, const Vec4& tangent);

/// Orthonormal frame by Gram-Schmidt: N' = N/|N|; T' = T - N'(N'.T); B' = B - N'(N'.B) - T'(T'.B)/(T'.T'); each
/// normalised. Where T is (nearly) parallel to N, or zero, T' comes from basisFromNormal; where B' vanishes, it is
/// cross(N', T'). N zero or not finite is taken as (0, 0, 1). The result is always finite, unit and orthogonal.
Frame orthonormalize(const Frame& frame);

/// The packed form of an orthonormalised frame: T' and the sign of the original frame.
Vec4 packTangent(const Frame& frame);

/// Right-handed orthonormal frame with the given unit normal: Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017. Continuous except where n.z changes sign.
Frame basisFromNormal(const Vec3& unit_normal);

/// Columns T, B, N: takes tangent space to object space.
Mat3 tangentToObject(const Frame& frame);
/// Rows T, B, N: the inverse of tangentToObject for an orthonormal frame only.
Mat3 objectToTangentOrthonormal(const Frame& frame);
/// The inverse of tangentToObject for any frame. Returns false, and writes nothing, when the determinant is zero or
/// not finite.
bool objectToTangent(const Frame& frame, Mat3& out);

/// m * v.
Vec3 transform(const Mat3& m, const Vec3& v);

/// Direction to tangent space and back, for any frame (general inverse). Not normalised. toTangentSpace returns
/// (0, 0, 0) for a singular frame.
Vec3 toTangentSpace(const Frame& frame, const Vec3& direction);
Vec3 toObjectSpace(const Frame& frame, const Vec3& direction);

/// How a normal-map texel is read.
struct TexelDecode {
    float scale = 1.0f;       ///< multiplies x and y before normalising
    Green green = Green::up;  ///< down: y is negated
};
/// A normal-map texel, each channel in [0, 1], decoded to a unit tangent-space normal: 2c - 1, x and y times `scale`
/// (usually 1; glTF normalTexture.scale), y negated for Green::down, normalised. (0, 0, 1) when the result has no
/// length.
Vec3 decodeNormal(const Vec3& texel, const TexelDecode& options = {});

/// uv * tiling + offset, then taken into [0, 1) per component: where a tiled texture is sampled.
Vec2 tileUv(const Vec2& uv, const Vec2& tiling, const Vec2& offset = {});

/// Lambert's cosine in tangent space: max(0, n.l) with n the decoded texel and l the object-space direction towards
/// the light taken to tangent space by the orthonormalised frame. The CPU reference for shaders.
float lambert(const Frame& frame, const Vec3& light_direction, const Vec3& tangent_space_normal);

/// Object-space normal for a decoded texel: unit(T x + B y + N z) with the frame orthonormalised first.
Vec3 objectNormal(const Frame& frame, const Vec3& tangent_space_normal);

/// objectNormal in MikkTSpace's convention, which bakers assume: T and N as interpolated, not normalised, B = sign *
/// cross(N, T) from them; only the result is normalised.
Vec3 objectNormalMikktspace(const Vec3& interpolated_normal, const Vec4& interpolated_tangent,
                            const Vec3& tangent_space_normal);

}  // namespace tspace
