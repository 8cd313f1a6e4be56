// SPDX-License-Identifier: MIT
// Computes the tangents of a mesh of at most 64 triangles with the steps of plain.cpp, on the stack: the contributions
// of all corners are computed at once (corner_terms.h), and a set of triangles is a 64-bit word. The results equal
// those of the vertex path, whose plans and lists would cost more than the tangents of so few triangles.
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/tangents/mikktspace/groups.h"

namespace tspace::mikk {
namespace {

static_assert(kTermTriangles == 64);

/// Half-edge in 8 bits: 4 * t + k is half-edge k of triangle t.
using PackedEdge = std::uint8_t;
constexpr PackedEdge kNoNeighbor = 255;
constexpr unsigned kNext[] = {1, 2, 0}, kPrevious[] = {2, 0, 1};

constexpr std::uint64_t bitOf(unsigned triangle) { return std::uint64_t{1} << triangle; }

/// Calls body(triangle) for each triangle of a set, in ascending order.
template <class Body>
void forTriangles(std::uint64_t triangles, const Body& body) {
    for (; triangles != 0; triangles &= triangles - 1) body(static_cast<unsigned>(std::countr_zero(triangles)));
}

class SmallMesh {
  public:
    SmallMesh(const WeldedMesh& welded, const Call<TangentOptions>& options, const TangentOutput& out,
              const Allocator* transient, Parallel& parallel)
        : in_(welded), options_(options), transient_(transient), parallel_(parallel), tangents_(out.tangents),
          sink_(out, options.convention), defaults_(out), count_(static_cast<unsigned>(welded.triangles.count)),
          needs_rest_(!requestsOnlyTangents(out)), cosine_(thresholdCosine(options.angular_threshold_deg)),
          rest_(options.execution.allocator, needs_rest_ ? 3 * welded.triangles.count + 1 : 0) {}

    TangentReport run() {
        readTriangles();
        pairEdges();
        if (options_.pairing == Pairing::reference) linkLastBucket();
        for (unsigned t = 0; t < count_; ++t) {
            for (unsigned k = 0; k < 3; ++k) openGroup(t, k);
        }
        finishMeans();
        if (!isAllGood()) copyToDegenerate();
        writeCorners();
        return report_;
    }

  private:
    // Steps 1 to 3 of plain.cpp.

    void readTriangles() {
        const unsigned count = count_;
        const std::uint32_t* const vertices = mikk::readTriangles(in_.mesh, in_.triangles, 0, count, vertices_);
        if (vertices != vertices_) std::copy_n(vertices, 3 * count, vertices_);
        const std::uint32_t* const nodes = in_.nodes.ofVertices(vertices_, 3 * count, nodes_);
        if (nodes != nodes_) std::copy_n(nodes, 3 * count, nodes_);
        for (unsigned i = 0; in_.nodes.mixed && i < 3 * count; ++i) vertices_[i] = in_.nodes.vertex(nodes_[i]);
        const std::size_t padded = (count + kTermGroup - 1) / kTermGroup * kTermGroup;
        std::fill(vertices_ + 3 * count, vertices_ + 3 * padded, vertices_[0]);
        const Pose pose{in_.mesh.positions, in_.mesh.normals};
        const CornerSource source{vertexArrays(pose, in_.mesh.uvs), Weighting::projected_angle, !needs_rest_, true,
                                  &directions_};
        cornerTermsFor(options_.execution.simd)(source, vertices_, count, terms_);
        for (unsigned t = 0; t < count; ++t) {
            const std::uint32_t marks = terms_.marks[0][t];
            if ((marks & kDegenerateMark) != 0) continue;
            good_ |= bitOf(t);
            if ((marks & kNoUvArea) == 0) adding_ |= bitOf(t);
            if ((marks & kMirroredMark) == 0) up_ |= bitOf(t);
        }
        const auto sizeOf = [](std::uint64_t set) { return static_cast<unsigned>(std::popcount(set)); };
        report_.triangle_count = count;
        report_.degenerate_triangle_count = count - sizeOf(good_);
        report_.degenerate_uv_count = sizeOf(good_ & ~adding_);
        report_.mirrored_count = sizeOf(adding_ & ~up_);
    }

    // Step 4 of plain.cpp: neighbors.

    /// Pairs each half-edge with the oldest unpaired one between the same nodes in the opposite direction; without one,
    /// it stays unpaired until a later one matches (groups.h).
    void pairEdges() {
        std::fill_n(around_, in_.nodes.count, std::uint64_t{0});
        std::fill_n(neighbors_, 4 * in_.triangles.count, kNoNeighbor);
        forTriangles(good_, [&](unsigned t) {
            const std::uint32_t* const n = nodes_ + 3 * t;
            for (unsigned k = 0; k < 3; ++k) {
                std::uint64_t others = around_[n[k]] & around_[n[kNext[k]]];
                for (; others != 0; others &= others - 1) {
                    const auto other = static_cast<unsigned>(std::countr_zero(others));
                    const std::uint32_t* const m = nodes_ + 3 * other;
                    const unsigned j = m[0] == n[kNext[k]] ? 0 : m[1] == n[kNext[k]] ? 1 : 2;
                    if (m[kNext[j]] != n[k] || neighbors_[4 * other + j] != kNoNeighbor) continue;
                    neighbors_[4 * other + j] = static_cast<PackedEdge>(4 * t + k);
                    neighbors_[4 * t + k] = static_cast<PackedEdge>(4 * other + j);
                    break;
                }
            }
            for (unsigned k = 0; k < 3; ++k) around_[n[k]] |= bitOf(t);
        });
    }

    /// Links half-edges as the reference does, if the order of its last bucket matters.
    void linkLastBucket() {
        if (isAllGood() && !lastBucketMayMatter({in_, nodes_, around_})) return;
        const LastBucket bucket = findLastBucket(in_, transient_, options_.execution.allocator, parallel_);
        report_.reference_order_abandoned = bucket.abandoned;
        const auto packed = [](std::uint32_t h) {
            return static_cast<PackedEdge>(h == kNone ? kNone : h / 3 * 4 + h % 3);
        };
        for (const LastBucket::Link& link : bucket.links) neighbors_[packed(link.half_edge)] = packed(link.partner);
    }

    [[nodiscard]] bool isAllGood() const { return good_ == ~std::uint64_t{0} >> (64 - count_); }

    // Steps 5 and 6 of plain.cpp: groups and means. Means are numbered from 1; number 0 is the default tangent of
    // corners that no group reaches.

    void openGroup(unsigned t, unsigned k) {
        if ((adding_ & bitOf(t)) == 0 || mean_of_[3 * t + k] != 0) return;
        const bool up = (up_ & bitOf(t)) != 0;
        std::uint64_t members = bitOf(t);
        corner_of_[t] = static_cast<std::uint8_t>(k);
        mean_of_[3 * t + k] = static_cast<std::uint8_t>(means_);
        walk(t, k, true, up, members);
        walk(t, k, false, up, members);
        ++report_.group_count;
        const std::uint64_t adding = members & adding_;
        std::uint32_t marks = kAllMarks;
        forTriangles(adding, [&](unsigned member) { marks &= marksOf(member); });
        const bool is_alone = (members & (members - 1)) == 0;
        is_alone || areNear(marks) ? addMean(adding, up) : separate(up, members);
    }

    /// Adds the triangles that follow around the node to the group, until one is missing, already in a group, or has
    /// the opposite orientation.
    void walk(unsigned t, unsigned k, bool forward, bool up, std::uint64_t& members) {
        for (;;) {
            const PackedEdge across = neighbors_[4 * t + (forward ? k : kPrevious[k])];
            if (across == kNoNeighbor) return;
            t = across / 4;
            k = forward ? kNext[across % 4] : across % 4;
            const std::uint64_t bit = bitOf(t);
            std::uint8_t* const means = mean_of_ + 3 * t;
            if (means[k] != 0) return;
            const bool may_turn = (adding_ & bit) == 0 && (means[0] | means[1] | means[2]) == 0;
            if (may_turn) up_ = up ? up_ | bit : up_ & ~bit;
            if (((up_ & bit) != 0) != up) return;
            means[k] = static_cast<std::uint8_t>(means_);
            members |= bit;
            corner_of_[t] = static_cast<std::uint8_t>(k);
        }
    }

    [[nodiscard]] unsigned rowOf(unsigned t) const { return 3 * t + corner_of_[t]; }
    [[nodiscard]] std::uint32_t marksOf(unsigned t) const { return terms_.marks[corner_of_[t]][t]; }

    /// Returns whether the common marks of some corners guarantee that all of these corners are averaged
    /// (corner_terms.h).
    [[nodiscard]] bool areNear(std::uint32_t marks) const {
        return cosine_ == -1.0f && (marks & kTangentSides) != 0 && (marks & kBitangentSides) != 0;
    }

    /// Assigns to each member the mean of the members whose directions differ from its own by less than the threshold.
    [[gnu::noinline]] void separate(bool up, std::uint64_t members) {
        const std::uint64_t adding = members & adding_;
        if (areTogether(adding)) return addMean(adding, up);
        float s[kTermTriangles][3], t[kTermTriangles][3];
        std::uint64_t apart[kTermTriangles], any = 0;
        forTriangles(members, [&](unsigned a) { apart[a] = 0; });
        forTriangles(adding, [&](unsigned a) {
            const Vec3 own_s = directionOf(directions_.unit_s, a),
                       own_t = unit(directionOf(directions_.projected_t, a));
            std::copy_n(&own_s.x, 3, s[a]);
            std::copy_n(&own_t.x, 3, t[a]);
            forTriangles(adding & (bitOf(a) - 1), [&](unsigned b) {
                const int are_within =
                    int{dot(own_s, vectorOf(s[b])) > cosine_} & int{dot(own_t, vectorOf(t[b])) > cosine_};
                apart[a] |= are_within != 0 ? 0 : bitOf(b);
                apart[b] |= are_within != 0 ? 0 : bitOf(a);
            });
            any |= apart[a];
        });
        if (any == 0) return addMean(adding, up);
        std::uint64_t last = 0;
        forTriangles(members, [&](unsigned a) {
            const std::uint64_t set = adding & ~apart[a];
            if (set != last) addMean(set, up);
            last = set;
            mean_of_[rowOf(a)] = static_cast<std::uint8_t>(means_ - 1);
        });
    }

    /// Returns whether every two of the corners are within the threshold. Their marks decide for most pairs.
    [[nodiscard]] bool areTogether(std::uint64_t set) const {
        std::uint32_t marks[kTermTriangles];
        std::uint8_t triangles[kTermTriangles];
        unsigned count = 0;
        for (; set != 0; set &= set - 1, ++count) {
            const auto t = static_cast<unsigned>(std::countr_zero(set));
            triangles[count] = static_cast<std::uint8_t>(t);
            marks[count] = marksOf(t);
            for (unsigned i = 0; i < count; ++i) {
                if (!areNear(marks[count] & marks[i]) && !areWithin(triangles[i], t)) return false;
            }
        }
        return true;
    }

    /// Returns whether two corners are within the threshold.
    [[nodiscard]] bool areWithin(unsigned a, unsigned b) const {
        const auto& [s, t] = directions_;
        return dot(directionOf(s, a), directionOf(s, b)) > cosine_ &&
               dot(unit(directionOf(t, a)), unit(directionOf(t, b))) > cosine_;
    }

    [[nodiscard]] Vec3 directionOf(const float (&directions)[3][3][kTermTriangles], unsigned t) const {
        const unsigned k = corner_of_[t];
        return {directions[0][k][t], directions[1][k][t], directions[2][k][t]};
    }

    /// Computes the sum over some triangles, which becomes the next mean.
    void addMean(std::uint64_t set, bool up) {
        Float4 sum{};
        forTriangles(set, [&](unsigned t) { sum += loadFloat4(terms_.s[rowOf(t)]); });
        storeFloat4(sums_[means_], sum);
        signs_[means_] = sink_.sign(up);
        if (needs_rest_) {
            rest_[means_] = {};
            forTriangles(set, [&](unsigned t) { addRest(rest_[means_], terms_, t, corner_of_[t]); });
        }
        ++means_;
    }

    /// Converts sums to means in place, four at a time: single divisions and square roots would wait for each other.
    void finishMeans() {
        const Tangents none{};
        for (unsigned i = means_; i < means_ + 3; ++i) std::fill_n(sums_[i], 4, 1.0f);
        std::fill_n(signs_ + means_, 3, 1.0f);
        for (unsigned i = 1; needs_rest_ && i < means_; ++i)
            rest_[i] = restOf(mikk::meanOf({}, rest_[i], sums_[i][3], false));
        for (unsigned i = 1; i < means_; i += 4) {
            Float4 x = loadFloat4(sums_[i]), y = loadFloat4(sums_[i + 1]), z = loadFloat4(sums_[i + 2]),
                   w = loadFloat4(sums_[i + 3]);
            transpose4(x, y, z, w);
            const Float4 inverse = splat(1) / sqrt4(dot(Vec3x4{x, y, z}, Vec3x4{x, y, z}));
            const auto counts = [](Float4 c) { return (c > splat(FLT_MIN)) | (c < splat(-FLT_MIN)); };
            // vectors with a component that counts as nonzero, as in unit()
            const Mask4 not_zero = counts(x) | counts(y) | counts(z);
            x = select4(not_zero, inverse * x, x);
            y = select4(not_zero, inverse * y, y);
            z = select4(not_zero, inverse * z, z);
            finite_ &= laneBits(dot(Vec3x4{x, y, z}, Vec3x4{x, y, z}) < splat(__builtin_huge_valf())) == 15u;
            w = loadFloat4(signs_ + i);
            transpose4(x, y, z, w);
            storeFloat4(sums_[i], x);
            storeFloat4(sums_[i + 1], y);
            storeFloat4(sums_[i + 2], z);
            storeFloat4(sums_[i + 3], w);
        }
        const float first[4] = {none.s.x, none.s.y, none.s.z, sink_.sign(none.positive)};
        std::copy_n(first, 4, sums_[0]);
        if (needs_rest_) rest_[0] = restOf(none);
    }

    // Steps 7 and 8 of plain.cpp: degenerate triangles and signs.

    /// For each corner of a degenerate triangle, copies the result of the first other corner at its node.
    void copyToDegenerate() {
        for (unsigned t = 0; t < count_; ++t) {
            for (unsigned k = 0; (good_ & bitOf(t)) == 0 && k < 3; ++k) {
                const std::uint32_t node = nodes_[3 * t + k];
                if (around_[node] == 0) continue;
                const auto first = static_cast<unsigned>(std::countr_zero(around_[node]));
                const std::uint32_t* const n = nodes_ + 3 * first;
                mean_of_[3 * t + k] = mean_of_[3 * first + (n[0] == node ? 0 : n[1] == node ? 1 : 2)];
            }
        }
    }

    void writeCorners() {
        for (unsigned corner = 0; corner < 3 * count_; ++corner) {
            const unsigned mean = mean_of_[corner];
            storeFloat4(&tangents_[corner].x, loadFloat4(sums_[mean]));
            if (mean == 0) [[unlikely]]
                defaults_.add(corner);
        }
        for (unsigned corner = 0; needs_rest_ && corner < 3 * count_; ++corner)
            sink_.writeRest(corner, rest_[mean_of_[corner]]);
        for (unsigned corner = 0; !finite_ && corner < 3 * count_; ++corner)
            report_.not_finite_count += !sink_.isFinite(corner);
        report_.default_corner_count = defaults_.count();
    }

    const WeldedMesh& in_;
    const Call<TangentOptions>& options_;
    const Allocator* transient_;
    Parallel& parallel_;
    StridedSpan<Vec4> tangents_;
    Sink sink_;
    DefaultCorners defaults_;
    unsigned count_;
    bool needs_rest_, finite_ = true;
    float cosine_;
    TangentReport report_;
    std::uint64_t good_ = 0;              // triangles that are not degenerate
    std::uint64_t adding_ = 0;            // triangles with UV area
    std::uint64_t up_ = 0;                // triangles with positive UV area
    std::uint64_t around_[kTermCorners];  // set of the triangles at each node
    std::uint32_t vertices_[kTermCorners], nodes_[kTermCorners];
    PackedEdge neighbors_[4 * kTermTriangles];
    // index of the corner at the group's node, for each member of the current group
    std::uint8_t corner_of_[kTermTriangles];
    std::uint8_t mean_of_[kTermCorners] = {};  // number of the mean that each corner gets
    // Number of means so far, including number 0, and the sum and sign of each mean.
    unsigned means_ = 1;
    float sums_[kTermCorners + 4][4];
    float signs_[kTermCorners + 4];
    Buffer<GroupRest> rest_;  // bitangents and lengths of each mean; empty if only tangents are requested
    CornerTerms terms_;
    CornerDirections directions_;
};

}  // namespace

bool isSmall(const WeldedMesh& welded, Method method) {
    return isMikktspace(method) && welded.triangles.count <= kTermTriangles && welded.triangles.corners.empty() &&
           welded.triangles.count != 0 && welded.nodes.count <= kTermCorners && welded.nodes.all_finite;
}

TangentReport evaluateSmall(const WeldedMesh& welded, const Call<TangentOptions>& options, const TangentOutput& out,
                            const Allocator* transient, Parallel& parallel) {
    SmallMesh mesh(welded, options, out, transient, parallel);
    return mesh.run();
}

}  // namespace tspace::mikk
