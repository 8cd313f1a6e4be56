// SPDX-License-Identifier: MIT
// The vertex path lists the corners around each selected node, links them across their shared edges, groups them, and
// writes a plan, which is evaluated (evaluate.h). One-pass evaluation selects the complex nodes: those with several
// groups, with a fan of too many parts, with contested or degenerate triangles, with sums that do not prove that
// nothing splits, or in the reference's last bucket. planTangents selects all nodes.
//
//   plan.cpp    triangles around the selected nodes, one orientation per face, corners node by node; and the plan
//   groups.cpp  links between the corners of a node, groups, contested triangles; groups that an angular threshold
//               below 180 degrees separates
#pragma once

#include <cstddef>
#include <span>

#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/evaluate.h"
#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/node_sums.h"
#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

/// Welded mesh, and the options of the call. nodes.vertex() must be valid.
struct NodeSetting : WeldedMesh {
    const Call<TangentOptions>& options;
    const LastBucket& bucket;

    [[nodiscard]] bool hasPolygons() const { return !triangles.faces.empty(); }
    [[nodiscard]] bool maySplit() const { return isMikktspace(options.method); }
};

/// Nodes to plan.
struct VertexPath {
    const NodeSetting& setting;
    /// Selected nodes, ascending. They must include all nodes of degenerate triangles, of contested triangles (unless a
    /// node has no other triangle), and of faces whose triangles differ in orientation or degeneracy (checkPolygons in
    /// one_pass.cpp).
    std::span<const std::uint32_t> chosen;
    bool are_all;  ///< true: `chosen` contains all nodes
    PlanUse use;   ///< once: the plan contains the terms of the mesh's own pose, except for estimators
    Parallel& parallel;
};

/// Flags of a triangle, in addition to kFacesUp or kFacesDown (shared by all triangles of a face: unifyFaces).
enum TriangleFlag : std::uint8_t {
    /// the triangle has no usable UV area: it joins groups of either orientation, starts none, and contributes nothing
    kAny = 4,
    /// the triangle is contested (groups.h): it uses the orientation of the first group that reaches it
    kContested = 8,
    kDegenerate = 16,
};

/// Corner of a triangle that is not degenerate. The corners of a node are contiguous.
struct NodeCorner {
    const float* s;                ///< row of the corner in CornerTerms::s
    std::uint32_t half_edge;       ///< half-edge: 3 * the triangle's number in `found` + k
    std::uint32_t next, previous;  ///< nodes of the next and the previous corner
    std::uint32_t facing;          ///< kFacesUp or kFacesDown; 0: its triangle has no UV area and contributes nothing

    /// Returns the row of the corner in CornerTerms::t.
    [[nodiscard]] const float* t() const {
        return s + (offsetof(CornerTerms, t) - offsetof(CornerTerms, s)) / sizeof *s;
    }
};

struct VertexCorners {
    // Arrays with one entry per triangle around a selected node:
    Buffer<std::uint32_t> found;  ///< numbers of the triangles in the mesh, ascending; empty: all triangles
    Buffer<std::uint8_t> flags;
    Buffer<CornerTerms> terms;  ///< terms of the triangles, in blocks of kTermTriangles
    // Arrays with three entries per triangle:
    Buffer<std::uint32_t> nodes;
    Buffer<std::uint32_t> places;  ///< position of each node in `chosen`, or chosen.size(); empty: equal to `nodes`
    TangentReport report;          ///< counts of triangles

    Buffer<NodeCorner> corners;  ///< corners of the selected nodes, node by node, ascending by triangle
    // Arrays with one entry per selected node:
    Buffer<std::uint32_t> begin;
    /// Orientations of the triangles that contribute to the node: kFacesUp, kFacesDown, or both. An additional entry,
    /// 0, represents nodes that are not selected.
    Marks facing;
    /// Corners of the mesh that belong to degenerate triangles only, with the corners that they copy, or kNone.
    Growing<Copy> copies;

    explicit VertexCorners(const Allocator* allocator) : copies(allocator) {}

    [[nodiscard]] std::span<const NodeCorner> around(std::size_t place) const {
        return {corners.data() + begin[place], begin[place + 1] - begin[place]};
    }
    [[nodiscard]] std::uint32_t triangleOf(std::size_t t) const {
        return found.empty() ? static_cast<std::uint32_t>(t) : found[t];
    }
    /// Converts the index of a half-edge among these triangles to its index in the mesh.
    [[nodiscard]] std::uint32_t halfEdgeOf(std::uint32_t half_edge) const {
        return 3 * triangleOf(half_edge / 3) + half_edge % 3;
    }
    [[nodiscard]] const std::uint32_t* placesOf(std::size_t t) const {
        return (places.empty() ? nodes.data() : places.data()) + 3 * t;
    }
};

VertexCorners readCorners(const VertexPath& path);

/// Plans the selected nodes; the report counts the triangles around them. Uses about 210 bytes per triangle around
/// these nodes. Throws OutOfMemory.
EvaluationPlan planChosen(const VertexPath& path);

/// Computes the tangents of the mesh's own pose: simple nodes in one pass (one_pass.cpp), complex ones by the vertex
/// path. Does not support angular thresholds below 180 degrees. `transient`: scratch memory for data that are not read
/// after tangents are written, so it may overlap the output. `range_shift`: log2 of the number of nodes per range;
/// 0: chosen for the mesh. Throws OutOfMemory.
TangentReport evaluateInOnePass(const NodeSetting& setting, const TangentOutput& out, ScratchBlock& transient,
                                Parallel& parallel, unsigned range_shift = 0);

/// Returns whether evaluateSmall applies: mikktspace, at most 64 triangular faces with few vertices and finite values.
bool isSmall(const WeldedMesh& welded, Method method);
/// Computes the tangents of a small mesh (small_mesh.cpp), for any angular threshold: the results of evaluateInOnePass,
/// or, below 180 degrees, those of a plan. Requires listVertices. `transient`: allocates memory that is released before
/// tangents are written.
TangentReport evaluateSmall(const WeldedMesh& welded, const Call<TangentOptions>& options, const TangentOutput& out,
                            const Allocator* transient, Parallel& parallel);

}  // namespace tspace::mikk
