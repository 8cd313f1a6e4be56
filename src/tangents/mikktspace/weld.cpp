// SPDX-License-Identifier: MIT
// Welding. The reference sorts corners into cells and compares all of a small cell with each other;
// here the vertices of the mesh are hashed. The classes are the same; their representative, where it matters,
// comes from grid_order.cpp.
//
// Most vertices of an indexed mesh are equal to no other. So each hash counts in a small table, by its upper
// bits, up to two; only vertices whose place in it counts two can be equal to another, and only they are
// looked up. Where most vertices are equal to others, all are looked up at once. Threads share nothing: each
// counts its own vertices, and looks up the vertices of its own range of hashes.
#include "tangents/mikktspace/weld.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/hash.h"
#include "core/repeated_hashes.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/grid_order.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

/// The reference adds the ends of intervals of positions: above this the sum may overflow and welding stops.
constexpr float kHugePosition = 1.6e38f;
constexpr std::size_t kGrain = 16384;  // vertices per task at least: below, starting threads costs more than it saves
constexpr std::size_t kFew = 4096;     // vertices; so few are all looked up
constexpr std::size_t kPlacesPerVertex = 8;  // of a counting table: leaves 1 vertex of 9 to be looked up
constexpr std::size_t kBlock = 256;          // vertices; their hashes stay in the first cache
constexpr std::size_t kBatch = 32;           // lookups; all that they touch has to stay in the first cache

struct Vertex {
    Vec3 position, normal;
    Vec2 uv;
};

Vertex load(const MeshView& mesh, std::size_t v) { return {mesh.positions[v], mesh.normals[v], mesh.uvs[v]}; }

bool equal(const Vertex& a, const Vertex& b) {
    return a.position == b.position && a.normal == b.normal && a.uv == b.uv;
}

bool isAllFinite(const Vertex& v) {
    const auto& p = v.position;
    const bool small =
        std::fabs(p.x) < kHugePosition && std::fabs(p.y) < kHugePosition && std::fabs(p.z) < kHugePosition;
    return small && isFinite(v.normal) && std::isfinite(v.uv.x) && std::isfinite(v.uv.y);
}

std::uint64_t pairAt(const void* at) {
    std::uint64_t pair = 0;
    std::memcpy(&pair, at, sizeof pair);
    return pair;
}

/// Whether two vertices have the same bits. Words are read as they lie: a copy would be written in small
/// pieces and read in large ones, which processors are slow at.
bool sameBits(const MeshView& mesh, std::size_t a, std::size_t b) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &m = mesh.normals[a], &n = mesh.normals[b];
    const std::uint64_t xy = (pairAt(&p) ^ pairAt(&q)) | (pairAt(&m) ^ pairAt(&n));
    const std::uint32_t z = (std::bit_cast<std::uint32_t>(p.z) ^ std::bit_cast<std::uint32_t>(q.z)) |
                            (std::bit_cast<std::uint32_t>(m.z) ^ std::bit_cast<std::uint32_t>(n.z));
    return (xy | z | (pairAt(&mesh.uvs[a]) ^ pairAt(&mesh.uvs[b]))) == 0;
}

/// Four floats or words at once, in the compiler's own vectors: scalar code where the target has none.
using Fours = float __attribute__((vector_size(16)));
using Words = std::uint32_t __attribute__((vector_size(16)));
using Pairs = std::uint64_t __attribute__((vector_size(16)));

/// Hashes of the vertices [begin, end). Vertices that compare equal have equal hashes: adding +0 turns -0
/// into +0. Returns whether all of them are finite and not huge; large normals and UVs are taken for huge here.
bool hashVertices(const MeshView& mesh, std::size_t begin, std::size_t end, std::uint32_t* hashes) {
    const Fours limit = Fours{} + kHugePosition;
    const Words no_sign = Words{} + 0x7fffffffu;
    auto finite = limit == limit;
    const StridedSpan<const Vec3> positions = mesh.positions, normals = mesh.normals;
    const StridedSpan<const Vec2> uvs = mesh.uvs;
    for (std::size_t v = begin; v < end; ++v) {
        const Vec3 &p = positions[v], &n = normals[v];
        const Fours z = {p.z, n.z, 0, 0};
        const Fours a = std::bit_cast<Fours>(Pairs{pairAt(&p), pairAt(&n)}) + Fours{};
        const Fours b = std::bit_cast<Fours>(Pairs{std::bit_cast<Pairs>(z)[0], pairAt(&uvs[v])}) + Fours{};
        finite &= (std::bit_cast<Fours>(std::bit_cast<Words>(a) & no_sign) < limit) &
                  (std::bit_cast<Fours>(std::bit_cast<Words>(b) & no_sign) < limit);
        // Turned against each other, so that signs that change together (mirrored shapes) do not cancel.
        const Words turned = std::bit_cast<Words>(b) << 13 | std::bit_cast<Words>(b) >> 19;
        const Pairs both = std::bit_cast<Pairs>(std::bit_cast<Words>(a) ^ turned);
        std::uint64_t h = both[0] * 0xbf58476d1ce4e5b9u ^ std::rotl(both[1] * 0x94d049bb133111ebu, 32);
        h = (h ^ h >> 29) * 0x9e3779b97f4a7c15u;
        hashes[v] = static_cast<std::uint32_t>(h >> 32);
    }
    return (finite[0] & finite[1] & finite[2] & finite[3]) != 0;
}

/// Finds the first equal vertex, the root, of each candidate. First by hashes alone: each task has the
/// candidates of one range of hashes, and a part of the table. Then the data of each candidate and its root
/// are compared, in order, which reads memory as it lies. The few that differ from the root of their hash are
/// looked up by their data.
class Lookup {
  public:
    /// `candidates` ascending; null: all vertices. roots[i] becomes the root of candidate i.
    Lookup(const MeshView& mesh, const std::uint32_t* hashes, const std::uint32_t* candidates, std::size_t count,
           bool all_finite, std::uint32_t* roots)
        : mesh_(mesh),
          hashes_(hashes),
          candidates_(candidates),
          count_(count),
          all_finite_(all_finite),
          roots_(roots) {}

    /// `distinct`: about how many different candidates there are. Returns whether equal vertices differ in a
    /// zero's sign.
    bool run(std::size_t distinct, const Allocator* allocator, Parallel& parallel) {
        if (candidates_ == nullptr && count_ < kFew) return runAtOnce(allocator);
        matchHashes(distinct, allocator, parallel);
        std::atomic<bool> any_mixed{false}, any_different{false};
        parallel.forRanges(count_, kGrain, [&](std::size_t begin, std::size_t end) {
            bool mixed = false, different = false;
            for (std::size_t i = begin; i < end; ++i) {
                if (i + kBatch < end && roots_[i + kBatch] != vertexOf(i + kBatch)) prefetch(roots_[i + kBatch]);
                verify(i, mixed, different);
            }
            if (mixed) any_mixed.store(true, std::memory_order_relaxed);
            if (different) any_different.store(true, std::memory_order_relaxed);
        });
        bool mixed = any_mixed;
        if (any_different) matchData(allocator, mixed);
        return mixed;
    }

  private:
    struct Slot {
        std::uint32_t hash = 0, vertex = kNone;
    };
    struct Item {
        std::uint32_t hash, vertex;
        std::size_t index;
    };

    /// The same for all of few vertices: what is read and written stays in the caches.
    bool runAtOnce(const Allocator* allocator) {
        Buffer<std::uint32_t> table(allocator, std::bit_ceil(2 * count_), kNone);
        const std::size_t mask = table.size() - 1;
        bool mixed = false, different = false;
        for (std::size_t v = 0; v < count_; ++v) {
            std::size_t at = hashes_[v] & mask;
            while (table[at] != kNone && hashes_[table[at]] != hashes_[v]) at = (at + 1) & mask;
            if (table[at] == kNone) table[at] = static_cast<std::uint32_t>(v);
            roots_[v] = table[at];
            verify(v, mixed, different);
        }
        if (different) matchData(allocator, mixed);
        return mixed;
    }

    [[nodiscard]] std::uint32_t vertexOf(std::size_t i) const {
        return candidates_ == nullptr ? static_cast<std::uint32_t>(i) : candidates_[i];
    }

    void matchHashes(std::size_t distinct, const Allocator* allocator, Parallel& parallel) {
        const std::size_t tasks =
            count_ < 2 * kGrain ? 1
                                : std::min<std::size_t>(parallel.width(), std::size_t{2} * RepeatedHashes::kMostRanges);
        std::size_t slots = std::bit_ceil(2 * distinct / tasks + 2 * kBatch);  // of each task
        for (bool full = true; full; slots *= 4) {  // when the guess is bad; at 4/3 of the candidates it ends for sure
            Buffer<Slot> table(allocator, tasks * slots);
            std::atomic<std::size_t> done{0};
            parallel.forTasks(tasks, [&](std::size_t task) {
                Slot* part = table.data() + task * slots;
                std::fill_n(part, slots, Slot{});
                if (matchRange(task, tasks, part, slots)) ++done;
            });
            full = done < tasks;
        }
    }

    /// The candidates of one range of hashes. Returns false when the table is too small.
    bool matchRange(std::size_t task, std::size_t tasks, Slot* table, std::size_t slots) {
        const std::size_t mask = slots - 1;
        std::size_t room = slots - slots / 4;
        Item items[kBatch];
        for (std::size_t begin = 0; begin < count_; begin += kBatch) {
            const std::size_t end = std::min(begin + kBatch, count_);
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const std::uint32_t vertex = vertexOf(i), hash = hashes_[vertex];
                items[count] = {hash, vertex, i};
                count += (std::uint64_t{hash} * tasks) >> 32 == task ? 1 : 0;
            }
            if (room < count) return false;
            for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(&table[items[i].hash & mask]);
            for (std::size_t i = 0; i < count; ++i) {
                const Item& item = items[i];
                std::size_t at = item.hash & mask;
                while (table[at].vertex != kNone && table[at].hash != item.hash) at = (at + 1) & mask;
                if (table[at].vertex == kNone) {
                    table[at] = {item.hash, item.vertex};
                    --room;
                }
                roots_[item.index] = table[at].vertex;
            }
        }
        return true;
    }

    void prefetch(std::uint32_t vertex) const {
        __builtin_prefetch(&mesh_.positions[vertex]);
        __builtin_prefetch(&mesh_.normals[vertex]);
        __builtin_prefetch(&mesh_.uvs[vertex]);
    }

    void verify(std::size_t i, bool& mixed, bool& different) {
        const std::uint32_t vertex = vertexOf(i), root = roots_[i];
        if (root == vertex) return;
        const bool same = sameBits(mesh_, vertex, root);
        if (same && all_finite_) return;
        if (equal(load(mesh_, vertex), load(mesh_, root))) {
            mixed |= !same;
        } else {  // NaN too, which equals nothing, not even itself
            roots_[i] = kNone;
            different = true;
        }
    }

    /// A hash of all bits, for vertices whose first hash is that of others.
    static std::uint64_t longHash(const Vertex& v) {
        std::uint64_t hash = foldHash(hashPosition(v.position), hashPosition(v.normal));
        return foldHash(hash, hashPosition({v.uv.x, v.uv.y, 0}));
    }

    [[gnu::cold]] void matchData(const Allocator* allocator, bool& mixed) {
        struct Entry {
            std::uint64_t hash = 0;
            std::uint32_t vertex = kNone;
        };
        const auto different = static_cast<std::size_t>(std::count(roots_, roots_ + count_, kNone));
        Buffer<Entry> table(allocator, std::bit_ceil(2 * different), Entry{});
        for (std::size_t i = 0; i < count_; ++i) {
            if (roots_[i] != kNone) continue;
            const std::uint32_t vertex = roots_[i] = vertexOf(i);
            const Vertex data = load(mesh_, vertex);
            if (!equal(data, data)) continue;
            const std::uint64_t hash = longHash(data);
            for (std::size_t at = hash & (table.size() - 1);; at = (at + 1) & (table.size() - 1)) {
                if (table[at].vertex == kNone) {
                    table[at] = {hash, vertex};
                } else {
                    if (table[at].hash != hash) continue;
                    if (!equal(data, load(mesh_, table[at].vertex))) continue;
                    roots_[i] = table[at].vertex;
                    mixed |= !sameBits(mesh_, vertex, roots_[i]);
                }
                break;
            }
        }
    }

    const MeshView& mesh_;
    const std::uint32_t* hashes_;
    const std::uint32_t* candidates_;
    std::size_t count_;
    bool all_finite_;
    std::uint32_t* roots_;
};

/// Equal vertices, without regard to triangles.
class VertexWelder {
  public:
    VertexWelder(const MeshView& mesh, const Allocator* allocator, const Allocator* transient, Parallel& parallel)
        : mesh_(mesh), count_(mesh.vertexCount()), allocator_(allocator), transient_(transient), parallel_(parallel) {}

    /// Fills count, of_vertex and mixed. Returns whether all vertices are finite and not huge.
    bool run(Nodes& nodes) {
        nodes.count = count_;
        hashes_ = Buffer<std::uint32_t>(transient_, count_);
        Buffer<std::uint32_t> candidates;
        std::size_t candidate_count = count_, distinct = count_;
        if (count_ < kFew || mesh_.indices.type == IndexType::none) {
            hashAll(nullptr, 1);
            if (count_ >= kFew) distinct = guessDistinct();
        } else {
            const std::size_t ranges = RepeatedHashes::rangesFor(count_, parallel_);
            RepeatedHashes counting(kPlacesPerVertex, transient_, count_, ranges);
            hashAll(&counting, ranges);
            distinct = counting.sum(ranges, parallel_);
            if (distinct >= count_ - count_ / 4) {
                candidates = Buffer<std::uint32_t>(transient_, count_);
                candidate_count = counting.collect(hashes_.data(), count_, ranges, candidates.data(), parallel_);
            }
        }
        if (candidate_count == count_) {
            candidates = {};
            Buffer<std::uint32_t> of_vertex(allocator_, count_);
            nodes.mixed = Lookup(mesh_, hashes_.data(), nullptr, count_, all_finite_, of_vertex.data())
                              .run(distinct, transient_, parallel_);
            numberAll(nodes, of_vertex);
            if (nodes.count < count_) nodes.of_vertex = std::move(of_vertex);
        } else {
            Buffer<std::uint32_t> roots(transient_, candidate_count);
            nodes.mixed = Lookup(mesh_, hashes_.data(), candidates.data(), candidate_count, all_finite_, roots.data())
                              .run(candidate_count, transient_, parallel_);
            hashes_ = {};
            numberFew(nodes, candidates, roots);
        }
        return all_finite_;
    }

  private:
    void hashAll(RepeatedHashes* counting, std::size_t ranges) {
        if (counting == nullptr) ranges = std::clamp<std::size_t>(count_ / kGrain, 1, parallel_.width());
        std::atomic<bool> finite{true};
        parallel_.forTasks(ranges, [&](std::size_t range) {
            if (counting != nullptr) counting->clear(range);
            bool all = true;
            const std::size_t end = count_ * (range + 1) / ranges;
            for (std::size_t v = count_ * range / ranges; v < end; v += kBlock) {
                const std::size_t stop = std::min(v + kBlock, end);
                all &= hashVertices(mesh_, v, stop, hashes_.data());
                if (counting != nullptr) counting->add(range, hashes_.data() + v, stop - v);
            }
            if (!all) finite.store(false, std::memory_order_relaxed);
        });
        all_finite_ = finite;
    }

    /// Counts a sample of the hashes, chosen by their value, so that equal vertices are in it together or not
    /// at all.
    [[nodiscard]] std::size_t guessDistinct() {
        constexpr std::uint32_t kShare = 32;
        RepeatedHashes counting(kPlacesPerVertex, transient_, count_ / kShare, 1);
        counting.clear(0);
        for (std::size_t v = 0; v < count_; ++v) {
            if (hashes_[v] % kShare == 0) counting.add(0, hashes_.data() + v, 1);
        }
        return std::min(count_, kShare * counting.sum(1, parallel_));
    }

    /// of_vertex holds each vertex's first equal vertex; it becomes the node.
    void numberAll(Nodes& nodes, Buffer<std::uint32_t>& of_vertex) const {
        std::uint32_t next = 0;
        for (std::size_t v = 0; v < count_; ++v) {
            const std::uint32_t root = of_vertex[v];
            const std::uint32_t node = of_vertex[root];  // a node already, but for the first vertex itself
            of_vertex[v] = root == v ? next : node;
            next += root == v ? 1 : 0;
        }
        nodes.count = next;
    }

    /// `roots`: the first equal vertices of the candidates.
    void numberFew(Nodes& nodes, const Buffer<std::uint32_t>& candidates, const Buffer<std::uint32_t>& roots) const {
        struct Repeated {
            std::uint32_t vertex, root;
        };
        std::size_t count = 0;
        for (std::size_t i = 0; i < roots.size(); ++i) count += roots[i] != candidates[i] ? 1 : 0;
        if (count == 0) return;
        Buffer<std::uint32_t> of_vertex(allocator_, count_);
        Buffer<Repeated> repeated(transient_, count);
        count = 0;
        for (std::size_t i = 0; i < roots.size(); ++i) {
            if (roots[i] != candidates[i]) repeated[count++] = {candidates[i], roots[i]};
        }
        nodes.count = count_ - count;
        parallel_.forRanges(count_, kGrain, [&](std::size_t begin, std::size_t end) {
            const Repeated* r = std::lower_bound(repeated.begin(), repeated.end(), begin,
                                                 [](const Repeated& a, std::size_t v) { return a.vertex < v; });
            for (std::size_t v = begin; v < end; ++v) {  // one step past the repeated vertex, which comes below
                const std::size_t before = static_cast<std::size_t>(r - repeated.begin());
                const std::size_t stop = r == repeated.end() ? end : std::min<std::size_t>(r->vertex, end);
                for (; v < stop; ++v) of_vertex[v] = static_cast<std::uint32_t>(v - before);
                if (v < end) ++r;
            }
        });
        for (const Repeated& r : repeated) of_vertex[r.vertex] = of_vertex[r.root];
        nodes.of_vertex = std::move(of_vertex);
    }

    const MeshView& mesh_;
    std::size_t count_;
    const Allocator *allocator_, *transient_;
    Parallel& parallel_;
    Buffer<std::uint32_t> hashes_;
    bool all_finite_ = true;
};

/// Where nodes mix -0 and +0, the reference's representative decides on the bits.
[[gnu::cold]] void resolveMixed(const MeshView& mesh, const TriangleList& triangles, Nodes& nodes,
                                const Allocator* allocator, Parallel& parallel) {
    listVertices(nodes, allocator, parallel);
    Growing<std::uint32_t> different(allocator);
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const std::uint32_t first = nodes.vertices[nodes.of_vertex[v]];
        if (!sameBits(mesh, v, first)) different.push(first);
    }
    Buffer<std::uint32_t> corners(allocator, nodes.count, kNone);
    GridOrder(mesh, triangles, nodes, allocator, parallel).find({different.begin(), different.end()}, corners.data());
    for (std::size_t node = 0; node < nodes.count; ++node) {
        if (corners[node] != kNone) nodes.vertices[node] = mesh.indices[corners[node]];
    }
}

[[gnu::cold]] bool usesFiniteVerticesOnly(const MeshView& mesh, const TriangleList& triangles) {
    for (std::size_t i = 0; i < 3 * triangles.count; ++i) {
        if (!isAllFinite(load(mesh, mesh.indices[triangles.corner(i)]))) return false;
    }
    return true;
}

}  // namespace

Nodes weld(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator, Parallel& parallel,
           const Allocator* transient) {
    Nodes nodes;
    nodes.all_finite =
        VertexWelder(mesh, allocator, transient != nullptr ? transient : allocator, parallel).run(nodes) ||
        usesFiniteVerticesOnly(mesh, triangles);
    if (nodes.mixed && nodes.all_finite) resolveMixed(mesh, triangles, nodes, allocator, parallel);
    return nodes;
}

void listVertices(Nodes& nodes, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kPart = 65536;  // vertices
    if (nodes.of_vertex.empty() || !nodes.vertices.empty()) return;
    nodes.vertices = Buffer<std::uint32_t>(allocator, nodes.count);
    const std::size_t count = nodes.of_vertex.size(), parts = (count + kPart - 1) / kPart;
    const auto endOf = [=](std::size_t part) { return std::min((part + 1) * kPart, count); };
    // Nodes are numbered by their first vertices: as many begin before a part as the largest number before it
    // says.
    Buffer<std::uint32_t> begun(allocator, parts + 1, 0u);
    if (parts > 1) {
        parallel.forTasks(parts, [&](std::size_t part) {
            std::int32_t largest = 0;  // nodes are fewer than 2^31, and SSE2 compares signed numbers only
            for (std::size_t v = part * kPart; v < endOf(part); ++v)
                largest = std::max(largest, static_cast<std::int32_t>(nodes.of_vertex[v]));
            begun[part + 1] = static_cast<std::uint32_t>(largest) + 1;
        });
        for (std::size_t part = 1; part < parts; ++part) begun[part] = std::max(begun[part], begun[part - 1]);
    }
    parallel.forTasks(parts, [&](std::size_t part) {
        std::uint32_t next = begun[part];
        for (std::size_t v = part * kPart; v < endOf(part); ++v) {
            if (nodes.of_vertex[v] == next) nodes.vertices[next++] = static_cast<std::uint32_t>(v);
        }
    });
}

}  // namespace tspace::mikk
