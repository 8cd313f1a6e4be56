// SPDX-License-Identifier: MIT
// Shading reference: converts a texel and the frames of a triangle to the normal that a renderer shades, and back.
// Computes in double precision, so that its rounding does not affect measured errors. See MapReading.
#pragma once

#include <array>
#include <cmath>

#include "core/base/vec_math.h"
#include "tspace/maps.h"

namespace tspace {

/// Stored frames of a triangle's three corners.
struct CornerFrames {
    std::array<Vec3, 3> normals = {};
    std::array<Vec4, 3> tangents = {};
};

/// T, B and N at a shaded point. They need not be unit vectors or orthogonal.
struct ShadingFrame {
    DVec3 tangent, bitangent, normal;
};

/// Interpolates the frame of a triangle at barycentric coordinates, whose sum must be 1. Points outside the triangle
/// are extrapolated.
ShadingFrame shadingFrame(const CornerFrames& corners, const std::array<double, 3>& weights, const MapReading& reading);

/// Decodes a texel, channels from 0 to 1, to a vector along T, B and N, with green, scale and the third channel
/// applied. The length is not changed.
DVec3 decodeTexel(const Vec3& texel, const MapReading& reading);
/// Returns the texel that decodes to the vector, approximately. Channels outside 0 to 1 are not clamped. With two
/// channels, z must not be negative, and the vector is normalized after x and y were divided by the scale.
DVec3 encodeTexel(const DVec3& vector, const MapReading& reading);

/// Converts a direction from mesh coordinates to the axes of a map (alongAxes), and back (fromAxes).
inline DVec3 alongAxes(const MapAxes& axes, const DVec3& direction) {
    return {dot(toDouble(axes.x), direction), dot(toDouble(axes.y), direction), dot(toDouble(axes.z), direction)};
}
inline DVec3 fromAxes(const MapAxes& axes, const DVec3& vector) {
    return vector.x * toDouble(axes.x) + vector.y * toDouble(axes.y) + vector.z * toDouble(axes.z);
}

/// Returns unit(x T + y B + z N), or zero if that vector has no direction.
DVec3 shadedNormal(const ShadingFrame& frame, const DVec3& vector);
/// Returns the unit vector (x, y, z) for which shadedNormal returns the direction. It uses the inverse of the frame,
/// not its transpose. Returns zero if the frame is singular or the direction is zero.
DVec3 vectorFor(const ShadingFrame& frame, const DVec3& direction);

/// Returns the angle between two vectors in degrees, which is accurate for small angles too. It is not finite if an
/// argument is not finite, and 0 if one is zero.
double degreesBetween(const DVec3& a, const DVec3& b);

}  // namespace tspace
