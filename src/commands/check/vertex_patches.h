// SPDX-License-Identifier: MIT
// Which vertices are connected.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/base/disjoint_sets.h"

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
            joinSets(parents_.data(), v[0], v[1]);
            joinSets(parents_.data(), v[0], v[2]);
        }
    }

    /// The lowest vertex of the patch.
    std::uint32_t of(std::uint32_t vertex) { return rootOf(parents_.data(), vertex); }

  private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace tspace
