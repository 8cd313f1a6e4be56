// SPDX-License-Identifier: MIT
// Triangles of the crate: six sides of a rounded cube, unrolled as described in crate.h.
#include <array>
#include <cmath>

#include "crate.h"

namespace crate {
namespace {

using Vec = std::array<double, 3>;

/// A row or column of the grid on a side.
struct Line {
    double flat = 0;    ///< nearest coordinate on the flat part
    double lean = 0;    ///< -1 to 1: tilt of the normal; -1 and 1 are at the middle of the edges
    double offset = 0;  ///< distance from the center of the side on the unrolled surface
};

std::vector<Line> gridLines() {
    constexpr int kBevelCells = 4, kFlatCells = 4;
    constexpr double flat_half = kHalfEdge - kBevelRadius;
    std::vector<Line> lines;
    const auto bevel = [&](double side, int step) {
        const double lean = side * step / kBevelCells;
        lines.push_back({side * flat_half, lean, side * flat_half + lean * kBevelArc});
    };
    for (int i = kBevelCells; i > 0; --i) {
        bevel(-1, i);
    }
    for (int i = 0; i <= kFlatCells; ++i) {
        const double at = flat_half * (2.0 * i / kFlatCells - 1);
        lines.push_back({at, 0, at});
    }
    for (int i = 1; i <= kBevelCells; ++i) {
        bevel(1, i);
    }
    return lines;
}

/// A side and its directions in space: outward, along u (for x > 0), and along v.
struct Axes {
    Side side;
    Vec out, right, down;
};

void addVertex(Mesh& mesh, const Axes& axes, const Line& column, const Line& row) {
    Vec normal, position;
    for (int k = 0; k < 3; ++k) {
        normal[k] = axes.right[k] * column.lean + axes.down[k] * row.lean + axes.out[k];
    }
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; ++k) {
        normal[k] /= length;
        position[k] = axes.right[k] * column.flat + axes.down[k] * row.flat + axes.out[k] * (kHalfEdge - kBevelRadius) +
                      kBevelRadius * normal[k];
        mesh.positions.push_back(static_cast<float>(position[k]));
        mesh.normals.push_back(static_cast<float>(normal[k]));
    }
    const Place place = placeOf(axes.side);
    const double across = isMirrored(axes.side) ? std::abs(column.offset) : column.offset;
    mesh.uvs.push_back(static_cast<float>(place.u + kUvPerMeter * across));
    mesh.uvs.push_back(static_cast<float>(place.v + kUvPerMeter * row.offset));
}

/// Adds sides that are one above the other. They share the vertices of their common edge.
void addStrip(Mesh& mesh, const std::vector<Axes>& sides) {
    const std::vector<Line> lines = gridLines();
    const std::size_t columns = lines.size();
    const std::size_t first = mesh.positions.size() / 3;
    std::size_t rows = 0;
    for (const Axes& axes : sides) {
        for (std::size_t r = rows == 0 ? 0 : 1; r < lines.size(); ++r, ++rows) {
            for (const Line& column : lines) {
                addVertex(mesh, axes, column, lines[r]);
            }
        }
    }
    for (std::size_t r = 0; r + 1 < rows; ++r) {
        for (std::size_t c = 0; c + 1 < columns; ++c) {
            const std::size_t a = first + r * columns + c, b = a + columns;
            for (const std::size_t corner : {a, b, b + 1, a, b + 1, a + 1}) {
                mesh.indices.push_back(static_cast<std::uint16_t>(corner));
            }
        }
    }
}

}  // namespace

Mesh makeMesh() {
    // Axes: x right, y up, z towards the viewer. down = right x out, so that u, -v, out are right-handed for x > 0.
    constexpr Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, left{-1, 0, 0}, down{0, -1, 0}, away{0, 0, -1};
    Mesh mesh;
    addStrip(mesh, {{Side::top, y, x, z}, {Side::front, z, x, down}});
    addStrip(mesh, {{Side::under, down, x, away}, {Side::back, away, x, y}});
    addStrip(mesh, {{Side::right, x, away, down}});
    addStrip(mesh, {{Side::left, left, z, down}});
    return mesh;
}

}  // namespace crate
