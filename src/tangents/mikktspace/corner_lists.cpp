// SPDX-License-Identifier: MIT
// Step 4: the tricorners of each node, by a counting sort. Each list is ascending, which is the order in
// which the reference opens groups, pairs edges and adds up, so nothing is ever sorted again.
#include "tangents/mikktspace/corner_lists.h"

namespace tspace::mikk {

void listCorners(GroupedPlan& plan, const Allocator* allocator) {
    const std::size_t count = 3 * plan.triangle_count;
    plan.node_begin = Buffer<std::uint32_t>(allocator, plan.listed_count + 1, 0u);
    // Counted two places up: after the sum, entry n + 1 is where node n starts, and filling moves it to its
    // end.
    std::uint32_t* begin = plan.node_begin.data();
    std::size_t listed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = std::size_t{plan.nodes[i]} + 2;
        if (at <= plan.listed_count) ++begin[at];
        listed += plan.nodes[i] < plan.listed_count ? 1 : 0;
    }
    plan.list = Buffer<std::uint32_t>(allocator, listed);
    for (std::size_t n = 2; n <= plan.listed_count; ++n) begin[n] += begin[n - 1];
    for (std::size_t i = 0; i < count; ++i) {
        if (plan.nodes[i] < plan.listed_count) plan.list[begin[plan.nodes[i] + 1]++] = static_cast<std::uint32_t>(i);
    }
}

}  // namespace tspace::mikk
