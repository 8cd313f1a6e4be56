// SPDX-License-Identifier: MIT
// Meshes whose exact frames are known at every vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "random.h"
#include "surfaces.h"
#include "tspace/mesh.h"

namespace tspace::accuracy {

struct TestMesh {
    const Surface* surface = nullptr;  ///< null for bevels
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> indices;  ///< triangles
    // Arrays with one entry per vertex:
    std::vector<ExactFrame> frames;
    std::vector<double> s, t;
    std::vector<std::int8_t> sides;       ///< side of the fold (mirrored seam); vertices on it exist once per side
    std::vector<std::uint8_t> is_inside;  ///< neither on the border of the chart nor on the fold
    /// Triangles on which shading is measured: all, or those of the flat part of a bevel.
    std::vector<std::uint32_t> measured;

    [[nodiscard]] MeshView view() const {
        return {.positions = positions, .normals = normals, .uvs = uvs, .indices = {indices}};
    }
    [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
    [[nodiscard]] bool hasExactUvs() const { return surface != nullptr; }
};

enum class Tessellation {
    regular,      ///< all diagonals in the same direction
    alternating,  ///< diagonals alternate from cell to cell
    irregular,    ///< points moved by up to 0.36 of a cell, Delaunay diagonals
    random,       ///< points moved by up to 0.3 of a cell, random diagonals
    anisotropic,  ///< like irregular, with an eighth of the rows
    loops,        ///< every fourth row and column has a tenth of the others' width
};

const char* nameOf(Tessellation tessellation);

/// Returns a mesh of `cells` by `cells` cells with exact normals, rounded to float.
TestMesh tessellate(const Surface& surface, Tessellation tessellation, int cells, Random random);

/// A square face with rounded borders.
struct Bevel {
    double radius = 0.05;
    int strips = 1;                     ///< across the rounded part
    int flat_cells = 1;                 ///< along each side of the flat part
    int diagonal = 0;                   ///< 0 or 1: one of the two diagonals in all cells; 2: random
    double stretch = 1, shear_deg = 0;  ///< stretch and shear of the UV map across the rounded part
};

/// Returns the bevels over which the results are averaged.
std::vector<Bevel> bevels();
TestMesh bevelMesh(const Bevel& bevel, Random random);

}  // namespace tspace::accuracy
