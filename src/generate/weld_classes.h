// SPDX-License-Identifier: MIT
// Vertices that are one on the base, and whether a morph target takes them apart.
#pragma once

#include <cstdint>
#include <vector>

#include "generate/local_mesh.h"

namespace tspace {

/// Vertices with equal position, normal and UV, over which the grouping methods go on.
class WeldClasses {
  public:
    WeldClasses() = default;
    /// Expected linear time; keeps 4 bytes per vertex.
    explicit WeldClasses(const LocalMesh& mesh);

    [[nodiscard]] std::uint32_t of(std::uint32_t vertex) const { return class_of_[vertex]; }

    /// Marks the classes whose vertices, those that `corners` name, have different positions or normals in a pose.
    /// Returns whether there is one. Linear.
    bool findApart(std::span<const std::uint32_t> corners, std::span<const Vec3> positions,
                   std::span<const Vec3> normals, std::vector<bool>& apart) const;

  private:
    std::vector<std::uint32_t> class_of_ = {};
    std::size_t count_ = 0;
};

}  // namespace tspace
