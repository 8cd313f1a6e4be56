// SPDX-License-Identifier: MIT
// The plan of a grouping method: where the data of each corner are, which sum it adds to, and which result each corner of
// the mesh takes. plan.cpp has a table of its lists.
#pragma once

#include "core/base/call.h"
#include "core/base/input_scale.h"
#include "core/base/memory.h"
#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/corner_terms.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

/// A group whose members do not all share one result (angular threshold).
struct EvaluatedSplit {
    std::uint32_t begin = 0, count = 0;  ///< its range in EvaluationPlan::members
    std::size_t rows = 0;                ///< first word in split_rows: `count` rows of (count + 63) / 64 words
    bool positive = false;
};

/// One of several results for a corner of the mesh, which are averaged where they differ.
struct Conflict {
    std::uint32_t corner = 0;
    std::uint32_t source = 0;  ///< a group, or kTopBit | a place in EvaluationPlan::members
};

struct GroupSums;

struct EvaluationPlan {
    Method method = Method::mikktspace;
    std::uint32_t refine = 0;  ///< steps of `best`
    Convention convention;
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;
    std::size_t triangle_count = 0;
    std::uint32_t group_count = 0;  ///< those that split are counted, but no half-edge names them

    /// One per half-edge: the vertex whose data stand for its corner. A plan that is kept has the corner's own vertex,
    /// because vertices that are equal on the mesh may come apart in a pose. Some more valid vertices follow at the end, so
    /// that kernels can read whole blocks.
    Buffer<std::uint32_t> vertices;
    /// One per half-edge: the group it belongs to, with kTopBit if it adds nothing to it; kNone without one,
    /// and for members of groups that split.
    Buffer<std::uint32_t> groups;
    /// One per half-edge: its corner of the mesh, with kTopBit where that is among the conflicts. Empty: half-edges are corners.
    Buffer<std::uint32_t> slots;
    Buffer<std::uint32_t> triangles;      ///< numbers in the mesh, ascending; empty: the plan is of all nodes
    Buffer<std::uint8_t> group_positive;  ///< one per group: its orientation
    Buffer<Vec2> uvs;                     ///< one per vertex; empty in a plan that is used once
    Buffer<CornerTerms> terms;            ///< in a plan that is used once: what its triangles add

    Buffer<EvaluatedSplit> splits;
    Buffer<std::uint32_t> members;     ///< half-edges of these groups
    Buffer<std::uint64_t> split_rows;  ///< bit b of row a: member b counts for member a
    std::uint32_t largest_split = 0;

    Buffer<Conflict> conflicts;             ///< by corner, then in the order in which the reference writes them
    Buffer<std::uint32_t> default_corners;  ///< corners that no group reaches
    Buffer<std::uint32_t> skipped_corners;  ///< corners of faces that are ignored: all outputs are 0
    Buffer<Copy> copies;                    ///< corners of degenerate triangles
    TangentReport report;                   ///< what can be counted without a pose

    [[nodiscard]] std::uint32_t slotOf(std::uint32_t half_edge) const {
        if (!slots.empty()) return slots[half_edge];
        return triangles.empty() ? half_edge : 3 * triangles[half_edge / 3] + half_edge % 3;
    }
    [[nodiscard]] std::size_t memoryBytes() const;
};

/// Plans a validated mesh with normals and UVs and at most kMaxHalfEdges, to be kept. Throws OutOfMemory.
EvaluationPlan planGrouped(const MeshView& mesh, const Call<TangentOptions>& options, Parallel& parallel,
                           PlanUse use = PlanUse::kept);

/// Evaluates one pose into checked outputs and completes the plan's report. `uvs`: one per vertex. Scratch memory: 12
/// bytes per group when only tangents are wanted, else 36, and core/base/range_lists.h where several threads sum. `estimates`: null, or the estimators' results for the groups
/// (roomForSums in results.h), which are moved from. Throws OutOfMemory.
TangentReport evaluateGroups(const EvaluationPlan& plan, const Pose& pose, const StridedSpan<const Vec2>& uvs,
                             const TangentOutput& out, const Execution& execution, Parallel& parallel,
                             GroupSums* estimates = nullptr);

/// Equals planGrouped and evaluateGroups on the mesh's own pose, bit for bit, in one call. Throws OutOfMemory.
TangentReport generateGrouped(const MeshView& mesh, const Call<TangentOptions>& options, const TangentOutput& out,
                              Parallel& parallel);

}  // namespace tspace::mikk
