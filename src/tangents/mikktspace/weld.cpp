// SPDX-License-Identifier: MIT
// Step 2: welding. The reference sorts corners into cells and compares all of a small cell with each other;
// here every vertex of the mesh is looked up once in a hash table. The classes are the same; their
// representative, where it matters, comes from weld_order.cpp.
#include "tangents/mikktspace/weld.h"

#include <atomic>
#include <bit>
#include <cmath>

#include "core/vec_math.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld_order.h"

namespace tspace::mikk {

namespace {

/// The reference adds the ends of intervals of positions: above this the sum may overflow and welding stops.
constexpr float kHugePosition = 1.6e38f;
constexpr std::size_t kGrain =
    8192;  // vertices per task at least: below, starting threads costs more than it saves
constexpr std::size_t kLookAhead = 48;  // corners; far enough for a table line to arrive from memory

struct Vertex {
    Vec3 position, normal;
    Vec2 uv;
};

Vertex load(const MeshView& mesh, std::size_t v) { return {mesh.positions[v], mesh.normals[v], mesh.uvs[v]}; }

bool equal(const Vertex& a, const Vertex& b) {
    return a.position == b.position && a.normal == b.normal && a.uv == b.uv;
}

struct Bits {
    std::uint32_t words[8];
    friend bool operator==(const Bits&, const Bits&) = default;
};
static_assert(sizeof(Vertex) == sizeof(Bits));

/// Adding +0 turns -0 into +0, so that vertices which compare equal have equal hashes.
std::uint32_t hashOf(const Vertex& v) {
    const Vertex plain{v.position + Vec3{}, v.normal + Vec3{}, {v.uv.x + 0.0f, v.uv.y + 0.0f}};
    const Bits bits = std::bit_cast<Bits>(plain);
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (int i = 0; i < 8; i += 2) {
        h ^= bits.words[i] | std::uint64_t{bits.words[i + 1]} << 32;
        h *= 0xbf58476d1ce4e5b9u;
        h ^= h >> 29;
    }
    h *= 0x94d049bb133111ebu;
    return static_cast<std::uint32_t>(h >> 32);
}

bool isTame(const Vertex& v) {
    const auto& p = v.position;
    const bool small =
        std::fabs(p.x) < kHugePosition && std::fabs(p.y) < kHugePosition && std::fabs(p.z) < kHugePosition;
    return small && isFinite(v.normal) && std::isfinite(v.uv.x) && std::isfinite(v.uv.y);
}

struct Slot {
    std::uint32_t hash = 0, node = kNone;
};

class Welder {
  public:
    Welder(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator,
           Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          allocator_(allocator),
          hashes_(allocator, mesh.vertexCount()),
          vertex_node_(allocator, mesh.vertexCount(), kNone),
          mixed_(allocator) {
        std::atomic<bool> tame{true};
        parallel.forRanges(hashes_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            bool all = true;
            for (std::size_t v = begin; v < end; ++v) {
                const Vertex vertex = load(mesh_, v);
                hashes_[v] = hashOf(vertex);
                all &= isTame(vertex);
            }
            if (!all) tame.store(false, std::memory_order_relaxed);
        });
        tame_ = tame.load();
        // A vertex with a NaN gives a node per corner, and vertices that the reference does not weld too.
        const std::size_t corners = mesh.cornerCount();
        const std::size_t most = tame_ ? std::min(corners, mesh.vertexCount()) : corners;
        nodes_.corner = Buffer<std::uint32_t>(allocator, most);
        nodes_.of_corner = triangles.corners.empty() ? Buffer<std::uint32_t>(allocator, corners)
                                                     : Buffer<std::uint32_t>(allocator, corners, kNone);
        const std::size_t slots = std::bit_ceil(mesh.vertexCount() + mesh.vertexCount() / 2 + 2);
        table_ = Buffer<Slot>(allocator, slots, Slot{});
        mask_ = slots - 1;
    }

    /// Nodes are numbered in the order in which triangles first use them.
    Nodes run(Parallel& parallel) {
        const std::size_t corners = 3 * triangles_.count;
        for (std::size_t i = 0; i < corners; ++i) {
            if (i + 2 * kLookAhead < corners) {
                const std::uint32_t far = mesh_.indices[triangles_.corner(i + 2 * kLookAhead)];
                __builtin_prefetch(&vertex_node_[far]);
                __builtin_prefetch(&hashes_[far]);
                const std::uint32_t ahead = mesh_.indices[triangles_.corner(i + kLookAhead)];
                if (vertex_node_[ahead] == kNone) __builtin_prefetch(&table_[hashes_[ahead] & mask_]);
            }
            const std::uint32_t corner = triangles_.corner(i);
            if (!triangles_.corners.empty() && nodes_.of_corner[corner] != kNone) continue;
            nodes_.of_corner[corner] = nodeOf(corner, mesh_.indices[corner]);
        }
        if (!tame_) {
            separateUnwelded(parallel);
        } else if (!mixed_.empty()) {
            Buffer<std::uint8_t> wanted(allocator_, nodes_.count, 0);
            for (const std::uint32_t node : mixed_) wanted[node] = 1;
            findRepresentatives(mesh_, triangles_, nodes_, wanted.data(), nullptr, allocator_, parallel);
        }
        return std::move(nodes_);
    }

  private:
    std::uint32_t newNode(std::uint32_t corner) {
        nodes_.corner[nodes_.count] = corner;
        return static_cast<std::uint32_t>(nodes_.count++);
    }

    std::uint32_t nodeOf(std::uint32_t corner, std::uint32_t vertex) {
        if (vertex_node_[vertex] != kNone) return vertex_node_[vertex];
        const Vertex data = load(mesh_, vertex);
        if (!tame_ && !equal(data, data)) return newNode(corner);  // NaN equals nothing, not even itself
        const std::uint32_t hash = hashes_[vertex];
        std::size_t i = hash & mask_;
        for (; table_[i].node != kNone; i = (i + 1) & mask_) {
            if (table_[i].hash != hash) continue;
            const Vertex other = load(mesh_, mesh_.indices[nodes_.corner[table_[i].node]]);
            if (!equal(data, other)) continue;
            if (!(std::bit_cast<Bits>(data) == std::bit_cast<Bits>(other))) mixed_.push(table_[i].node);
            return vertex_node_[vertex] = table_[i].node;
        }
        table_[i] = {hash, newNode(corner)};
        return vertex_node_[vertex] = table_[i].node;
    }

    /// Where the reference gives up, each corner stays alone. The corner that stands for the node keeps it.
    void separateUnwelded(Parallel& parallel) {
        Buffer<std::uint8_t> not_welded(allocator_, mesh_.cornerCount(), 0);
        findRepresentatives(mesh_, triangles_, nodes_, nullptr, not_welded.data(), allocator_, parallel);
        for (std::size_t c = 0; c < nodes_.of_corner.size(); ++c) {
            const std::uint32_t node = nodes_.of_corner[c];
            if (not_welded[c] != 0 && node != kNone && nodes_.corner[node] != c) {
                nodes_.of_corner[c] = newNode(static_cast<std::uint32_t>(c));
            }
        }
        nodes_.exact = true;
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Allocator* allocator_;
    Buffer<std::uint32_t> hashes_;
    Buffer<std::uint32_t> vertex_node_;
    Growing<std::uint32_t> mixed_;
    Buffer<Slot> table_;
    std::size_t mask_ = 0;
    bool tame_ = true;
    Nodes nodes_;
};

}  // namespace

Nodes weld(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator,
           Parallel& parallel) {
    return Welder(mesh, triangles, allocator, parallel).run(parallel);
}

}  // namespace tspace::mikk
