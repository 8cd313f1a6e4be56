// SPDX-License-Identifier: MIT
// The last bucket of the reference's edge list. To know its order, the reference's first sort (a
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
    TailFinder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
               Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          node_at_(allocator, 3 * triangles.count),
          corners_(allocator, nodes.count, kNone),
          allocator_(allocator),
          parallel_(parallel),
          edges_(allocator) {}

    TailPairs run() {
        TailPairs pairs;
        readTriangles();
        if (count_ == 0) return pairs;
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
    /// kNone at the corners of degenerate triangles, which have no edges there.
    void readTriangles() {
        const auto position = [&](std::size_t i) -> const Vec3& {
            return mesh_.positions[mesh_.indices[triangles_.corner(i)]];
        };
        for (std::size_t i = 0; i < node_at_.size(); i += 3) {
            const Vec3 &a = position(i), &b = position(i + 1), &c = position(i + 2);
            const bool degenerate = a == b || b == c || c == a;
            for (std::size_t k = i; k < i + 3; ++k)
                node_at_[k] = degenerate ? kNone : nodes_.ofVertex(mesh_.indices[triangles_.corner(k)]);
            count_ += degenerate ? 0 : 3;
        }
    }

    std::uint32_t representative(std::uint32_t node) const { return corners_[node]; }
    static std::size_t nextOf(std::size_t half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }

    /// body(half_edge) for those of all triangles that are not degenerate.
    template <class Body>
    void forEachHalfEdge(const Body& body) const {
        for (std::size_t h = 0; h < node_at_.size(); ++h) {
            if (node_at_[h] != kNone) body(static_cast<std::uint32_t>(h));
        }
    }

    /// Finds the lower end of the last bucket's edges: in each triangle the middle one of the representatives
    /// is the lower end of its highest edge.
    void findLargestLow() {
        WeldOrder(mesh_, triangles_, nodes_, allocator_, parallel_).findAll(corners_.data());
        const std::uint32_t* n = node_at_.data();
        for (std::size_t i = 0; i < node_at_.size(); i += 3) {
            if (n[i] == kNone) continue;
            const std::uint32_t r[3] = {representative(n[i]), representative(n[i + 1]), representative(n[i + 2])};
            const std::uint32_t middle = middleOf(r[0], r[1], r[2]);
            if (middle < low_) continue;
            low_ = middle;
            low_node_ = n[i + (r[1] == middle ? 1 : r[2] == middle ? 2 : 0)];
        }
    }

    /// The last bucket lies around one node.
    void collectEdges() {
        forEachHalfEdge([&](std::uint32_t h) {
            const std::uint32_t from = node_at_[h], to = node_at_[nextOf(h)];
            if (from == low_node_ && representative(to) > low_) edges_.push({representative(to), to, h, true});
            if (to == low_node_ && representative(from) > low_) edges_.push({representative(from), from, h, false});
        });
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
        Buffer<Record> records(allocator_, count_);
        std::size_t count = 0;
        forEachHalfEdge([&](std::uint32_t h) {
            records[count++] = {std::min(representative(node_at_[h]), representative(node_at_[nextOf(h)])), h};
        });
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
    Buffer<std::uint32_t> node_at_;  // one per half-edge: where it begins
    std::size_t count_ = 0;          // of half-edges
    Buffer<std::uint32_t> corners_;  // one per node: its representative
    const Allocator* allocator_;
    Parallel& parallel_;
    Growing<TailEdge> edges_;
    std::uint32_t low_ = 0;  // representative that all edges of the last bucket have as lower end
    std::uint32_t low_node_ = 0;
};

}  // namespace

TailPairs findTailPairs(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                        const Allocator* allocator, Parallel& parallel) {
    return TailFinder(mesh, triangles, nodes, allocator, parallel).run();
}

}  // namespace tspace::mikk
