// SPDX-License-Identifier: MIT
// Operations on a single frame (T, B, N), after Lengyel, "Foundations of Game Engine Development 2", 2019, ch. 7. All
// functions are pure and O(1), use no memory, cannot fail, and may be called from any thread. Results are finite for
// finite valid input. Vectors need not have unit length unless a function says so.
#pragma once

#include "tspace/convention.h"
#include "tspace/span.h"

namespace tspace {

/// T, B and N in object space: the columns of the matrix from tangent space to object space.
struct Frame {
    Vec3 tangent{1, 0, 0};
    Vec3 bitangent{0, 1, 0};
    Vec3 normal{0, 0, 1};
};

/// Row-major 3x3 matrix.
struct Mat3 {
    Vec3 rows[3];
};

/// Unnormalized dP/du and dP/dv of a triangle, and the UV determinant s1 t2 - s2 t1 (twice the signed UV area).
struct FaceFrame {
    Vec3 tangent;    ///< (t2 E1 - t1 E2) / determinant; zero when the determinant is zero
    Vec3 bitangent;  ///< (s1 E2 - s2 E1) / determinant; zero when the determinant is zero
    float determinant = 0;
};

/// Computes the frame from the edges P1-P0 and P2-P0. Does not divide if the determinant is zero or not finite.
FaceFrame faceFrame(const Vec3 positions[3], const Vec2 uvs[3]);
/// Computes faceFrame from the edges P1-P0 and P2-P1; the results are equal except for rounding.
FaceFrame faceFrameFromPath(const Vec3 positions[3], const Vec2 uvs[3]);

/// Returns the determinant of the matrix with columns T, B, N.
float determinant(const Frame& frame);

/// Returns the sign of determinant(frame): +1 or -1; +1 if the determinant is zero.
float frameSign(const Frame& frame);

/// Returns B = sign * cross(N, T). `tangent.w` is the sign.
Vec3 rebuildBitangent(const Vec3& normal, const Vec4& tangent);

/// Orthonormalizes a frame by Gram-Schmidt: N' = N/|N|; T' = T - N'(N'.T); B' = B - N'(N'.B) - T'(T'.B)/(T'.T'); each
/// vector is normalized. If T is zero or (nearly) parallel to N, T' is taken from basisFromNormal; if B' vanishes, it
/// is cross(N', T'). If N is zero or not finite, (0, 0, 1) replaces it. The result is always finite, unit and
/// orthogonal.
Frame orthonormalize(const Frame& frame);

/// Returns the packed form of an orthonormalized frame: T' and the sign of the original frame.
Vec4 packTangent(const Frame& frame);

/// Returns a right-handed orthonormal frame with the given unit normal: Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017. Continuous except where n.z changes sign.
Frame basisFromNormal(const Vec3& unit_normal);

/// Returns the matrix from tangent space to object space, with columns T, B, N.
Mat3 tangentToObject(const Frame& frame);
/// Returns the matrix with rows T, B, N: the inverse of tangentToObject, for an orthonormal frame only.
Mat3 objectToTangentOrthonormal(const Frame& frame);
/// Computes the inverse of tangentToObject for any frame. Returns false, and writes nothing, if the determinant is zero
/// or not finite.
bool objectToTangent(const Frame& frame, Mat3& out);

/// Returns m * v.
Vec3 transform(const Mat3& m, const Vec3& v);

/// Transforms a direction to tangent space or back, for any frame (general inverse), without normalization.
/// toTangentSpace returns (0, 0, 0) for a singular frame.
Vec3 toTangentSpace(const Frame& frame, const Vec3& direction);
Vec3 toObjectSpace(const Frame& frame, const Vec3& direction);

/// Options for decoding a normal-map texel.
struct TexelDecode {
    float scale = 1.0f;       ///< multiplies x and y before normalization
    Green green = Green::up;  ///< down: y is negated
};
/// Decodes a normal-map texel, each channel in [0, 1], to a unit tangent-space normal: 2c - 1, x and y times `scale`
/// (usually 1; glTF normalTexture.scale), y negated for Green::down, normalized. Returns (0, 0, 1) if the result has no
/// length.
Vec3 decodeNormal(const Vec3& texel, const TexelDecode& options = {});

/// Returns uv * tiling + offset, wrapped to [0, 1) per component: the coordinates at which a tiled texture is sampled.
Vec2 tileUv(const Vec2& uv, const Vec2& tiling, const Vec2& offset = {});

/// Returns Lambert's cosine in tangent space: max(0, n.l), where n is the decoded texel and l the object-space
/// direction towards the light, transformed to tangent space by the orthonormalized frame. This is the CPU reference
/// for shaders.
float lambert(const Frame& frame, const Vec3& light_direction, const Vec3& tangent_space_normal);

/// Returns the object-space normal for a decoded texel: unit(T x + B y + N z) with the orthonormalized frame.
Vec3 objectNormal(const Frame& frame, const Vec3& tangent_space_normal);

/// Returns objectNormal in MikkTSpace's convention, which bakers assume: T and N as interpolated, not normalized, and B
/// = sign * cross(N, T) from them; only the result is normalized.
Vec3 objectNormalMikktspace(const Vec3& interpolated_normal, const Vec4& interpolated_tangent,
                            const Vec3& tangent_space_normal);

}  // namespace tspace
