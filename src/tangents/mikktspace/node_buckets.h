// SPDX-License-Identifier: MIT
// The triangles of a mesh in random order, by where their nodes are: each bucket has a range of nodes, and all
// triangles with one of them, in order. A range is so small that all data of its nodes stay in the second
// cache.
#pragma once

#include <algorithm>

#include "core/memory.h"
#include "core/parallel.h"
#include "core/scratch_block.h"
#include "tangents/mikktspace/corner_terms.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/weld.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

struct alignas(16) BucketTriangle {
    std::uint32_t nodes[3];
    std::uint32_t number;  ///< plus kMark where the bucket of its first node is another one
};

/// Some triangles of a bucket, as many as a kernel takes. Unused places at the end hold valid nodes too.
struct BucketChunk {
    static constexpr std::size_t kTriangles = kTermTriangles;

    BucketTriangle triangles[kTriangles];
};

class NodeBuckets {
  public:
    /// All must outlive this object.
    NodeBuckets(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
                Parallel& parallel);

    /// Fills the buckets, in what is left of `brief`. Returns false when they do not fit, or when many triangles are in
    /// several buckets. Not for polygons.
    bool fill(ScratchBlock& brief);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t firstNode(std::size_t bucket) const { return bucket << shift_; }
    [[nodiscard]] std::size_t endNode(std::size_t bucket) const {
        return std::min((bucket + 1) << shift_, nodes_.count);
    }

    /// body(chunk, count) for a bucket's triangles in their order. Asks for the memory of the chunk that
    /// follows.
    template <class Body>
    void forEachChunk(std::size_t bucket, const Body& body) const {
        for (std::size_t part = 0; part < parts_; ++part) {
            const List& list = lists_[part * count_ + bucket];
            for (std::uint32_t chunk = list.first; chunk != kNone;) {
                const std::uint32_t next = links_[chunk];
                if (next != kNone) askFor(chunks_[next]);
                body(chunks_[chunk], next == kNone ? list.used : BucketChunk::kTriangles);
                chunk = next;
            }
        }
    }

  private:
    /// The chunks of a bucket that one task filled.
    struct List {
        std::uint32_t first = kNone, last = kNone;  ///< chunks
        std::uint32_t used = 0;                     ///< triangles of the last one
    };
    class Filler;

    /// Inlined by force: GCC 12 drops calls to functions that only ask for memory.
    [[gnu::always_inline]] static void askFor(const BucketChunk& chunk) {
        constexpr std::size_t kLine = 64;
        const auto* bytes = reinterpret_cast<const std::byte*>(&chunk);
        for (std::size_t i = 0; i < sizeof(BucketChunk); i += kLine) __builtin_prefetch(bytes + i);
    }
    [[nodiscard]] bool isWorthIt() const;

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    unsigned shift_;
    std::size_t count_, parts_ = 0;
    Buffer<BucketChunk> chunks_;
    Buffer<std::uint32_t> links_;  // one per chunk: the next one of its bucket, or kNone
    Buffer<List> lists_;           // parts_ times count_
};

}  // namespace tspace::mikk
