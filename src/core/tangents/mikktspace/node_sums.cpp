// SPDX-License-Identifier: MIT
// Sums of all nodes. A task owns a range of nodes: it processes the triangles that have a node there, in order, and
// adds to these nodes only. Each sum is therefore computed by one task, in the reference's order, and no task waits for
// another. Triangles at the border of two ranges are computed twice. If consecutive triangles have nearby nodes, a few
// ranges per task are sufficient; otherwise ranges are so small that all data of their nodes stay in the L2 cache.
#include "core/tangents/mikktspace/node_sums.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "core/base/mesh_loops.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"

namespace tspace::mikk {
namespace {

// log2 of the minimum number of nodes per task: for fewer, another thread costs more than it saves
constexpr unsigned kTaskShift = 12;
/// log2 of the nodes per range for triangles in random order. Measured: 8192 nodes take 97 ns per triangle, 4096 nodes
/// 99, 16384 nodes 102, 65536 nodes 117, and 1024 nodes 137.
constexpr unsigned kScatteredShift = 13;
constexpr std::size_t kScatteredRange = std::size_t{1} << kScatteredShift;
constexpr std::size_t kTasksPerThread = 4;
/// Locality argument of __builtin_prefetch: the L2 cache, because the prefetched data of a block do not fit into the L1
/// cache together with the data of the kernel. Measured: 120 ns per triangle with L1, 67 with L2.
constexpr int kSecondCache = 2;

/// Arguments of a pass over all triangles.
struct Sweep : WeldedMesh {
    const CornerSource& source;
    CornerTermsFunction terms;
    NodeSums& sums;
    bool prefetches = false;  // true: the data of the nodes exceed the L2 cache
};

/// Computes the sums of the ranges of one task.
class Summer {
  public:
    explicit Summer(const Sweep& sweep) : sweep_(sweep), sums_(sweep.sums) {}

    void run(GroupRange range, RangeLists::Batches triangles, const FanPool& room) {
        fan_room_ = room;
        range_ = range;
        std::fill_n(sums_.nodes.data() + range.begin, range.size(), NodeSum{});
        std::fill_n(sums_.marks.data() + range.begin, range.size(), std::uint16_t{kAllMarks});
        if (!sums_.rest.empty()) std::fill_n(sums_.rest.data() + range.begin, range.size(), GroupRest{});
        // A batch is read, and its data prefetched, before the previous one is computed.
        TriangleBatch batches[2];
        bool more = read(triangles, batches[0]);
        for (std::size_t current = 0; more; current ^= 1) {
            more = read(triangles, batches[current ^ 1]);
            compute(batches[current]);
        }
    }

  private:
    bool read(RangeLists::Batches& triangles, TriangleBatch& batch) {
        if (!triangles.next(batch)) return false;
        batch.vertices = fillGroup(batch.vertices, batch.count, kTermGroup, batch.own_vertices);
        if (sweep_.prefetches) prefetch(batch);
        return true;
    }

    /// Always inlined: GCC 12 considers a function that only prefetches to have no effect, and drops the call.
    [[gnu::always_inline]] void prefetch(const TriangleBatch& batch) const {
        const CornerSource& source = sweep_.source;
        for (std::size_t i = 0; i < 3 * batch.count; ++i) {
            __builtin_prefetch(&sums_.nodes[batch.groups[i]], 1, kSecondCache);
            __builtin_prefetch(source.positions + source.position_stride * batch.vertices[i], 0, kSecondCache);
            __builtin_prefetch(source.normals + source.normal_stride * batch.vertices[i], 0, kSecondCache);
            __builtin_prefetch(source.uvs + source.uv_stride * batch.vertices[i], 0, kSecondCache);
        }
    }

    void compute(const TriangleBatch& batch) {
        sweep_.terms(sweep_.source, batch.vertices, batch.count, terms_);
        const auto kindOf = [&](std::size_t t) { return static_cast<TriangleKind>(terms_.marks[0][t] >> kFlagShift); };
        TriangleKind* const kinds = sums_.kinds.data();
        const std::size_t first = batch.numbers[0], whole_count = batch.is_whole ? batch.count : 0;
        for (std::size_t t = 0; t < whole_count; ++t) kinds[first + t] = kindOf(t);
        for (std::size_t t = 0; !batch.is_whole && t < batch.count; ++t) {
            if (range_.has(batch.groups[3 * t])) kinds[batch.number(t)] = kindOf(t);
        }
        if (kHasAllMethods && sweep_.source.weighting == Weighting::none) {
            add<Sums::none>(batch);
        } else if (sums_.rest.empty()) {
            add<Sums::tangents>(batch);
        } else {
            add<Sums::all>(batch);
        }
    }

    enum class Sums { none, tangents, all };

    /// Pointers to the sums, copied to a local struct so that they stay in registers.
    struct Target {
        NodeSum* nodes;
        std::uint16_t* marks;
    };

    template <Sums kSums>
    void add(const TriangleBatch& batch) {
        const Target to{sums_.nodes.data(), sums_.marks.data()};
        const bool is_whole = batch.is_whole;
        const GroupRange range = range_;
        for (std::size_t t = 0; t < batch.count; ++t) {
            const std::uint32_t* n = batch.groups + 3 * t;
            if ((terms_.marks[0][t] & (kDegenerateMark | kNoUvArea)) != 0) [[unlikely]] {
                addNonContributing(n, (terms_.marks[0][t] & kDegenerateMark) != 0);
                continue;
            }
            const std::uint32_t a = n[0], b = n[1], c = n[2];
            const auto addCorner = [&](std::size_t k, std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
                if constexpr (kSums != Sums::none)
                    addRow(to.nodes[node].s, terms_.s[3 * t + k]);  // the fourth number of the row is the weight
                if constexpr (kSums == Sums::all) addRest(sums_.rest[node], terms_, t, k);
                to.marks[node] = static_cast<std::uint16_t>(to.marks[node] & terms_.marks[k][t]);
                to.nodes[node].fan.add(next, previous, fan_room_);
            };
            if (is_whole || range.has(a)) addCorner(0, a, b, c);
            if (is_whole || range.has(b)) addCorner(1, b, c, a);
            if (is_whole || range.has(c)) addCorner(2, c, a, b);
        }
    }

    /// Adds a triangle that contributes nothing to the sums: a degenerate triangle makes its nodes complex, and a
    /// triangle without UV area extends fans.
    void addNonContributing(const std::uint32_t* n, bool degenerate) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!range_.has(n[k])) continue;
            if (degenerate) {
                sums_.marks[n[k]] = 0;
            } else {
                sums_.nodes[n[k]].fan.add(n[(k + 1) % 3], n[(k + 2) % 3], fan_room_);
            }
        }
    }

    const Sweep& sweep_;
    NodeSums& sums_;
    FanPool fan_room_{nullptr};
    GroupRange range_;
    CornerTerms terms_;
};

/// Returns log2 of the number of nodes per range. Small ranges are faster if triangles are scattered but the nodes of
/// each triangle are in one range.
unsigned rangeShift(const Sweep& sweep, const MeshTriangles& by_node, unsigned width) {
    const std::size_t nodes = sweep.nodes.count;
    if (sweep.sums.scattered && RangeLists::areCompact(by_node, 1, nodes, kScatteredRange)) return kScatteredShift;
    const std::size_t wanted = width == 1 ? 1 : sweep.sums.scattered ? width : kTasksPerThread * width;
    unsigned shift = kTaskShift;
    while (((nodes - 1) >> shift) >= wanted) ++shift;
    return shift;
}

}  // namespace

TriangleGroups::InPlace MeshTriangles::inPlace(std::size_t first, std::size_t) const {
    const bool is_own = in_.nodes.of_vertex.empty() && in_.triangles.corners.empty() && kinds_ == nullptr;
    if (!is_own || in_.mesh.indices.type != IndexType::u32) return {};
    const std::uint32_t* const vertices = static_cast<const std::uint32_t*>(in_.mesh.indices.data) + 3 * first;
    return {vertices, vertices};
}

void MeshTriangles::read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* groups) const {
    finish(
        readTriangles(in_.mesh, in_.triangles, first, size, groups), size, [=](std::size_t t) { return first + t; },
        vertices, groups);
}

void MeshTriangles::readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                             std::uint32_t* groups) const {
    withIndices(in_.mesh.indices, [&](auto vertexOf) {
        for (std::size_t t = 0; t < size; ++t) {
            const std::size_t first = 3 * std::size_t{numbers[t]};
            for (std::size_t k = 0; k < 3; ++k) groups[3 * t + k] = vertexOf(in_.triangles.corner(first + k));
        }
    });
    finish(
        groups, size, [=](std::size_t t) { return numbers[t]; }, vertices, groups);
}

template <class NumberOf>
void MeshTriangles::finish(const std::uint32_t* found, std::size_t size, const NumberOf& numberOf,
                           std::uint32_t* vertices, std::uint32_t* groups) const {
    if (vertices != nullptr) std::copy_n(found, 3 * size, vertices);
    const std::uint32_t* const nodes = in_.nodes.ofVertices(found, 3 * size, groups);
    if (nodes != groups) std::copy_n(nodes, 3 * size, groups);
    for (std::size_t i = 0; vertices != nullptr && in_.nodes.mixed && i < 3 * size; ++i)
        vertices[i] = in_.nodes.vertex(groups[i]);
    for (std::size_t t = 0; kinds_ != nullptr && t < size; ++t) {
        if ((kinds_[numberOf(t)] & kDegenerateUv) != 0) std::fill_n(groups + 3 * t, 3, kNone);
    }
}

void finishInRanges(std::size_t count, const FinishNodes& finish, Parallel& parallel) {
    constexpr std::size_t kStep = 64, kGrain = 128;  // nodes per step, and steps per task
    parallel.forRanges((count + kStep - 1) / kStep, kGrain, [&](std::size_t begin, std::size_t end) {
        finish(begin * kStep, std::min(end * kStep, count));
    });
}

void sumNodes(const WeldedMesh& welded, const CornerSource& source, CornerTermsFunction terms, ScratchBlock& transient,
              const Allocator* allocator, Parallel& parallel, NodeSums& sums, const FinishNodes& finish,
              unsigned range_shift) {
    const std::size_t node_count = welded.nodes.count;
    sums.nodes = Buffer<NodeSum>(allocator, node_count);
    sums.marks = Buffer<std::uint16_t>(allocator, node_count);
    if (!source.tangents_only) sums.rest = Buffer<GroupRest>(allocator, node_count);
    sums.kinds = Buffer<TriangleKind>(transient.allocator(), welded.triangles.count);
    if (node_count == 0) return;
    Sweep sweep{welded, source, terms, sums};
    const MeshTriangles by_node(welded, nullptr);
    sums.scattered = !RangeLists::areCompact(by_node, kTermTriangles, node_count, kScatteredRange);
    const unsigned shift = range_shift != 0 ? range_shift : rangeShift(sweep, by_node, parallel.width());
    sweep.prefetches = sums.scattered && shift > kScatteredShift;
    const RangeLists lists(by_node, kTermTriangles, node_count, std::size_t{1} << shift, transient.allocator(),
                           parallel);
    const std::size_t ranges = lists.count(), tasks = std::min<std::size_t>(ranges, parallel.width());
    const std::size_t fans_each = std::min(lists.range(0).size(), lists.mostTriangles(welded.triangles.count));
    // most pages of this memory are never touched
    Buffer<ManyPaths> many_paths(transient.allocator(), tasks * fans_each);
    std::atomic<std::size_t> next{0};
    parallel.forTasks(tasks, [&](std::size_t task) {
        Summer summer(sweep);
        for (std::size_t index = next++; index < ranges; index = next++) {
            const GroupRange range = lists.range(index);
            summer.run(range, {by_node, lists, index}, FanPool(many_paths.data() + task * fans_each));
            if (ranges > 1) finish(range.begin, range.end);
        }
    });
    std::uint32_t degenerate = 0, no_uv_area = 0, mirrored = 0;
    for (const TriangleKind kind : sums.kinds) {
        degenerate += (kind & kDegenerateTriangle) != 0 ? 1 : 0;
        no_uv_area += (kind & (kDegenerateTriangle | kDegenerateUv)) == kDegenerateUv ? 1 : 0;
        mirrored += kind == kMirrored ? 1 : 0;
    }
    sums.report = {.triangle_count = welded.triangles.count,
                   .degenerate_triangle_count = degenerate,
                   .degenerate_uv_count = no_uv_area,
                   .mirrored_count = mirrored};
    if (ranges == 1) finishInRanges(node_count, finish, parallel);
}

}  // namespace tspace::mikk
