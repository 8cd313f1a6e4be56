// SPDX-License-Identifier: MIT
// The sums of all nodes of a mesh in random order, bucket by bucket (node_buckets.h): each sum is made in the
// order of triangles, and all that it needs is in the second cache. Triangles with nodes in several buckets
// are computed for each.
#include "tangents/mikktspace/bucket_sums.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>

#include "core/add_row.h"
#include "tangents/mikktspace/fan_list.h"

namespace tspace::mikk {

namespace {

/// A node while its bucket is worked on: a cache line.
struct alignas(64) OpenNode {
    float s[4];
    FanList list;
    std::uint32_t marks;
    std::uint32_t listed;    ///< corners in `list`
    std::uint32_t followed;  ///< 1: there were more, or distant ones; those before are in the node's fan

    void clear() {
        for (float& x : s) x = 0;
        marks = kAllMarks;
        listed = followed = 0;
        list.clear();
    }
};

enum class Sums { none, tangents, all };

class BucketSummer {
  public:
    BucketSummer(const NodeBuckets& buckets, const Nodes& nodes, const CornerSource& source, CornerTermsFunction terms,
                 NodeSums& sums, const FinishNodes& finish, OpenNode* open, Fan* fans, std::size_t open_count,
                 FanRoom fan_room)
        : buckets_(buckets),
          nodes_(nodes),
          source_(source),
          compute_(terms),
          sums_(sums),
          finish_(finish),
          open_(open),
          fans_(fans),
          fan_room_(fan_room) {
        for (std::size_t i = 0; i < open_count; ++i) open_[i].clear();
    }

    void run(std::size_t bucket) {
        const std::size_t first = buckets_.firstNode(bucket), end = buckets_.endNode(bucket);
        first_node_ = static_cast<std::uint32_t>(first);
        node_count_ = static_cast<std::uint32_t>(end - first);
        if (!sums_.rest.empty()) {
            std::fill_n(sums_.rest.data() + first, node_count_, NodeRest{});
            std::fill_n(sums_.lengths_t.data() + first, node_count_, 0.0f);
        }
        buckets_.forEachChunk(bucket, [&](const BucketChunk& chunk, std::size_t count) {
            compute(chunk, count);
            if (source_.weighting == Weighting::none) {
                add<Sums::none>(chunk, count);
            } else if (sums_.rest.empty()) {
                add<Sums::tangents>(chunk, count);
            } else {
                add<Sums::all>(chunk, count);
            }
        });
        for (std::uint32_t n = 0; n < node_count_; ++n) close(n);
        finish_(first, end);
    }

    std::uint64_t degenerate_count = 0, no_uv_area_count = 0, mirrored_count = 0;

  private:
    void compute(const BucketChunk& chunk, std::size_t count) {
        // Three numbers of each triangle, side by side. A fourth one is written, and written over by the next.
        std::uint32_t vertices[kTermCorners + 1];
        for (std::size_t i = 0; i < BucketChunk::kTriangles; ++i)
            std::memcpy(vertices + 3 * i, &chunk.triangles[i], sizeof(BucketTriangle));
        for (std::size_t i = 0; !nodes_.vertices.empty() && i < kTermCorners; ++i)
            vertices[i] = nodes_.vertices[vertices[i]];
        compute_(source_, vertices, count, terms_);
        degenerate_count += terms_.degenerate_count;
        no_uv_area_count += terms_.no_uv_area_count;
        mirrored_count += terms_.mirrored_count;
        std::uint32_t any = 0;
        for (std::size_t t = 0; t < count; ++t) any |= chunk.triangles[t].number;
        if ((any & kMark) != 0) discount(chunk, count);
    }

    /// Each triangle is counted in the bucket of its first node only.
    void discount(const BucketChunk& chunk, std::size_t count) {
        std::uint32_t degenerate = 0, flat = 0, mirrored = 0;
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t m = terms_.marks[0][t], counted_elsewhere = chunk.triangles[t].number / kMark;
            const std::uint32_t is_degenerate = m / kDegenerateMark & counted_elsewhere;
            const std::uint32_t is_flat = m / kNoUvArea & ~is_degenerate & counted_elsewhere;
            degenerate += is_degenerate;
            flat += is_flat;
            mirrored += m / kFacesDown & ~is_degenerate & ~is_flat & counted_elsewhere;
        }
        degenerate_count -= degenerate;
        no_uv_area_count -= flat;
        mirrored_count -= mirrored;
    }

    template <Sums kSums>
    void add(const BucketChunk& chunk, std::size_t count) {
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t* n = chunk.triangles[t].nodes;
            const std::uint32_t a = n[0] - first_node_, b = n[1] - first_node_, c = n[2] - first_node_;
            if ((terms_.marks[0][t] & (kDegenerateMark | kNoUvArea)) != 0) [[unlikely]] {
                addUnusual(chunk.triangles[t], t);
            } else if (std::max({a, b, c}) < node_count_) [[likely]] {
                addCorner<kSums>(t, 0, a, b, c);
                addCorner<kSums>(t, 1, b, c, a);
                addCorner<kSums>(t, 2, c, a, b);
            } else {
                addAtBorder<kSums>(t, {a, b, c});
            }
        }
    }

    /// Triangles that add nothing to the sums. Nodes of degenerate ones are left to the vertex path.
    void addUnusual(const BucketTriangle& triangle, std::size_t t) {
        const bool degenerate = (terms_.marks[0][t] & kDegenerateMark) != 0;
        std::uint32_t n[3];
        for (std::size_t k = 0; k < 3; ++k) n[k] = triangle.nodes[k] - first_node_;
        for (std::size_t k = 0; k < 3; ++k) {
            if (n[k] >= node_count_) continue;
            if (degenerate) {
                open_[n[k]].marks = 0;
            } else {
                link(n[k], n[(k + 1) % 3], n[(k + 2) % 3]);
            }
        }
        if (!degenerate && n[0] < node_count_) sums_.flat[triangle.number] = 1;
    }

    /// Triangles with nodes of other buckets. (All nodes are given by their distance from the bucket's first.)
    template <Sums kSums>
    void addAtBorder(std::size_t t, const std::array<std::uint32_t, 3>& n) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (n[k] >= node_count_) continue;
            addTerms<kSums>(t, k, n[k]);
            link(n[k], n[(k + 1) % 3], n[(k + 2) % 3]);
        }
    }

    template <Sums kSums>
    void addCorner(std::size_t t, std::size_t k, std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
        addTerms<kSums>(t, k, node);
        list(node, next, previous);
    }

    template <Sums kSums>
    void addTerms(std::size_t t, std::size_t k, std::uint32_t node) {
        OpenNode& to = open_[node];
        const std::size_t row = 3 * t + k;
        if constexpr (kSums != Sums::none) addRow(to.s, terms_.s[row]);  // and the weight
        to.marks &= terms_.marks[k][t];
        if constexpr (kSums == Sums::all) {
            addRow(sums_.rest[first_node_ + node].t, terms_.t[row]);
            sums_.lengths_t[first_node_ + node] += terms_.lengths_t[k][t];
        }
    }

    /// As list(), for neighbours anywhere.
    void link(std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
        if (FanList::holds(next) && FanList::holds(previous)) {
            list(node, next, previous);
        } else {
            follow(node);
            addToFan(node, next, previous);
        }
    }

    void list(std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
        OpenNode& to = open_[node];
        if (to.listed == FanList::kMost) [[unlikely]]
            follow(node);
        to.list.set(to.listed++, next, previous);
    }

    /// Nodes of many corners, or with distant neighbours: what is listed is followed as it lies, and the list begun
    /// anew.
    [[gnu::noinline]] void follow(std::uint32_t node) {
        OpenNode& from = open_[node];
        if (from.followed == 0) fans_[node] = Fan{};
        from.followed = 1;
        for (std::uint32_t i = 0; i < from.listed; ++i) {
            addToFan(node, static_cast<std::uint32_t>(std::int32_t{from.list.next[i]}),
                     static_cast<std::uint32_t>(std::int32_t{from.list.previous[i]}));
        }
        from.listed = 0;
    }

    void addToFan(std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
        if (!fans_[node].add(first_node_ + next, first_node_ + previous, fan_room_)) open_[node].marks &= ~kFanKnown;
    }

    void close(std::uint32_t node) {
        OpenNode& from = open_[node];
        if (from.followed != 0) [[unlikely]] {
            follow(node);
            if (!fans_[node].isOne()) from.marks &= ~kFanKnown;
        } else if (from.listed != 0 && !isOneFan(from.list, from.listed)) {
            from.marks &= ~kFanKnown;
        }
        std::copy_n(from.s, 4, sums_.rows[first_node_ + node].s);
        sums_.marks[first_node_ + node] = static_cast<std::uint16_t>(from.marks);
        from.clear();
    }

    const NodeBuckets& buckets_;
    const Nodes& nodes_;
    const CornerSource& source_;
    CornerTermsFunction compute_;
    NodeSums& sums_;
    const FinishNodes& finish_;
    OpenNode* open_;  // one for each node of a bucket
    Fan* fans_;       // the same, of those that are followed
    FanRoom fan_room_;
    std::uint32_t first_node_ = 0, node_count_ = 0;
    CornerTerms terms_;
};

}  // namespace

void sumBuckets(const NodeBuckets& buckets, const Nodes& nodes, const CornerSource& source, CornerTermsFunction terms,
                NodeSums& sums, const FinishNodes& finish, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kFans = 256;  // of more than two paths at a time, in one bucket
    struct Counts {
        std::uint64_t degenerate, no_uv_area, mirrored;
    };
    const std::size_t tasks = std::clamp<std::size_t>(buckets.count(), 1, parallel.width());
    const std::size_t nodes_each = buckets.endNode(0);
    Buffer<Counts> counts(allocator, tasks);
    Buffer<OpenNode> open(allocator, tasks * nodes_each);
    Buffer<Fan> fans(allocator, tasks * nodes_each);
    Buffer<ManyPaths> many_paths(allocator, tasks * kFans);
    std::atomic<std::size_t> next{0};
    parallel.forTasks(tasks, [&](std::size_t task) {
        BucketSummer summer(buckets, nodes, source, terms, sums, finish, open.data() + task * nodes_each,
                            fans.data() + task * nodes_each, nodes_each, {many_paths.data() + task * kFans, kFans});
        for (std::size_t bucket = next++; bucket < buckets.count(); bucket = next++) summer.run(bucket);
        counts[task] = {summer.degenerate_count, summer.no_uv_area_count, summer.mirrored_count};
    });
    for (std::size_t task = 0; task < tasks; ++task) {
        sums.degenerate_count += counts[task].degenerate;
        sums.no_uv_area_count += counts[task].no_uv_area;
        sums.mirrored_count += counts[task].mirrored;
    }
}

}  // namespace tspace::mikk
