// SPDX-License-Identifier: MIT
// The plan of the methods that group faces: mikktspace, uniform, angle and area. Words used in this folder:
//
// node        a welded vertex: all corners with equal position, normal and UV (see weld.h)
// triangle    after cutting faces, and unless said otherwise only the good ones: those without two corners at
//             one position, numbered in face order
// tricorner   3 * triangle + k: corner k of a triangle, and also the half-edge from corner k to corner k+1
// slot        the corner of the mesh that a tricorner's result belongs to; the two corners at a quad's
//             diagonal are slots of two tricorners each
//
// The reference names these "tri info", "group" and "tangent space"; its results are described in terms of
// faces and recursion. Here every node is worked on alone: see pairing.h for why that gives the same result.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/plan_use.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

inline constexpr std::uint32_t kNone = 0xffffffffu;
/// Mark in GroupedPlan::list: first tricorner of a group (or of the ungrouped rest at a node's end).
/// Mark in GroupedPlan::slots: several tricorners give this slot different results, which are averaged.
inline constexpr std::uint32_t kMark = 0x80000000u;
inline constexpr std::uint32_t kValue = 0x7fffffffu;
/// Most tricorners a mesh may have: they share 32 bits with a mark.
inline constexpr std::uint64_t kMaxTricorners = kValue;

enum TriangleFlag : std::uint8_t {
    kPositive = 1,  ///< positive UV area (after quads were made uniform): the orientation of the triangle's groups
    kAny = 2,       ///< no usable UV area: joins groups of either orientation, opens none, adds nothing
    kGrouped = 4,   ///< used while grouping: some corner of this kAny triangle has a group
};

/// dP/du and dP/dv of a triangle: directions (zero when they have none) and lengths.
struct TriangleFrame {
    Vec3 s, t;
    float mag_s = 0, mag_t = 0;
};

/// What the angular test needs of the mesh's own pose.
struct PoseData {
    Buffer<Vec3> positions;        ///< one per node
    Buffer<TriangleFrame> frames;  ///< one per triangle
};

/// A group whose members do not all share one result (angular threshold).
struct SplitGroup {
    std::uint32_t begin = 0, count = 0;  ///< its range in GroupedPlan::list
    std::size_t rows = 0;                ///< first word in split_rows: `count` rows of (count + 63) / 64 words
    std::size_t leaders = 0;             ///< first entry in split_leaders
};

struct Copy {
    std::uint32_t to = 0, from = 0;  ///< corners of the mesh
};

struct Nodes;
struct TriangleList;

/// Filled step by step; evaluation_plan.h has what remains in the end.
struct GroupedPlan {
    Method method = Method::mikktspace;
    float sign_factor = 1.0f;       ///< what the sign of the UV determinant is multiplied with
    float bitangent_factor = 1.0f;  ///< signFactor(convention)
    std::size_t vertex_count = 0;
    std::size_t corner_count = 0;
    std::size_t triangle_count = 0;

    Buffer<std::uint32_t> nodes;  ///< one per tricorner
    Buffer<std::uint32_t> slots;  ///< one per tricorner, or empty: slot == tricorner
    Buffer<std::uint8_t> flags;   ///< one per triangle: TriangleFlag
    std::size_t node_count = 0;
    /// Nodes from this one on only lend their data to triangles: they have no list, no groups and no results.
    std::size_t listed_count = 0;
    Buffer<std::uint32_t> node_vertex;  ///< the vertex whose data stands for the node
    Buffer<Vec2> node_uv;
    Buffer<std::uint32_t> node_begin;  ///< listed_count + 1: ranges of `list`
    /// Tricorners node by node; within a node group by group in the order the reference opens them, within a
    /// group ascending. Tricorners without a group come last.
    Buffer<std::uint32_t> list;

    Buffer<SplitGroup> split_groups;      ///< ascending by begin
    Buffer<std::uint64_t> split_rows;     ///< bit b of row a: member b counts for member a
    Buffer<std::uint32_t> split_leaders;  ///< the first member with the same row
    std::uint32_t largest_split_group = 0;

    Buffer<std::uint32_t> conflicts;        ///< positions in `list` whose slot is marked, ascending
    Buffer<std::uint32_t> conflict_order;   ///< indices into conflicts, by slot, then as the reference writes them
    Buffer<std::uint32_t> default_corners;  ///< corners that no group reaches
    Buffer<std::uint32_t> skipped_corners;  ///< corners of faces that are ignored: all outputs are 0
    Buffer<Copy> copies;                    ///< corners of degenerate triangles
    TangentReport report;                   ///< what can be counted without a pose

    [[nodiscard]] std::uint32_t slot(std::uint32_t tricorner) const {
        return slots.empty() ? tricorner : slots[tricorner] & kValue;
    }
};

/// How many triangles the faces of a mesh are cut into.
std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons);

struct EvaluationPlan;

/// Whether Pairing::reference is asked for and can make a difference.
bool needsReferenceOrder(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles,
                         const Nodes& nodes, Parallel& parallel);

/// Plans a validated mesh with normals and UVs and at most kMaxTricorners. Throws OutOfMemory.
EvaluationPlan planGrouped(const MeshView& mesh, const TangentOptions& options, Parallel& parallel);

/// The same from triangles that are cut and nodes that are known, for the first `listed_count` nodes. With
/// Pairing::reference these must be all; it is meant for what needsReferenceOrder. `nodes` may become exact.
EvaluationPlan planNodes(const MeshView& mesh, const TangentOptions& options, TriangleList triangles, Nodes& nodes,
                         std::size_t listed_count, PlanUse use, Parallel& parallel);

}  // namespace tspace::mikk
