// SPDX-License-Identifier: MIT
// Grouping and evaluation in one pass over the triangles, for simple nodes: one fan, one orientation, tangents that the
// angular test cannot separate. Nearly all nodes of nearly all meshes are simple. The steps, in the order of this file:
//
//   1. sums: for all nodes, with the marks shared by their triangles, and their fans (node_sums.cpp)
//   2. finishNodes: replaces the sums of simple nodes by results in place; marks others as complex
//   3. checkPolygons, checkDegenerateUvs: mark nodes as complex if the reference's rules about whole triangles apply
//   4. estimators: for `fast` and `best` the sums are replaced by estimates, for simple and complex nodes together
//   5. writeCorners: each corner gets the result of its node
//   6. the vertex path plans and evaluates complex nodes (plan.cpp, evaluate.cpp), overwriting the results of step 5
//
// The vertex path gives equal bits for any node, so results do not depend on which nodes are simple.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <span>
#include <utility>

#include "core/base/memory.h"
#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/evaluate.h"
#include "core/tangents/mikktspace/node_sums.h"
#include "core/tangents/mikktspace/vertex_path.h"
#include "core/tangents/mikktspace/weld.h"

namespace tspace::mikk {
namespace {

constexpr std::size_t kCornerGrain = 16384;
constexpr std::uint16_t kReplaced = 0x8000;  ///< flag in NodeSums::marks: the node has a default instead of an estimate

/// State that the steps of one single-pass tangent computation share.
struct OnePass {
    OnePass(const NodeSetting& setting, const TangentOutput& output, ScratchBlock& scratch, Parallel& threads)
        : in(setting), out(output), transient(scratch), parallel(threads),
          allocator(setting.options.execution.allocator), sink(output, setting.options.convention), defaults(output),
          complex(allocator, setting.nodes.count / 64 + 1, std::uint64_t{0}) {}

    /// Returns whether the method is `fast` or `best`: estimators compute its sums, and this pass only forms groups.
    [[nodiscard]] bool estimates() const { return isEstimated(in.options.method); }
    [[nodiscard]] bool isComplex(std::size_t n) const { return (complex[n / 64] >> (n % 64) & 1) != 0; }

    /// Leaves a node to the vertex path, even if it was finished. (If it had no groups, it was not counted.)
    void makeComplex(std::uint32_t node) {
        std::uint64_t& word = complex[node / 64];
        const std::uint64_t bit = std::uint64_t{1} << (node % 64);
        if ((word & bit) != 0) return;
        word |= bit;
        ++complex_count;
        if (!sums.isEmpty(node)) --group_count;
    }

    const NodeSetting& in;
    TangentOutput out;
    ScratchBlock& transient;
    Parallel& parallel;
    const Allocator* allocator;
    Sink sink;
    DefaultCorners defaults;

    NodeSums sums;
    Buffer<std::uint64_t> complex;  ///< one bit per node
    std::atomic<std::size_t> complex_count{0};
    std::atomic<std::uint64_t> group_count{0};
};

// -- 2. simple nodes --

struct FourKinds {
    unsigned complex, empty;  ///< one bit for each of the four nodes
};

/// Finishes the nodes n to n + 3, one per lane. If only `left` of them exist, the last one is repeated in the remaining
/// lanes.
FourKinds finishFour(OnePass& pass, std::size_t n, std::size_t left) {
    const auto nodeOf = [=](std::size_t i) { return n + std::min(i, left - 1); };
    const std::size_t at[4] = {n, nodeOf(1), nodeOf(2), nodeOf(3)};
    const auto inLanes = [&](const auto& of) {
        const auto lane = [&](std::size_t i) { return static_cast<std::int32_t>(of(at[i])); };
        return Mask4{lane(0), lane(1), lane(2), lane(3)};
    };
    NodeSum* const nodes = pass.sums.nodes.data();
    const Mask4 marks = inLanes([all = pass.sums.marks.data()](std::size_t node) { return all[node]; });
    const Mask4 second_path = inLanes([=](std::size_t node) { return nodes[node].fan.secondPath(); });
    const auto has = [&](std::uint32_t mark) { return (marks & static_cast<std::int32_t>(mark)) != 0; };
    const Mask4 up = has(kFacesUp), down = has(kFacesDown), empty = up & down;
    // A node with one orientation has triangles, so its fan has at least one path; without a second path it is one fan.
    Mask4 simple = (up ^ down) & (second_path == 0);
    const unsigned missing = 15u & ~0u << std::min<std::size_t>(left, 4);
    if (pass.estimates()) return {laneBits(~(simple | empty)) & ~missing, laneBits(empty) & ~missing};
    Float4 x = loadFloat4(nodes[at[0]].s), y = loadFloat4(nodes[at[1]].s), z = loadFloat4(nodes[at[2]].s),
           w = loadFloat4(nodes[at[3]].s);
    transpose4(x, y, z, w);
    const Float4 square = dot(Vec3x4{x, y, z}, Vec3x4{x, y, z});
    // If a sum vanishes, its node is left to the vertex path.
    simple &= (square > splat(0)) & (square < splat(__builtin_huge_valf()));
    if (pass.in.maySplit()) simple &= has(kTangentSides) & has(kBitangentSides);
    for (std::size_t i = 0; !pass.sums.rest.empty() && i < std::min<std::size_t>(left, 4); ++i) {
        GroupRest& rest = pass.sums.rest[at[i]];
        rest = restOf(empty[i] != 0 ? Tangents{} : meanOf({}, rest, nodes[at[i]].s[3], false));
    }
    const Float4 inverse = splat(1) / sqrt4(square);
    const Mask4 negative = ~(marks & ~empty) << 31;  // moves the bit of kFacesUp to the sign bit
    const Float4 sign = std::bit_cast<Float4>(std::bit_cast<Mask4>(splat(pass.sink.sign(true))) ^ negative);
    w = sign;
    x = select4(empty, splat(1), inverse * x);
    y = select4(empty, splat(0), inverse * y);
    z = select4(empty, splat(0), inverse * z);
    transpose4(x, y, z, w);
    storeFloat4(nodes[at[0]].s, x);
    storeFloat4(nodes[at[1]].s, y);
    storeFloat4(nodes[at[2]].s, z);
    storeFloat4(nodes[at[3]].s, w);
    return {laneBits(~(simple | empty)) & ~missing, laneBits(empty) & ~missing};
}

/// Marks complex nodes, and replaces the sums of all others by results in place (estimated methods have no sums).
/// `first`: a multiple of 64. May be called by several threads.
void finishNodes(OnePass& pass, std::size_t first, std::size_t end) {
    std::uint64_t complex_here = 0, groups_here = 0;
    for (; first < end; first += 64) {
        const std::size_t last = std::min(first + 64, end);
        std::uint64_t complex = 0, empty = 0;
        for (std::size_t n = first; n < last; n += 4) {
            const FourKinds kinds = finishFour(pass, n, last - n);
            complex |= std::uint64_t{kinds.complex} << (n - first);
            empty |= std::uint64_t{kinds.empty} << (n - first);
        }
        pass.complex[first / 64] = complex;
        complex_here += static_cast<std::uint64_t>(std::popcount(complex));
        groups_here += last - first - static_cast<std::uint64_t>(std::popcount(complex | empty));
    }
    pass.complex_count += complex_here;
    pass.group_count += groups_here;
}

// -- 3. nodes that are complex because of properties of whole triangles --

/// Marks nodes of faces whose triangles differ as complex. All triangles of a face use the same orientation, and
/// degenerate ones copy results; only the vertex path implements this.
void checkPolygons(OnePass& pass) {
    const Buffer<std::uint32_t>& faces = pass.in.triangles.faces;
    for (std::size_t first = 0, end = 0; first < faces.size(); first = end) {
        const TriangleKind kind = pass.sums.kinds[first];
        bool agree = (kind & kDegenerateTriangle) == 0;
        for (end = first; end < faces.size() && faces[end] == faces[first]; ++end)
            agree &= pass.sums.kinds[end] == kind;
        if (agree || end - first == 1) continue;
        for (std::size_t i = 3 * first; i < 3 * end; ++i) {
            pass.makeComplex(pass.in.nodeAt(i));
            pass.sums.marks[pass.in.nodeAt(i)] = 0;
        }
    }
}

/// Calls body(triangle, its nodes) for each triangle without UV area. Tests eight kinds at once, since such triangles
/// are rare.
template <class Body>
void forEachDegenerateUv(const OnePass& pass, const Body& body) {
    constexpr std::uint64_t kDegenerateUvs = 0x0101010101010101u * kDegenerateUv;
    const Buffer<TriangleKind>& kinds = pass.sums.kinds;
    for (std::size_t begin = 0; begin < kinds.size(); begin += sizeof(std::uint64_t)) {
        const std::size_t count = std::min(sizeof(std::uint64_t), kinds.size() - begin);
        std::uint64_t any = 0;
        std::memcpy(&any, kinds.data() + begin, count);
        if ((any & kDegenerateUvs) == 0) continue;
        std::uint32_t nodes[3 * sizeof any];
        MeshTriangles(pass.in, nullptr).read(begin, count, nullptr, nodes);
        for (std::size_t t = 0; t < count; ++t) {
            if ((kinds[begin + t] & (kDegenerateUv | kDegenerateTriangle)) == kDegenerateUv)
                body(begin + t, nodes + 3 * t);
        }
    }
}

/// Prepares counting of default corners, so that no corner is counted twice: several triangles of a polygon may share a
/// corner of the mesh.
void distinguishDefaults(OnePass& pass) {
    if (pass.in.hasPolygons()) pass.defaults.distinguish(pass.in.mesh.cornerCount(), pass.allocator);
}

/// Marks nodes at which triangles without UV area need the vertex path. Such a triangle uses the orientation of the
/// first group that reaches it, at any of its nodes. If all other triangles at its three nodes have the same
/// orientation, it uses that orientation, whatever the order of groups, and only links its neighbors in the fan. Nodes
/// of other such triangles become complex, unless they have no other triangle and so no group. Corners there are
/// counted as defaults.
void checkDegenerateUvs(OnePass& pass) {
    if (pass.sums.report.degenerate_uv_count == 0) return;
    distinguishDefaults(pass);
    forEachDegenerateUv(pass, [&](std::size_t triangle, const std::uint32_t* nodes) {
        std::uint32_t facing = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t here = pass.sums.marks[nodes[k]] & kFacing;
            // If the marks are 0, the node's triangles may have any orientation.
            facing |= here == 0 ? kFacing : here == kFacing ? 0 : here;
            if (here == kFacing) pass.defaults.add(pass.in.triangles.corner(3 * triangle + k));
        }
        for (std::size_t k = 0; facing == kFacing && k < 3; ++k) {
            if (!pass.sums.isEmpty(nodes[k])) pass.makeComplex(nodes[k]);
        }
    });
}

// -- 4. estimates --

/// Triangles with one numbering for all groups. A simple node is one group, with the number of the node. Groups of
/// complex nodes come from `plan`, and their numbers follow those of all nodes. So all groups are estimated together.
class JoinedTriangles final : public TriangleGroups {
  public:
    /// `is_planned`: one bit per node, set for complex nodes.
    JoinedTriangles(const TriangleGroups& by_node, std::size_t node_count, const EvaluationPlan& plan,
                    std::span<const std::uint64_t> is_planned)
        : TriangleGroups(by_node.count), by_node_(by_node), node_count_(static_cast<std::uint32_t>(node_count)),
          plan_(plan), is_planned_(is_planned) {}

    void read(std::size_t first, std::size_t triangles, std::uint32_t* vertices, std::uint32_t* groups) const override {
        by_node_.read(first, triangles, vertices, groups);
        const std::uint32_t *begin = plan_.triangles.data(), *end = begin + plan_.triangles.size();
        for (const std::uint32_t* t = std::lower_bound(begin, end, first); t != end && *t < first + triangles; ++t) {
            const std::uint32_t* planned = plan_.groups.data() + 3 * (t - begin);
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t& group = groups[3 * (*t - first) + k];
                if (group >= node_count_ || (is_planned_[group / 64] >> (group % 64) & 1) == 0) continue;
                group = planned[k] < plan_.group_count ? node_count_ + planned[k] : kNone;
            }
        }
    }

  private:
    const TriangleGroups& by_node_;
    std::uint32_t node_count_;
    const EvaluationPlan& plan_;
    std::span<const std::uint64_t> is_planned_;
};

/// Estimates all groups together, since a step of `best` reads the results of neighboring groups. Results of simple
/// nodes replace their sums; those of the plan's groups are returned.
GroupSums estimateWithPlan(OnePass& pass, const EvaluationPlan& plan) {
    if (!requestsOnlyTangents(pass.out)) pass.sums.rest = Buffer<GroupRest>(pass.allocator, pass.in.nodes.count);
    GroupSums planned = allocateSums(plan, needsOnlyTangents(plan, pass.out), pass.allocator);
    const bool has_degenerate_uvs = pass.sums.report.degenerate_uv_count != 0;
    const MeshTriangles by_node(pass.in, has_degenerate_uvs ? pass.sums.kinds.data() : nullptr);
    const JoinedTriangles joined(by_node, pass.in.nodes.count, plan, {pass.complex.data(), pass.complex.size()});
    const estimators::GroupEstimates to[2] = {{reinterpret_cast<std::byte*>(pass.sums.nodes.data()), sizeof(NodeSum),
                                               pass.sums.rest.data(), pass.in.nodes.count},
                                              estimatesIn(planned)};
    if constexpr (kHasAllMethods) {
        Execution execution = pass.in.options.execution;
        execution.allocator = pass.transient.allocator();
        estimators::estimateGroups(pass.in.options.method, pass.in.options.refine, joined,
                                   {pass.in.mesh.positions, pass.in.mesh.normals}, pass.in.mesh.uvs,
                                   inputScale(by_node, pass.in.mesh.positions, pass.in.mesh.uvs), to, execution,
                                   pass.parallel);
    }
    return planned;
}

/// Converts estimates of simple nodes to results, with defaults for those that vanish. Returns whether any did.
bool finishEstimates(OnePass& pass, std::size_t first, std::size_t end) {
    bool any_replaced = false;
    for (std::size_t n = first; n < end; ++n) {
        if (pass.isComplex(n)) continue;
        float* const row = pass.sums.row(n);
        const bool empty = pass.sums.isEmpty(n), is_default = empty || !notZero(vectorOf(row));
        row[3] = pass.sink.sign(!empty && (pass.sums.marks[n] & kFacesUp) != 0);
        if (!is_default) continue;
        row[0] = 1;
        row[1] = row[2] = 0;
        if (!pass.sums.rest.empty()) pass.sums.rest[n] = restOf(Tangents{});
        if (empty) continue;
        pass.sums.marks[n] |= kReplaced;
        any_replaced = true;
    }
    return any_replaced;
}

/// Counts the corners of nodes whose estimate vanished.
void countReplaced(OnePass& pass) {
    distinguishDefaults(pass);
    for (std::size_t i = 0; i < 3 * pass.in.triangles.count; ++i) {
        if ((pass.sums.marks[pass.in.nodeAt(i)] & kReplaced) != 0) pass.defaults.add(pass.in.triangles.corner(i));
    }
}

/// Computes estimates (step 4), and returns the results of the plan's groups.
GroupSums estimate(OnePass& pass, const EvaluationPlan& plan) {
    GroupSums planned = estimateWithPlan(pass, plan);
    std::atomic<bool> any_replaced{false};
    finishInRanges(
        pass.in.nodes.count,
        [&](std::size_t first, std::size_t end) {
            if (finishEstimates(pass, first, end)) any_replaced.store(true, std::memory_order_relaxed);
        },
        pass.parallel);
    if (any_replaced) countReplaced(pass);
    return planned;
}

// -- 5. corners --

/// Writes a range of corners in parts. The nodes of the next part are looked up, and prefetched, before a part is
/// written.
void writeCorners(const OnePass& pass, std::size_t first, std::size_t end) {
    constexpr std::size_t kPart = 64;
    const bool streamed = pass.out.tangents.stride_bytes == sizeof(Vec4) &&
                          areStreamed(pass.out.tangents.data, pass.out.tangents.count * sizeof(Vec4));
    std::uint32_t scratch[2][kPart];
    const auto lookUp = [&](std::size_t begin, std::uint32_t* room) {
        const std::size_t count = std::min(kPart, end - begin);
        const std::uint32_t* nodes =
            pass.in.nodes.ofVertices(readIndices(pass.in.mesh.indices, begin, count, room), count, room);
        if (!pass.sums.scattered) return nodes;
        for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(pass.sums.row(nodes[i]));
        return nodes;
    };
    const std::uint32_t* nodes = lookUp(first, scratch[0]);
    for (std::size_t other = 1; first < end; first += kPart, other ^= 1) {
        const std::uint32_t* following = first + kPart < end ? lookUp(first + kPart, scratch[other]) : nullptr;
        const std::size_t count = std::min(kPart, end - first);
        const auto write = [&, to = pass.out.tangents, rows = pass.sums.nodes.data()](const auto& store) {
            for (std::size_t i = 0; i < count; ++i) store(&to[first + i].x, rows[nodes[i]].s);
        };
        if (streamed) {
            write([](float* to, const float* row) { streamRow(to, row); });
        } else {
            write([](float* to, const float* row) { storeFloat4(to, loadFloat4(row)); });
        }
        for (std::size_t i = 0; !pass.sums.rest.empty() && i < count; ++i)
            pass.sink.writeRest(first + i, pass.sums.rest[nodes[i]]);
        nodes = following;
    }
    if (streamed) endOfRows();
}

/// Writes all corners, including those of complex nodes, which the vertex path overwrites.
void writeCorners(const OnePass& pass) {
    pass.parallel.forRanges(pass.in.mesh.cornerCount(), kCornerGrain,
                            [&](std::size_t begin, std::size_t end) { writeCorners(pass, begin, end); });
    for (const std::uint32_t c : pass.in.triangles.skipped_corners) pass.sink.clear(c);
}

// -- 6. complex nodes --

Buffer<std::uint32_t> complexNodes(const OnePass& pass) {
    Buffer<std::uint32_t> chosen(pass.allocator, pass.complex_count);
    std::size_t count = 0;
    for (std::size_t word = 0; word < pass.complex.size(); ++word) {
        for (std::uint64_t bits = pass.complex[word]; bits != 0; bits &= bits - 1)
            chosen[count++] = static_cast<std::uint32_t>(64 * word + static_cast<unsigned>(std::countr_zero(bits)));
    }
    return chosen;
}

}  // namespace

TangentReport evaluateInOnePass(const NodeSetting& setting, const TangentOutput& out, ScratchBlock& transient,
                                Parallel& parallel, unsigned range_shift) {
    OnePass pass(setting, out, transient, parallel);
    const TangentOptions& options = setting.options;
    const Pose pose{setting.mesh.positions, setting.mesh.normals};
    CornerSource source =
        cornerSource(pose, setting.mesh.uvs, options.method, pass.estimates() || requestsOnlyTangents(out));
    source.adding_only = true;
    sumNodes(
        setting, source, cornerTermsFor(setting.options.execution.simd), transient, pass.allocator, parallel, pass.sums,
        [&](std::size_t first, std::size_t end) { finishNodes(pass, first, end); }, range_shift);
    checkPolygons(pass);
    checkDegenerateUvs(pass);
    for (const std::uint32_t node : setting.bucket.nodes) {
        if (!pass.sums.isEmpty(node)) pass.makeComplex(node);
    }
    TangentReport report = pass.sums.report;
    // The sums are released before the corners of complex nodes are listed, except for estimates, which need the groups
    // of all nodes first.
    if (!pass.estimates()) {
        writeCorners(pass);
        pass.sums = {};
    }
    TangentReport of_complex;
    if (pass.complex_count != 0 || pass.estimates()) {
        EvaluationPlan plan;
        if (pass.complex_count != 0) {
            const Buffer<std::uint32_t> chosen = complexNodes(pass);
            plan = planChosen({setting, {chosen.data(), chosen.size()}, false, PlanUse::once, parallel});
        }
        GroupSums estimates;
        if (pass.estimates()) {
            estimates = estimate(pass, plan);
            writeCorners(pass);
        }
        of_complex = evaluateGroups(plan, pose, setting.mesh.uvs, out, setting.options.execution, parallel,
                                    pass.estimates() ? &estimates : nullptr);
    }
    report.skipped_face_count = setting.triangles.skipped_face_count;
    report.reference_order_abandoned = of_complex.reference_order_abandoned || setting.bucket.abandoned;
    report.group_count = of_complex.group_count + pass.group_count;
    report.default_corner_count = of_complex.default_corner_count + pass.defaults.count();
    report.not_finite_count = of_complex.not_finite_count;
    return report;
}

}  // namespace tspace::mikk
