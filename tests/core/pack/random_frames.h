// SPDX-License-Identifier: MIT
// Frames for tests of packing. They are generated without functions of tspace.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tspace/span.h"

namespace tspace::test {

/// Random numbers that are the same on every machine.
class RandomBits {
  public:
    explicit RandomBits(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
        x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
        x = (x ^ x >> 27) * 0x94d049bb133111ebu;
        return x ^ x >> 31;
    }
    /// Returns a number in [-1, 1).
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
    /// Adds the frame that results when the axes are rotated by q.
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

/// Returns a uniformly distributed rotation: a quaternion sampled in the unit 4-ball by rejection, not normalized.
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
    for (std::size_t i = 0; i < count; ++i) {
        // The rotation is generated in a separate statement, so that its numbers come before the sign's with every
        // compiler.
        const Quaternion rotation = randomRotation(random);
        frames.add(rotation, (random.next() & 1) != 0 ? -1.0f : 1.0f);
    }
    return frames;
}

/// Returns the angle in degrees. It is accurate for angles of any size, unlike the arc cosine.
inline double angleDeg(const Vec3& a, const Vec3& b) {
    const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
    const double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    return std::atan2(std::sqrt(x * x + y * y + z * z), ax * bx + ay * by + az * bz) * 57.295779513082321;
}

}  // namespace tspace::test
