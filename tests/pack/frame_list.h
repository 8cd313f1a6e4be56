// SPDX-License-Identifier: MIT
// Frames to pack, made without tspace: random ones, and what packing did to them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "tspace/pack.h"

namespace tspace::test {

inline constexpr FrameFormat kAllFormats[] = {
    FrameFormat::frame32,      FrameFormat::frame48,     FrameFormat::frame64,
    FrameFormat::oct32,        FrameFormat::qtangent64,  FrameFormat::snorm8_pair,
    FrameFormat::snorm16_pair, FrameFormat::gltf_snorm8, FrameFormat::gltf_snorm16};
/// Those that promise to find each unpacked frame again.
inline constexpr FrameFormat kExactFormats[] = {FrameFormat::frame32, FrameFormat::frame48, FrameFormat::frame64,
                                                FrameFormat::oct32};

inline std::string nameOf(FrameFormat format) {
    static const char* const kNames[] = {"frame32",     "frame48",      "frame64",     "oct32",       "qtangent64",
                                         "snorm8_pair", "snorm16_pair", "gltf_snorm8", "gltf_snorm16"};
    return kNames[static_cast<std::size_t>(format)];
}

/// How many frames a test looks at: `otherwise`, unless the environment says.
inline long frameCount(long otherwise) {
    const char* text = std::getenv("TSPACE_FRAMES");
    return text != nullptr ? std::atol(text) : otherwise;
}

/// The same numbers on every machine.
class RandomBits {
  public:
    explicit RandomBits(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
        x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
        x = (x ^ x >> 27) * 0x94d049bb133111ebu;
        return x ^ x >> 31;
    }
    /// In [-1, 1).
    double number() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1; }

  private:
    std::uint64_t state_;
};

struct Quaternion {
    double x = 0, y = 0, z = 0, w = 1;
};

inline Quaternion unit(const Quaternion& q) {
    const double scale = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

struct FrameList {
    std::vector<Vec3> normals = {};
    std::vector<Vec4> tangents = {};

    [[nodiscard]] std::size_t size() const { return normals.size(); }
    void add(const Vec3& n, const Vec4& t) {
        normals.push_back(n);
        tangents.push_back(t);
    }
    /// The frame that a rotation of the axes gives.
    void add(Quaternion q, float sign) {
        const double scale = 2 / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
        const auto f = [](double x) { return static_cast<float>(x); };
        add({f(scale * (q.x * q.z + q.w * q.y)), f(scale * (q.y * q.z - q.w * q.x)),
             f(1 - scale * (q.x * q.x + q.y * q.y))},
            {f(1 - scale * (q.y * q.y + q.z * q.z)), f(scale * (q.x * q.y + q.w * q.z)),
             f(scale * (q.x * q.z - q.w * q.y)), sign});
    }
    void resize(std::size_t count) {
        normals.resize(count);
        tangents.resize(count);
    }
};

/// Evenly spread over all rotations: points in the ball of four dimensions.
inline Quaternion randomRotation(RandomBits& random) {
    for (;;) {
        const Quaternion q{random.number(), random.number(), random.number(), random.number()};
        const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
        if (square > 0.01 && square <= 1) return q;
    }
}

inline FrameList randomFrames(RandomBits& random, std::size_t count) {
    FrameList frames;
    frames.normals.reserve(count);
    frames.tangents.reserve(count);
    for (std::size_t i = 0; i < count; ++i) frames.add(randomRotation(random), (random.next() & 1) != 0 ? -1.0f : 1.0f);
    return frames;
}

inline std::vector<std::byte> packed(FrameFormat format, const FrameList& frames) {
    std::vector<std::byte> bytes(frames.size() * frameBytes(format));
    EXPECT_TRUE(packFrames(format, frames.normals, frames.tangents, bytes));
    return bytes;
}

inline FrameList unpacked(FrameFormat format, const std::vector<std::byte>& bytes) {
    FrameList frames;
    frames.resize(bytes.size() / frameBytes(format));
    EXPECT_TRUE(unpackFrames(format, bytes, frames.normals, frames.tangents));
    return frames;
}

/// Exact for angles of any size, unlike the arc cosine.
inline double angleDeg(const Vec3& a, const Vec3& b) {
    const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
    const double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    return std::atan2(std::sqrt(x * x + y * y + z * z), ax * bx + ay * by + az * bz) * 57.295779513082321;
}

struct PackErrors {
    double normal_deg = 0, tangent_deg = 0;  ///< the worst of all frames
    double normal_sum = 0, tangent_sum = 0;
    std::uint64_t wrong_signs = 0;

    void add(const FrameList& before, const FrameList& after) {
        for (std::size_t i = 0; i < before.size(); ++i) {
            const double n = angleDeg(before.normals[i], after.normals[i]);
            const double t = angleDeg(xyz(before.tangents[i]), xyz(after.tangents[i]));
            normal_deg = std::max(normal_deg, n);
            tangent_deg = std::max(tangent_deg, t);
            normal_sum += n;
            tangent_sum += t;
            if (before.tangents[i].w != after.tangents[i].w) ++wrong_signs;
        }
    }
};

inline PackErrors errorsOf(FrameFormat format, const FrameList& frames) {
    PackErrors errors;
    errors.add(frames, unpacked(format, packed(format, frames)));
    return errors;
}

inline void expectWithinBounds(FrameFormat format, const PackErrors& errors) {
    const FrameErrorBound bound = frameErrorBound(format);
    EXPECT_LE(errors.normal_deg, bound.normal_deg) << nameOf(format);
    EXPECT_LE(errors.tangent_deg, bound.tangent_deg) << nameOf(format);
    EXPECT_EQ(errors.wrong_signs, 0) << nameOf(format);
}

}  // namespace tspace::test
