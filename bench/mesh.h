// SPDX-License-Identifier: MIT
// Meshes that are measured. Every name gives the same mesh on every machine.
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
/// duplicated. The direction of u reverses every `fold` columns, so every second band is mirrored, and vertices between
/// bands are split. One quad in 200 has a triangle without UV area. Up to 8 triangles (at most one per 1000) have two
/// corners at one vertex.
Mesh torus(std::uint32_t columns, std::uint32_t rows, std::uint32_t fold);
/// Returns a torus of about `triangles` triangles, with twice as many columns as rows, and one half mirrored.
Mesh torusOf(std::size_t triangles);
/// Returns a box with one chart per face: 24 vertices, 12 triangles.
Mesh boxMesh();
/// Returns a torus of about `triangles` triangles whose u reverses every tenth column, so 10 % of its vertices are
/// split.
Mesh foldsOf(std::size_t triangles);
/// Returns a UV sphere. Each pole consists of one vertex per column.
Mesh sphereOf(std::size_t triangles);
/// Returns a wavy sheet without seams.
Mesh gridOf(std::size_t triangles);
/// Returns torusOf(triangles) with each pair of triangles combined into a quad, and without degenerate triangles.
Mesh quadsOf(std::size_t triangles);

/// Returns the mesh with a vertex of its own for each corner.
Mesh unindexed(const Mesh& mesh);
/// Returns the mesh with its faces in random order; the order of vertices is kept.
Mesh shuffled(Mesh mesh);
/// Returns an indexed mesh with its triangles in one of triangleOrders(); the order of vertices is kept.
Mesh inOrder(Mesh mesh, const std::string& order);
/// Returns the names of the orders. "reversed"; "two_sweep": first every second triangle, then the others, as array
/// code cuts quads; "vertex_cache": optimized for the vertex cache of a GPU; "spatial": along a Morton curve;
/// "shuffled": random (the only order that supports faces of any size).
const std::vector<std::string>& triangleOrders();

/// Returns a mesh that makes naive implementations slow. `name`: one of hardMeshNames().
Mesh hardMesh(const std::string& name, std::size_t triangles);
std::vector<std::string> hardMeshNames();

/// Returns all triangles of a .glb, .gltf or .obj file as one mesh; polygons of OBJ files are kept. Returns a mesh
/// without triangles if the file cannot be read.
Mesh modelMesh(const std::string& path);
/// Returns the triangle primitives with normals and UVs of all .glb and .gltf files in a folder and its subfolders, in
/// the order of their paths.
std::vector<Mesh> modelPrimitives(const std::string& folder);

}  // namespace tspace::bench
