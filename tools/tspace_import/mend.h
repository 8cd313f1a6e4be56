// SPDX-License-Identifier: MIT
// Numbers that other formats allow and glTF does not.
#pragma once

#include <assimp/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tspace::import {

/// Counts of repaired values.
struct Mended {
    std::size_t positions = 0, uvs = 0, normals = 0, tangents = 0, transforms = 0;
    std::size_t edges = 0, coarse_edges = 0;  ///< edges of triangles; see countCoarseEdges
    std::size_t coarse_places = 0;            ///< nodes whose translation floats hold less exactly than to a millimeter
    double worst_place = 0;                   ///< largest shift of a node by rounding to floats, in meters

    /// Whether so many edges are coarse that it shows: one in twenty, as for OBJ.
    [[nodiscard]] bool isCoarse() const { return coarse_edges != 0 && 20 * coarse_edges >= edges; }
    /// Human-readable description for isCoarse().
    [[nodiscard]] std::string coarseness() const;
    /// A sentence for each kind that occurred, but for coarse edges.
    [[nodiscard]] std::vector<std::string> warnings() const;
};

/// A number from 0 to 1; `otherwise` for one that is not finite.
double unitInterval(float value, double otherwise);

bool isFinite(const float* values, std::size_t count);

/// Puts 0 in place of every element of `components` floats that is not finite as a whole. Returns how many.
std::size_t zeroNotFinite(std::vector<float>& values, std::size_t components);

/// Makes normals unit. One that has no direction gets that of the first of the vertex's triangles that has an area, and
/// (0, 0, 1) where none has. Returns how many had none. `triangles`: three vertices each.
std::size_t mendNormals(std::vector<float>& normals, const std::vector<float>& positions,
                        const std::vector<std::uint32_t>& triangles);

/// Counts the edges of triangles, and among them those too far from the origin: rounding to floats, which Assimp reads all
/// numbers as, may change them by a five-hundredth of their length along an axis. All of them where none has a length, and the mesh is so far
/// away that they may have been rounded to it.
void countCoarseEdges(const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles, Mended& mended);

/// Counts a node whose translation is so large that rounding it to floats may move the node by a millimeter or more.
/// `meters`: one unit of the translation.
void countCoarsePlace(const aiMatrix4x4& matrix, double meters, Mended& mended);

/// Column by column, as glTF wants it; Assimp stores rows. The last row is exactly 0 0 0 1. The identity, counted,
/// where a number is not finite.
std::vector<float> columnsOf(const aiMatrix4x4& matrix, Mended& mended);

/// Unit; the identity where it has no direction.
aiQuaternion unitRotation(const aiQuaternion& rotation);

}  // namespace tspace::import
