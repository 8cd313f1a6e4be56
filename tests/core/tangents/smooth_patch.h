// SPDX-License-Identifier: MIT
// Patches with known derivatives, and other small shapes for tests of the estimators.
#pragma once

#include <functional>

#include "core/tangents/shapes.h"

namespace tspace::test {

struct PatchPoint {
    double x, y, z;
};

struct SmoothPatch {
    SimpleMesh shape;
    std::vector<Vec3> tangents;  ///< one per vertex: unit vector along dP/du
    std::vector<bool> inside;    ///< one per vertex: not at the border
};

/// Returns an irregular mesh of a surface over [0, 1]^2, with `side` x `side` cells. Inner points are moved by up to a
/// quarter of a cell, and diagonals are random.
inline SmoothPatch smoothPatch(const std::function<PatchPoint(double, double)>& surface, std::uint32_t side,
                               std::uint32_t seed) {
    SmoothPatch patch;
    std::mt19937 random(seed);
    const auto jitter = [&] { return (static_cast<double>(random() % 1000) / 999 - 0.5) * 0.5; };
    for (std::uint32_t y = 0; y <= side; ++y) {
        for (std::uint32_t x = 0; x <= side; ++x) {
            const bool inside = x > 0 && y > 0 && x < side && y < side;
            const double dx = inside ? jitter() : 0, dy = inside ? jitter() : 0;
            const Vec2 uv{static_cast<float>((x + dx) / side), static_cast<float>((y + dy) / side)};
            const double u = uv.x, v = uv.y, h = 1e-4;
            const auto slope = [&](double du, double dv) {
                const PatchPoint a = surface(u - du, v - dv), b = surface(u + du, v + dv);
                return PatchPoint{(b.x - a.x) / (2 * h), (b.y - a.y) / (2 * h), (b.z - a.z) / (2 * h)};
            };
            const PatchPoint p = surface(u, v), s = slope(h, 0), t = slope(0, h);
            const PatchPoint n{s.y * t.z - s.z * t.y, s.z * t.x - s.x * t.z, s.x * t.y - s.y * t.x};
            const double n_length = std::hypot(n.x, n.y, n.z), s_length = std::hypot(s.x, s.y, s.z);
            const auto vec = [](const PatchPoint& q, double length) {
                return Vec3{float(q.x / length), float(q.y / length), float(q.z / length)};
            };
            patch.shape.addVertex(vec(p, 1), vec(n, n_length), uv);
            patch.tangents.push_back(vec(s, s_length));
            patch.inside.push_back(inside);
        }
    }
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = y * (side + 1) + x, b = a + 1, c = b + side, d = c + 1;
            const bool other = random() % 2 != 0;
            patch.shape.addTriangle(a, b, other ? c : d);
            patch.shape.addTriangle(other ? b : a, d, c);
        }
    }
    return patch;
}

/// Returns triangles around vertex 0, which is their first corner. The surface is curved, and normals and UVs are
/// unrelated to it.
inline SimpleMesh bumpyRing(std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto noise = [&] { return static_cast<float>(random() % 1000) / 999 - 0.5f; };
    const auto normal = [&] {
        const Vec3 n{0.3f * noise(), 0.3f * noise(), 1};
        const float length = std::hypot(n.x, n.y, n.z);
        return Vec3{n.x / length, n.y / length, n.z / length};
    };
    SimpleMesh shape;
    shape.addVertex({0.1f, 0.2f, 0.3f}, normal(), {0.4f, 0.3f});
    for (std::uint32_t i = 0; i < count; ++i) {
        const float angle = 6.2831853f * (static_cast<float>(i) + 0.5f * noise()) / static_cast<float>(count);
        const float r = 1 + 0.6f * noise(), x = r * std::cos(angle), y = r * std::sin(angle);
        shape.addVertex({x + 0.1f, y + 0.2f, 0.3f + 0.2f * noise()}, normal(),
                        {0.4f + 0.2f * x + 0.05f * y + 0.03f * noise(), 0.3f + 0.25f * y + 0.03f * noise()});
    }
    for (std::uint32_t i = 0; i < count; ++i) shape.addTriangle(0, 1 + i, 1 + (i + 1) % count);
    return shape;
}

/// Returns a flat square (the first two triangles) with a rounded border of this radius on two sides. The UVs of the
/// border are sheared.
inline SimpleMesh shearedBevel(float radius) {
    SimpleMesh shape;
    const float edges[3] = {-1, 1, 1 + radius};
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            const bool right = x == 2, top = y == 2;
            const float low = right || top ? -radius : 0;
            const float tilt = right != top ? 1.0f : 0.70710678f;
            const Vec3 n = right || top ? Vec3{right ? tilt : 0.0f, top ? tilt : 0.0f, 0} : kUp;
            const Vec2 uv{edges[x] + (top && !right ? 3 * radius : 0.0f),
                          edges[y] + (right && !top ? 3 * radius : 0.0f)};
            shape.addVertex({edges[x], edges[y], low}, n, uv);
        }
    }
    for (const std::uint32_t a : {0u, 1u, 3u}) {
        shape.addTriangle(a, a + 1, a + 4);
        shape.addTriangle(a, a + 4, a + 3);
    }
    return shape;
}

}  // namespace tspace::test
