// SPDX-License-Identifier: MIT
#include "maps/texels/shading.h"

#include <cstring>
#include <limits>

#include "core/base/vec_math.h"

namespace tspace {
namespace {

DVec3 mixed(const std::array<DVec3, 3>& of, const std::array<double, 3>& weights) {
    return weights[0] * of[0] + weights[1] * of[1] + weights[2] * of[2];
}

/// Returns the normalized vector. Zero and vectors that are not finite are returned unchanged.
DVec3 unitOrSame(DVec3 v) {
    normalize(v);
    return v;
}

}  // namespace

const MapReading* findMapReading(const char* name) {
    static constexpr MapReading kPlain{};
    static constexpr MapReading kDirectx{.green = Green::down};
    static constexpr MapReading kUnreal{.green = Green::down, .two_channels = true};
    static constexpr MapReading kUnity{.two_channels = true};
    static constexpr MapReading kThree{.bitangent = BitangentPlace::perVertex, .unit_vectors = true};
    static constexpr MapReading kGodot{
        .bitangent = BitangentPlace::perVertex, .unit_vectors = true, .two_channels = true};
    struct Named {
        const char* name;
        const MapReading* reading;
    };
    static constexpr Named kAll[] = {{"gltf", &kPlain},      {"opengl", &kPlain},  {"blender", &kPlain},
                                     {"directx", &kDirectx}, {"unreal", &kUnreal}, {"unity", &kUnity},
                                     {"godot", &kGodot},     {"three", &kThree}};
    if (name == nullptr) return nullptr;
    for (const Named& known : kAll) {
        if (std::strcmp(known.name, name) == 0) return known.reading;
    }
    return nullptr;
}

ShadingFrame shadingFrame(const CornerFrames& corners, const std::array<double, 3>& weights,
                          const MapReading& reading) {
    std::array<DVec3, 3> normals, tangents;
    double sign = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        normals[i] = toDouble(corners.normals[i]);
        tangents[i] = toDouble(xyz(corners.tangents[i]));
        sign += weights[i] * corners.tangents[i].w;
    }
    ShadingFrame frame{mixed(tangents, weights), {}, mixed(normals, weights)};
    if (reading.bitangent == BitangentPlace::perVertex) {
        for (std::size_t i = 0; i < 3; ++i)
            frame.bitangent = frame.bitangent + (weights[i] * corners.tangents[i].w) * cross(normals[i], tangents[i]);
    } else {
        if (reading.unit_vectors) {
            frame.normal = unitOrSame(frame.normal);
            frame.tangent = unitOrSame(frame.tangent);
        }
        frame.bitangent = sign * cross(frame.normal, frame.tangent);
    }
    if (reading.unit_vectors)
        frame = {unitOrSame(frame.tangent), unitOrSame(frame.bitangent), unitOrSame(frame.normal)};
    return frame;
}

DVec3 decodeTexel(const Vec3& texel, const MapReading& reading) {
    const double x = 2.0 * texel.x - 1, y = 2.0 * texel.y - 1;
    const double z = reading.two_channels ? std::sqrt(std::fmax(0.0, 1 - x * x - y * y)) : 2.0 * texel.z - 1;
    const double scale = reading.scale;
    return {scale * x, reading.green == Green::down ? -scale * y : scale * y, z};
}

DVec3 encodeTexel(const DVec3& vector, const MapReading& reading) {
    const double scale = reading.scale;
    DVec3 stored{vector.x / scale, (reading.green == Green::down ? -vector.y : vector.y) / scale, vector.z};
    if (reading.two_channels) {
        // The decoded z must be consistent with the scaled x and y.
        const double wanted = std::sqrt(stored.x * stored.x + stored.y * stored.y + stored.z * stored.z);
        if (wanted > 0) stored = (1 / wanted) * stored;
    }
    return {0.5 * (stored.x + 1), 0.5 * (stored.y + 1), 0.5 * (stored.z + 1)};
}

DVec3 shadedNormal(const ShadingFrame& frame, const DVec3& vector) {
    DVec3 sum = vector.x * frame.tangent + vector.y * frame.bitangent + vector.z * frame.normal;
    return normalize(sum) ? sum : DVec3{};
}

DVec3 vectorFor(const ShadingFrame& frame, const DVec3& direction) {
    // Rows of the inverse matrix, multiplied by the determinant, whose magnitude does not matter for a direction.
    const DVec3 row_x = cross(frame.bitangent, frame.normal);
    const double determinant = dot(row_x, frame.tangent);
    DVec3 vector{dot(row_x, direction), dot(cross(frame.normal, frame.tangent), direction),
                 dot(cross(frame.tangent, frame.bitangent), direction)};
    if (!(std::fabs(determinant) > 0) || !std::isfinite(determinant)) return {};
    if (determinant < 0) vector = -1.0 * vector;
    return normalizeOrdinary(vector) ? vector : DVec3{};
}

double degreesBetween(const DVec3& a, const DVec3& b) {
    const double x = dot(a, b), y = length(cross(a, b));
    if (!std::isfinite(x) || !std::isfinite(y)) return std::numeric_limits<double>::quiet_NaN();
    return polarAngle(x, y) * (180 / kPi);
}

}  // namespace tspace
