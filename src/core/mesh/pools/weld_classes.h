// SPDX-License-Identifier: MIT
// Vertices that are one on the base, and whether a morph target takes them apart.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/pools/local_mesh.h"
#include "core/mesh/surface/equal_vertices.h"

namespace tspace {

/// Vertices with equal position, normal and UV, over which the grouping methods go on.
class WeldClasses {
  public:
    /// Expected linear time; keeps 4 bytes per vertex.
    explicit WeldClasses(const LocalMesh& mesh) : classes_(findEqualVertices(mesh.positions, mesh.normals, mesh.uvs)) {}

    [[nodiscard]] std::uint32_t of(std::uint32_t vertex) const { return classes_.class_of[vertex]; }

    /// Marks the classes whose vertices, those that `corners` name, have different positions or normals in a pose.
    /// Returns whether there is one. Linear.
    bool findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                   std::span<const Vec3> normals, std::vector<bool>& apart) const;

    /// Marks all classes of a triangle that has a marked one, `rounds` times. Linear in each.
    void spread(const LocalMesh& mesh, unsigned rounds, std::vector<bool>& apart) const;

  private:
    EqualVertices classes_;
};

}  // namespace tspace
