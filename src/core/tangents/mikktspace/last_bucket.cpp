// SPDX-License-Identifier: MIT
// Finds the last bucket of the reference's edge list, and the links that its order changes.
//
// The key of an edge is the lower one of its two nodes' representatives (which are corners), and the last bucket
// contains the edges with the largest key, V. The largest key in a triangle is the middle one of its three
// representatives. Let F be the lowest corner of some triangles at the end of the list: the representatives of nodes
// outside these triangles are less than F. Therefore, if the representatives of nodes of these triangles yield a key of
// at least F, the largest such key is V, and both ends of all edges of the bucket are among these nodes. Otherwise more
// triangles are needed.
//
// If the order of the bucket can change a link, the reference's first sort (a quicksort with a fixed seed, not stable)
// is replayed.
//
// Every step ends as soon as the remaining work cannot change the result. Gains in instructions of a whole call, on 355
// primitives of real models:
//
// step                    the step ends if                               gain
// mayMatter               no node has three triangles: the order of two  no grid is read for separate triangles and
//                         edges is irrelevant                            quads: 11 to 34 % of a call
// findBucket, 5 or 10     a key of at least F is among the last          5 and 10 instead of 6 and 12: 0.3 % up to 50
// triangles               triangles, as in natural order                 triangles, 0.7 % above 5,000
//   24 if unordered       one in 36 edges of a late triangle has its     20,000 shuffled triangles: 6.8 % more with 10,
//                         key among these triangles                      0.2 % more with 24
//   as far as V / 3       the triangles reach back to the largest key    up to 50 triangles 1.4 %, up to 500 6.8 %,
//                         so far, which is a corner                      above 0.5 % (with shared counters)
// orderMatters            fewer than three half-edges, or no edge in     no replay for nearly all meshes that get this
//                         both directions                                far
// sortRecords             follows only the side of each partition that   about 4 steps per element of a random order,
//                         contains the largest key                       at any size
#include "core/tangents/mikktspace/last_bucket.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <span>
#include <utility>

#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/tangents/mikktspace/grid_order.h"
#include "core/tangents/mikktspace/welded_mesh.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {
namespace {

constexpr std::uint32_t kSeed = 39871946;
/// Maximum number of steps of the replayed sort, per element. A random order needs about 4 steps, because only the side
/// with the last bucket is followed. Only inputs constructed against the fixed seed come close to the limit.
constexpr std::uint64_t kStepsPerElement = 64;

/// An element of the replayed sort.
struct Record {
    std::uint32_t key = 0, half_edge = 0;
};

/// Replays the quicksort as far as it moves records with the largest key. Returns false if the limit of steps is
/// exceeded.
[[gnu::cold]] bool sortRecords(Record* records, std::size_t count, std::uint32_t largest, const Allocator* allocator) {
    struct Range {
        std::int64_t begin, last;
        std::uint32_t seed;
    };
    Growing<Range> waiting(allocator);
    waiting.push({0, static_cast<std::int64_t>(count) - 1, kSeed});
    std::uint64_t steps = kStepsPerElement * count + 1024;
    while (!waiting.empty()) {
        auto [i, j, seed] = waiting[waiting.size() - 1];
        waiting.drop(1);
        if (j <= i) continue;
        const auto begin = i, last = j;
        const auto size = static_cast<std::uint64_t>(last - begin + 1);
        if (size > steps) return false;
        steps -= size;
        if (size == 2) {
            if (records[begin].key > records[last].key) std::swap(records[begin], records[last]);
            continue;
        }
        seed += std::rotl(seed, static_cast<int>(seed & 31)) + 3;
        const std::uint32_t pivot = records[begin + static_cast<std::int64_t>(seed % size)].key;
        do {
            while (records[i].key < pivot) ++i;
            while (records[j].key > pivot) --j;
            if (i <= j) std::swap(records[i++], records[j--]);
        } while (i <= j);
        if (pivot == largest) waiting.push({begin, j, seed});
        waiting.push({i, last, seed});
    }
    return true;
}

/// A half-edge of the last bucket.
struct BucketEdge {
    std::uint32_t high = 0;  // representative of the higher end
    std::uint32_t high_node = 0;
    std::uint32_t half_edge = 0;
    // other half-edge of the edge: with the normal pairing, and as in the reference
    std::uint32_t usual = kNone, partner = kNone;
    bool ascending = false;  // true: the half-edge runs from the smaller to the larger vertex index
};

/// Sorts edges by half-edge, or, with `by_ends`, by higher end first and then by half-edge.
[[gnu::cold]] void sortEdges(BucketEdge* begin, BucketEdge* end, bool by_ends) {
    sortList(begin, end, [=](const BucketEdge& a, const BucketEdge& b) {
        return by_ends && a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
    });
}

/// Returns the largest key of a triangle's edges: the median of the representatives of its nodes.
inline std::uint32_t keyOf(const std::uint32_t* nodes, const std::uint32_t* representatives) {
    const std::uint32_t a = representatives[nodes[0]], b = representatives[nodes[1]], c = representatives[nodes[2]];
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

class BucketFinder {
  public:
    BucketFinder(const WeldedMesh& welded, const Allocator* allocator, Parallel& parallel)
        : in_(welded), allocator_(allocator), parallel_(parallel), representatives_(allocator, welded.nodes.count),
          bucket_(allocator) {}

    /// Returns the links that the bucket changes. `kept`: allocator of the result.
    LastBucket run(const Allocator* kept) {
        LastBucket result;
        if (!mayMatter()) return result;
        findBucket();
        if (!orderMatters()) return result;
        pairUp(&BucketEdge::usual);
        result.abandoned = !sortAsReference();
        if (result.abandoned) return result;
        pairUp(&BucketEdge::partner);
        listChanges(result, kept);
        return result;
    }

  private:
    /// Vertices and nodes of a triangle: pointers into the mesh if possible, otherwise to arrays of this object.
    struct Triangle {
        Triangle(const WeldedMesh& in, std::size_t t)
            : vertices(readTriangles(in.mesh, in.triangles, t, 1, own_vertices)),
              nodes(in.nodes.ofVertices(vertices, 3, own_nodes)) {}
        Triangle(const Triangle&) = delete;

        std::uint32_t own_vertices[3], own_nodes[3];
        const std::uint32_t *vertices, *nodes;
    };

    [[nodiscard]] bool isGood(const Triangle& triangle) const {
        const auto at = [&](std::size_t k) -> const Vec3& { return in_.mesh.positions[triangle.vertices[k]]; };
        return !(at(0) == at(1) || at(1) == at(2) || at(2) == at(0));
    }

    /// Returns whether three edges of the last bucket may share a node. All edges of the bucket share one node, and a
    /// triangle has at most one of these edges: if it had two, the edge between their higher ends would have a larger
    /// key. So three triangles must share a node.
    [[nodiscard]] bool mayMatter() {
        clearRepresentatives();  // the memory is used for counts first
        for (std::size_t t = 0; t < in_.triangles.count; ++t) {
            const Triangle triangle(in_, t);
            for (std::size_t k = 0; k < 3; ++k) {
                if (++representatives_[triangle.nodes[k]] == 3) return clearRepresentatives(), true;
            }
        }
        return false;
    }

    void clearRepresentatives() { std::memset(representatives_.data(), 0, in_.nodes.count * sizeof(std::uint32_t)); }

    /// Returns the start of the last `length` triangles, or a few triangles earlier, so that no face is split.
    [[nodiscard]] std::size_t beginOfLast(std::size_t length) const {
        std::size_t begin = length < in_.triangles.count ? in_.triangles.count - length : 0;
        while (begin > 0 && in_.triangles.face(begin) == in_.triangles.face(begin - 1)) --begin;
        return begin;
    }

    /// Finds the largest key V, and the edges that have it.
    void findBucket() {
        // Initial numbers of triangles at the end of the list, and the factor by which they grow. The table at the top
        // of this file lists the gains.
        constexpr std::size_t kSmallMesh = 4096, kLastOfSmall = 5, kLast = 10, kLastOfRandom = 24, kLonger = 4;
        const std::size_t count = in_.triangles.count;
        std::size_t length = count < kSmallMesh ? kLastOfSmall : kLastOfRandom;
        // In random order, adjacent triangles of the list share no node. Tests the middle of the list, because the end
        // of a real model may consist of leftovers of strips.
        for (std::size_t t = count / 2; length == kLastOfRandom && t < count / 2 + 10; ++t) {
            const Triangle a(in_, t), b(in_, t + 1);
            if (std::find_first_of(a.nodes, a.nodes + 3, b.nodes, b.nodes + 3) != a.nodes + 3) length = kLast;
        }
        std::uint32_t first_corner = kNone;
        for (std::size_t begin = in_.triangles.count; begin != 0 && key_ < first_corner;) {
            const std::size_t end = std::exchange(begin, beginOfLast(length));
            Growing<std::uint32_t> vertices(allocator_);
            for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
                first_corner = std::min(first_corner, in_.triangles.corner(i));
                if (representatives_[in_.nodeAt(i)] == 0) vertices.push(in_.vertexAt(i));
            }
            const Buffer<std::uint32_t> around = findRepresentatives(in_, {vertices.begin(), vertices.size()},
                                                                     representatives_.data(), allocator_, parallel_);
            // Processes triangles in reverse order, because keys are mostly ascending and each larger key empties the
            // bucket.
            for (std::size_t i = around.size(); i-- > 0;) addEdges(around[i]);
            // The triangles from the corner of the largest key to the end of the list are sufficient. The limit is
            // needed because skipped faces have corners too.
            length = std::max(2 * length, std::min(kLonger * length, in_.triangles.count - key_ / 3));
        }
    }

    void addEdges(std::uint32_t t) {
        const std::uint32_t* const representatives = representatives_.data();
        const Triangle triangle(in_, t);
        const std::uint32_t key = keyOf(triangle.nodes, representatives);
        if (key == 0 || key < key_ || !isGood(triangle)) return;
        if (key > key_) bucket_.drop(bucket_.size());
        key_ = key;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = (k + 1) % 3, from = representatives[triangle.nodes[k]],
                                to = representatives[triangle.nodes[next]];
            if (std::min(from, to) != key) continue;
            const std::uint32_t low = from < to ? k : next, high = k + next - low;
            low_node_ = triangle.nodes[low];
            bucket_.push({std::max(from, to), triangle.nodes[high], 3 * t + k, kNone, kNone, from < to});
        }
    }

    /// Returns false if the bucket has at most two half-edges, or no edge in both directions. Leaves the bucket sorted
    /// by higher end, then half-edge, without duplicates.
    [[nodiscard]] bool orderMatters() {
        sortEdges(bucket_.begin(), bucket_.end(), true);
        const auto areOne = [](const BucketEdge& a, const BucketEdge& b) { return a.half_edge == b.half_edge; };
        BucketEdge* const end = std::unique(bucket_.begin(), bucket_.end(), areOne);
        bucket_.drop(static_cast<std::size_t>(bucket_.end() - end));
        if (bucket_.size() <= 2) return false;
        for (std::size_t i = 1; i < bucket_.size(); ++i) {
            if (bucket_[i].high == bucket_[i - 1].high && bucket_[i].ascending != bucket_[i - 1].ascending) return true;
        }
        return false;
    }

    /// Sorts the bucket into the order in which the reference processes its edges. Returns false if the replay was
    /// abandoned.
    [[gnu::cold]] bool sortAsReference() {
        findRepresentatives(in_, numbersBelow(in_.mesh.vertexCount(), allocator_), representatives_.data(), allocator_,
                            parallel_);
        Growing<Record> records(allocator_);
        records.reserve(3 * in_.triangles.count);
        for (std::uint32_t t = 0; t < in_.triangles.count; ++t) {
            const Triangle here(in_, t);
            if (!isGood(here)) continue;
            const auto cornerOf = [&](std::uint32_t k) { return representatives_[here.nodes[k % 3]]; };
            Record* to = records.extend(3);
            for (std::uint32_t k = 0; k < 3; ++k) to[k] = {std::min(cornerOf(k), cornerOf(k + 1)), 3 * t + k};
        }
        if (!sortRecords(records.begin(), records.size(), key_, allocator_)) return false;
        sortEdges(bucket_.begin(), bucket_.end(), false);
        Growing<BucketEdge> ordered(allocator_);
        for (std::size_t i = records.size() - bucket_.size(); i < records.size(); ++i) {
            ordered.push(*std::lower_bound(bucket_.begin(), bucket_.end(), records[i].half_edge,
                                           [](const BucketEdge& e, std::uint32_t h) { return e.half_edge < h; }));
        }
        bucket_ = std::move(ordered);
        // The reference's third sort orders ranges with equal higher ends by triangle, except for the very last range.
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

    /// Pairs half-edges within ranges with equal higher ends, like the reference: the partner is the oldest unpaired
    /// half-edge of the opposite direction (groups.h). Edges with equal ends in two separate ranges are not paired:
    /// this is the defect.
    [[gnu::cold]] void pairUp(std::uint32_t BucketEdge::*partner) {
        for (std::size_t begin = 0, end = 0; begin < bucket_.size(); begin = end) {
            end = endOfRun(begin);
            std::size_t waiting = begin;  // all half-edges before this one are paired
            for (std::size_t i = begin; i < end; ++i) {
                while (waiting < i && bucket_[waiting].*partner != kNone) ++waiting;
                if (waiting == i || bucket_[waiting].ascending == bucket_[i].ascending) continue;
                bucket_[waiting].*partner = bucket_[i].half_edge;
                bucket_[i].*partner = bucket_[waiting].half_edge;
            }
        }
    }

    /// Lists the half-edges whose partner in the reference differs from the usual one.
    [[gnu::cold]] void listChanges(LastBucket& result, const Allocator* kept) {
        sortEdges(bucket_.begin(), bucket_.end(), false);
        Growing<LastBucket::Link> links(kept);
        Growing<std::uint32_t> nodes(kept);
        for (const BucketEdge& e : bucket_) {
            if (e.usual == e.partner) continue;
            links.push({e.half_edge, e.partner});
            nodes.push(e.high_node);
        }
        if (links.empty()) return;
        nodes.push(low_node_);
        sortList(nodes.begin(), nodes.end(), std::less<>());
        result.links = links.exact();
        result.nodes = nodes.exact();
    }

    const WeldedMesh& in_;
    const Allocator* allocator_;
    Parallel& parallel_;
    Buffer<std::uint32_t> representatives_;  // representative of each node; 0: not known yet
    std::uint32_t key_ = 0;                  // the largest key V, which is never 0
    std::uint32_t low_node_ = 0;             // the node that V represents
    Growing<BucketEdge> bucket_;
};

}  // namespace

LastBucket findLastBucket(const WeldedMesh& welded, const Allocator* transient, const Allocator* allocator,
                          Parallel& parallel) {
    if (welded.triangles.count == 0) return {};
    return BucketFinder(welded, transient, parallel).run(allocator);
}

}  // namespace tspace::mikk
