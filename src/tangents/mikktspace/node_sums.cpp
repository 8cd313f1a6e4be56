// SPDX-License-Identifier: MIT
// The sums of all nodes. A task owns a range of nodes: it goes through the triangles that have a node there, in order, and
// adds to these nodes only. So each sum is made by one task, in the reference's order, and no task waits for another.
// Triangles at the border of two ranges are computed twice. Triangles that lie close together need few ranges, one for
// each task; for others ranges are so small that all data of their nodes stay in the second cache.
#include "tangents/mikktspace/node_sums.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <optional>

#include "core/add_row.h"
#include "core/range_lists.h"
#include "core/typed_indices.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kManyShare = 16;  // one fan in so many may have more than two paths at a time
constexpr unsigned kTaskShift = 12;     // nodes of a task at least: below, another thread costs more than it saves
/// Measured for triangles in random order: 8192 nodes 97 ns per triangle, 4096 99, 16384 102, 65536 117, 1024 137.
constexpr unsigned kScatteredShift = 13;
constexpr std::size_t kTasksPerThread = 4;
constexpr std::size_t kTermGroup = 16;  // triangles that kernels read at once at most (corner_terms.h)
/// Where early requests put memory (__builtin_prefetch): there is more of it than a block needs of the first
/// cache, which the kernel works in. Measured: 120 ns per triangle with the first cache, 67 with the second.
constexpr int kSecondCache = 2;

/// What to sum.
struct Sweep : WeldedMesh {
    const CornerSource& source;
    CornerTermsFunction terms;
    NodeSums& sums;
    const RangeLists* lists = nullptr;  // of the ranges; null: there is one
    bool asks = false;                  // for memory that is in no near cache
};

/// Triangles to compute. The numbers are the caller's own where they can be taken as they are.
struct Block {
    const std::uint32_t* vertices = nullptr;  // where data is read
    const std::uint32_t* nodes = nullptr;     // where it is added
    std::size_t count = 0;
    bool is_whole = false;  // consecutive, and all their nodes are in the range
    std::uint32_t own_vertices[kTermCorners];
    std::uint32_t own_nodes[kTermCorners];
    std::uint32_t triangles[kTermTriangles];  // their numbers; of a whole block the first one
};

/// One task's worth of ranges.
class Summer {
  public:
    explicit Summer(const Sweep& sweep) : sweep_(sweep), sums_(sweep.sums) {}

    void run(std::size_t range, std::size_t first_node, std::size_t end_node, const FanRoom& room) {
        fan_room_ = room;
        first_node_ = static_cast<std::uint32_t>(first_node);
        node_count_ = static_cast<std::uint32_t>(end_node - first_node);
        std::fill_n(sums_.nodes.data() + first_node_, node_count_, NodeSum{});
        std::fill_n(sums_.marks.data() + first_node_, node_count_, std::uint16_t{kAllMarks});
        if (!sums_.rest.empty()) std::fill_n(sums_.rest.data() + first_node_, node_count_, GroupRest{});
        next_ = 0;
        if (sweep_.lists != nullptr) entries_ = sweep_.lists->entries(range);
        // One block is read, and memory asked for what it needs, before the one before it is computed.
        Block blocks[2];
        fill(blocks[0]);
        for (std::size_t current = 0; blocks[current].count != 0; current ^= 1) {
            fill(blocks[current ^ 1]);
            compute(blocks[current]);
        }
    }

  private:
    [[nodiscard]] bool owns(std::uint32_t node) const { return node - first_node_ < node_count_; }

    /// The next triangles.
    void fill(Block& block) {
        block.count = 0;
        if (sweep_.lists == nullptr) {
            fillWhole(block, next_);
            next_ += kTermTriangles;
            return;
        }
        constexpr std::uint32_t kBlock = RangeLists::kBlock;
        if (next_ < entries_.size() && (entries_[next_] & kBlock) != 0) {
            fillWhole(block, std::size_t{entries_[next_++] & ~kBlock} * kTermTriangles);
            return;
        }
        while (block.count < kTermTriangles && next_ < entries_.size() && (entries_[next_] & kBlock) == 0)
            block.triangles[block.count++] = entries_[next_++];
        block.is_whole = false;
        withIndices(sweep_.mesh.indices, [&](auto vertexOf) {
            std::uint32_t* to = block.own_vertices;
            for (std::size_t t = 0; t < block.count; ++t, to += 3) {
                const std::size_t first = 3 * std::size_t{block.triangles[t]};
                for (std::size_t k = 0; k < 3; ++k) to[k] = vertexOf(sweep_.triangles.corner(first + k));
            }
        });
        block.vertices = block.own_vertices;
        finish(block);
    }

    void fillWhole(Block& block, std::size_t first) {
        if (first >= sweep_.triangles.count) return;
        block.count = std::min(kTermTriangles, sweep_.triangles.count - first);
        block.is_whole = true;
        block.triangles[0] = static_cast<std::uint32_t>(first);
        block.vertices = readTriangles(sweep_.mesh, sweep_.triangles, first, block.count, block.own_vertices);
        finish(block);
    }

    /// Looks up the nodes.
    void finish(Block& block) {
        const Nodes& map = sweep_.nodes;
        if (block.count == 0) return;
        block.nodes = map.ofVertices(block.vertices, 3 * block.count, block.own_nodes);
        if (map.mixed) {
            for (std::size_t i = 0; i < 3 * block.count; ++i) block.own_vertices[i] = map.vertex(block.nodes[i]);
            block.vertices = block.own_vertices;
        }
        block.vertices = fillGroup(block.vertices, block.count, kTermGroup, block.own_vertices);
        if (sweep_.asks) askFor(block);
    }

    /// Inlined by force: GCC 12 sees a function that only asks for memory as one without effect, and drops
    /// calls to it.
    [[gnu::always_inline]] void askFor(const Block& block) const {
        const CornerSource& source = sweep_.source;
        for (std::size_t i = 0; i < 3 * block.count; ++i) {
            __builtin_prefetch(&sums_.nodes[block.nodes[i]], 1, kSecondCache);
            __builtin_prefetch(source.positions + source.position_stride * block.vertices[i], 0, kSecondCache);
            __builtin_prefetch(source.normals + source.normal_stride * block.vertices[i], 0, kSecondCache);
            __builtin_prefetch(source.uvs + source.uv_stride * block.vertices[i], 0, kSecondCache);
        }
    }

    void compute(const Block& block) {
        sweep_.terms(sweep_.source, block.vertices, block.count, terms_);
        const auto kindOf = [&](std::size_t t) { return static_cast<TriangleKind>(terms_.marks[0][t] >> 8); };
        TriangleKind* const kinds = sums_.kinds.data();
        const std::size_t first = block.triangles[0], whole_count = block.is_whole ? block.count : 0;
        for (std::size_t t = 0; t < whole_count; ++t) kinds[first + t] = kindOf(t);
        for (std::size_t t = 0; !block.is_whole && t < block.count; ++t) {
            if (owns(block.nodes[3 * t])) kinds[block.triangles[t]] = kindOf(t);
        }
        if (sweep_.source.weighting == Weighting::none) {
            add<Sums::none>(block);
        } else if (sums_.rest.empty()) {
            add<Sums::tangents>(block);
        } else {
            add<Sums::all>(block);
        }
    }

    enum class Sums { none, tangents, all };

    /// Where sums are made: a copy, so that pointers stay in registers.
    struct Target {
        NodeSum* nodes;
        std::uint16_t* marks;
    };

    template <Sums kSums>
    void add(const Block& block) {
        const Target to{sums_.nodes.data(), sums_.marks.data()};
        const bool is_whole = block.is_whole;
        for (std::size_t t = 0; t < block.count; ++t) {
            const std::uint32_t* n = block.nodes + 3 * t;
            if ((terms_.marks[0][t] & (kDegenerateMark | kNoUvArea)) != 0) [[unlikely]] {
                addUnusual(n, (terms_.marks[0][t] & kDegenerateMark) != 0);
                continue;
            }
            const std::uint32_t a = n[0], b = n[1], c = n[2];
            const auto addCorner = [&](std::size_t k, std::uint32_t node, std::uint32_t next, std::uint32_t previous) {
                if constexpr (kSums != Sums::none) addRow(to.nodes[node].s, terms_.s[3 * t + k]);  // and the weight
                if constexpr (kSums == Sums::all) addRest(sums_.rest[node], terms_, t, k);
                to.marks[node] = static_cast<std::uint16_t>(to.marks[node] & terms_.marks[k][t]);
                to.nodes[node].fan.add(next, previous, fan_room_);
            };
            if (is_whole || owns(a)) addCorner(0, a, b, c);
            if (is_whole || owns(b)) addCorner(1, b, c, a);
            if (is_whole || owns(c)) addCorner(2, c, a, b);
        }
    }

    /// Triangles that add nothing to the sums. Nodes of degenerate ones are left to the vertex path.
    void addUnusual(const std::uint32_t* n, bool degenerate) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!owns(n[k])) continue;
            if (degenerate) {
                sums_.marks[n[k]] = 0;
            } else {
                sums_.nodes[n[k]].fan.add(n[(k + 1) % 3], n[(k + 2) % 3], fan_room_);
            }
        }
    }

    const Sweep& sweep_;
    NodeSums& sums_;
    FanRoom fan_room_{nullptr, 0};
    std::uint32_t first_node_ = 0, node_count_ = 0;
    std::span<const std::uint32_t> entries_;
    std::size_t next_ = 0;  // triangle or entry to read
    CornerTerms terms_;
};

/// Of the triangles of a sample, how many test(t) says yes to, of 1024.
template <class Test>
std::size_t outOf1024(std::size_t count, const Test& test) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < 1024; ++i) found += test(count * i / 1024);
    return found;
}

/// Whether consecutive triangles lie far apart.
bool isScattered(const Sweep& sweep) {
    constexpr std::int64_t kFar = 2048;                                                  // vertices
    if (sweep.triangles.count < 2 || sweep.mesh.vertexCount() < 4 * kFar) return false;  // nothing is far
    return outOf1024(sweep.triangles.count - 1, [&](std::size_t t) -> std::size_t {
               const std::int64_t a = sweep.vertexAt(3 * t), b = sweep.vertexAt(3 * t + 3);
               return std::abs(a - b) > kFar ? 1 : 0;
           }) > 256;
}

/// Whether triangles mostly have their nodes in one range.
bool areWorthRanges(const Sweep& sweep, unsigned shift) {
    return outOf1024(sweep.triangles.count, [&](std::size_t t) -> std::size_t {
               const auto range = [&](std::size_t k) { return sweep.nodeAt(3 * t + k) >> shift; };
               const std::uint32_t a = range(0), b = range(1), c = range(2);
               return (b != a ? 1 : 0) + (c != a && c != b ? 1 : 0);
           }) <= 256;
}

unsigned rangeShift(const Sweep& sweep, unsigned width) {
    if (sweep.sums.scattered && areWorthRanges(sweep, kScatteredShift)) return kScatteredShift;
    const std::size_t wanted = width == 1 ? 1 : sweep.sums.scattered ? width : kTasksPerThread * width;
    unsigned shift = kTaskShift;
    while (((sweep.nodes.count - 1) >> shift) >= wanted) ++shift;
    return shift;
}

}  // namespace

void MeshTriangles::read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* groups) const {
    const std::uint32_t* const found = readTriangles(in_.mesh, in_.triangles, first, size, groups);
    if (vertices != nullptr) std::copy_n(found, 3 * size, vertices);
    const std::uint32_t* const nodes = in_.nodes.ofVertices(found, 3 * size, groups);
    if (nodes != groups) std::copy_n(nodes, 3 * size, groups);
    if (vertices != nullptr && in_.nodes.mixed) {
        for (std::size_t i = 0; i < 3 * size; ++i) vertices[i] = in_.nodes.vertex(groups[i]);
    }
    for (std::size_t t = 0; kinds_ != nullptr && t < size; ++t) {
        if ((kinds_[first + t] & kDegenerateUv) != 0) std::fill_n(groups + 3 * t, 3, kNone);
    }
}

bool sumCannotSplit(const float* sum, std::uint32_t marks, const Vec3& normal) {
    if ((marks & (kTurnsLeft | kTurnsRight)) == 0 || (marks & kNotLight) == 0) return false;
    const Float4 x = splat(sum[0]), y = splat(sum[1]), z = splat(sum[2]);
    const Vec3x4 n{splat(normal.x), splat(normal.y), splat(normal.z)};
    return laneBits(cannotSplit(dot(Vec3x4{x, y, z}, Vec3x4{x, y, z}), splat(sum[3]),
                                Mask4{} + static_cast<std::int32_t>(marks), n)) != 0;
}

void finishInRanges(std::size_t count, const FinishNodes& finish, Parallel& parallel) {
    constexpr std::size_t kStep = 64, kGrain = 128;  // nodes; steps
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
    sums.scattered = isScattered(sweep);
    const unsigned shift = range_shift != 0 ? range_shift : rangeShift(sweep, parallel.width());
    const std::size_t ranges = ((node_count - 1) >> shift) + 1;
    sweep.asks = sums.scattered && shift > kScatteredShift;
    std::optional<RangeLists> range_lists;
    if (ranges > 1) {
        range_lists.emplace(MeshTriangles(welded, nullptr), kTermTriangles, node_count, std::size_t{1} << shift,
                            transient.allocator(), parallel);
        sweep.lists = &*range_lists;
    }
    const std::size_t tasks = std::min<std::size_t>(ranges, parallel.width());
    const std::size_t fans_each = std::min(node_count, std::size_t{1} << shift) / kManyShare + 64;
    Buffer<ManyPaths> many_paths(transient.allocator(), tasks * fans_each);
    std::atomic<std::size_t> next{0};
    parallel.forTasks(tasks, [&](std::size_t task) {
        Summer summer(sweep);
        for (std::size_t range = next++; range < ranges; range = next++) {
            const std::size_t end = std::min((range + 1) << shift, node_count);
            summer.run(range, range << shift, end, {many_paths.data() + task * fans_each, fans_each});
            if (ranges > 1) finish(range << shift, end);
        }
    });
    std::uint32_t degenerate = 0, no_uv_area = 0, mirrored = 0;
    for (const TriangleKind kind : sums.kinds) {
        degenerate += (kind & kDegenerateTriangle) != 0 ? 1 : 0;
        no_uv_area += (kind & (kDegenerateTriangle | kDegenerateUv)) == kDegenerateUv ? 1 : 0;
        mirrored += kind == kMirrored ? 1 : 0;
    }
    sums.degenerate_count = degenerate;
    sums.no_uv_area_count = no_uv_area;
    sums.mirrored_count = mirrored;
    if (ranges == 1) finishInRanges(node_count, finish, parallel);
}

}  // namespace tspace::mikk
