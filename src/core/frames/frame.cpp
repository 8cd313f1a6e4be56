// SPDX-License-Identifier: MIT
// Operations on a single frame, in double precision, so that no float input overflows or loses its direction. Based on:
// Lengyel, "Foundations of Game Engine Development 2", 2019, ch. 7; Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6(1), 2017.
#include "tspace/frame.h"

#include <cmath>

#include "core/base/vec_math.h"

namespace tspace {
namespace {

// Sine of the angle below which two float directions count as parallel: smaller angles are rounding noise (each
// direction has a relative error of 6e-8).
constexpr double kParallelSine = 1e-6;

Vec3 unitOr(DVec3 v, const Vec3& substitute) { return normalize(v) ? toFloat(v) : substitute; }

struct DFrame {
    DVec3 tangent, bitangent, normal;
};

DFrame toDouble(const Frame& f) { return {toDouble(f.tangent), toDouble(f.bitangent), toDouble(f.normal)}; }

double determinant(const DFrame& f) { return dot(cross(f.tangent, f.bitangent), f.normal); }

/// Removes the component of v along `unit`; returns false if the rest is too short to be a direction.
bool reject(DVec3& v, const DVec3& unit) {
    const double before = length(v);
    const DVec3 rest = v - dot(v, unit) * unit;
    const double after = length(rest);
    if (!std::isfinite(before) || !(after > kParallelSine * before)) return false;
    v = (1 / after) * rest;
    return true;
}

DFrame orthonormal(const Frame& frame) {
    DFrame f = toDouble(frame);
    if (!normalize(f.normal)) f.normal = {0, 0, 1};
    if (!reject(f.tangent, f.normal)) f.tangent = planeAxes(f.normal).x;
    // In three dimensions, only one line is orthogonal to both N and T; B determines the direction along it.
    const DVec3 side = cross(f.normal, f.tangent);
    const double along = dot(f.bitangent, side);
    const bool backwards = std::isfinite(along) && along < -kParallelSine * length(f.bitangent);
    f.bitangent = backwards ? -1.0 * side : side;
    return f;
}

DVec3 combine(const DFrame& f, const DVec3& v) { return v.x * f.tangent + v.y * f.bitangent + v.z * f.normal; }

FaceFrame divided(const UvFrame& sums) {
    FaceFrame out;
    out.determinant = static_cast<float>(sums.determinant);
    if (!hasUvArea(sums.determinant) || out.determinant == 0 || !std::isfinite(out.determinant)) return out;
    const Vec3 tangent = toFloat((1 / sums.determinant) * sums.tangent);
    const Vec3 bitangent = toFloat((1 / sums.determinant) * sums.bitangent);
    if (!isFinite(tangent) || !isFinite(bitangent)) return out;
    out.tangent = tangent;
    out.bitangent = bitangent;
    return out;
}

float fraction(double x) {
    const float f = static_cast<float>(x - std::floor(x));
    // rounding can give exactly 1, which becomes 0; so do values that are not finite
    return f >= 0 && f < 1 ? f : 0.0f;
}

}  // namespace

FaceFrame faceFrame(const Vec3 positions[3], const Vec2 uvs[3]) {
    return divided(uvFrame(positions[0], positions[1], positions[2], uvs[0], uvs[1], uvs[2]));
}

FaceFrame faceFrameFromPath(const Vec3 positions[3], const Vec2 uvs[3]) {
    const DVec3 p1 = toDouble(positions[1]);
    return divided(uvFrame(p1 - toDouble(positions[0]), toDouble(positions[2]) - p1,
                           double{uvs[1].x} - double{uvs[0].x}, double{uvs[1].y} - double{uvs[0].y},
                           double{uvs[2].x} - double{uvs[1].x}, double{uvs[2].y} - double{uvs[1].y}));
}

float determinant(const Frame& frame) { return static_cast<float>(determinant(toDouble(frame))); }

float frameSign(const Frame& frame) { return determinant(toDouble(frame)) < 0 ? -1.0f : 1.0f; }

Vec3 rebuildBitangent(const Vec3& normal, const Vec4& tangent) { return tangent.w * cross(normal, xyz(tangent)); }

Frame orthonormalize(const Frame& frame) {
    const DFrame f = orthonormal(frame);
    return {toFloat(f.tangent), toFloat(f.bitangent), toFloat(f.normal)};
}

Vec4 packTangent(const Frame& frame) {
    const Vec3 t = toFloat(orthonormal(frame).tangent);
    return {t.x, t.y, t.z, frameSign(frame)};
}

Frame basisFromNormal(const Vec3& unit_normal) {
    const auto [tangent, bitangent] = planeAxes(toDouble(unit_normal));
    return {toFloat(tangent), toFloat(bitangent), unit_normal};
}

Mat3 tangentToObject(const Frame& f) {
    return {{{f.tangent.x, f.bitangent.x, f.normal.x},
             {f.tangent.y, f.bitangent.y, f.normal.y},
             {f.tangent.z, f.bitangent.z, f.normal.z}}};
}

Mat3 objectToTangentOrthonormal(const Frame& frame) { return {{frame.tangent, frame.bitangent, frame.normal}}; }

bool objectToTangent(const Frame& frame, Mat3& out) {
    const DFrame f = toDouble(frame);
    const double d = determinant(f);
    if (d == 0 || !std::isfinite(d)) return false;
    // Computes the inverse by Cramer's rule: its rows are cross products of two columns.
    const Mat3 inverse{{toFloat((1 / d) * cross(f.bitangent, f.normal)), toFloat((1 / d) * cross(f.normal, f.tangent)),
                        toFloat((1 / d) * cross(f.tangent, f.bitangent))}};
    for (const Vec3& row : inverse.rows) {
        if (!isFinite(row)) return false;
    }
    out = inverse;
    return true;
}

Vec3 transform(const Mat3& m, const Vec3& v) {
    const DVec3 d = toDouble(v);
    return toFloat(DVec3{dot(toDouble(m.rows[0]), d), dot(toDouble(m.rows[1]), d), dot(toDouble(m.rows[2]), d)});
}

Vec3 toTangentSpace(const Frame& frame, const Vec3& direction) {
    Mat3 inverse;
    return objectToTangent(frame, inverse) ? transform(inverse, direction) : Vec3{0, 0, 0};
}

Vec3 toObjectSpace(const Frame& frame, const Vec3& direction) {
    return toFloat(combine(toDouble(frame), toDouble(direction)));
}

Vec3 decodeNormal(const Vec3& texel, const TexelDecode& options) {
    const DVec3 c = toDouble(texel);
    const double y_sign = options.green == Green::down ? -1.0 : 1.0;
    return unitOr({(2 * c.x - 1) * options.scale, (2 * c.y - 1) * options.scale * y_sign, 2 * c.z - 1}, {0, 0, 1});
}

Vec2 tileUv(const Vec2& uv, const Vec2& tiling, const Vec2& offset) {
    return {fraction(double{uv.x} * tiling.x + offset.x), fraction(double{uv.y} * tiling.y + offset.y)};
}

float lambert(const Frame& frame, const Vec3& light_direction, const Vec3& tangent_space_normal) {
    const DFrame f = orthonormal(frame);
    const DVec3 light = toDouble(light_direction);
    DVec3 l{dot(f.tangent, light), dot(f.bitangent, light), dot(f.normal, light)};
    DVec3 n = toDouble(tangent_space_normal);
    if (!normalize(l) || !normalize(n)) return 0;
    const double cosine = dot(n, l);
    return cosine > 0 ? static_cast<float>(cosine) : 0.0f;
}

Vec3 objectNormal(const Frame& frame, const Vec3& tangent_space_normal) {
    const DFrame f = orthonormal(frame);
    return unitOr(combine(f, toDouble(tangent_space_normal)), toFloat(f.normal));
}

Vec3 objectNormalMikktspace(const Vec3& interpolated_normal, const Vec4& interpolated_tangent,
                            const Vec3& tangent_space_normal) {
    DFrame f{toDouble(xyz(interpolated_tangent)), {}, toDouble(interpolated_normal)};
    f.bitangent = double{interpolated_tangent.w} * cross(f.normal, f.tangent);
    return unitOr(combine(f, toDouble(tangent_space_normal)), unitOr(f.normal, {0, 0, 1}));
}

}  // namespace tspace
