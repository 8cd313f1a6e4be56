// SPDX-License-Identifier: MIT
#include "bake_cases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/vec_math.h"
#include "test_mesh.h"

namespace tspace::bench {

namespace {

using accuracy::ExactFrame;
using accuracy::Surface;
using accuracy::TestMesh;

constexpr int kCells = 16;
constexpr double kMargin = 0.03;

struct Square {
    double x = 0, y = 0, size = 1;
};

/// Rotates (and optionally mirrors) the UVs of these corners, and fits them into a square with a margin.
void placeChart(std::vector<Vec2>& uvs, const std::vector<std::size_t>& corners, double degrees, bool mirrored,
                const Square& square) {
    const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
    std::vector<std::array<double, 2>> turned;
    std::array<double, 2> least{1e9, 1e9}, most{-1e9, -1e9};
    for (const std::size_t corner : corners) {
        const double u = mirrored ? -uvs[corner].x : uvs[corner].x, v = uvs[corner].y;
        turned.push_back({c * u - s * v, s * u + c * v});
        for (std::size_t i = 0; i < 2; ++i) {
            least[i] = std::min(least[i], turned.back()[i]);
            most[i] = std::max(most[i], turned.back()[i]);
        }
    }
    const double extent = std::max(most[0] - least[0], most[1] - least[1]);
    const double scale = square.size * (1 - 2 * kMargin) / extent;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        uvs[corners[i]] = {static_cast<float>(square.x + square.size * kMargin + scale * (turned[i][0] - least[0])),
                           static_cast<float>(square.y + square.size * kMargin + scale * (turned[i][1] - least[1]))};
    }
}

void placeCharts(const TestMesh& mesh, Charts charts, std::vector<Vec2>& uvs) {
    std::array<std::vector<std::size_t>, 4> quarters;
    for (std::size_t corner = 0; corner < uvs.size(); corner += 3) {
        double s = 0, t = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            s += mesh.s[mesh.indices[corner + i]] / 3;
            t += mesh.t[mesh.indices[corner + i]] / 3;
        }
        std::size_t chart = 0;
        if (charts == Charts::four) chart = (s < 0.5 ? 0 : 1) + (t < 0.5 ? 0 : 2);
        if (charts == Charts::mirrored) chart = s < 0.5 ? 0 : 1;
        for (std::size_t i = 0; i < 3; ++i) quarters[chart].push_back(corner + i);
    }
    if (charts == Charts::four) {
        placeChart(uvs, quarters[0], 0, false, {0, 0, 0.5});
        placeChart(uvs, quarters[1], 37, false, {0.5, 0, 0.5});
        placeChart(uvs, quarters[2], 90, false, {0, 0.5, 0.5});
        placeChart(uvs, quarters[3], 0, true, {0.5, 0.5, 0.5});
    } else if (charts == Charts::mirrored) {
        placeChart(uvs, quarters[0], 0, false, {});
        placeChart(uvs, quarters[1], 0, true, {});
    } else {
        placeChart(uvs, quarters[0], 0, false, {});
    }
}

/// Returns the height of the relief at a point. `size`: the size of the surface.
double lift(const DVec3& at, double size) {
    const double k = 2 * kPi * 11 / size;
    const DVec3 from = at - (0.2 * size) * DVec3{1, 0.3, -0.4};
    return size / (2 * kPi * 11) * 0.13 *
           (std::sin(k * (0.8 * at.x + 0.5 * at.y - 0.3 * at.z)) + std::cos(0.9 * k * length(from)));
}

DVec3 lifted(const Surface& surface, double s, double t, double size) {
    const ExactFrame frame = accuracy::exactFrame(surface, s, t, s < surface.fold ? -1 : 1);
    return size > 0 ? frame.position + lift(frame.position, size) * frame.normal : frame.position;
}

}  // namespace

LowMesh makeLow(const Surface& surface, Charts charts, Method method) {
    const TestMesh mesh = accuracy::tessellate(surface, accuracy::Tessellation::irregular, kCells, accuracy::Random{7});
    LowMesh low;
    for (const std::uint32_t vertex : mesh.indices) {
        low.positions.push_back(mesh.positions[vertex]);
        low.normals.push_back(mesh.normals[vertex]);
        low.uvs.push_back(mesh.uvs[vertex]);
    }
    placeCharts(mesh, charts, low.uvs);
    low.tangents.resize(low.positions.size());
    const MeshView view{.positions = low.positions, .normals = low.normals, .uvs = low.uvs};
    const Result<TangentReport> made =
        generateTangents(view, {.method = method, .convention = conventions::gltf}, {.tangents = low.tangents});
    if (!made) low.tangents.clear();
    return low;
}

HighMesh makeHigh(const Surface& surface, int cells, bool relief, int beyond) {
    HighMesh high;
    const auto side = static_cast<std::uint32_t>(cells + 2 * beyond + 1);
    const double size =
        relief
            ? length(accuracy::exactFrame(surface, 1, 1, 1).position - accuracy::exactFrame(surface, 0, 0, -1).position)
            : 0;
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const double s = (static_cast<double>(column) - beyond) / cells,
                         t = (static_cast<double>(row) - beyond) / cells;
            constexpr double kStep = 1e-5;
            high.positions.push_back(toFloat(lifted(surface, s, t, size)));
            const DVec3 ds = lifted(surface, s + kStep, t, size) - lifted(surface, s - kStep, t, size);
            const DVec3 dt = lifted(surface, s, t + kStep, size) - lifted(surface, s, t - kStep, size);
            DVec3 normal = cross(ds, dt);
            const DVec3 outside = accuracy::exactFrame(surface, s, t, s < surface.fold ? -1 : 1).normal;
            if (dot(normal, outside) < 0) normal = -1.0 * normal;
            high.normals.push_back(normalize(normal) ? toFloat(normal) : toFloat(outside));
        }
    }
    for (std::uint32_t row = 0; row + 1 < side; ++row) {
        for (std::uint32_t column = 0; column + 1 < side; ++column) {
            const std::uint32_t a = row * side + column, b = a + 1, c = a + side, d = c + 1;
            for (const std::uint32_t vertex : {a, b, d, a, d, c}) high.corners.push_back(vertex);
        }
    }
    // Makes all triangles counter-clockwise seen from outside, for either orientation of the parameters.
    for (std::size_t i = 0; i < high.corners.size(); i += 3) {
        const Vec3 &a = high.positions[high.corners[i]], &b = high.positions[high.corners[i + 1]],
                   &c = high.positions[high.corners[i + 2]];
        if (dot(cross(b - a, c - a), high.normals[high.corners[i]]) < 0)
            std::swap(high.corners[i + 1], high.corners[i + 2]);
    }
    return high;
}

}  // namespace tspace::bench
