// SPDX-License-Identifier: MIT
// What is left of a plan for evaluating poses: where each corner's data are, which sum it adds to, and which
// result each corner of the mesh holds.
#pragma once

#include "core/memory.h"
#include "tangents/estimators/input_scale.h"
#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

/// A group whose members do not all share one result (angular threshold).
struct EvaluatedSplit {
    std::uint32_t begin = 0, count = 0;  ///< its range in EvaluationPlan::members
    std::size_t rows = 0;                ///< first word in split_rows: `count` rows of (count + 63) / 64 words
    std::size_t leaders = 0;             ///< first entry in split_leaders
    bool positive = false;
};

/// One of several results for a corner of the mesh, which are averaged.
struct Conflict {
    std::uint32_t corner = 0;
    std::uint32_t source = 0;  ///< a group, or kMark | a place in EvaluationPlan::members
};

struct EvaluationPlan {
    Method method = Method::mikktspace;
    float sign_factor = 1.0f;       ///< what the sign of the UV determinant is multiplied with
    float bitangent_factor = 1.0f;  ///< signFactor(convention)
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;
    std::size_t triangle_count = 0;
    std::uint32_t group_count = 0;  ///< groups that do not split
    bool has_repeats = false;       ///< some corner of the mesh belongs to several triangles

    /// One per tricorner: the vertex whose data stand for it. In a plan that is kept that is the corner's own, because
    /// vertices that are equal on the mesh may come apart in a pose. Followed by the numbers of some more valid
    /// vertices, so that kernels can read whole blocks.
    Buffer<std::uint32_t> vertices;
    /// One per tricorner: the group it belongs to, with kMark if it adds nothing to it; kNone without one,
    /// and for members of groups that split.
    Buffer<std::uint32_t> groups;
    /// One per corner of the mesh: the group whose result it holds, or kNone (it is in one of the lists
    /// below). Empty: `groups` without marks is just that.
    Buffer<std::uint32_t> corner_groups;
    Buffer<std::uint8_t> group_positive;  ///< one per group: its orientation
    Buffer<Vec2> uvs;                     ///< one per vertex

    Buffer<EvaluatedSplit> splits;
    Buffer<std::uint32_t> members;        ///< tricorners of these groups
    Buffer<std::uint32_t> member_slots;   ///< one per member: its corner of the mesh, with kMark where others conflict
    Buffer<std::uint64_t> split_rows;     ///< bit b of row a: member b counts for member a
    Buffer<std::uint32_t> split_leaders;  ///< the first member with the same row
    std::uint32_t largest_split = 0;

    Buffer<Conflict> conflicts;             ///< by corner, then in the order in which the reference writes them
    Buffer<std::uint32_t> repeat_slots;     ///< with has_repeats, one per tricorner: its corner of the mesh
    Buffer<std::uint32_t> default_corners;  ///< corners that no group reaches
    Buffer<std::uint32_t> skipped_corners;  ///< corners of faces that are ignored: all outputs are 0
    Buffer<Copy> copies;                    ///< corners of degenerate triangles
    TangentReport report;                   ///< what can be counted without a pose

    [[nodiscard]] std::uint32_t groupOfCorner(std::size_t corner) const {
        return corner_groups.empty() ? groups[corner] & kValue : corner_groups[corner];
    }
    [[nodiscard]] std::size_t memoryBytes() const;
};

/// `plan` is used up.
EvaluationPlan makeEvaluationPlan(GroupedPlan plan, const MeshView& mesh, PlanUse use, const Allocator* allocator,
                                  Parallel& parallel);

/// Evaluates one pose into checked outputs and completes the plan's report. Scratch memory: 12 bytes per
/// group when only tangents are asked for, else 44. `scale`: for `fast` and `best`, where it is not to be found from
/// the pose itself. Throws OutOfMemory.
TangentReport evaluateGroups(const EvaluationPlan& plan, const Pose& pose, const TangentOutput& out,
                             const Execution& execution, Parallel& parallel,
                             const estimators::InputScale* scale = nullptr);

}  // namespace tspace::mikk
