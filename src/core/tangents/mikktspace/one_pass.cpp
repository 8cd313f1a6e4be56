// SPDX-License-Identifier: MIT
// Grouping and evaluation in one pass over the triangles, for the nodes where that can be done: one fan, one orientation,
// tangents that the angular test cannot separate. Those are nearly all nodes of nearly all meshes. Sum, look at what is
// simple, write, and give the rest to the vertex path, which has the same bits for everything.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <span>
#include <utility>

#include "core/base/caches.h"
#include "core/base/float4.h"
#include "core/base/mesh_loops.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/collect.h"
#include "core/tangents/mikktspace/node_sums.h"
#include "core/tangents/mikktspace/results.h"
#include "core/tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kCornerGrain = 16384;
constexpr std::uint16_t kReplaced = 0x8000;  ///< in NodeSums::marks: the node has a default in place of an estimate

/// For one estimate of all groups of a mesh: triangles in which each node is a group; the groups of planned nodes follow behind all nodes.
class JoinedTriangles final : public TriangleGroups {
  public:
    /// `is_planned`: one bit per node.
    JoinedTriangles(const TriangleGroups& by_node, std::size_t node_count, const EvaluationPlan& plan,
                    std::span<const std::uint64_t> is_planned)
        : TriangleGroups(by_node.count),
          by_node_(by_node),
          node_count_(static_cast<std::uint32_t>(node_count)),
          plan_(plan),
          is_planned_(is_planned) {}

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

class OnePass {
  public:
    OnePass(const NodeSetting& setting, const TangentOutput& out, ScratchBlock& transient, Parallel& parallel)
        : in_(setting),
          out_(out),
          transient_(transient),
          parallel_(parallel),
          allocator_(setting.options.execution.allocator),
          estimates_(isEstimated(setting.options.method)),
          sink_(out, setting.options.convention) {}

    TangentReport run(unsigned range_shift) {
        CornerSource source = cornerSource({in_.mesh.positions, in_.mesh.normals}, in_.mesh.uvs, in_.options.method,
                                           estimates_ || wantsTangentsOnly(out_));
        source.adding_only = true;
        complex_ = Buffer<std::uint64_t>(allocator_, in_.nodes.count / 64 + 1, std::uint64_t{0});
        sumNodes(
            in_, source, cornerTermsFor(in_.options.execution.simd), transient_, allocator_, parallel_, sums_,
            [&](std::size_t first, std::size_t end) { finishNodes(first, end); }, range_shift);
        checkFaces();
        checkDegenerateUvs();
        for (const std::uint32_t node : in_.bucket.nodes) {
            if (!sums_.isEmpty(node)) leaveNode(node);
        }
        TangentReport report = sums_.report;
        const TangentReport of_complex = write();
        report.skipped_face_count = in_.triangles.skipped_face_count;
        report.reference_order_abandoned = of_complex.reference_order_abandoned || in_.bucket.abandoned;
        report.group_count = of_complex.group_count + group_count_;
        report.default_corner_count = of_complex.default_corner_count + default_corner_count_;
        report.not_finite_count = of_complex.not_finite_count;
        return report;
    }

  private:
    /// Sums are given back before the corners of complex nodes are listed; but estimates need the groups of all nodes, since
    /// a step reads the results of all groups around.
    TangentReport write() {
        if (!estimates_) writeCorners();
        if (!estimates_) sums_ = {};
        if (complex_count_ == 0 && !estimates_) return {};
        EvaluationPlan plan;
        if (complex_count_ != 0) {
            const Buffer<std::uint32_t> chosen = complexNodes();
            plan = planChosen({in_, {chosen.data(), chosen.size()}, false, PlanUse::once, parallel_});
        }
        GroupSums estimates;
        if (estimates_) {
            estimates = estimateGroupsWith(plan);
            finishInRanges(
                in_.nodes.count, [&](std::size_t first, std::size_t end) { finishEstimates(first, end); }, parallel_);
            if (any_replaced_) countReplaced();
            writeCorners();
        }
        return evaluateGroups(plan, {in_.mesh.positions, in_.mesh.normals}, in_.mesh.uvs, out_, in_.options.execution,
                              parallel_, estimates_ ? &estimates : nullptr);
    }

    /// Results of all nodes take the place of their sums; those of the plan's groups are returned.
    GroupSums estimateGroupsWith(const EvaluationPlan& plan) {
        if (!wantsTangentsOnly(out_)) sums_.rest = Buffer<GroupRest>(allocator_, in_.nodes.count);
        GroupSums planned = roomForSums(plan, wantsOnlyTangents(plan, out_), allocator_);
        const bool has_degenerate_uvs = sums_.report.degenerate_uv_count != 0;
        const MeshTriangles by_node(in_, has_degenerate_uvs ? sums_.kinds.data() : nullptr);
        const JoinedTriangles joined(by_node, in_.nodes.count, plan, {complex_.data(), complex_.size()});
        const estimators::GroupEstimates to[2] = {
            {reinterpret_cast<std::byte*>(sums_.nodes.data()), sizeof(NodeSum), sums_.rest.data(), in_.nodes.count},
            estimatesIn(planned)};
        Execution execution = in_.options.execution;
        execution.allocator = transient_.allocator();
        estimators::estimateGroups(in_.options.method, in_.options.refine, joined,
                                   {in_.mesh.positions, in_.mesh.normals}, in_.mesh.uvs,
                                   inputScale(by_node, in_.mesh.positions, in_.mesh.uvs), to, execution, parallel_);
        return planned;
    }

    /// A triangle without UV area takes the orientation of the first group that reaches it, at any of its
    /// nodes. Where all other triangles at its three nodes have one orientation, so will it, whoever is
    /// first; then it just links its neighbours in a fan. Nodes of others are left aside, but for those where
    /// no other triangle is: there is no group.
    void checkDegenerateUvs() {
        if (sums_.report.degenerate_uv_count == 0) return;
        Marks counted;  // several triangles of a polygon may have one corner of the mesh
        if (!in_.triangles.faces.empty()) counted = noMarks(allocator_, in_.mesh.cornerCount());
        forEachDegenerateUv([&](std::size_t triangle, const std::uint32_t* nodes) {
            std::uint32_t facing = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t here = sums_.marks[nodes[k]] & kFacing;
                // A node that is left aside may have any.
                facing |= here == 0 ? kFacing : here == kFacing ? 0 : here;
                const std::size_t i = 3 * triangle + k;
                const bool counts = here == kFacing && (counted.empty() || counted[in_.triangles.corner(i)] == 0);
                default_corner_count_ += counts ? 1 : 0;
                if (!counted.empty()) counted[in_.triangles.corner(i)] |= counts ? 1 : 0;
            }
            for (std::size_t k = 0; facing == kFacing && k < 3; ++k) {
                if (!sums_.isEmpty(nodes[k])) leaveNode(nodes[k]);
            }
        });
    }

    /// Takes back what was finished. (A node without groups was not counted.)
    void leaveNode(std::uint32_t node) {
        std::uint64_t& word = complex_[node / 64];
        const std::uint64_t bit = std::uint64_t{1} << (node % 64);
        if ((word & bit) != 0) return;
        word |= bit;
        ++complex_count_;
        if (!sums_.isEmpty(node)) --group_count_;
    }

    /// body(triangle, its nodes) for those without UV area, which are few in most meshes.
    template <class Body>
    void forEachDegenerateUv(const Body& body) const {
        constexpr std::uint64_t kDegenerateUvs = 0x0101010101010101u * kDegenerateUv;
        const Buffer<TriangleKind>& kinds = sums_.kinds;
        for (std::size_t begin = 0; begin < kinds.size(); begin += sizeof(std::uint64_t)) {
            const std::size_t count = std::min(sizeof(std::uint64_t), kinds.size() - begin);
            std::uint64_t any = 0;
            std::memcpy(&any, kinds.data() + begin, count);
            if ((any & kDegenerateUvs) == 0) continue;
            std::uint32_t nodes[3 * sizeof any];
            MeshTriangles(in_, nullptr).read(begin, count, nullptr, nodes);
            for (std::size_t t = 0; t < count; ++t) {
                if ((kinds[begin + t] & (kDegenerateUv | kDegenerateTriangle)) == kDegenerateUv)
                    body(begin + t, nodes + 3 * t);
            }
        }
    }

    /// The vertex path gives all triangles of a face one orientation and treats degenerate ones in a way of its own.
    /// Nodes of faces whose triangles do not simply agree are left to it.
    void checkFaces() {
        const Buffer<std::uint32_t>& faces = in_.triangles.faces;
        for (std::size_t first = 0, end = 0; first < faces.size(); first = end) {
            const TriangleKind kind = sums_.kinds[first];
            bool agree = (kind & kDegenerateTriangle) == 0;
            for (end = first; end < faces.size() && faces[end] == faces[first]; ++end)
                agree &= sums_.kinds[end] == kind;
            if (agree || end - first == 1) continue;
            for (std::size_t i = 3 * first; i < 3 * end; ++i) {
                leaveNode(in_.nodeAt(i));
                sums_.marks[in_.nodeAt(i)] = 0;
            }
        }
    }

    /// Turns the sums of simple nodes into results, in place, but for methods that estimate; finds the others. `first`: a
    /// multiple of 64.
    void finishNodes(std::size_t first, std::size_t end) {
        std::uint64_t complex_here = 0, groups_here = 0;
        for (; first < end; first += 64) {
            const std::size_t last = std::min(first + 64, end);
            std::uint64_t complex = 0, empty = 0;
            for (std::size_t n = first; n < last; n += 4) {
                const FourKinds kinds = finishFour(n, last - n);
                complex |= std::uint64_t{kinds.complex} << (n - first);
                empty |= std::uint64_t{kinds.empty} << (n - first);
            }
            complex_[first / 64] = complex;
            complex_here += static_cast<std::uint64_t>(std::popcount(complex));
            groups_here += last - first - static_cast<std::uint64_t>(std::popcount(complex | empty));
        }
        complex_count_ += complex_here;
        group_count_ += groups_here;
    }

    [[nodiscard]] bool isComplex(std::size_t n) const { return (complex_[n / 64] >> (n % 64) & 1) != 0; }

    void finishEstimates(std::size_t first, std::size_t end) {
        bool any_replaced = false;
        for (std::size_t n = first; n < end; ++n) {
            if (isComplex(n)) continue;
            float* const row = sums_.row(n);
            const bool empty = sums_.isEmpty(n), is_default = empty || !notZero(vectorOf(row));
            row[3] = sink_.sign(!empty && (sums_.marks[n] & kFacesUp) != 0);
            if (!is_default) continue;
            row[0] = 1;
            row[1] = row[2] = 0;
            if (!sums_.rest.empty()) sums_.rest[n] = restOf(Tangents{});
            if (empty) continue;
            sums_.marks[n] |= kReplaced;
            any_replaced = true;
        }
        if (any_replaced) any_replaced_.store(true, std::memory_order_relaxed);
    }

    /// Corners of groups whose estimate vanishes.
    void countReplaced() {
        for (std::size_t i = 0; i < 3 * in_.triangles.count; ++i) {
            const std::uint32_t node = in_.nodeAt(i);
            default_corner_count_ += (sums_.marks[node] & kReplaced) != 0 ? 1 : 0;
        }
    }

    [[nodiscard]] Buffer<std::uint32_t> complexNodes() const {
        Buffer<std::uint32_t> chosen(allocator_, complex_count_);
        std::size_t count = 0;
        for (std::size_t word = 0; word < complex_.size(); ++word) {
            for (std::uint64_t bits = complex_[word]; bits != 0; bits &= bits - 1)
                chosen[count++] = static_cast<std::uint32_t>(64 * word + static_cast<unsigned>(std::countr_zero(bits)));
        }
        return chosen;
    }

    struct FourKinds {
        unsigned complex, empty;  ///< a bit per node
    };

    /// Finishes the nodes from n on: four, or the `left` ones, of which the last one then stands for those that are missing.
    /// Simple nodes have one fan of one orientation, and tangents that the angular test cannot separate.
    FourKinds finishFour(std::size_t n, std::size_t left) {
        const auto nodeOf = [=](std::size_t i) { return n + std::min(i, left - 1); };
        const std::size_t at[4] = {n, nodeOf(1), nodeOf(2), nodeOf(3)};
        const std::uint16_t* const all_marks = sums_.marks.data();
        NodeSum* const nodes = sums_.nodes.data();
        const Mask4 marks = {all_marks[at[0]], all_marks[at[1]], all_marks[at[2]], all_marks[at[3]]};
        const auto has = [&](std::uint32_t mark) { return (marks & static_cast<std::int32_t>(mark)) != 0; };
        const auto pathOf = [&](std::size_t i) { return static_cast<std::int32_t>(nodes[at[i]].fan.secondPath()); };
        const Mask4 second_path = {pathOf(0), pathOf(1), pathOf(2), pathOf(3)};
        const Mask4 up = has(kFacesUp), down = has(kFacesDown), empty = up & down;
        // With one orientation it has triangles, which make at least one path.
        Mask4 simple = (up ^ down) & (second_path == 0);
        const unsigned missing = 15u & ~0u << std::min<std::size_t>(left, 4);
        if (estimates_) return {laneBits(~(simple | empty)) & ~missing, laneBits(empty) & ~missing};
        Float4 x = loadFloat4(nodes[at[0]].s), y = loadFloat4(nodes[at[1]].s), z = loadFloat4(nodes[at[2]].s),
               w = loadFloat4(nodes[at[3]].s);
        transpose4(x, y, z, w);
        const Float4 square = dot(Vec3x4{x, y, z}, Vec3x4{x, y, z});
        // A sum that vanishes is left to the vertex path.
        simple &= (square > splat(0)) & (square < splat(__builtin_huge_valf()));
        if (in_.maySplit()) simple &= has(kTangentSides) & has(kBitangentSides);
        for (std::size_t i = 0; !sums_.rest.empty() && i < std::min<std::size_t>(left, 4); ++i) {
            GroupRest& rest = sums_.rest[at[i]];
            rest = restOf(empty[i] != 0 ? Tangents{} : meanOf({}, rest, nodes[at[i]].s[3], false));
        }
        const Float4 inverse = splat(1) / sqrt4(square);
        const Mask4 negative = ~(marks & ~empty) << 31;  // the bit of kFacesUp becomes that of the sign
        const Float4 sign = std::bit_cast<Float4>(std::bit_cast<Mask4>(splat(sink_.sign(true))) ^ negative);
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

    /// Those of complex nodes get what nobody needs.
    void writeCorners() {
        parallel_.forRanges(in_.mesh.cornerCount(), kCornerGrain,
                            [&](std::size_t begin, std::size_t end) { writeCorners(begin, end); });
        for (const std::uint32_t c : in_.triangles.skipped_corners) sink_.clear(c);
    }

    /// Nodes of one part are looked up, and asked for, before the part before it is written.
    void writeCorners(std::size_t first, std::size_t end) {
        constexpr std::size_t kPart = 64;
        const bool streamed = out_.tangents.stride_bytes == sizeof(Vec4) &&
                              areStreamed(out_.tangents.data, out_.tangents.count * sizeof(Vec4));
        std::uint32_t rooms[2][kPart];
        const auto lookUp = [&](std::size_t begin, std::uint32_t* room) {
            const std::size_t count = std::min(kPart, end - begin);
            const std::uint32_t* nodes =
                in_.nodes.ofVertices(readIndices(in_.mesh.indices, begin, count, room), count, room);
            if (!sums_.scattered) return nodes;
            for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(sums_.row(nodes[i]));
            return nodes;
        };
        const std::uint32_t* nodes = lookUp(first, rooms[0]);
        for (std::size_t other = 1; first < end; first += kPart, other ^= 1) {
            const std::uint32_t* following = first + kPart < end ? lookUp(first + kPart, rooms[other]) : nullptr;
            const std::size_t count = std::min(kPart, end - first);
            const auto write = [&, to = out_.tangents, rows = sums_.nodes.data()](const auto& store) {
                for (std::size_t i = 0; i < count; ++i) store(&to[first + i].x, rows[nodes[i]].s);
            };
            if (streamed) {
                write([](float* to, const float* row) { streamRow(to, row); });
            } else {
                write([](float* to, const float* row) { storeFloat4(to, loadFloat4(row)); });
            }
            for (std::size_t i = 0; !sums_.rest.empty() && i < count; ++i)
                sink_.writeRest(first + i, sums_.rest[nodes[i]]);
            nodes = following;
        }
        if (streamed) endOfRows();
    }

    const NodeSetting& in_;
    TangentOutput out_;
    ScratchBlock& transient_;
    Parallel& parallel_;
    const Allocator* allocator_;
    bool estimates_;  // fast and best: the estimators sum, and this class only groups
    Sink sink_;

    NodeSums sums_;
    Buffer<std::uint64_t> complex_;  // one bit per node
    std::atomic<std::size_t> complex_count_{0};
    std::atomic<std::uint64_t> group_count_{0};
    std::atomic<bool> any_replaced_{false};  // by defaults: estimates that vanish
    std::uint64_t default_corner_count_ = 0;
};

}  // namespace

TangentReport evaluateInOnePass(const NodeSetting& setting, const TangentOutput& out, ScratchBlock& transient,
                                Parallel& parallel, unsigned range_shift) {
    return OnePass(setting, out, transient, parallel).run(range_shift);
}

}  // namespace tspace::mikk
