// SPDX-License-Identifier: MIT
// The meshes that are measured. Every name makes the same mesh on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tspace/mesh.h"

namespace tspace::bench {

struct Mesh {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> indices = {};     ///< empty: unindexed corners
    std::vector<std::uint32_t> face_sizes = {};  ///< empty: all faces have face_size corners
    std::uint32_t face_size = 3;

    [[nodiscard]] MeshView view() const;
    [[nodiscard]] std::size_t cornerCount() const { return indices.empty() ? positions.size() : indices.size(); }
    /// Triangles after cutting each face as a fan.
    [[nodiscard]] std::size_t triangleCount() const;
    /// The faces cut as fans, for loops that know only indexed triangles.
    [[nodiscard]] Mesh triangulated() const;

    std::uint32_t vertex(const Vec3& position, const Vec3& normal, const Vec2& uv);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// A displaced torus of 2 * columns * rows triangles. Its UVs have seams in u and v, where vertices are
/// duplicated, and u turns round every `fold` columns, so every second band is mirrored and vertices between
/// bands split. One quad in 200 has a triangle without UV area. Up to 8 triangles (one for each 1000) have
/// two corners at one vertex.
Mesh torus(std::uint32_t columns, std::uint32_t rows, std::uint32_t fold);
/// About that many triangles, twice as many columns as rows, one half mirrored.
Mesh torusOf(std::size_t triangles);
/// A box with a chart for each side: 24 vertices, 12 triangles.
Mesh boxMesh();
/// A torus of about that many triangles that is mirrored every tenth column: 10 % of its vertices split.
Mesh foldsOf(std::size_t triangles);
/// A sphere in longitude and latitude, with one vertex for each column at the poles.
Mesh sphereOf(std::size_t triangles);
/// A wavy sheet without seams.
Mesh gridOf(std::size_t triangles);
/// torusOf(triangles), two triangles to a quad, so without those that are degenerate.
Mesh quadsOf(std::size_t triangles);

/// Each corner gets a vertex of its own.
Mesh unindexed(const Mesh& mesh);
/// Faces in random order; vertices keep theirs.
Mesh shuffled(Mesh mesh);
/// Triangles of an indexed mesh in one of triangleOrders(); vertices keep theirs.
Mesh inOrder(Mesh mesh, const std::string& order);
/// "reversed"; "two_sweep": each second triangle, then the others, as array code cuts quads; "vertex_cache": as tools order
/// triangles for the vertex cache of a GPU; "spatial": along a Morton curve; "shuffled", which takes any faces.
const std::vector<std::string>& triangleOrders();

/// One of the meshes that make careless implementations slow: a name of hardMeshNames().
Mesh hardMesh(const std::string& name, std::size_t triangles);
std::vector<std::string> hardMeshNames();

/// All triangles of a .glb, .gltf or .obj as one mesh. Polygons of OBJ files stay as they are. Without
/// triangles where the file cannot be read.
Mesh modelMesh(const std::string& path);
/// The triangle primitives with normals and UVs of all .glb and .gltf files in a folder and those below it, by path.
std::vector<Mesh> modelPrimitives(const std::string& folder);

}  // namespace tspace::bench
