// SPDX-License-Identifier: MIT
// Step 5: whether the last bucket of the reference's edge list can matter.
//
// An edge's key is the lower one of its two nodes' representatives (which are corners), and the last bucket
// holds the edges with the largest key, V. Where are they? Let F be the first corner of some triangles at the
// end of the list, so that corners from F on are in these triangles only, and S the nodes that have such a
// corner.
//
//   If V >= F, both ends of every edge of the last bucket are in S: the lower end's representative is V, the
//   higher end's is larger, and a node's representative is one of its corners.
//
// So it is enough to look at edges with both ends in S. Let L be the largest key among them. V >= L, since
// they are edges of the mesh. If L >= F, then V >= F, all of the bucket is among them, and V = L. Else V < F
// (otherwise V would be the key of one of them), and the end of the list has to be taken longer; with the
// whole list F is its first corner.
//
// Few triangles are enough, nearly always: in a mesh in natural order most nodes of the last ones have no
// other corners; in a mesh without order each edge of a late triangle has its key there once in 36 times.
//
// For a small mesh there is a shorter way. The first and the last corner of a node are bounds of its
// representative, so those of the late nodes give a lower bound of V. If it is not below F, S can be the
// nodes whose last corner is not below that bound: a handful. Where their edges cannot matter, whatever the
// representatives, nobody asks for those.
#include "tangents/mikktspace/tail_check.h"

#include <algorithm>
#include <utility>

#include "core/vec_math.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld_order.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kFirstTail = 24;  // triangles
constexpr std::size_t kLonger = 4;      // times, when that was not enough
constexpr std::size_t kManyEdges = 512;
constexpr std::size_t kFewEntries = 4096;     // of the corner list; then late nodes get bounds
constexpr std::size_t kFirstBoundedTail = 8;  // triangles; of those

/// The first and the last corner of a node.
struct CornerRange {
    std::uint32_t first, last;
};

/// A half-edge with both ends in S.
struct LateEdge {
    std::uint32_t from, to;  // nodes
    std::uint32_t third;     // of the triangle; only on the shorter way
};

class TailCheck {
  public:
    TailCheck(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
              Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          allocator_(allocator),
          parallel_(parallel),
          late_nodes_(noMarks(allocator, nodes.count)),
          late_vertices_(allocator),
          representatives_(allocator, nodes.count),
          edges_(allocator),
          tail_nodes_(allocator),
          shared_(allocator),
          records_(allocator),
          suspects_(allocator) {}

    bool run() {
        if (3 * triangles_.count <= kFewEntries) {
            const std::uint32_t least = leastKey();
            if (findEdgesByBounds(least)) {
                if (!findSuspects(least)) return false;
                const WeldOrder order(mesh_, triangles_, nodes_, allocator_, parallel_);
                if (!narrowSuspects(order, least)) return false;
                findKey(order);
                return bucketMatters();
            }
            std::fill(late_nodes_.begin(), late_nodes_.end(), std::uint8_t{0});
        }
        const WeldOrder order(mesh_, triangles_, nodes_, allocator_, parallel_);
        std::size_t end = triangles_.count;
        for (std::size_t length = kFirstTail;; length *= kLonger) {
            const std::size_t begin = tailOf(length);
            addNodes(begin, end);
            findEdges(order);
            if (!edges_.empty() && key_ >= firstCorner(begin)) break;
            if (begin == 0) return false;  // no edge at all
            end = begin;
        }
        return bucketMatters();
    }

  private:
    /// A lower bound of V, not below F: the key of some edge is not below the first corners of its nodes. 0
    /// when there is no edge. Leaves bounds of all nodes with corners from F on.
    std::uint32_t leastKey() {
        bounds_ = Buffer<CornerRange>(allocator_, nodes_.count);
        for (std::size_t length = kFirstBoundedTail;; length *= kLonger) {
            tail_ = tailOf(length);
            std::uint32_t least = 0;
            withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
                findBounds(vertexOf);
                for (std::size_t t = tail_; t < triangles_.count; ++t) {
                    const auto first = [&](std::size_t k) {
                        return bounds_[nodes_.ofVertex(vertexOf(3 * t + k))].first;
                    };
                    const std::uint32_t a = first(0), b = first(1), c = first(2);
                    const std::uint32_t middle = std::max(std::min(a, b), std::min(std::max(a, b), c));
                    if (middle > least && isGood(t, vertexOf)) least = middle;
                }
            });
            if (tail_ == 0 || least >= firstCorner(tail_)) return least;
            for (const std::uint32_t node : tail_nodes_) late_nodes_[node] = 0;
            tail_nodes_.drop(tail_nodes_.size());
            shared_.drop(shared_.size());
        }
    }

    /// The bounds of the nodes that triangles from tail_ on have, and the triangles before it that have two
    /// of these or more.
    template <class VertexOf>
    void findBounds(const VertexOf& vertexOf) {
        for (std::size_t i = 3 * tail_; i < 3 * triangles_.count; ++i) {
            const std::uint32_t node = nodes_.ofVertex(vertexOf(i)), corner = triangles_.corner(i);
            if (std::exchange(late_nodes_[node], std::uint8_t{1}) == 0) {
                bounds_[node] = {corner, corner};
                tail_nodes_.push(node);
            }
            widen(node, corner);
        }
        for (std::size_t t = 0; t < tail_; ++t) {
            const std::uint32_t n[3] = {nodes_.ofVertex(vertexOf(3 * t)), nodes_.ofVertex(vertexOf(3 * t + 1)),
                                        nodes_.ofVertex(vertexOf(3 * t + 2))};
            const unsigned late_count = late_nodes_[n[0]] + late_nodes_[n[1]] + late_nodes_[n[2]];
            if (late_count == 0) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                if (late_nodes_[n[k]] != 0) widen(n[k], triangles_.corner(3 * t + k));
            }
            if (late_count > 1) shared_.push(static_cast<std::uint32_t>(t));
        }
    }

    void widen(std::uint32_t node, std::uint32_t corner) {
        CornerRange& range = bounds_[node];
        range = {std::min(range.first, corner), std::max(range.last, corner)};
    }

    /// Returns false when there are too many to be worth it.
    bool findEdgesByBounds(std::uint32_t least) {
        for (const std::uint32_t node : tail_nodes_) late_nodes_[node] = bounds_[node].last >= least ? 1 : 0;
        withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
            for (const std::uint32_t t : shared_) addEdges(t, vertexOf);
            for (std::size_t t = tail_; t < triangles_.count && edges_.size() <= kManyEdges; ++t) addEdges(t, vertexOf);
        });
        return edges_.size() <= kManyEdges;
    }

    /// Those of a triangle.
    template <class VertexOf>
    void addEdges(std::size_t t, const VertexOf& vertexOf) {
        const auto nodeOf = [&](std::size_t k) { return nodes_.ofVertex(vertexOf(3 * t + k)); };
        const std::uint32_t a = nodeOf(0), b = nodeOf(1), c = nodeOf(2);
        if (late_nodes_[a] + late_nodes_[b] + late_nodes_[c] < 2 || !isGood(t, vertexOf)) return;
        const auto add = [&](std::uint32_t from, std::uint32_t to, std::uint32_t third) {
            if (late_nodes_[from] + late_nodes_[to] == 2) edges_.push({from, to, third});
        };
        add(a, b, c);
        add(b, c, a);
        add(c, a, b);
    }

    /// What an edge is in the bucket of its lower node.
    struct BoundedRecord {
        std::uint64_t key;    // the lower node, the higher one, 1 for an edge from that to this
        std::uint32_t third;  // the third node of the triangle

        [[nodiscard]] std::uint32_t low() const { return static_cast<std::uint32_t>(key >> 32); }
        [[nodiscard]] std::uint32_t high() const { return static_cast<std::uint32_t>(key) >> 1; }
    };
    using Records = std::span<const BoundedRecord>;

    /// Whether some node may have the last bucket, and that bucket may matter: finds all of them.
    bool findSuspects(std::uint32_t least) {
        records_.reserve(2 * edges_.size());
        const auto add = [&](std::uint32_t low, std::uint32_t high, std::uint32_t third, std::uint32_t ascends) {
            if (bounds_[low].first < bounds_[high].last)
                records_.push({std::uint64_t{low} << 32 | high << 1 | ascends, third});
        };
        for (const LateEdge& e : edges_) {
            add(e.from, e.to, e.third, 1);
            add(e.to, e.from, e.third, 0);
        }
        std::sort(records_.begin(), records_.end(),
                  [](const BoundedRecord& a, const BoundedRecord& b) { return a.key < b.key; });
        for (std::size_t begin = 0, end = 0; begin < records_.size(); begin = end) {
            for (end = begin + 1; end < records_.size() && records_[end].low() == records_[begin].low();) ++end;
            const Records bucket(records_.begin() + begin, end - begin);
            if (mayMatter(bucket, least)) suspects_.push(bucket);
        }
        return !suspects_.empty();
    }

    /// Gives suspects their representatives as bounds: often that is enough, and takes less than to find
    /// those of all neighbours. Returns whether any suspicion is left.
    bool narrowSuspects(const WeldOrder& order, std::uint32_t least) {
        for (const Records& bucket : suspects_) late_vertices_.push(mesh_.indices[bounds_[bucket.front().low()].first]);
        order.findSome({late_vertices_.begin(), late_vertices_.size()}, representatives_.data());
        late_vertices_.drop(late_vertices_.size());
        for (const Records& bucket : suspects_) {
            const std::uint32_t node = bucket.front().low();
            bounds_[node] = {representatives_[node], representatives_[node]};
        }
        return std::any_of(suspects_.begin(), suspects_.end(),
                           [&](const Records& bucket) { return mayMatter(bucket, least); });
    }

    /// The edges of one node x to nodes that may be higher. If x has the last bucket, V is its
    /// representative, and a triangle at x that has a higher node has a lower one as well: otherwise the edge
    /// between those two would have a larger key. So neighbours are higher, or not, by far not as they like.
    /// For the bucket to matter, an edge to one of them must be there in both directions, and another one, to
    /// the same or another neighbour.
    [[nodiscard]] bool mayMatter(Records records, std::uint32_t least) const {
        constexpr std::size_t kMany = 64;
        if (records.size() <= 2) return false;
        if (records.size() > kMany) return true;
        const CornerRange x = bounds_[records.front().low()];
        struct Neighbor {
            const BoundedRecord *begin, *end;
            std::uint32_t node, lowest, highest;  // these of V, when this neighbour is higher
            bool is_both;
        } neighbors[kMany];
        std::size_t count = 0;
        for (std::size_t begin = 0, end = 0; begin < records.size(); begin = end) {
            const std::uint32_t high = records[begin].high();
            std::uint32_t lowest = std::max(x.first, least), highest = std::min(x.last, bounds_[high].last - 1);
            for (end = begin; end < records.size() && records[end].high() == high; ++end) {
                const std::uint32_t third = records[end].third;
                if (late_nodes_[third] != 0) lowest = std::max(lowest, bounds_[third].first + 1);
            }
            if (lowest > highest) continue;
            const bool is_both = ((records[begin].key ^ records[end - 1].key) & 1) != 0;
            if (is_both && end - begin > 2) return true;
            neighbors[count++] = {records.data() + begin, records.data() + end, high, lowest, highest, is_both};
        }
        for (std::size_t i = 1; i < count; ++i) {
            const Neighbor& y = neighbors[i];
            for (std::size_t j = 0; j < i; ++j) {
                const Neighbor& w = neighbors[j];
                if (!y.is_both && !w.is_both) continue;
                if (std::max(y.lowest, w.lowest) > std::min(y.highest, w.highest)) continue;
                if (std::none_of(y.begin, y.end, [&](const BoundedRecord& r) { return r.third == w.node; }))
                    return true;
            }
        }
        return false;
    }

    /// The representatives of all nodes that edges have, and V.
    void findKey(const WeldOrder& order) {
        std::fill(late_nodes_.begin(), late_nodes_.end(), std::uint8_t{0});
        const auto want = [&](std::uint32_t node) {
            if (std::exchange(late_nodes_[node], std::uint8_t{1}) != 0) return;
            const CornerRange range = bounds_[node];
            representatives_[node] = range.first;
            if (range.first != range.last) late_vertices_.push(mesh_.indices[range.first]);
        };
        for (const LateEdge& e : edges_) {
            want(e.from);
            want(e.to);
        }
        if (!late_vertices_.empty())
            order.findSome({late_vertices_.begin(), late_vertices_.size()}, representatives_.data());
        key_ = 0;
        for (const LateEdge& e : edges_) key_ = std::max(key_, keyOf(e));
    }

    /// Where the last `length` triangles begin, or a few more: a face is not cut in two.
    [[nodiscard]] std::size_t tailOf(std::size_t length) const {
        if (length >= triangles_.count) return 0;
        std::size_t begin = triangles_.count - length;
        while (begin > 0 && triangles_.face(begin - 1) == triangles_.face(begin)) --begin;
        return begin;
    }

    /// F: a face's first corner is in one of its triangles.
    [[nodiscard]] std::uint32_t firstCorner(std::size_t triangle) const {
        std::uint32_t first = kNone;
        for (std::size_t t = triangle; t < triangles_.count && triangles_.face(t) == triangles_.face(triangle); ++t) {
            for (std::size_t k = 0; k < 3; ++k) first = std::min(first, triangles_.corner(3 * t + k));
        }
        return first;
    }

    [[nodiscard]] std::uint32_t nodeAt(std::size_t entry) const { return nodes_.of(mesh_, triangles_.corner(entry)); }

    template <class VertexOf>
    [[nodiscard]] bool isGood(std::size_t triangle, const VertexOf& vertexOf) const {
        const auto at = [&](std::size_t k) { return mesh_.positions[vertexOf(3 * triangle + k)]; };
        const Vec3 a = at(0), b = at(1), c = at(2);
        return !(a == b || b == c || c == a);
    }

    /// Adds the nodes of triangles to S.
    void addNodes(std::size_t begin, std::size_t end) {
        for (std::size_t entry = 3 * begin; entry < 3 * end; ++entry) {
            const std::uint32_t node = nodeAt(entry);
            if (late_nodes_[node] != 0) continue;
            late_nodes_[node] = 1;
            late_vertices_.push(mesh_.indices[triangles_.corner(entry)]);
        }
    }

    /// The edges that have both ends in S, and L.
    void findEdges(const WeldOrder& order) {
        Growing<std::uint32_t> shared(allocator_);
        order.findSome({late_vertices_.begin(), late_vertices_.size()}, representatives_.data(), &shared);
        edges_.drop(edges_.size());
        key_ = 0;
        for (const std::uint32_t t : shared) {
            if (!isGood(t, [&](std::size_t i) { return mesh_.indices[triangles_.corner(i)]; })) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t from = 3 * std::size_t{t} + k, to = k == 2 ? from - 2 : from + 1;
                const LateEdge edge{nodeAt(from), nodeAt(to), kNone};
                if (late_nodes_[edge.from] == 0 || late_nodes_[edge.to] == 0) continue;
                edges_.push(edge);
                key_ = std::max(key_, keyOf(edge));
            }
        }
    }

    [[nodiscard]] std::uint32_t keyOf(const LateEdge& e) const {
        return std::min(representatives_[e.from], representatives_[e.to]);
    }

    bool bucketMatters() {
        struct Record {
            std::uint32_t high;
            bool ascending;
        };
        Growing<Record> bucket(allocator_);
        for (const LateEdge& e : edges_) {
            if (keyOf(e) != key_) continue;
            const bool ascending = representatives_[e.from] < representatives_[e.to];
            bucket.push({ascending ? e.to : e.from, ascending});
        }
        if (bucket.size() <= 2) return false;
        std::sort(bucket.begin(), bucket.end(), [](const Record& a, const Record& b) {
            return a.high != b.high ? a.high < b.high : a.ascending < b.ascending;
        });
        for (std::size_t i = 1; i < bucket.size(); ++i) {
            if (bucket[i].high == bucket[i - 1].high && bucket[i].ascending != bucket[i - 1].ascending) return true;
        }
        return false;
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    Marks late_nodes_;                      // 1: in S
    Growing<std::uint32_t> late_vertices_;  // a vertex of each node in S
    Buffer<std::uint32_t> representatives_;
    Growing<LateEdge> edges_;
    // On the shorter way:
    std::size_t tail_ = 0;               // the first of the triangles whose nodes have bounds
    Growing<std::uint32_t> tail_nodes_;  // these nodes
    Growing<std::uint32_t> shared_;      // triangles before tail_ with two of them or more
    Buffer<CornerRange> bounds_;         // one per node
    Growing<BoundedRecord> records_;
    Growing<Records> suspects_;  // buckets that may be the last one and matter
    std::uint32_t key_ = 0;      // L, and V in the end
};

}  // namespace

bool tailMayMatter(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
                   Parallel& parallel) {
    if (!nodes.all_finite) return true;
    if (triangles.count == 0) return false;
    return TailCheck(mesh, triangles, nodes, allocator, parallel).run();
}

}  // namespace tspace::mikk
