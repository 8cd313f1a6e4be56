// SPDX-License-Identifier: MIT
// Step 5: the last bucket of the reference's edge list. To know its order, the reference's first sort (a
// quicksort with a fixed seed, not stable) must be replayed; but nearly always tail_check.cpp shows that the
// order cannot matter.
//
// Half-edges compare by their nodes' representative corners only.
#include "tangents/mikktspace/tail_order.h"

#include <algorithm>
#include <bit>

#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld_order.h"

namespace tspace::mikk {

namespace {

constexpr std::uint32_t kSeed = 39871946;
/// Elements that the replayed sort may look at, per element. A random order needs about 4 (only the last
/// bucket's side is followed); only orders made against the fixed seed come near.
constexpr std::uint64_t kStepsPerElement = 64;

struct Record {
    std::uint32_t low = 0, half_edge = 0;
};

std::uint32_t middleOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// Replays the quicksort as far as it moves records with the largest key. Returns false when the budget is
/// spent.
class EdgeSort {
  public:
    EdgeSort(Buffer<Record>& records, std::uint32_t largest) : records_(records), largest_(largest) {}

    bool run() {
        struct Range {
            std::int64_t begin, last;
            std::uint32_t seed;
        };
        Range waiting[64];  // the larger side waits, so each is at most half of the one before
        std::size_t depth = 0;
        std::uint64_t steps = kStepsPerElement * records_.size() + 1024;
        Range range{0, static_cast<std::int64_t>(records_.size()) - 1, kSeed};
        while (true) {
            const auto size = static_cast<std::uint64_t>(range.last - range.begin + 1);
            Range sides[2];
            int count = 0;
            if (range.last > range.begin) {
                if (size > steps) return false;
                steps -= size;
                if (size == 2) {
                    if (key(range.begin) > key(range.last)) std::swap(record(range.begin), record(range.last));
                } else {
                    const std::uint32_t seed =
                        range.seed + std::rotl(range.seed, static_cast<int>(range.seed & 31)) + 3;
                    std::int64_t i = range.begin, j = range.last;
                    const std::uint32_t pivot = key(range.begin + static_cast<std::int64_t>(seed % size));
                    partition(i, j, pivot);
                    if (pivot == largest_ && range.begin < j) sides[count++] = {range.begin, j, seed};
                    if (i < range.last) sides[count++] = {i, range.last, seed};
                }
            }
            if (count == 0) {
                if (depth == 0) return true;
                range = waiting[--depth];
            } else {
                if (count == 2) {
                    const bool first_is_larger = sides[0].last - sides[0].begin > sides[1].last - sides[1].begin;
                    waiting[depth++] = sides[first_is_larger ? 0 : 1];
                    range = sides[first_is_larger ? 1 : 0];
                } else {
                    range = sides[0];
                }
            }
        }
    }

  private:
    Record& record(std::int64_t i) { return records_[static_cast<std::size_t>(i)]; }
    std::uint32_t key(std::int64_t i) { return record(i).low; }

    void partition(std::int64_t& i, std::int64_t& j, std::uint32_t pivot) {
        do {
            while (key(i) < pivot) ++i;
            while (key(j) > pivot) --j;
            if (i <= j) std::swap(record(i++), record(j--));
        } while (i <= j);
    }

    Buffer<Record>& records_;
    std::uint32_t largest_;
};

/// One half-edge of the last bucket.
struct TailEdge {
    std::uint32_t high = 0;  // representative of the higher end
    std::uint32_t high_node = 0;
    std::uint32_t half_edge = 0;
    bool ascending = false;  // runs from the lower to the higher end
};

class TailFinder {
  public:
    TailFinder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const GroupedPlan& plan,
               const Allocator* allocator, Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          plan_(plan),
          allocator_(allocator),
          parallel_(parallel),
          edges_(allocator) {}

    TailPairs run() {
        TailPairs pairs;
        if (plan_.triangle_count == 0) return pairs;
        findLargestLow();
        collectEdges();
        if (!orderMatters()) return pairs;
        if (!sortAsReference()) {
            pairs.abandoned = true;
            return pairs;
        }
        pairUp(pairs);
        return pairs;
    }

  private:
    std::uint32_t representative(std::uint32_t node) const {
        return nodes_.tame ? corners_[node] : nodes_.representatives[node];
    }

    /// Finds the lower end of the last bucket's edges: in each triangle the middle one of the representatives
    /// is the lower end of its highest edge.
    void findLargestLow() {
        if (nodes_.tame) {
            corners_ = Buffer<std::uint32_t>(allocator_, nodes_.count, kNone);
            WeldOrder(mesh_, triangles_, nodes_, allocator_, parallel_).findAll(corners_.data());
        }
        const std::uint32_t* n = plan_.nodes.data();
        for (std::size_t i = 0; i < 3 * plan_.triangle_count; i += 3) {
            const std::uint32_t r[3] = {representative(n[i]), representative(n[i + 1]), representative(n[i + 2])};
            const std::uint32_t middle = middleOf(r[0], r[1], r[2]);
            if (middle < low_) continue;
            low_ = middle;
            low_node_ = n[i + (r[1] == middle ? 1 : r[2] == middle ? 2 : 0)];
        }
    }

    /// The last bucket lies around one node.
    void collectEdges() {
        for (std::uint32_t e = plan_.node_begin[low_node_]; e < plan_.node_begin[low_node_ + 1]; ++e) {
            const std::uint32_t h = plan_.list[e], first = h - h % 3;
            const std::uint32_t before = first + (h - first + 2) % 3;
            const std::uint32_t next = plan_.nodes[first + (h - first + 1) % 3], previous = plan_.nodes[before];
            if (representative(next) > low_) edges_.push({representative(next), next, h, true});
            if (representative(previous) > low_) edges_.push({representative(previous), previous, before, false});
        }
    }

    /// Order cannot matter when no edge of the bucket is there in both directions.
    bool orderMatters() {
        if (edges_.size() <= 2) return false;
        std::sort(edges_.begin(), edges_.end(), [](const TailEdge& a, const TailEdge& b) {
            return a.high != b.high ? a.high < b.high : a.ascending < b.ascending;
        });
        for (std::size_t i = 1; i < edges_.size(); ++i) {
            if (edges_[i].high == edges_[i - 1].high && edges_[i].ascending != edges_[i - 1].ascending) return true;
        }
        return false;
    }

    /// Leaves edges_ in the order in which the reference meets them.
    bool sortAsReference() {
        Buffer<Record> records(allocator_, 3 * plan_.triangle_count);
        for (std::size_t h = 0; h < records.size(); ++h) {
            const std::size_t next = h % 3 == 2 ? h - 2 : h + 1;
            records[h] = {std::min(representative(plan_.nodes[h]), representative(plan_.nodes[next])),
                          static_cast<std::uint32_t>(h)};
        }
        if (!EdgeSort(records, low_).run()) return false;
        std::sort(edges_.begin(), edges_.end(),
                  [](const TailEdge& a, const TailEdge& b) { return a.half_edge < b.half_edge; });
        Growing<TailEdge> ordered(allocator_);
        for (std::size_t i = records.size() - edges_.size(); i < records.size(); ++i) {
            ordered.push(*std::lower_bound(edges_.begin(), edges_.end(), records[i].half_edge,
                                           [](const TailEdge& e, std::uint32_t h) { return e.half_edge < h; }));
        }
        edges_ = std::move(ordered);
        // Runs of one higher end are sorted by triangle, but for the very last run.
        for (std::size_t begin = 0; begin < edges_.size();) {
            const std::size_t end = endOfRun(begin);
            if (end < edges_.size()) {
                std::sort(edges_.begin() + begin, edges_.begin() + end,
                          [](const TailEdge& a, const TailEdge& b) { return a.half_edge / 3 < b.half_edge / 3; });
            }
            begin = end;
        }
        return true;
    }

    std::size_t endOfRun(std::size_t begin) {
        std::size_t end = begin + 1;
        while (end < edges_.size() && edges_[end].high == edges_[begin].high) ++end;
        return end;
    }

    /// Within a run the oldest waiting half-edge of the opposite direction is the partner (see pairing.h);
    /// runs know nothing of each other.
    void pairUp(TailPairs& pairs) {
        Buffer<std::uint32_t> partner(allocator_, edges_.size(), kNone);
        for (std::size_t begin = 0; begin < edges_.size();) {
            const std::size_t end = endOfRun(begin);
            std::size_t waiting = begin;  // no half-edge before it waits
            for (std::size_t i = begin; i < end; ++i) {
                while (waiting < i && partner[waiting] != kNone) ++waiting;
                if (waiting == i || edges_[waiting].ascending == edges_[i].ascending) continue;
                partner[waiting] = edges_[i].half_edge;
                partner[i] = edges_[waiting].half_edge;
            }
            begin = end;
        }
        struct Link {
            std::uint32_t half_edge, partner;
        };
        Buffer<Link> links(allocator_, edges_.size());
        pairs.nodes = Buffer<std::uint32_t>(allocator_, edges_.size() + 1);
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            links[i] = {edges_[i].half_edge, partner[i]};
            pairs.nodes[i] = edges_[i].high_node;
        }
        pairs.nodes[edges_.size()] = low_node_;
        std::sort(pairs.nodes.begin(), pairs.nodes.end());
        std::sort(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.half_edge < b.half_edge; });
        pairs.half_edges = Buffer<std::uint32_t>(allocator_, links.size());
        pairs.partners = Buffer<std::uint32_t>(allocator_, links.size());
        for (std::size_t i = 0; i < links.size(); ++i) {
            pairs.half_edges[i] = links[i].half_edge;
            pairs.partners[i] = links[i].partner;
        }
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const GroupedPlan& plan_;
    Buffer<std::uint32_t> corners_;  // representatives, where the nodes do not bring them along
    const Allocator* allocator_;
    Parallel& parallel_;
    Growing<TailEdge> edges_;
    std::uint32_t low_ = 0;  // representative that all edges of the last bucket have as lower end
    std::uint32_t low_node_ = 0;
};

}  // namespace

void TailPairs::apply(std::uint32_t node, Around& around) const {
    if (half_edges.empty() || !std::binary_search(nodes.begin(), nodes.end(), node)) return;
    const std::uint32_t* list_end = around.list + around.count;
    const auto member = [&](std::uint32_t tricorner) {
        return static_cast<std::uint32_t>(std::lower_bound(around.list, list_end, tricorner) - around.list);
    };
    const auto find = [&](std::uint32_t half_edge, std::uint32_t& partner) {
        const std::uint32_t* at = std::lower_bound(half_edges.begin(), half_edges.end(), half_edge);
        if (at == half_edges.end() || *at != half_edge) return false;
        partner = partners[static_cast<std::size_t>(at - half_edges.begin())];
        return true;
    };
    const auto turn = [](std::uint32_t tricorner, std::uint32_t by) {
        const std::uint32_t k = tricorner % 3;
        return tricorner - k + (k + by) % 3;
    };
    for (std::uint32_t i = 0; i < around.count; ++i) {
        const std::uint32_t h = around.list[i];
        std::uint32_t partner = kNone;
        // A partner runs the opposite way: across the leaving edge it arrives here, across the arriving edge
        // it leaves.
        if (find(h, partner)) around.left[i] = partner == kNone ? kNone : member(turn(partner, 1));
        if (find(turn(h, 2), partner)) around.right[i] = partner == kNone ? kNone : member(partner);
    }
}

TailPairs findTailPairs(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                        const GroupedPlan& plan, const Allocator* allocator, Parallel& parallel) {
    return TailFinder(mesh, triangles, nodes, plan, allocator, parallel).run();
}

}  // namespace tspace::mikk
