// SPDX-License-Identifier: MIT
#include "core/winding/box_tree.h"

#include <bit>

namespace tspace::winding {

namespace {

constexpr std::size_t kLeaf = 8;  // boxes, at most

}  // namespace

BoxTree::BoxTree(const Buffer<Box>& boxes, std::size_t count, const Allocator* allocator)
    : boxes_(boxes),
      count_(count),
      order_(allocator, count),
      nodes_(allocator, 2 * std::bit_ceil(std::max<std::size_t>(1, (count + kLeaf - 1) / kLeaf)), Box{}) {
    for (std::size_t i = 0; i < count; ++i) order_[i] = static_cast<std::uint32_t>(i);
    for (std::size_t node = 1; node < nodes_.size(); ++node) {
        const Range range = rangeOf(node);
        for (std::size_t i = range.begin; i < range.end; ++i) nodes_[node].add(boxes_[order_[i]]);
        if (2 * node >= nodes_.size()) continue;
        const Box& box = nodes_[node];
        int axis = 0;
        for (int k = 1; k < 3; ++k) {
            if (box.most[k] - box.least[k] > box.most[axis] - box.least[axis]) axis = k;
        }
        const auto middle = [&](std::uint32_t i) { return boxes_[i].least[axis] + boxes_[i].most[axis]; };
        std::nth_element(
            order_.data() + range.begin, order_.data() + (range.begin + range.end) / 2, order_.data() + range.end,
            [&](std::uint32_t a, std::uint32_t b) { return middle(a) != middle(b) ? middle(a) < middle(b) : a < b; });
    }
}

BoxTree::Range BoxTree::rangeOf(std::size_t node) const {
    Range range{0, count_};
    for (unsigned level = static_cast<unsigned>(std::bit_width(node)) - 1; level-- > 0;) {
        const std::size_t middle = (range.begin + range.end) / 2;
        if ((node >> level & 1) != 0) {
            range.begin = middle;
        } else {
            range.end = middle;
        }
    }
    return range;
}

}  // namespace tspace::winding
