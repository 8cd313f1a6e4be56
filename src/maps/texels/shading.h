// SPDX-License-Identifier: MIT
// The shading reference: from a texel and the frames of a triangle to the normal that a renderer shades, and back. In
// double, so that measured errors are not its own rounding. See MapReading.
#pragma once

#include <array>
#include <cmath>

#include "core/base/vec_math.h"
#include "tspace/maps.h"

namespace tspace {

/// The stored frames of a triangle's three corners.
struct CornerFrames {
    std::array<Vec3, 3> normals = {};
    std::array<Vec4, 3> tangents = {};
};

/// T, B and N where a texel is applied: neither unit nor at right angles.
struct ShadingFrame {
    DVec3 tangent, bitangent, normal;
};

/// At the point with these barycentric coordinates (their sum is 1; a point outside of the triangle goes on as its plane
/// does).
ShadingFrame shadingFrame(const CornerFrames& corners, const std::array<double, 3>& weights, const MapReading& reading);

/// Decodes a texel, channels from 0 to 1, to a vector along T, B and N, with green, scale and the third channel
/// applied. The length is not changed.
DVec3 decodeTexel(const Vec3& texel, const MapReading& reading);
/// The texel that is decoded to the vector, or nearly: channels beyond 0 to 1 are not clamped. With two channels the vector
/// is made unit, and its z must not be negative.
DVec3 encodeTexel(const DVec3& vector, const MapReading& reading);

/// A direction in the coordinates of the meshes along the axes of a map, and back.
inline DVec3 alongAxes(const MapAxes& axes, const DVec3& direction) {
    return {dot(toDouble(axes.x), direction), dot(toDouble(axes.y), direction), dot(toDouble(axes.z), direction)};
}
inline DVec3 fromAxes(const MapAxes& axes, const DVec3& vector) {
    return vector.x * toDouble(axes.x) + vector.y * toDouble(axes.y) + vector.z * toDouble(axes.z);
}

/// unit(x T + y B + z N); zero where that has no direction.
DVec3 shadedNormal(const ShadingFrame& frame, const DVec3& vector);
/// The unit vector (x, y, z) for which shadedNormal gives the direction: the inverse of the frame, whatever it is, and not
/// its transpose. Zero where the frame is singular or the direction has none.
DVec3 vectorFor(const ShadingFrame& frame, const DVec3& direction);

/// In degrees, exact for small angles too. Not finite where one of them is; 0 where one is zero.
double degreesBetween(const DVec3& a, const DVec3& b);

}  // namespace tspace
