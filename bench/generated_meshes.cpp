// SPDX-License-Identifier: MIT
// Regular meshes, generated from their number of triangles.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh.h"

namespace tspace::bench {

namespace {

/// Sine and cosine of a full turn divided into `steps`, and a ripple of `waves` periods with its derivative.
struct Turn {
    std::vector<double> sine, cosine, ripple, ripple_slope;

    Turn(std::uint32_t steps, double waves) {
        for (std::uint32_t i = 0; i <= steps; ++i) {
            // The last step has exactly the angle of the first one, so that the two vertices at a seam have the same
            // position.
            const double angle = 2 * std::numbers::pi * (i % steps) / steps;
            sine.push_back(std::sin(angle));
            cosine.push_back(std::cos(angle));
            ripple.push_back(std::sin(waves * angle));
            ripple_slope.push_back(waves * std::cos(waves * angle));
        }
    }
};

Vec3 toFloat(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

Vec3 unit(double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    return toFloat(x / length, y / length, z / length);
}

/// Returns u for each line between columns: it increases for `fold` columns, then decreases at three quarters of the
/// rate, and so on. The different rates make u differ on the two sides of the seam.
std::vector<float> foldedU(std::uint32_t columns, std::uint32_t fold) {
    std::vector<float> u = {0};
    double value = 0;
    for (std::uint32_t i = 0; i < columns; ++i) {
        value += (i / fold % 2 == 0 ? 1.0 : -0.75) / fold;
        u.push_back(static_cast<float>(value));
    }
    return u;
}

void addTorusVertices(Mesh& mesh, std::uint32_t columns, std::uint32_t rows, std::uint32_t fold) {
    constexpr double kMajor = 2, kMinor = 0.8, kHeight = 0.1;
    const Turn around(columns, 7), across(rows, 5);
    const std::vector<float> u = foldedU(columns, fold);
    for (std::uint32_t i = 0; i <= columns; ++i) {
        for (std::uint32_t j = 0; j <= rows; ++j) {
            const double su = around.sine[i], cu = around.cosine[i], sv = across.sine[j], cv = across.cosine[j];
            const double radius = kMinor + kHeight * around.ripple[i] * across.ripple[j];
            const double by_u = kHeight * around.ripple_slope[i] * across.ripple[j];
            const double by_v = kHeight * around.ripple[i] * across.ripple_slope[j];
            const double reach = kMajor + radius * cv;
            // The normal is the cross product of the derivatives of the position along u and v.
            const double ux = by_u * cv * cu - reach * su, uy = by_u * cv * su + reach * cu, uz = by_u * sv;
            const double slope = by_v * cv - radius * sv;
            const double vx = slope * cu, vy = slope * su, vz = by_v * sv + radius * cv;
            mesh.vertex(toFloat(reach * cu, reach * su, radius * sv),
                        unit(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx),
                        {u[i], 2 * static_cast<float>(j) / static_cast<float>(rows)});
        }
    }
}

/// Returns the number of rows with which a torus of twice as many columns has about `triangles` triangles.
std::uint32_t rowsFor(std::size_t triangles) {
    return std::max(1u, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4)));
}

}  // namespace

Mesh torus(std::uint32_t columns, std::uint32_t rows, std::uint32_t fold) {
    constexpr std::size_t kQuadsPerFlatUv = 200, kDegenerate = 8, kTrianglesPerDegenerate = 1000;
    Mesh mesh;
    addTorusVertices(mesh, columns, rows, fold);
    std::size_t quad = 0;
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j, ++quad) {
            const std::uint32_t a = i * (rows + 1) + j, b = a + rows + 1, c = b + 1, d = a + 1;
            mesh.triangle(a, b, c);
            const bool flat_uv = quad % kQuadsPerFlatUv == 0;
            mesh.triangle(a, flat_uv ? mesh.vertex(mesh.positions[c], mesh.normals[c], mesh.uvs[d]) : c, d);
        }
    }
    const std::size_t triangles = mesh.indices.size() / 3;
    const std::size_t degenerate = std::min(kDegenerate, triangles / kTrianglesPerDegenerate);
    for (std::size_t k = 0; k < degenerate; ++k) {
        const std::size_t t = (2 * k + 1) * triangles / (2 * degenerate);
        mesh.indices[3 * t + 1] = mesh.indices[3 * t];
    }
    return mesh;
}

Mesh torusOf(std::size_t triangles) {
    const std::uint32_t rows = rowsFor(triangles);
    return torus(2 * rows, rows, rows);
}

Mesh foldsOf(std::size_t triangles) {
    const std::uint32_t rows = rowsFor(triangles);
    return torus(2 * rows, rows, 10);
}

Mesh quadsOf(std::size_t triangles) {
    const std::uint32_t rows = rowsFor(triangles), columns = 2 * rows;
    Mesh mesh;
    addTorusVertices(mesh, columns, rows, rows);
    mesh.face_size = 4;
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t a = i * (rows + 1) + j, b = a + rows + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a + 1});
        }
    }
    return mesh;
}

Mesh sphereOf(std::size_t triangles) {
    const std::uint32_t rows = rowsFor(triangles) + 1, columns = 2 * (rows - 1);
    const Turn around(columns, 1), across(2 * rows, 1);
    Mesh mesh;
    for (std::uint32_t i = 0; i <= columns; ++i) {
        for (std::uint32_t j = 0; j <= rows; ++j) {
            const double ring = j % rows == 0 ? 0 : across.sine[j];
            const Vec3 p = toFloat(ring * around.cosine[i], ring * around.sine[i], -across.cosine[j]);
            mesh.vertex(p, p,
                        {static_cast<float>(i) / static_cast<float>(columns),
                         static_cast<float>(j) / static_cast<float>(rows)});
        }
    }
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t a = i * (rows + 1) + j, b = a + rows + 1, c = b + 1, d = a + 1;
            if (j != 0) mesh.triangle(a, b, c);
            if (j + 1 != rows) mesh.triangle(a, c, d);
        }
    }
    return mesh;
}

Mesh gridOf(std::size_t triangles) {
    const std::uint32_t rows = rowsFor(triangles), columns = 2 * rows;
    Mesh mesh;
    for (std::uint32_t i = 0; i <= columns; ++i) {
        for (std::uint32_t j = 0; j <= rows; ++j) {
            const double x = i, y = j;
            const double slope_x = 0.3 * std::cos(0.3 * x) * std::cos(0.2 * y);
            const double slope_y = -0.2 * std::sin(0.3 * x) * std::sin(0.2 * y);
            mesh.vertex(toFloat(x, y, std::sin(0.3 * x) * std::cos(0.2 * y)), unit(-slope_x, -slope_y, 1),
                        {static_cast<float>(i) / static_cast<float>(columns),
                         static_cast<float>(j) / static_cast<float>(rows)});
        }
    }
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t a = i * (rows + 1) + j, b = a + rows + 1, c = b + 1, d = a + 1;
            mesh.triangle(a, b, c);
            mesh.triangle(a, c, d);
        }
    }
    return mesh;
}

Mesh boxMesh() {
    Mesh mesh;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto at = [&](float u, float v) {
                float position[3], normal[3] = {};
                position[axis] = normal[axis] = side;
                position[(axis + 1) % 3] = side * (2 * u - 1);
                position[(axis + 2) % 3] = 2 * v - 1;
                return mesh.vertex({position[0], position[1], position[2]}, {normal[0], normal[1], normal[2]}, {u, v});
            };
            const std::uint32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
            mesh.triangle(a, b, c);
            mesh.triangle(a, c, d);
        }
    }
    return mesh;
}

}  // namespace tspace::bench
