// SPDX-License-Identifier: MIT
// Plan of a method with groups, and its evaluation: sums of groups, results, outputs.
#pragma once

#include <cfloat>
#include <cmath>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/tangents/estimators/group_estimates.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/corner_terms.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

// Precomputed plan of a tangent method that groups corners. For each triangle corner, it stores where to read the data
// and which sum it is added to; for each mesh corner, which result it receives. plan.cpp has a table of the plan's
// lists.

/// Group whose members do not all share one result, because of the angular threshold.
struct EvaluatedSplit {
    std::uint32_t begin = 0, count = 0;  ///< range in EvaluationPlan::members
    /// index of the first word in split_rows, which contains `count` rows of (count + 63) / 64 words
    std::size_t rows = 0;
    bool positive = false;
};

/// One of several results for a corner of the mesh, which are merged if they differ.
struct Conflict {
    std::uint32_t corner = 0;
    std::uint32_t source = 0;  ///< a group, or kTopBit | an index in EvaluationPlan::members
};

struct GroupSums;

struct EvaluationPlan {
    Method method = Method::mikktspace;
    std::uint32_t refine = 0;  ///< refinement steps of `best`
    Convention convention;
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;
    std::size_t triangle_count = 0;
    std::uint32_t group_count = 0;  ///< number of groups; it includes split groups, which no half-edge refers to

    /// One per half-edge: the vertex that provides the data of its corner. A plan that is kept uses the corner's own
    /// vertex, because vertices that are equal on the mesh may differ in a pose. Some additional valid vertices follow
    /// at the end, so that kernels can read whole blocks.
    Buffer<std::uint32_t> vertices;
    /// One per half-edge: its group, with kTopBit if the half-edge does not contribute to it. kNone for a half-edge
    /// without a group, and for members of groups that split.
    Buffer<std::uint32_t> groups;
    /// One per half-edge: its corner of the mesh, with kTopBit if the corner has conflicts. Empty: half-edges are
    /// corners.
    Buffer<std::uint32_t> slots;
    Buffer<std::uint32_t> triangles;      ///< triangles of the mesh, ascending; empty: the plan includes all nodes
    Buffer<std::uint8_t> group_positive;  ///< one per group: 1 for a positive orientation
    Buffer<Vec2> uvs;                     ///< one per vertex; empty in a plan that is used once
    Buffer<CornerTerms> terms;            ///< contributions of the triangles; only in a plan that is used once

    Buffer<EvaluatedSplit> splits;
    Buffer<std::uint32_t> members;     ///< half-edges of the groups that split
    Buffer<std::uint64_t> split_rows;  ///< bit b of row a: member b contributes to member a
    std::uint32_t largest_split = 0;

    /// conflicts, sorted by corner, then in the order in which the reference writes the results
    Buffer<Conflict> conflicts;
    Buffer<std::uint32_t> default_corners;  ///< corners that belong to no group
    Buffer<std::uint32_t> skipped_corners;  ///< corners of ignored faces, whose outputs are 0
    Buffer<Copy> copies;                    ///< copies for corners of degenerate triangles
    TangentReport report;                   ///< counts of the report that do not depend on the pose

    [[nodiscard]] std::uint32_t slotOf(std::uint32_t half_edge) const {
        if (!slots.empty()) return slots[half_edge];
        return triangles.empty() ? half_edge : 3 * triangles[half_edge / 3] + half_edge % 3;
    }
    /// Returns whether the plan contains the terms of the pose, as every plan of a build without kept plans.
    [[nodiscard]] bool hasTerms() const { return !kHasAllMethods || !terms.empty(); }
    [[nodiscard]] std::size_t memoryBytes() const;
};

/// Creates a plan, by default for repeated evaluation. Requires a validated mesh with normals and UVs and at most
/// kMaxHalfEdges. Throws OutOfMemory.
EvaluationPlan planGrouped(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel,
                           PlanUse use = PlanUse::kept);

/// Evaluates one pose into validated outputs, and returns the completed report. `uvs`: one per vertex. Scratch memory:
/// 12 bytes per group if only tangents are requested, otherwise 36, and the memory of RangeLists if several threads
/// compute sums. `estimates`: null, or the estimators' results for the groups (allocateSums), which are moved from.
/// Throws OutOfMemory.
TangentReport evaluateGroups(const EvaluationPlan& plan, const Pose& pose, const StridedSpan<const Vec2>& uvs,
                             const TangentOutput& out, const Execution& execution, Parallel& parallel,
                             GroupSums* estimates = nullptr);

/// Computes planGrouped and evaluateGroups on the mesh's own pose, with identical bits, in one call. Throws
/// OutOfMemory.
TangentReport generateGrouped(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                              Parallel& parallel);

// Sums of a group, the result of a group, merging of several results of a corner, and writing of outputs.

// Rules of the reference for "not zero" and for normalization, which determine the bits for tiny, zero and non-finite
// vectors.

/// Returns whether x is not zero. Subnormal numbers and NaN count as zero; infinity does not.
inline bool notZero(float x) { return std::fabs(x) > FLT_MIN; }
inline bool notZero(const Vec3& v) { return notZero(v.x) || notZero(v.y) || notZero(v.z); }

/// Returns v divided by its length; a vector that counts as zero is returned unchanged.
inline Vec3 unit(const Vec3& v) { return notZero(v) ? (1.0f / length(v)) * v : v; }

/// Returns the unit vector of v without its component along n. n is used as given, without normalization.
inline Vec3 flatten(const Vec3& n, const Vec3& v) { return unit(v - dot(n, v) * n); }

inline bool requestsOnlyTangents(const TangentOutput& out) {
    return kIsMinimal || (out.bitangents.empty() && out.magnitudes_s.empty() && out.magnitudes_t.empty());
}

/// Returns the weighting of a method. For `fast` and `best`, which compute their own sums (estimators/), the kernels
/// write only marks.
inline Weighting weightingOf(Method method) {
    switch (method) {
        case Method::fast:
        case Method::best: return Weighting::none;
        case Method::uniform: return Weighting::one;
        case Method::angle: return Weighting::angle;
        case Method::area: return Weighting::area;
        default: return Weighting::projected_angle;
    }
}

/// Returns the vertex data of a call. `uvs` must be nonempty, with one entry per vertex of the pose.
inline CornerSource cornerSource(const Pose& pose, const StridedSpan<const Vec2>& uvs, Method method,
                                 bool tangents_only) {
    return {vertexArrays(pose, uvs), weightingOf(method), tangents_only};
}

using estimators::GroupRest;

inline Vec3 vectorOf(const float* row) { return {row[0], row[1], row[2]}; }
inline Vec3 vectorOf(Float4 row) { return {row[0], row[1], row[2]}; }

struct Tangents {
    Vec3 s{1, 0, 0}, t{0, 1, 0};
    float mag_s = 1, mag_t = 1;
    bool positive = false;
};

/// Returns the bitangent and both magnitudes of a result, in the struct that otherwise holds the sums of a group.
inline GroupRest restOf(const Tangents& r) { return {{r.t.x, r.t.y, r.t.z, r.mag_s}, r.mag_t}; }

/// Returns the result of a group. s and `rest` are the sums of its members' rows (corner_terms.h).
inline Tangents meanOf(const Vec3& s, const GroupRest& rest, float weight, bool positive) {
    Tangents r{unit(s), unit(vectorOf(rest.t)), rest.t[3], rest.length_t, positive};
    if (weight > 0) {
        r.mag_s /= weight;
        r.mag_t /= weight;
    }
    return r;
}

inline bool sameResult(const Tangents& a, const Tangents& b) {
    return a.mag_s == b.mag_s && a.mag_t == b.mag_t && a.s == b.s && a.t == b.t;
}

/// Merges results by the reference's rule for a corner that is written repeatedly: equal results are kept (a NaN is
/// never equal), others become the normalized mean. The later orientation is used.
inline void merge(Tangents& first, const Tangents& second) {
    first.positive = second.positive;
    if (sameResult(first, second)) return;
    first.mag_s = 0.5f * (first.mag_s + second.mag_s);
    first.mag_t = 0.5f * (first.mag_t + second.mag_t);
    first.s = unit(first.s + second.s);
    first.t = unit(first.t + second.t);
}

/// Writes the requested outputs.
class Sink {
  public:
    /// Prepares writing. The UV determinant refers to the side to which cross(P1-P0, P2-P0) points, whereas the sign
    /// must refer to N's side.
    Sink(const TangentOutput& out, Convention convention)
        : out_(out), sign_factor_(signFactor(convention) * normalFactor(convention)),
          bitangent_factor_(signFactor(convention)) {}

    [[nodiscard]] float sign(bool positive) const { return positive ? sign_factor_ : -sign_factor_; }
    void write(std::size_t corner, const Tangents& r) const {
        out_.tangents[corner] = {r.s.x, r.s.y, r.s.z, sign(r.positive)};
        writeRest(corner, restOf(r));
    }
    void writeRest(std::size_t corner, const GroupRest& rest) const {
        if (!out_.bitangents.empty()) out_.bitangents[corner] = bitangent_factor_ * vectorOf(rest.t);
        if (!out_.magnitudes_s.empty()) out_.magnitudes_s[corner] = rest.t[3];
        if (!out_.magnitudes_t.empty()) out_.magnitudes_t[corner] = rest.length_t;
    }
    void clear(std::size_t corner) const {
        out_.tangents[corner] = {};
        if (!out_.has_tangent.empty()) out_.has_tangent[corner] = 0;
        if (!out_.bitangents.empty()) out_.bitangents[corner] = {};
        if (!out_.magnitudes_s.empty()) out_.magnitudes_s[corner] = 0;
        if (!out_.magnitudes_t.empty()) out_.magnitudes_t[corner] = 0;
    }
    void copy(const Copy& c) const {
        out_.tangents[c.to] = out_.tangents[c.from];
        if (!out_.bitangents.empty()) out_.bitangents[c.to] = out_.bitangents[c.from];
        if (!out_.magnitudes_s.empty()) out_.magnitudes_s[c.to] = out_.magnitudes_s[c.from];
        if (!out_.magnitudes_t.empty()) out_.magnitudes_t[c.to] = out_.magnitudes_t[c.from];
    }
    [[nodiscard]] bool isFinite(std::size_t corner) const { return tspace::isFinite(xyz(out_.tangents[corner])); }

  private:
    TangentOutput out_;
    float sign_factor_, bitangent_factor_;
};

/// Corners that get the default because no face contributes to them. Counts each of them once, and clears its entry of
/// TangentOutput::has_tangent, which must be all 1 initially.
class DefaultCorners {
  public:
    explicit DefaultCorners(const TangentOutput& out) : has_tangent_(out.has_tangent) {}

    /// Makes corners distinguishable. Required before `has`, and before corners are added that may have been added
    /// already.
    void distinguish(std::size_t corner_count, const Allocator* allocator) {
        if (!has_tangent_.empty()) return;
        own_ = Buffer<std::uint8_t>(allocator, corner_count, std::uint8_t{1});
        has_tangent_ = {own_.data(), own_.size()};
    }
    void add(std::size_t corner) {
        if (has_tangent_.empty()) {
            ++count_;
        } else {
            count_ += has_tangent_[corner];
            has_tangent_[corner] = 0;
        }
    }
    [[nodiscard]] bool has(std::size_t corner) const { return has_tangent_[corner] == 0; }
    [[nodiscard]] std::uint64_t count() const { return count_; }

  private:
    StridedSpan<std::uint8_t> has_tangent_;
    Buffer<std::uint8_t> own_;
    std::uint64_t count_ = 0;
};

/// Adds the bitangent and lengths of corner k of triangle t to a sum.
inline void addRest(GroupRest& sum, const CornerTerms& terms, std::size_t t, std::size_t k) {
    storeFloat4(sum.t, loadFloat4(sum.t) + loadFloat4(terms.t[3 * t + k]));
    sum.length_t += terms.lengths_t[k][t];
}

struct GroupSums {
    Buffer<Vec3> groups;     ///< weighted tangents, which take most of the memory of an evaluation
    Buffer<GroupRest> rest;  ///< bitangents and lengths of each group; empty if tangents_only
};

/// Returns whether the sums of bitangents and lengths can be omitted. Conflicts need them: whether two results of a
/// corner are merged depends on all their components.
inline bool needsOnlyTangents(const EvaluationPlan& plan, const TangentOutput& out) {
    return requestsOnlyTangents(out) && plan.conflicts.empty();
}

/// Allocates memory for the sums or estimates of a plan's groups.
GroupSums allocateSums(const EvaluationPlan& plan, bool tangents_only, const Allocator* allocator);
/// Returns the memory of `sums` in the form that estimators write to.
estimators::GroupEstimates estimatesIn(GroupSums& sums);

}  // namespace tspace::mikk
