// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/node_buckets.h"

#include <atomic>

#include "tangents/mikktspace/collect.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kMostBuckets = 1024;     // each is a place that is written to
constexpr unsigned kShiftForThreads = 11;      // buckets are not made smaller than this for more threads
constexpr std::size_t kPartTriangles = 16384;  // of a task at least

}  // namespace

/// Puts some triangles where they belong.
class NodeBuckets::Filler {
  public:
    Filler(NodeBuckets& to, List* lists, std::uint32_t* links, std::size_t first_chunk, std::size_t end_chunk)
        : to_(to),
          lists_(lists),
          links_(links),
          next_chunk_(static_cast<std::uint32_t>(first_chunk)),
          end_chunk_(static_cast<std::uint32_t>(end_chunk)) {
        std::fill_n(lists_, to.count_, List{});
    }

    /// Returns false when there is no room left.
    template <class NodeOf>
    bool run(std::size_t begin, std::size_t end, const NodeOf& nodeOf) {
        const unsigned shift = to_.shift_;
        for (std::size_t t = begin; t < end; ++t) {
            const std::uint32_t a = nodeOf(3 * t), b = nodeOf(3 * t + 1), c = nodeOf(3 * t + 2);
            const std::uint32_t at_a = a >> shift, at_b = b >> shift, at_c = c >> shift;
            const auto number = static_cast<std::uint32_t>(t);
            if (!add(at_a, number, a, b, c)) return false;
            if (((at_a ^ at_b) | (at_a ^ at_c)) == 0) [[likely]]
                continue;
            if (at_b != at_a && !add(at_b, number | kMark, a, b, c)) return false;
            if (at_c != at_a && at_c != at_b && !add(at_c, number | kMark, a, b, c)) return false;
        }
        finish();
        return true;
    }

  private:
    bool add(std::size_t bucket, std::uint32_t number, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        List& list = lists_[bucket];
        if (list.used % BucketChunk::kTriangles == 0 && !addChunk(list)) [[unlikely]]
            return false;
        to_.chunks_[list.last].triangles[list.used++] = {{a, b, c}, number};
        return true;
    }

    bool addChunk(List& list) {
        if (next_chunk_ == end_chunk_) return false;
        (list.first == kNone ? list.first : links_[list.last]) = next_chunk_;
        list.last = next_chunk_++;
        list.used = 0;
        return true;
    }

    void finish() {
        for (std::size_t bucket = 0; bucket < to_.count_; ++bucket) {
            const List& list = lists_[bucket];
            if (list.first == kNone) continue;
            links_[list.last] = kNone;
            BucketTriangle* triangles = to_.chunks_[list.last].triangles;
            std::fill(triangles + list.used, triangles + BucketChunk::kTriangles, BucketTriangle{});
        }
    }

    NodeBuckets& to_;
    List* lists_;
    std::uint32_t* links_;
    std::uint32_t next_chunk_, end_chunk_;
};

NodeBuckets::NodeBuckets(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                         const Allocator* allocator, Parallel& parallel)
    : mesh_(mesh),
      triangles_(triangles),
      nodes_(nodes),
      allocator_(allocator),
      parallel_(parallel),
      shift_(nodes.blocks.bucket_shift) {
    const std::size_t few = parallel.width() == 1 ? 0 : 2 * std::size_t{parallel.width()};
    while (shift_ > kShiftForThreads && (nodes.count >> shift_) < few) --shift_;
    while ((nodes.count >> shift_) >= kMostBuckets) ++shift_;
    count_ = (nodes.count >> shift_) + 1;
}

/// Judged by a sample.
bool NodeBuckets::isWorthIt() const {
    constexpr std::size_t kSamples = 1024, kMostFurther = kSamples / 4;
    std::size_t further = 0;  // buckets after the first one
    for (std::size_t i = 0; i < kSamples; ++i) {
        const std::size_t t = triangles_.count * i / kSamples;
        const auto bucketAt = [&](std::size_t k) {
            return nodes_.ofVertex(mesh_.indices[triangles_.corner(3 * t + k)]) >> shift_;
        };
        const std::uint32_t a = bucketAt(0), b = bucketAt(1), c = bucketAt(2);
        further += (b != a ? 1 : 0) + (c != a && c != b ? 1 : 0);
    }
    return further <= kMostFurther;
}

bool NodeBuckets::fill(ScratchBlock& brief) {
    if (!isWorthIt()) return false;
    const std::size_t chunks = std::min<std::size_t>(brief.left() / sizeof(BucketChunk), kNone);
    chunks_ = Buffer<BucketChunk>(brief.allocator(), chunks);
    parts_ = std::clamp<std::size_t>(triangles_.count / kPartTriangles, 1, parallel_.width());
    links_ = Buffer<std::uint32_t>(allocator_, chunks);
    lists_ = Buffer<List>(allocator_, parts_ * count_);
    std::atomic<bool> fits{true};
    withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
        parallel_.forTasks(parts_, [&](std::size_t part) {
            Filler filler(*this, lists_.data() + part * count_, links_.data(), chunks * part / parts_,
                          chunks * (part + 1) / parts_);
            const std::size_t begin = triangles_.count * part / parts_, end = triangles_.count * (part + 1) / parts_;
            const std::uint32_t* node_of = nodes_.of_vertex.data();
            const bool done = node_of == nullptr
                                  ? filler.run(begin, end, vertexOf)
                                  : filler.run(begin, end, [=](std::size_t i) { return node_of[vertexOf(i)]; });
            if (!done) fits = false;
        });
    });
    return fits;
}

}  // namespace tspace::mikk
