// SPDX-License-Identifier: MIT
// The last bucket of the reference's edge list.
//
// An edge's key is the lower one of its two nodes' representatives (which are corners), and the last bucket
// holds the edges with the largest key, V. Where are they? The largest key in a triangle is the middle one of its
// representatives. Let F be the first corner of some triangles at the end of the list: a node of others only has a
// representative below F. So when the representatives of their nodes show a key from F on, the largest one is V, and all
// edges of the bucket have both ends there. Else the end of the list has to be taken longer.
//
// Few triangles are enough, nearly always: in a mesh in natural order most nodes of the last ones have no
// other corners; in a mesh without order each edge of a late triangle has its key there once in 36 times.
//
// Where the order of the bucket can change a link, the reference's first sort (a quicksort with a fixed seed, not
// stable) is replayed to know it.
#include "tangents/mikktspace/last_bucket.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
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

/// An element of the sort.
struct Record {
    std::uint32_t key = 0, half_edge = 0;
};

/// Replays the quicksort as far as it moves records with the largest key. Returns false when the budget is
/// spent.
class EdgeSort {
  public:
    EdgeSort(std::span<Record> records, std::uint32_t largest) : records_(records), largest_(largest) {}

    [[gnu::cold]] bool run(const Allocator* allocator) {
        struct Range {
            std::int64_t begin, last;
            std::uint32_t seed;
        };
        Growing<Range> waiting(allocator);
        waiting.push({0, static_cast<std::int64_t>(records_.size()) - 1, kSeed});
        std::uint64_t steps = kStepsPerElement * records_.size() + 1024;
        while (!waiting.empty()) {
            const auto [begin, last, old_seed] = waiting[waiting.size() - 1];
            waiting.drop(1);
            if (last <= begin) continue;
            const auto size = static_cast<std::uint64_t>(last - begin + 1);
            if (size > steps) return false;
            steps -= size;
            if (size == 2) {
                if (key(begin) > key(last)) std::swap(record(begin), record(last));
                continue;
            }
            const std::uint32_t seed = old_seed + std::rotl(old_seed, static_cast<int>(old_seed & 31)) + 3;
            std::int64_t i = begin, j = last;
            const std::uint32_t pivot = key(begin + static_cast<std::int64_t>(seed % size));
            partition(i, j, pivot);
            if (pivot == largest_) waiting.push({begin, j, seed});
            waiting.push({i, last, seed});
        }
        return true;
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
    BucketFinder(const WeldedMesh& welded, const Allocator* allocator, Parallel& parallel)
        : in_(welded),
          allocator_(allocator),
          parallel_(parallel),
          representatives_(allocator, welded.nodes.count),
          bucket_(allocator) {
        std::memset(representatives_.data(), 0xff, welded.nodes.count * sizeof(std::uint32_t));
    }

    /// `kept`: for the result.
    LastBucket run(const Allocator* kept) {
        LastBucket result;
        if (!hasNodeOfThree()) return result;
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
    struct Triangle {
        std::uint32_t vertices[3], nodes[3];
        std::uint32_t corners[3];  // representatives one up, and 0 where they are not known
        /// The largest key of its edges.
        [[nodiscard]] std::uint32_t key() const {
            const auto [a, b, c] = corners;
            return std::max(std::min(a, b), std::min(std::max(a, b), c));
        }
    };

    [[nodiscard]] Triangle triangle(std::size_t t) const {
        std::uint32_t buffer[3];
        const std::uint32_t* vertices = readTriangles(in_.mesh, in_.triangles, t, 1, buffer);
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.vertices[k] = vertices[k];
            triangle.nodes[k] = in_.nodes.ofVertex(vertices[k]);
            triangle.corners[k] = representatives_[triangle.nodes[k]] + 1;
        }
        return triangle;
    }

    [[nodiscard]] bool isGood(const Triangle& triangle) const {
        const auto at = [&](std::size_t k) -> const Vec3& { return in_.mesh.positions[triangle.vertices[k]]; };
        return !(at(0) == at(1) || at(1) == at(2) || at(2) == at(0));
    }

    /// Whether some node has three corners. All edges of the bucket meet at one node, and a triangle has at most one of
    /// them: between the higher ends of two would be an edge with a larger key. Of two edges the order does not matter.
    [[nodiscard]] bool hasNodeOfThree() const {
        Marks counts = noMarks(allocator_, in_.nodes.count);
        std::uint32_t buffer[kBlockCorners], most = 0;
        for (std::size_t first = 0; most < 3 && first < in_.triangles.count; first += kCollectBlock) {
            const std::size_t count = std::min(kCollectBlock, in_.triangles.count - first);
            const std::uint32_t* vertices = readTriangles(in_.mesh, in_.triangles, first, count, buffer);
            for (std::size_t i = 0; most < 3 && i < 3 * count; ++i)
                most = std::max<std::uint32_t>(most, ++counts[in_.nodes.ofVertex(vertices[i])]);
        }
        return most == 3;
    }

    /// Where the last `length` triangles begin, or a few more: a face is not cut in two.
    [[nodiscard]] std::size_t beginOfLast(std::size_t length) const {
        std::size_t begin = length < in_.triangles.count ? in_.triangles.count - length : 0;
        while (begin > 0 && in_.triangles.face(begin) == in_.triangles.face(begin - 1)) --begin;
        return begin;
    }

    Buffer<std::uint32_t> findRepresentatives(const Buffer<std::uint32_t>& vertices) {
        return mikk::findRepresentatives(in_, {vertices.data(), vertices.size()}, representatives_.data(), allocator_,
                                         parallel_);
    }

    /// V, and its edges.
    void findBucket() {
        constexpr std::size_t kSmallMesh = 4096, kLastOfSmall = 8, kLast = 24;  // triangles
        constexpr std::size_t kLonger = 4;                                      // times, when that was not enough
        std::size_t length = in_.triangles.count < kSmallMesh ? kLastOfSmall : kLast;
        std::uint32_t first_corner = kNone;
        for (std::size_t begin = in_.triangles.count; begin != 0 && key_ <= first_corner; length *= kLonger) {
            begin = beginOfLast(length);
            Buffer<std::uint32_t> vertices(allocator_, 3 * (in_.triangles.count - begin));
            for (std::size_t i = 0; i < vertices.size(); ++i) {
                const std::uint32_t corner = in_.triangles.corner(3 * begin + i);
                first_corner = std::min(first_corner, corner);
                vertices[i] = in_.mesh.indices[corner];
            }
            const Buffer<std::uint32_t> around = findRepresentatives(vertices);
            key_ = 1;
            // Backwards, as keys mostly ascend.
            for (std::size_t i = around.size(); i-- > 0;) addEdges(around[i], triangle(around[i]));
        }
    }

    void addEdges(std::uint32_t t, const Triangle& triangle) {
        const std::uint32_t key = triangle.key();
        if (key < key_ || !isGood(triangle)) return;
        if (key > key_) bucket_.drop(bucket_.size());
        key_ = key;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = (k + 1) % 3, from = triangle.corners[k], to = triangle.corners[next];
            if (std::min(from, to) != key) continue;
            const std::uint32_t low = from < to ? k : next, high = k + next - low;
            low_node_ = triangle.nodes[low];
            bucket_.push({triangle.corners[high], triangle.nodes[high], 3 * t + k, kNone, kNone, from < to});
        }
    }

    /// Only where there are more than two half-edges, and an edge in both directions. Leaves the bucket sorted by
    /// higher ends, then half-edges.
    [[nodiscard]] bool orderMatters() {
        if (bucket_.size() <= 2) return false;
        sortEdges(bucket_.begin(), bucket_.end(), true);
        for (std::size_t i = 1; i < bucket_.size(); ++i) {
            if (bucket_[i].high == bucket_[i - 1].high && bucket_[i].ascending != bucket_[i - 1].ascending) return true;
        }
        return false;
    }

    /// Leaves the bucket in the order in which the reference meets its edges.
    [[gnu::cold]] bool sortAsReference() {
        findRepresentatives(numbersBelow(in_.mesh.vertexCount(), allocator_));
        Growing<Record> records(allocator_);
        records.reserve(3 * in_.triangles.count);
        for (std::uint32_t t = 0; t < in_.triangles.count; ++t) {
            const Triangle here = triangle(t);
            if (!isGood(here)) continue;
            const auto [a, b, c] = here.corners;
            Record* to = records.extend(3);
            to[0] = {std::min(a, b), 3 * t};
            to[1] = {std::min(b, c), 3 * t + 1};
            to[2] = {std::min(c, a), 3 * t + 2};
        }
        if (!EdgeSort({records.begin(), records.size()}, key_).run(allocator_)) return false;
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
    Buffer<std::uint32_t> representatives_;  // one per node; kNone where it is not known
    std::uint32_t key_ = 0;                  // V, one up
    std::uint32_t low_node_ = 0;             // whose representative it is
    Growing<BucketEdge> bucket_;
};

}  // namespace

LastBucket findLastBucket(const WeldedMesh& welded, const Allocator* transient, const Allocator* allocator,
                          Parallel& parallel) {
    if (welded.triangles.count == 0) return {};
    return BucketFinder(welded, transient, parallel).run(allocator);
}

}  // namespace tspace::mikk
