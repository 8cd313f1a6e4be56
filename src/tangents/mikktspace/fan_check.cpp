// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/fan_check.h"

#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/pairing.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kGrain = 1024;     // fans
constexpr std::size_t kWorthwhile = 64;  // one fan in so many nodes

struct ListedCorner {
    std::uint32_t fan, next, previous;
};

class FanChecker {
  public:
    FanChecker(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, NodeSums& sums,
               const Allocator* allocator, Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          sums_(sums),
          allocator_(allocator),
          parallel_(parallel),
          fans_(allocator),
          corners_(allocator) {}

    void run() {
        chooseNodes();
        if (fans_.size() < nodes_.count / kWorthwhile || fans_.empty()) return;
        listCorners();
        Buffer<std::uint32_t> begin(allocator_, fans_.size() + 2, 0u), order(allocator_, corners_.size());
        for (const ListedCorner& c : corners_) ++begin[c.fan + 2];
        for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
        for (std::size_t i = 0; i < corners_.size(); ++i)
            order[begin[corners_[i].fan + 1]++] = static_cast<std::uint32_t>(i);
        parallel_.forRanges(fans_.size(), kGrain, [&](std::size_t first, std::size_t end) {
            for (std::size_t f = first; f < end; ++f) {
                if (!isOneFan(order.data() + begin[f], begin[f + 1] - begin[f])) continue;
                NodeSum& node = sums_.nodes[fans_[f]];
                node.fan = Fan{};
                node.fan.leaves[0] = node.fan.arrives[0] = Fan::kClosed;
                sums_.marks[fans_[f]] |= kFanKnown;
            }
        });
    }

  private:
    /// Nodes whose fan is all that is unknown. The place of their second path holds their number here.
    void chooseNodes() {
        for (std::size_t n = 0; n < nodes_.count; ++n) {
            if (!isChosen(n)) continue;
            sums_.nodes[n].fan.leaves[1] = static_cast<std::uint32_t>(fans_.size());
            fans_.push(static_cast<std::uint32_t>(n));
        }
    }

    [[nodiscard]] bool isChosen(std::size_t node) const {
        return (sums_.marks[node] & kFanKnown) == 0 && (sums_.marks[node] & (kFacesUp | kFacesDown)) != 0;
    }

    /// None of these triangles is degenerate: nodes of such are not chosen.
    void listCorners() {
        constexpr std::size_t kAhead = 16;  // triangles
        Marks marks = noMarks(allocator_, mesh_.vertexCount());
        for (std::size_t v = 0; v < marks.size(); ++v)
            marks[v] = isChosen(nodes_.ofVertex(static_cast<std::uint32_t>(v))) ? 1 : 0;
        const Buffer<std::uint32_t> found =
            collectTriangles(mesh_, triangles_, marks, 1, allocator_, parallel_);
        corners_.reserve(7 * fans_.size());
        withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
            for (std::size_t i = 0; i < found.size(); ++i) {
                if (i + kAhead < found.size()) {
                    const std::size_t ahead = 3 * std::size_t{found[i + kAhead]};
                    for (std::size_t k = 0; k < 3; ++k)
                        __builtin_prefetch(&sums_.nodes[nodes_.ofVertex(vertexOf(ahead + k))]);
                }
                std::uint32_t n[3];
                for (std::size_t k = 0; k < 3; ++k)
                    n[k] = nodes_.ofVertex(vertexOf(3 * std::size_t{found[i]} + k));
                for (std::size_t k = 0; k < 3; ++k) {
                    if (isChosen(n[k]))
                        corners_.push({sums_.nodes[n[k]].fan.leaves[1], n[(k + 1) % 3], n[(k + 2) % 3]});
                }
            }
        });
    }

    [[nodiscard]] bool isOneFan(const std::uint32_t* listed, std::uint32_t count) const {
        if (count > kSmallNode) return false;
        std::uint32_t next[kSmallNode], previous[kSmallNode], left[kSmallNode], right[kSmallNode];
        for (std::uint32_t i = 0; i < count; ++i) {
            next[i] = corners_[listed[i]].next;
            previous[i] = corners_[listed[i]].previous;
        }
        Around around{count, nullptr, next, previous, left, right};
        pairSmall(around);
        std::uint32_t reached = 1, m = 0;
        while (left[m] != kNone && left[m] != 0) m = left[m], ++reached;
        if (left[m] == 0) return reached == count;  // a ring
        for (m = 0; right[m] != kNone; m = right[m]) ++reached;
        return reached == count;
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    NodeSums& sums_;
    const Allocator* allocator_;
    Parallel& parallel_;
    Growing<std::uint32_t> fans_;  // their nodes
    Growing<ListedCorner> corners_;
};

}  // namespace

void checkFans(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, NodeSums& sums,
               const Allocator* allocator, Parallel& parallel) {
    FanChecker(mesh, triangles, nodes, sums, allocator, parallel).run();
}

}  // namespace tspace::mikk
