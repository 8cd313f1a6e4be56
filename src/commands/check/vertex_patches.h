// SPDX-License-Identifier: MIT
// Which vertices are connected.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace tspace {

/// Vertices that triangles connect, by their indices. Near-linear.
class VertexPatches {
  public:
    /// `connects(v)`: whether the triangle with the corners v[0], v[1] and v[2] does.
    template <class Connects>
    VertexPatches(std::size_t vertex_count, std::span<const std::uint32_t> corners, const Connects& connects)
        : parents_(vertex_count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
        for (const std::uint32_t* v = corners.data(); v != corners.data() + corners.size(); v += 3) {
            if (!connects(v)) continue;
            parents_[of(v[1])] = of(v[0]);
            parents_[of(v[2])] = of(v[0]);
        }
    }

    /// One of the vertices of the patch, the same for all of them.
    std::uint32_t of(std::uint32_t vertex) {
        while (parents_[vertex] != vertex) vertex = parents_[vertex] = parents_[parents_[vertex]];
        return vertex;
    }

  private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace tspace
