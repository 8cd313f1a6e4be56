// SPDX-License-Identifier: MIT
// Measured meshes. Every name gives the same mesh on every machine.
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
    /// Returns the number of triangles after fan triangulation of each face.
    [[nodiscard]] std::size_t triangleCount() const;
    /// Returns the mesh with fan-triangulated faces, for loops that support only indexed triangles.
    [[nodiscard]] Mesh triangulated() const;

    std::uint32_t vertex(const Vec3& position, const Vec3& normal, const Vec2& uv);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// Returns a displaced torus of 2 * columns * rows triangles. Its UVs have seams in u and v, where vertices are
/// duplicated, and u reverses every `fold` columns, so every second band is mirrored and vertices between bands split.
/// One quad in 200 has a triangle without UV area. Up to 8 triangles (one for each 1000) have two corners at one
/// vertex.
Mesh torus(std::uint32_t columns, std::uint32_t rows, std::uint32_t fold);
/// Returns a torus of about that many triangles, with twice as many columns as rows, and one half mirrored.
Mesh torusOf(std::size_t triangles);
/// Returns a box with a chart for each side: 24 vertices, 12 triangles.
Mesh boxMesh();
/// Returns a torus of about that many triangles that is mirrored every tenth column: 10 % of its vertices split.
Mesh foldsOf(std::size_t triangles);
/// Returns a UV sphere, with one vertex per column at each pole.
Mesh sphereOf(std::size_t triangles);
/// Returns a wavy sheet without seams.
Mesh gridOf(std::size_t triangles);
/// Returns torusOf(triangles) with two triangles combined to a quad, without degenerate ones.
Mesh quadsOf(std::size_t triangles);

/// Gives each corner its own vertex.
Mesh unindexed(const Mesh& mesh);
/// Puts faces in random order; vertices keep their order.
Mesh shuffled(Mesh mesh);
/// Puts the triangles of an indexed mesh in one of triangleOrders(); vertices keep their order.
Mesh inOrder(Mesh mesh, const std::string& order);
/// "reversed"; "two_sweep": each second triangle, then the others, as array code cuts quads; "vertex_cache": as tools
/// order triangles for the vertex cache of a GPU; "spatial": along a Morton curve; "shuffled", which supports any
/// faces.
const std::vector<std::string>& triangleOrders();

/// Returns one of the meshes that make naive implementations slow: a name of hardMeshNames().
Mesh hardMesh(const std::string& name, std::size_t triangles);
std::vector<std::string> hardMeshNames();

/// Returns all triangles of a .glb, .gltf or .obj as one mesh. Polygons of OBJ files are kept. Without triangles if the
/// file cannot be read.
Mesh modelMesh(const std::string& path);
/// Returns the triangle primitives with normals and UVs of all .glb and .gltf files in a folder and its subfolders, by
/// path.
std::vector<Mesh> modelPrimitives(const std::string& folder);

}  // namespace tspace::bench
