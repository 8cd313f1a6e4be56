// SPDX-License-Identifier: MIT
// Meshes for tests: regular ones, and ones that make naive implementations slow or wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "support/simple_mesh.h"
#include "tspace/tangents.h"

namespace tspace::test {

inline constexpr Vec3 kUp{0, 0, 1};

/// Returns a wavy sheet of 2 * side * side triangles.
inline SimpleMesh grid(std::uint32_t side) {
    SimpleMesh shape;
    for (std::uint32_t y = 0; y <= side; ++y) {
        for (std::uint32_t x = 0; x <= side; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y), n = static_cast<float>(side);
            shape.addVertex({fx, fy, std::sin(fx * 0.3f) * std::cos(fy * 0.2f)}, kUp, {fx / n, fy / n});
        }
    }
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t a = y * (side + 1) + x, b = a + 1, c = b + side + 1, d = a + side + 1;
            shape.addTriangle(a, b, c);
            shape.addTriangle(a, c, d);
        }
    }
    return shape;
}

inline SimpleMesh gridOf(std::size_t triangles) {
    return grid(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2)));
}

inline void shuffleTriangles(SimpleMesh& shape, std::uint32_t seed) {
    std::mt19937 random(seed);
    for (std::size_t i = shape.indices.size() / 3; i-- > 1;) {
        const std::size_t j = random() % (i + 1);
        for (std::size_t k = 0; k < 3; ++k) std::swap(shape.indices[3 * i + k], shape.indices[3 * j + k]);
    }
}

/// Returns triangles that share one vertex. UVs are the positions, seen from above.
inline SimpleMesh fan(std::size_t triangles) {
    SimpleMesh shape;
    const std::uint32_t apex = shape.addVertex({0, 0, 0.5f}, kUp, {0.5f, 0.5f});
    for (std::size_t i = 0; i < triangles; ++i) {
        const double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(triangles);
        const auto x = static_cast<float>(std::cos(a)), y = static_cast<float>(std::sin(a));
        shape.addVertex({x, y, 0}, kUp, {0.5f + 0.5f * x, 0.5f + 0.5f * y});
    }
    for (std::size_t i = 0; i < triangles; ++i) {
        const auto n = static_cast<std::uint32_t>(triangles);
        shape.addTriangle(apex, 1 + static_cast<std::uint32_t>(i), 1 + (static_cast<std::uint32_t>(i) + 1) % n);
    }
    return shape;
}

/// Returns a fan whose rim is unrolled in UV space, so that the tangents at the apex point in all directions.
inline SimpleMesh unrolledFan(std::size_t triangles) {
    SimpleMesh shape = fan(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        shape.uvs[i + 1] = {static_cast<float>(i) / static_cast<float>(triangles), 0};
    }
    shape.uvs[0] = {0.5f, 1};
    shape.indices.resize(shape.indices.size() - 3);
    return shape;
}

/// Returns a cone with a separate UV per face at the apex, so that there are as many nodes at one position as faces.
inline SimpleMesh cone(std::size_t triangles) {
    SimpleMesh shape = fan(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        shape.indices[3 * i] =
            shape.addVertex({0, 0, 0.5f}, kUp, {static_cast<float>(i) / static_cast<float>(triangles), 1});
    }
    return shape;
}

/// Returns triangles whose corners are all at one position, with separate UVs.
inline SimpleMesh collapsed(std::size_t triangles) {
    SimpleMesh shape;
    for (std::size_t i = 0; i < triangles; ++i) {
        const float u = static_cast<float>(i);
        const std::uint32_t a = shape.addVertex({1, 2, 3}, kUp, {u, 0});
        shape.addVertex({1, 2, 3}, kUp, {u, 1});
        shape.addVertex({1, 2, 3}, kUp, {u + 1, 0});
        shape.addTriangle(a, a + 1, a + 2);
    }
    return shape;
}

/// Returns triangles that share one edge. `mixed`: every second triangle traverses the edge in the opposite direction.
inline SimpleMesh book(std::size_t pages, bool mixed) {
    SimpleMesh shape;
    const std::uint32_t a = shape.addVertex({0, 0, 0}, {0, 1, 0}, {0, 0}),
                        b = shape.addVertex({0, 0, 1}, {0, 1, 0}, {0, 1});
    for (std::size_t i = 0; i < pages; ++i) {
        const double angle = 1.5 * static_cast<double>(i) / static_cast<double>(pages);
        const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
        const std::uint32_t c = shape.addVertex({x, y, 0.5f}, {0, 1, 0}, {1, 0.5f});
        if (mixed && i % 2 == 1) {
            shape.addTriangle(b, a, c);
        } else {
            shape.addTriangle(a, b, c);
        }
    }
    return shape;
}

/// Returns a sheet in which every triangle has separate vertices, with equal positions but different normals.
inline SimpleMesh duplicatesWithOtherNormals(std::size_t triangles) {
    SimpleMesh shape;
    for (std::size_t i = 0; i < triangles; ++i) {
        const double tilt = static_cast<double>(i) * 1e-5;
        const Vec3 n{static_cast<float>(std::sin(tilt)), 0, static_cast<float>(std::cos(tilt))};
        const std::uint32_t a = shape.addVertex({0, 0, 0}, n, {0, 0});
        shape.addVertex({1, 0, 0}, n, {1, 0});
        shape.addVertex({0, 1, 0}, n, {0, 1});
        shape.addTriangle(a, a + 1, a + 2);
    }
    return shape;
}

/// Returns a grid in which every hundredth triangle has two corners at one position.
inline SimpleMesh someDegenerate(std::size_t triangles) {
    SimpleMesh shape = gridOf(triangles);
    for (std::size_t t = 50; t < shape.indices.size() / 3; t += 100) shape.indices[3 * t + 1] = shape.indices[3 * t];
    return shape;
}

/// Returns a grid whose adjacent squares have UVs of opposite orientation.
inline SimpleMesh checkerboard(std::size_t triangles) {
    SimpleMesh shape = gridOf(triangles);
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(shape.positions.size())));
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            shape.uvs[y * side + x] = {static_cast<float>(x % 2), static_cast<float>(y % 2)};
        }
    }
    return shape;
}

/// Returns a sheet with scattered NaN and infinities.
inline SimpleMesh notFinite(std::size_t triangles) {
    SimpleMesh shape = gridOf(triangles);
    for (std::size_t v = 7; v < shape.positions.size(); v += 97) {
        shape.positions[v].y = std::numeric_limits<float>::quiet_NaN();
        if (v + 3 < shape.positions.size()) shape.uvs[v + 3].x = std::numeric_limits<float>::infinity();
    }
    return shape;
}

/// Returns a grid with some triangles whose UVs are all equal.
inline SimpleMesh someWithoutUvArea(std::size_t triangles) {
    SimpleMesh shape = gridOf(triangles);
    for (std::size_t v = 0; v < shape.uvs.size(); ++v) {
        if (v / 16 % 2 == 0) shape.uvs[v] = {0.5f, 0.5f};
    }
    return shape;
}

/// Returns triangles in an order that makes the fixed-seed quicksort of the reference choose the smallest key as pivot
/// repeatedly. The first 2048 faces are degenerate and assign number 3i to vertex i; the key of an edge is the smaller
/// number of its ends. Keys are assigned lazily while simulating the sort, when a pivot hits them.
inline SimpleMesh sortKiller(std::size_t triangles) {
    constexpr std::uint32_t kVertices = 2048, kHigh = 2000, kRounds = 100;
    SimpleMesh shape;
    for (std::uint32_t i = 0; i < kVertices; ++i) {
        const auto x = static_cast<float>(i);
        shape.addVertex({x, 0, 0}, kUp, {x, static_cast<float>(i * i % 97)});
        shape.addTriangle(i, i, i);
    }
    std::mt19937 random(1);
    std::vector<std::uint32_t> corners(3 * triangles);
    // At first all corners are high, so any of them may be made low later.
    for (std::size_t t = 0; t < triangles; ++t) {
        const std::uint32_t a = random() % 48, b = a + 1 + random() % 23, c = b + 24;
        corners[3 * t] = kHigh + a;
        corners[3 * t + 1] = kHigh + (t % 2 == 0 ? b : c) % 48;
        corners[3 * t + 2] = kHigh + (t % 2 == 0 ? c : b) % 48;
    }
    const auto key = [&](std::uint32_t edge) {
        return std::min(corners[edge], corners[edge % 3 == 2 ? edge - 2 : edge + 1]);
    };
    std::vector<std::uint32_t> edges(3 * triangles);
    for (std::uint32_t e = 0; e < edges.size(); ++e) edges[e] = e;
    std::size_t begin = 0;
    std::uint32_t seed = 39871946;
    for (std::uint32_t round = 0; round < kRounds; ++round) {
        seed = seed + (seed << (seed & 31) | seed >> ((32 - (seed & 31)) & 31)) + 3;
        const std::uint32_t pivot_edge = edges[begin + seed % (edges.size() - begin)];
        if (key(pivot_edge) >= kHigh) corners[pivot_edge] = round;
        const std::uint32_t pivot = key(pivot_edge);
        std::int64_t i = static_cast<std::int64_t>(begin), j = static_cast<std::int64_t>(edges.size()) - 1;
        do {
            while (key(edges[static_cast<std::size_t>(i)]) < pivot) ++i;
            while (key(edges[static_cast<std::size_t>(j)]) > pivot) --j;
            if (i <= j) std::swap(edges[static_cast<std::size_t>(i++)], edges[static_cast<std::size_t>(j--)]);
        } while (i <= j);
        begin = static_cast<std::size_t>(i);
    }
    for (std::size_t t = 0; t < triangles; ++t)
        shape.addTriangle(corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]);
    return shape;
}

struct Outputs {
    std::vector<Vec4> tangents;
    std::vector<Vec3> bitangents;
    std::vector<float> magnitudes_s, magnitudes_t;
    TangentReport report;

    explicit Outputs(std::size_t corners)
        : tangents(corners, Vec4{9, 9, 9, 9}), bitangents(corners, Vec3{9, 9, 9}), magnitudes_s(corners, 9.0f),
          magnitudes_t(corners, 9.0f) {}
    [[nodiscard]] TangentOutput view() { return {tangents, bitangents, magnitudes_s, magnitudes_t}; }
};

/// Returns a torus of `columns` times `rows` cells; its positions are computed without the C library, so that they are
/// the same on all machines. If `closed`, the first and last rows share vertices; otherwise the mesh has UV seams.
inline SimpleMesh torus(std::uint32_t columns, std::uint32_t rows, bool closed) {
    const auto circle = [](std::uint32_t i, std::uint32_t count, float& x, float& y) {
        // The circle consists of four quarters, each of which is ((1 - t t), 2 t) / (1 + t t) for t from 0 to 1.
        const std::uint32_t step = 4 * (i % count), quarter = step / count;
        const float t = static_cast<float>(step % count) / static_cast<float>(count), n = 1 / (1 + t * t);
        const float a = (1 - t * t) * n, b = 2 * t * n;
        x = quarter == 0 ? a : quarter == 1 ? -b : quarter == 2 ? -a : b;
        y = quarter == 0 ? b : quarter == 1 ? a : quarter == 2 ? -b : -a;
    };
    SimpleMesh shape;
    const std::uint32_t more = closed ? 0 : 1;
    for (std::uint32_t i = 0; i < columns + more; ++i) {
        for (std::uint32_t j = 0; j < rows + more; ++j) {
            float x = 0, y = 0, reach = 0, height = 0;
            circle(i, columns, x, y);
            circle(j, rows, reach, height);
            const float ripple = static_cast<float>((7 * i + 3 * j) % 11) / 64;
            const float u = static_cast<float>(i) + ripple, v = static_cast<float>(j) - ripple;
            shape.addVertex({(2 + 0.75f * reach) * x, (2 + 0.75f * reach) * y, 0.75f * height + ripple},
                            {reach * x, reach * y, height}, {closed ? u * u : u, v});
        }
    }
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t row = rows + more, i2 = (i + 1) % (columns + more), j2 = (j + 1) % (rows + more);
            const std::uint32_t a = i * row + j, b = i2 * row + j, c = i2 * row + j2, d = i * row + j2;
            shape.addTriangle(a, b, c);
            shape.addTriangle(a, c, d);
        }
    }
    return shape;
}

}  // namespace tspace::test
