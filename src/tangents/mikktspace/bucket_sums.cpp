// SPDX-License-Identifier: MIT
// The sums of all nodes of a mesh in random order, bucket by bucket (node_buckets.h): each sum is made in the
// order of triangles, and all that it needs is in the second cache. Triangles with nodes in several buckets
// are computed for each.
#include "tangents/mikktspace/bucket_sums.h"

#include <algorithm>
#include <atomic>

#include "tangents/mikktspace/add_row.h"
#include "tangents/mikktspace/fan_list.h"

namespace tspace::mikk {

namespace {

/// A node while its bucket is worked on.
struct alignas(32) OpenNode {
    float s[4];
    std::uint32_t marks;
    std::uint32_t listed;    ///< corners in `list`
    std::uint32_t followed;  ///< 1: there were more; those before are in the node's fan
    FanList list;

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
                 NodeSums& sums, OpenNode* open, std::size_t open_count, FanRoom fan_room)
        : buckets_(buckets),
          nodes_(nodes),
          source_(source),
          compute_(terms),
          sums_(sums),
          open_(open),
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
        for (std::size_t n = first; n < end; ++n) close(n);
    }

    std::uint64_t degenerate_count = 0, no_uv_area_count = 0, mirrored_count = 0;

  private:
    [[nodiscard]] bool owns(std::uint32_t node) const { return node - first_node_ < node_count_; }

    void compute(const BucketChunk& chunk, std::size_t count) {
        if (nodes_.vertices.empty()) {
            compute_(source_, chunk.nodes, count, terms_);
        } else {
            std::uint32_t vertices[kTermCorners];
            for (std::size_t i = 0; i < kTermCorners; ++i) vertices[i] = nodes_.vertices[chunk.nodes[i]];
            compute_(source_, vertices, count, terms_);
        }
        degenerate_count += terms_.degenerate_count;
        no_uv_area_count += terms_.no_uv_area_count;
        mirrored_count += terms_.mirrored_count;
        std::uint32_t any = 0;
        for (std::size_t t = 0; t < count; ++t) any |= chunk.triangles[t];
        if ((any & kMark) != 0) discount(chunk, count);
    }

    /// Each triangle is counted in the bucket of its first node only.
    void discount(const BucketChunk& chunk, std::size_t count) {
        for (std::size_t t = 0; t < count; ++t) {
            if ((chunk.triangles[t] & kMark) == 0) continue;
            const std::uint32_t m = terms_.marks[0][t];
            const bool degenerate = (m & kDegenerateMark) != 0, flat = !degenerate && (m & kNoUvArea) != 0;
            degenerate_count -= degenerate ? 1 : 0;
            no_uv_area_count -= flat ? 1 : 0;
            mirrored_count -= !degenerate && !flat && (m & kFacesDown) != 0 ? 1 : 0;
        }
    }

    template <Sums kSums>
    void add(const BucketChunk& chunk, std::size_t count) {
        for (std::size_t t = 0; t < count; ++t) {
            const std::uint32_t* n = chunk.nodes + 3 * t;
            if ((terms_.marks[0][t] & (kDegenerateMark | kNoUvArea)) != 0) [[unlikely]] {
                addUnusual(chunk, t);
                continue;
            }
            addCorner<kSums>(t, 0, n[0], n[1], n[2]);
            addCorner<kSums>(t, 1, n[1], n[2], n[0]);
            addCorner<kSums>(t, 2, n[2], n[0], n[1]);
        }
    }

    /// Triangles that add nothing to the sums. Nodes of degenerate ones are left to the general steps.
    void addUnusual(const BucketChunk& chunk, std::size_t t) {
        const std::uint32_t* n = chunk.nodes + 3 * t;
        const bool degenerate = (terms_.marks[0][t] & kDegenerateMark) != 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!owns(n[k])) continue;
            OpenNode& node = open_[n[k] - first_node_];
            if (degenerate) {
                node.marks = 0;
            } else {
                list(node, n[k], n[(k + 1) % 3], n[(k + 2) % 3]);
            }
        }
        if (!degenerate && owns(n[0])) sums_.flat[chunk.triangles[t]] = 1;
    }

    template <Sums kSums>
    void addCorner(std::size_t t, std::size_t k, std::uint32_t number, std::uint32_t next, std::uint32_t previous) {
        if (!owns(number)) return;
        OpenNode& node = open_[number - first_node_];
        const std::size_t row = 3 * t + k;
        if constexpr (kSums != Sums::none) addRow(node.s, terms_.s[row]);  // and the weight
        node.marks &= terms_.marks[k][t];
        list(node, number, next, previous);
        if constexpr (kSums == Sums::all) {
            addRow(sums_.rest[number].t, terms_.t[row]);
            sums_.lengths_t[number] += terms_.lengths_t[k][t];
        }
    }

    void list(OpenNode& node, std::uint32_t number, std::uint32_t next, std::uint32_t previous) {
        if (node.listed == FanList::kMost) [[unlikely]]
            follow(node, number);
        node.list.next[node.listed] = next;
        node.list.previous[node.listed++] = previous;
    }

    /// Nodes of many corners: a list that is full is followed as it lies, and begun anew.
    [[gnu::noinline]] void follow(OpenNode& node, std::uint32_t number) {
        Fan& fan = sums_.nodes[number].fan;
        if (node.followed == 0) fan = Fan{};
        node.followed = 1;
        for (std::uint32_t i = 0; i < node.listed; ++i) {
            if (!fan.add(node.list.next[i], node.list.previous[i], fan_room_)) node.marks &= ~kFanKnown;
        }
        node.listed = 0;
    }

    void close(std::size_t number) {
        OpenNode& node = open_[number - first_node_];
        NodeSum& sum = sums_.nodes[number];
        if (node.followed != 0) [[unlikely]] {
            follow(node, static_cast<std::uint32_t>(number));
        } else {
            sum.fan = Fan{};
            if (node.listed != 0) {
                sum.fan.leaves[0] = sum.fan.arrives[0] = Fan::kClosed;
                if (!isOneFan(node.list, node.listed)) node.marks &= ~kFanKnown;
            }
        }
        std::copy_n(node.s, 4, sum.s);
        sums_.marks[number] = static_cast<std::uint16_t>(node.marks);
        node.clear();
    }

    const NodeBuckets& buckets_;
    const Nodes& nodes_;
    const CornerSource& source_;
    CornerTermsFunction compute_;
    NodeSums& sums_;
    OpenNode* open_;  // one for each node of a bucket
    FanRoom fan_room_;
    std::uint32_t first_node_ = 0, node_count_ = 0;
    CornerTerms terms_;
};

}  // namespace

void sumBuckets(const NodeBuckets& buckets, const Nodes& nodes, const CornerSource& source, CornerTermsFunction terms,
                NodeSums& sums, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kFans = 256;  // of more than two paths at a time, in one bucket
    struct Counts {
        std::uint64_t degenerate, no_uv_area, mirrored;
    };
    const std::size_t tasks = std::clamp<std::size_t>(buckets.count(), 1, parallel.width());
    const std::size_t nodes_each = buckets.endNode(0);
    Buffer<Counts> counts(allocator, tasks);
    Buffer<OpenNode> open(allocator, tasks * nodes_each);
    Buffer<ManyPaths> many_paths(allocator, tasks * kFans);
    std::atomic<std::size_t> next{0};
    parallel.forTasks(tasks, [&](std::size_t task) {
        BucketSummer summer(buckets, nodes, source, terms, sums, open.data() + task * nodes_each, nodes_each,
                            {many_paths.data() + task * kFans, kFans});
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
