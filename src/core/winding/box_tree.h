// SPDX-License-Identifier: MIT
// A tree of boxes, halved at the median of the widest side: for rays and for points.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/memory.h"
#include "core/base/vec_math.h"

namespace tspace::winding {

struct Box {
    float least[3] = {3e38f, 3e38f, 3e38f}, most[3] = {-3e38f, -3e38f, -3e38f};

    void add(const Vec3& p) {
        const float at[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; ++k) {
            least[k] = std::min(least[k], at[k]);
            most[k] = std::max(most[k], at[k]);
        }
    }
    void add(const Box& b) {
        for (int k = 0; k < 3; ++k) {
            least[k] = std::min(least[k], b.least[k]);
            most[k] = std::max(most[k], b.most[k]);
        }
    }
    [[nodiscard]] bool holds(const Box& b) const {
        for (int k = 0; k < 3; ++k) {
            if (!(least[k] <= b.least[k] && b.most[k] <= most[k])) return false;
        }
        return true;
    }
};

class BoxTree {
  public:
    /// `boxes` stay where they are as long as the tree.
    BoxTree(const Buffer<Box>& boxes, std::size_t count, const Allocator* allocator);

    /// body(number) for the boxes that, as all nodes above them, are accepted by accepts(box).
    template <class Accepts, class Body>
    void visit(Accepts&& accepts, Body&& body) const {
        std::size_t stack[64], depth = 0;
        if (count_ != 0) stack[depth++] = 1;
        while (depth != 0) {
            const std::size_t node = stack[--depth];
            if (!accepts(nodes_[node])) continue;
            if (2 * node + 1 < nodes_.size()) {
                stack[depth++] = 2 * node + 1;
                stack[depth++] = 2 * node;
                continue;
            }
            const Range range = rangeOf(node);
            for (std::size_t i = range.begin; i < range.end; ++i) {
                if (accepts(boxes_[order_[i]])) body(order_[i]);
            }
        }
    }

  private:
    struct Range {
        std::size_t begin, end;
    };
    /// Nodes are numbered from 1, level by level; each level halves the ranges of the one above.
    [[nodiscard]] Range rangeOf(std::size_t node) const;

    const Buffer<Box>& boxes_;
    std::size_t count_;
    Buffer<std::uint32_t> order_;
    Buffer<Box> nodes_;
};

}  // namespace tspace::winding
