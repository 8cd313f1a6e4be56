// SPDX-License-Identifier: MIT
// The last bucket of the reference's edge list.
//
// An edge's key is the lower one of its two nodes' representatives (which are corners), and the last bucket
// holds the edges with the largest key, V. Where are they? Let F be the first corner of some triangles at the
// end of the list, so that corners from F on are in these triangles only. A node's representative lies between
// its first corner and its last. So in each triangle the middle one of its nodes' first corners is not above the
// key of some edge, and the largest of these, L, is not above V. If L >= F, both ends of the bucket's edges have a
// corner from L on: they are nodes of the triangles at the end. Else the end of the list has to be taken longer;
// with the whole list F is its first corner.
//
// Few triangles are enough, nearly always: in a mesh in natural order most nodes of the last ones have no
// other corners; in a mesh without order each edge of a late triangle has its key there once in 36 times.
//
// Where the order of the bucket can change a link, the reference's first sort (a quicksort with a fixed seed, not
// stable) is replayed to know it.
#include "tangents/mikktspace/last_bucket.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "core/sort.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/grid_order.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

constexpr std::uint32_t kSeed = 39871946;
/// Elements that the replayed sort may look at, per element. A random order needs about 4 (only the last
/// bucket's side is followed); only orders made against the fixed seed come near.
constexpr std::uint64_t kStepsPerElement = 64;

std::uint32_t middleOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// An element of the sort.
struct Record {
    std::uint32_t key = 0, half_edge = 0;
};

/// Replays the quicksort as far as it moves records with the largest key. Returns false when the budget is
/// spent.
class EdgeSort {
  public:
    EdgeSort(std::span<Record> records, std::uint32_t largest) : records_(records), largest_(largest) {}

    [[gnu::cold]] bool run() {
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
    std::uint32_t key(std::int64_t i) { return record(i).key; }

    void partition(std::int64_t& i, std::int64_t& j, std::uint32_t pivot) {
        do {
            while (key(i) < pivot) ++i;
            while (key(j) > pivot) --j;
            if (i <= j) std::swap(record(i++), record(j--));
        } while (i <= j);
    }

    std::span<Record> records_;
    std::uint32_t largest_;
};

/// One half-edge of the last bucket.
struct BucketEdge {
    std::uint32_t high = 0;  // representative of the higher end
    std::uint32_t high_node = 0;
    std::uint32_t half_edge = 0;
    std::uint32_t usual = kNone, partner = kNone;  // other half-edges: as pairing links them, as the reference does
    bool ascending = false;                        // runs from the lower to the higher end
};

/// By half-edges; those of each higher end together where `by_ends`.
[[gnu::cold]] void sortEdges(BucketEdge* begin, BucketEdge* end, bool by_ends) {
    sortList(begin, end, [=](const BucketEdge& a, const BucketEdge& b) {
        return by_ends && a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
    });
}

class BucketFinder {
  public:
    BucketFinder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
                 Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          allocator_(allocator),
          parallel_(parallel),
          representatives_(allocator, nodes.count),
          around_(allocator),
          edges_(allocator),
          bucket_(allocator) {}

    /// `kept`: for the result.
    LastBucket run(const Allocator* kept) {
        LastBucket result;
        findEdges();
        if (edges_.size() <= 2 || !mayMatter()) return result;
        findBucket();
        if (!orderMatters()) return result;
        pairUp(&BucketEdge::usual);
        if (!sortAsReference()) {
            result.abandoned = true;
            return result;
        }
        pairUp(&BucketEdge::partner);
        listChanges(result, kept);
        return result;
    }

  private:
    /// The first and the last corner of a node, between which its representative is.
    struct CornerRange {
        std::uint32_t first, last;
    };
    struct LateTriangle {
        std::uint32_t number, nodes[3];
    };
    /// A half-edge of which both ends may have representatives from V on.
    struct LateEdge {
        std::uint32_t from, to, third;  // nodes of its triangle
        std::uint32_t half_edge;
    };

    [[nodiscard]] std::uint32_t nodeAt(std::size_t entry) const { return nodes_.of(mesh_, triangles_.corner(entry)); }

    [[nodiscard]] bool isGood(std::size_t triangle) const {
        const auto at = [&](std::size_t k) {
            return mesh_.positions[mesh_.indices[triangles_.corner(3 * triangle + k)]];
        };
        const Vec3 a = at(0), b = at(1), c = at(2);
        return !(a == b || b == c || c == a);
    }

    /// Where the last `length` triangles begin, or a few more: a face is not cut in two.
    [[nodiscard]] std::size_t beginOfLast(std::size_t length) const {
        std::size_t begin = length < triangles_.count ? triangles_.count - length : 0;
        while (begin > 0 && triangles_.face(begin) == triangles_.face(begin - 1)) --begin;
        return begin;
    }

    /// All half-edges whose ends both have a corner from L on; among them are those of the last bucket.
    void findEdges() {
        constexpr std::size_t kTinyMesh = 64, kSmallMesh = 1024, kLastOfTiny = 2, kLastOfSmall = 8,
                              kLast = 24;   // triangles
        constexpr std::size_t kLonger = 4;  // times, when that was not enough
        ranges_ = Buffer<CornerRange>(allocator_, nodes_.count);
        const std::size_t count = triangles_.count;
        const std::size_t first_length = count < kTinyMesh ? kLastOfTiny : count < kSmallMesh ? kLastOfSmall : kLast;
        for (std::size_t length = first_length;; length *= kLonger) {
            const std::size_t begin = beginOfLast(length);
            const std::uint32_t first_corner = findRanges(begin);
            least_ = leastKey();
            if (begin == 0 || least_ >= first_corner) break;
            if (length == kLastOfTiny) continue;
            findExactly([](std::uint32_t) { return true; });
            least_ = leastKey();
            if (least_ >= first_corner) break;
        }
        const auto mayBe = [&](std::uint32_t node) { return is_late_[node] != 0 && ranges_[node].last >= least_; };
        for (const LateTriangle& t : around_) {
            const bool may_be[] = {mayBe(t.nodes[0]), mayBe(t.nodes[1]), mayBe(t.nodes[2])};
            if (may_be[0] + may_be[1] + may_be[2] < 2 || !isGood(t.number)) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t next = (k + 1) % 3;
                if (may_be[k] && may_be[next])
                    edges_.push({t.nodes[k], t.nodes[next], t.nodes[3 - k - next], 3 * t.number + k});
            }
        }
    }

    /// L: a lower bound of V.
    [[nodiscard]] std::uint32_t leastKey() const {
        std::uint32_t least = 0;
        const auto first = [&](std::uint32_t node) { return is_late_[node] != 0 ? ranges_[node].first : 0; };
        for (const LateTriangle& t : around_) {
            const std::uint32_t middle = middleOf(first(t.nodes[0]), first(t.nodes[1]), first(t.nodes[2]));
            if (middle > least && isGood(t.number)) least = middle;
        }
        return least;
    }

    /// The ranges of the nodes that triangles from `begin` on have, and all triangles at these nodes. Returns F.
    std::uint32_t findRanges(std::size_t begin) {
        is_late_ = noMarks(allocator_, nodes_.count);
        around_.drop(around_.size());
        const auto add = [&](std::uint32_t t) {
            const std::size_t entry = 3 * std::size_t{t};
            around_.push({t, {nodeAt(entry), nodeAt(entry + 1), nodeAt(entry + 2)}});
        };
        std::uint32_t first_corner = kNone;
        for (std::size_t t = begin; t < triangles_.count; ++t) {
            add(static_cast<std::uint32_t>(t));
            for (const std::size_t k : {0, 1, 2}) first_corner = std::min(first_corner, triangles_.corner(3 * t + k));
        }
        for (const LateTriangle& t : around_) {
            for (const std::uint32_t node : t.nodes) {
                is_late_[node] = 1;
                ranges_[node] = {kNone, 0};
            }
        }
        if (begin != 0) {
            for (const std::uint32_t t :
                 collectAround(mesh_, triangles_, nodes_, is_late_, {}, allocator_, parallel_)) {
                if (t < begin) add(t);
            }
        }
        for (const LateTriangle& t : around_) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (is_late_[t.nodes[k]] == 0) continue;
                // Corners of a polygon's triangles need not ascend.
                const std::uint32_t corner = triangles_.corner(3 * std::size_t{t.number} + k);
                CornerRange& range = ranges_[t.nodes[k]];
                range = {std::min(range.first, corner), std::max(range.last, corner)};
            }
        }
        return first_corner;
    }

    /// Makes the ranges of late nodes for which isWanted(node) their representatives.
    template <class IsWanted>
    void findExactly(const IsWanted& isWanted) {
        Growing<std::uint32_t> vertices(allocator_);
        for (const LateTriangle& t : around_) {
            for (const std::uint32_t node : t.nodes) {
                CornerRange& range = ranges_[node];
                if (is_late_[node] == 0 || range.first == range.last || !isWanted(node)) continue;
                vertices.push(mesh_.indices[range.first]);
                range.first = range.last;  // once
            }
        }
        if (vertices.empty()) return;
        if (!order_) order_.emplace(mesh_, triangles_, nodes_, allocator_, parallel_);
        order_->find({vertices.begin(), vertices.size()}, representatives_.data());
        for (const std::uint32_t vertex : vertices) {
            const std::uint32_t node = nodes_.ofVertex(vertex);
            ranges_[node] = {representatives_[node], representatives_[node]};
        }
    }

    /// Whether the ranges leave it open that the order of the bucket matters. For that, if V is x's representative,
    /// an edge to a higher node y must be there in both directions, and another one to y or some higher node w. But a
    /// triangle at x with a higher node has a lower one as well: otherwise these two would have an edge with a larger
    /// key.
    [[nodiscard]] bool mayMatter() const {
        constexpr std::size_t kMany = 64;
        if (edges_.size() > kMany) return true;
        for (const LateEdge& e : edges_) {
            const auto isBack = [&](const LateEdge& b) { return b.from == e.to && b.to == e.from; };
            const LateEdge* back = std::find_if(edges_.begin(), edges_.end(), isBack);
            if (back == edges_.end()) continue;
            for (const std::uint32_t x : {e.from, e.to}) {
                const CornerRange here = keysOf(e, x), there = keysOf(*back, x);
                for (const LateEdge& other : edges_) {
                    if (&other == &e || &other == back || (other.from != x && other.to != x)) continue;
                    const std::uint32_t w = other.from == x ? other.to : other.from;
                    const CornerRange too = keysOf(other, x);
                    if (e.third != w && back->third != w &&
                        std::max({here.first, there.first, too.first}) <= std::min({here.last, there.last, too.last}))
                        return true;
                }
            }
        }
        return false;
    }

    /// Which V leave it possible that the edge is in the bucket of its end x.
    [[nodiscard]] CornerRange keysOf(const LateEdge& e, std::uint32_t x) const {
        const CornerRange low = ranges_[x], high = ranges_[e.from == x ? e.to : e.from];
        const std::uint32_t above_third = is_late_[e.third] != 0 ? ranges_[e.third].first + 1 : 0;
        return {std::max({low.first, least_, above_third}), std::min(low.last, high.last - 1)};
    }

    /// V, and its edges.
    [[gnu::cold]] void findBucket() {
        findExactly([&](std::uint32_t node) { return ranges_[node].last >= least_; });
        for (const LateEdge& e : edges_) {
            const std::uint32_t from = ranges_[e.from].first, to = ranges_[e.to].first, low = std::min(from, to);
            if (low < key_) continue;
            if (low > key_) bucket_.drop(bucket_.size());
            key_ = low;
            if (from < to) {
                bucket_.push({.high = to, .high_node = e.to, .half_edge = e.half_edge, .ascending = true});
                low_node_ = e.from;
            } else {
                bucket_.push({.high = from, .high_node = e.from, .half_edge = e.half_edge, .ascending = false});
                low_node_ = e.to;
            }
        }
    }

    /// Only where there are more than two half-edges, and an edge in both directions. Leaves the bucket sorted by
    /// higher ends, then half-edges.
    [[gnu::cold]] bool orderMatters() {
        if (bucket_.size() <= 2) return false;
        sortEdges(bucket_.begin(), bucket_.end(), true);
        for (std::size_t i = 1; i < bucket_.size(); ++i) {
            if (bucket_[i].high == bucket_[i - 1].high && bucket_[i].ascending != bucket_[i - 1].ascending) return true;
        }
        return false;
    }

    /// Leaves the bucket in the order in which the reference meets its edges.
    [[gnu::cold]] bool sortAsReference() {
        if (!order_) order_.emplace(mesh_, triangles_, nodes_, allocator_, parallel_);
        order_->findAll(representatives_.data());
        Growing<Record> records(allocator_);
        records.reserve(3 * triangles_.count);
        for (std::uint32_t t = 0; t < triangles_.count; ++t) {
            if (!isGood(t)) continue;
            const std::uint32_t r[] = {representatives_[nodeAt(3 * t)], representatives_[nodeAt(3 * t + 1)],
                                       representatives_[nodeAt(3 * t + 2)]};
            for (std::uint32_t k = 0; k < 3; ++k) records.push({std::min(r[k], r[(k + 1) % 3]), 3 * t + k});
        }
        if (!EdgeSort({records.begin(), records.size()}, key_).run()) return false;
        sortEdges(bucket_.begin(), bucket_.end(), false);
        Growing<BucketEdge> ordered(allocator_);
        for (std::size_t i = records.size() - bucket_.size(); i < records.size(); ++i) {
            ordered.push(*std::lower_bound(bucket_.begin(), bucket_.end(), records[i].half_edge,
                                           [](const BucketEdge& e, std::uint32_t h) { return e.half_edge < h; }));
        }
        bucket_ = std::move(ordered);
        // Runs of one higher end are sorted by triangle, but for the very last run.
        for (std::size_t begin = 0, end = 0; begin < bucket_.size(); begin = end) {
            end = endOfRun(begin);
            if (end == bucket_.size()) break;
            sortEdges(bucket_.begin() + begin, bucket_.begin() + end, false);
        }
        return true;
    }

    [[nodiscard]] std::size_t endOfRun(std::size_t begin) const {
        std::size_t end = begin + 1;
        while (end < bucket_.size() && bucket_[end].high == bucket_[begin].high) ++end;
        return end;
    }

    /// Within a run the oldest waiting half-edge of the opposite direction is the partner (see groups.h);
    /// runs know nothing of each other.
    [[gnu::cold]] void pairUp(std::uint32_t BucketEdge::*partner) {
        for (std::size_t begin = 0, end = 0; begin < bucket_.size(); begin = end) {
            end = endOfRun(begin);
            std::size_t waiting = begin;  // no half-edge before it waits
            for (std::size_t i = begin; i < end; ++i) {
                while (waiting < i && bucket_[waiting].*partner != kNone) ++waiting;
                if (waiting == i || bucket_[waiting].ascending == bucket_[i].ascending) continue;
                bucket_[waiting].*partner = bucket_[i].half_edge;
                bucket_[i].*partner = bucket_[waiting].half_edge;
            }
        }
    }

    [[gnu::cold]] void listChanges(LastBucket& result, const Allocator* kept) {
        sortEdges(bucket_.begin(), bucket_.end(), false);
        Growing<std::uint32_t> half_edges(kept), partners(kept), nodes(kept);
        for (const BucketEdge& e : bucket_) {
            if (e.usual == e.partner) continue;
            half_edges.push(e.half_edge);
            partners.push(e.partner);
            nodes.push(e.high_node);
        }
        if (half_edges.empty()) return;
        nodes.push(low_node_);
        sortList(nodes.begin(), nodes.end(), std::less<>());
        result.half_edges = half_edges.exact();
        result.partners = partners.exact();
        result.nodes = nodes.exact();
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    Marks is_late_;                          // one per node
    Buffer<CornerRange> ranges_;             // one per node; set for late ones
    Buffer<std::uint32_t> representatives_;  // one per node; set where somebody asks
    Growing<LateTriangle> around_;           // triangles at late nodes
    std::optional<GridOrder> order_;
    Growing<LateEdge> edges_;
    std::uint32_t least_ = 0;     // L
    std::uint32_t key_ = 0;       // V
    std::uint32_t low_node_ = 0;  // whose representative it is
    Growing<BucketEdge> bucket_;
};

}  // namespace

LastBucket findLastBucket(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                          const Allocator* transient, const Allocator* allocator, Parallel& parallel) {
    if (triangles.count == 0) return {};
    return BucketFinder(mesh, triangles, nodes, transient, parallel).run(allocator);
}

}  // namespace tspace::mikk
