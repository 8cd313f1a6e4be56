// SPDX-License-Identifier: MIT
// Repairs numbers that other formats allow and glTF does not.
#pragma once

#include <assimp/scene.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tspace::import {

/// Counts of repaired values.
struct RepairCounts {
    std::size_t positions = 0, uvs = 0, normals = 0, tangents = 0, transforms = 0;
    std::size_t edges = 0, coarse_edges = 0;  ///< edges of triangles; see countCoarseEdges
    /// Number of nodes whose translation floats represent less precisely than a millimeter.
    std::size_t coarse_places = 0;
    double worst_place = 0;  ///< largest shift of a node by rounding to floats, in meters

    /// Returns whether enough edges are coarse to be visible: one in twenty, as for OBJ.
    [[nodiscard]] bool isCoarse() const { return coarse_edges != 0 && 20 * coarse_edges >= edges; }
    /// Returns a description of the coarse edges for isCoarse().
    [[nodiscard]] std::string coarseness() const;
    /// Returns a sentence per kind of repair, except coarse edges.
    [[nodiscard]] std::vector<std::string> warnings() const;
};

/// Clamps a number to 0 to 1; returns `otherwise` if it is not finite.
double unitInterval(float value, double otherwise);

bool isFinite(const float* values, std::size_t count);

/// Replaces every element of `components` floats by zeros if any of them is not finite. Returns the number of replaced
/// elements.
std::size_t zeroNotFinite(std::vector<float>& values, std::size_t components);

/// Normalizes normals. A normal without direction becomes that of the first nondegenerate triangle of its vertex, or
/// (0, 0, 1) if there is none. Returns the number of normals without direction. `triangles`: three vertices each.
std::size_t repairNormals(std::vector<float>& normals, const std::vector<float>& positions,
                          const std::vector<std::uint32_t>& triangles);

/// Counts the edges of triangles, and the coarse ones among them: edges so far from the origin that rounding to floats
/// (Assimp reads all numbers as floats) may change them by more than 1/500 of their length along an axis. If all edges
/// have length zero, and the mesh is so far away that rounding may be the cause, all edges are counted as coarse.
void countCoarseEdges(const std::vector<float>& positions, const std::vector<std::uint32_t>& triangles,
                      RepairCounts& repairs);

/// Counts a node whose translation is so large that rounding to floats may move the node by a millimeter or more.
/// `meters`: meters per unit of the translation.
void countCoarsePlace(const aiMatrix4x4& matrix, double meters, RepairCounts& repairs);

/// Returns the matrix in column-major order, as in glTF (Assimp is row-major). The last row is exactly 0 0 0 1. Returns
/// the identity, and counts it, if a number is not finite.
std::vector<float> columnsOf(const aiMatrix4x4& matrix, RepairCounts& repairs);

/// Normalizes a rotation; returns the identity if it has no direction.
aiQuaternion unitRotation(const aiQuaternion& rotation);

}  // namespace tspace::import
