// SPDX-License-Identifier: MIT
// One estimate for all groups of a mesh: most nodes are one group; those that are not have been planned.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/range_lists.h"
#include "tangents/mikktspace/evaluation_plan.h"

namespace tspace::mikk {

/// Triangles in which each node is a group; the groups of planned nodes follow behind all nodes.
class JoinedTriangles final : public TriangleGroups {
  public:
    /// `is_planned`: one bit per node.
    JoinedTriangles(const TriangleGroups& by_node, std::size_t node_count, const EvaluationPlan& plan,
                    std::span<const std::uint64_t> is_planned)
        : TriangleGroups(by_node.count),
          by_node_(by_node),
          node_count_(static_cast<std::uint32_t>(node_count)),
          plan_(plan),
          is_planned_(is_planned) {}

    void read(std::size_t first, std::size_t triangles, std::uint32_t* vertices, std::uint32_t* groups) const override {
        by_node_.read(first, triangles, vertices, groups);
        const std::uint32_t *begin = plan_.triangles.data(), *end = begin + plan_.triangles.size();
        for (const std::uint32_t* t = std::lower_bound(begin, end, first); t != end && *t < first + triangles; ++t) {
            const std::uint32_t* planned = plan_.groups.data() + 3 * (t - begin);
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& group = groups[3 * (*t - first) + k];
                if (group >= node_count_ || (is_planned_[group / 64] >> (group % 64) & 1) == 0) continue;
                group = planned[k] < plan_.group_count ? node_count_ + planned[k] : kNone;
            }
        }
    }

  private:
    const TriangleGroups& by_node_;
    std::uint32_t node_count_;
    const EvaluationPlan& plan_;
    std::span<const std::uint64_t> is_planned_;
};

}  // namespace tspace::mikk
