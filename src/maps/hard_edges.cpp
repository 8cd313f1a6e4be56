// SPDX-License-Identifier: MIT
#include "maps/hard_edges.h"

#include <algorithm>
#include <queue>
#include <span>

#include "core/base/disjoint_sets.h"
#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "maps/segment_distance.h"

namespace tspace {

namespace {

std::uint32_t nextCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

class Search {
  public:
    Search(StridedSpan<const Vec3> positions, std::span<const std::uint32_t> roots, double far)
        : positions_(positions), roots_(roots), far_(far), groups_(positions.count) {
        for (std::uint32_t i = 0; i < groups_.size(); ++i) groups_[i] = i;
    }

    HardEdges run() {
        const auto forHalves = [&](const auto& add) {
            for (std::uint32_t corner = 0; corner < positions_.count; ++corner) {
                const std::uint32_t a = roots_[corner], b = roots_[nextCorner(corner)];
                if (a != b) add(std::min(a, b), std::max(a, b), corner);
            }
        };
        forEachEdge(positions_.count, nullptr, forHalves,
                    [&](std::uint32_t low, std::uint32_t high, std::span<const HalfEdge> sides) {
                        joinOrPart(low, high, sides);
                    });
        if (found_.edges.empty()) return std::move(found_);
        spread();
        found_.nearest.resize(groups_.size());
        found_.at_edge.resize(groups_.size());
        for (const auto& [corner, edge] : at_edges_) found_.at_edge[groupOf(corner)] = true;
        for (std::uint32_t i = 0; i < groups_.size(); ++i) {
            const std::uint32_t group = groupOf(i);
            found_.nearest[i] = near_[group];
            found_.at_edge[i] = found_.at_edge[group];
        }
        found_.groups.resize(groups_.size());
        for (std::uint32_t i = 0; i < groups_.size(); ++i) found_.groups[i] = groupOf(i);
        return std::move(found_);
    }

  private:
    [[nodiscard]] DVec3 normalOf(std::uint32_t corner) const {
        const std::uint32_t first = corner - corner % 3;
        const DVec3 at = toDouble(positions_[first]);
        DVec3 normal = cross(toDouble(positions_[first + 1]) - at, toDouble(positions_[first + 2]) - at);
        return normalize(normal) ? normal : DVec3{};
    }

    /// The sides of one edge: it is hard, or its two faces are one around both of its ends.
    void joinOrPart(std::uint32_t low, std::uint32_t high, std::span<const HalfEdge> sides) {
        constexpr double kCosine = 0.861629160441525819;  // of kHardDeg
        if (sides.size() == 1) return;
        if (sides.size() == 2) {
            const DVec3 a = normalOf(cornerOf(sides[0])), b = normalOf(cornerOf(sides[1]));
            // A triangle without area bends nothing.
            const bool has_angle = dot(a, a) > 0 && dot(b, b) > 0;
            if (!has_angle || dot(a, b) >= kCosine) {
                for (const std::uint32_t end : {low, high})
                    joinSets(groups_.data(), cornerAt(cornerOf(sides[0]), end), cornerAt(cornerOf(sides[1]), end));
                return;
            }
        }
        const auto edge = static_cast<std::uint32_t>(found_.edges.size());
        DVec3 way{};
        for (const HalfEdge side : sides) way = way + normalOf(cornerOf(side));
        const std::uint32_t first = cornerOf(sides[0]);
        found_.edges.push_back({{first, nextCorner(first)}, normalize(way) ? way : DVec3{}});
        for (const HalfEdge side : sides) {
            at_edges_.push_back({cornerOf(side), edge});
            at_edges_.push_back({nextCorner(cornerOf(side)), edge});
        }
    }

    [[nodiscard]] std::uint32_t cornerAt(std::uint32_t side, std::uint32_t root) const {
        return roots_[side] == root ? side : nextCorner(side);
    }

    /// The first corner of its group.
    std::uint32_t groupOf(std::uint32_t corner) { return rootOf(groups_.data(), corner); }

    [[nodiscard]] double distanceTo(std::uint32_t edge, std::uint32_t corner) const {
        const auto& [from, to] = found_.edges[edge].corners;
        return std::sqrt(
            squaredDistanceTo(toDouble(positions_[corner]), toDouble(positions_[from]), toDouble(positions_[to])));
    }

    struct Reached {
        double distance = 0;
        std::uint32_t group = 0, edge = 0;
        bool operator<(const Reached& other) const {
            if (distance != other.distance) return distance > other.distance;
            return group != other.group ? group > other.group : edge > other.edge;
        }
    };

    /// Edges pass from corners to the other corners of their triangles, the nearest first; a corner passes on the first two
    /// that reach it.
    void spread() {
        near_.assign(groups_.size(), {HardEdges::kNone, HardEdges::kNone});
        // The corners of each group, in a list.
        std::vector<std::uint32_t> first(groups_.size(), HardEdges::kNone), next(groups_.size(), HardEdges::kNone);
        for (auto corner = static_cast<std::uint32_t>(groups_.size()); corner-- > 0;) {
            const std::uint32_t group = groupOf(corner);
            next[corner] = first[group];
            first[group] = corner;
        }
        std::priority_queue<Reached> queue;
        for (const auto& [corner, edge] : at_edges_) queue.push({0, groupOf(corner), edge});
        while (!queue.empty()) {
            const Reached reached = queue.top();
            queue.pop();
            auto& near = near_[reached.group];
            if (near[0] == reached.edge || near[1] != HardEdges::kNone) continue;
            near[near[0] == HardEdges::kNone ? 0 : 1] = reached.edge;
            for (std::uint32_t at = first[reached.group]; at != HardEdges::kNone; at = next[at]) {
                for (std::uint32_t other = nextCorner(at); other != at; other = nextCorner(other)) {
                    const std::uint32_t group = groupOf(other);
                    if (near_[group][0] == reached.edge || near_[group][1] != HardEdges::kNone) continue;
                    const double distance = distanceTo(reached.edge, other);
                    if (distance <= far_) queue.push({distance, group, reached.edge});
                }
            }
        }
    }

    StridedSpan<const Vec3> positions_;
    std::span<const std::uint32_t> roots_;
    double far_;
    std::vector<std::uint32_t> groups_;  ///< corners at one place whose faces meet smoothly: a forest
    std::vector<std::array<std::uint32_t, 2>> at_edges_ = {};  ///< corners at hard edges, and which
    std::vector<std::array<std::uint32_t, 2>> near_ = {};      ///< of each group
    HardEdges found_ = {};
};

}  // namespace

HardEdges findHardEdges(StridedSpan<const Vec3> positions, std::span<const std::uint32_t> roots, double far) {
    return Search(positions, roots, far).run();
}

}  // namespace tspace
