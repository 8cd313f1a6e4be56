// SPDX-License-Identifier: MIT
// Counts occurrences of a fault, with their surface area and first vertices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/sort.h"

namespace tspace {

struct Tally {
    static constexpr std::size_t kMaxVertices = 8;

    std::uint64_t count = 0;
    std::uint64_t total = 0;  ///< number of candidates, such as vertices or triangles
    double area = 0;
    double surface_share = 0;  ///< share of the area of the mesh; set by finish()
    double worst_deg = 0;
    std::vector<std::uint32_t> vertices = {};  ///< first vertices that have the fault, without duplicates

    /// Returns the tally of a fault that all of `count` candidates have.
    static Tally all(std::uint64_t count) { return {.count = count, .total = count}; }

    void add(std::uint32_t vertex, double its_area, double deg = 0) {
        ++count;
        area += its_area;
        worst_deg = std::max(worst_deg, deg);
        if (vertices.size() < kMaxVertices && std::find(vertices.begin(), vertices.end(), vertex) == vertices.end())
            vertices.push_back(vertex);
    }
    /// Adds a tally with the same total.
    void include(const Tally& other) {
        count += other.count;
        area += other.area;
        surface_share = std::min(1.0, surface_share + other.surface_share);
        worst_deg = std::max(worst_deg, other.worst_deg);
        vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
        sortList(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        if (vertices.size() > kMaxVertices) vertices.resize(kMaxVertices);
    }
    [[nodiscard]] double share() const {
        return total == 0 ? 0 : static_cast<double>(count) / static_cast<double>(total);
    }
    void finish(double whole_area) { surface_share = whole_area > 0 ? std::min(1.0, area / whole_area) : 0; }
};

}  // namespace tspace
