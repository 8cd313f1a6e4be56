// SPDX-License-Identifier: MIT
// The vertex path: nodes whose corners are listed after all, grouped node by node, and written down as a plan, which is
// evaluated (evaluation_plan.h). It takes those that one pass leaves complex: several groups, fans of too many parts,
// triangles without UV area that groups of both orientations reach, sums that do not show that nothing splits, corners of
// degenerate triangles, the reference's last bucket. And it takes all nodes, to make a plan that is kept.
#pragma once

#include <cstddef>
#include <span>

#include "core/tangents/method_kind.h"
#include "core/tangents/mikktspace/collect.h"
#include "core/tangents/mikktspace/evaluation_plan.h"
#include "core/tangents/mikktspace/growing.h"
#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// What to compute of the nodes of a mesh.
struct NodeSetting : WeldedMesh {  ///< nodes.vertex() must be valid
    const Call<TangentOptions>& options;
    const LastBucket& bucket;

    [[nodiscard]] bool hasPolygons() const { return !triangles.faces.empty(); }
    [[nodiscard]] bool maySplit() const { return isMikktspace(options.method); }
};

/// Which nodes.
struct VertexPath {
    const NodeSetting& setting;
    /// Ascending. They must have the nodes of triangles without UV area whose three nodes may have both orientations,
    /// unless no other triangle is there, and those of degenerate triangles and of faces whose triangles do not simply
    /// agree (node_sums.cpp).
    std::span<const std::uint32_t> chosen;
    bool are_all;  ///< `chosen` are all nodes
    PlanUse use;   ///< once: the plan has the mesh's own terms, but for estimators
    Parallel& parallel;
};

/// Of a triangle, beside kFacesUp or kFacesDown: the orientation of its groups, after faces were made uniform.
enum TriangleFlag : std::uint8_t {
    kAny = 4,        ///< no usable UV area: joins groups of either orientation, opens none, adds nothing
    kContested = 8,  ///< groups.h; takes the orientation of the first group that asks
    kDegenerate = 16,
};

/// A corner of a triangle that is not degenerate. Those of a node lie side by side.
struct NodeCorner {
    const float* s;                ///< its row of CornerTerms::s
    std::uint32_t half_edge;       ///< 3 * the triangle's number in `found` + k
    std::uint32_t next, previous;  ///< nodes
    std::uint32_t facing;          ///< kFacesUp or kFacesDown; 0: its triangle has no UV area, and it adds nothing

    /// Its row of CornerTerms::t.
    [[nodiscard]] const float* t() const {
        return s + (offsetof(CornerTerms, t) - offsetof(CornerTerms, s)) / sizeof *s;
    }
};

struct VertexCorners {
    // One per triangle around a chosen node.
    Buffer<std::uint32_t> found;  ///< their numbers in the mesh, ascending; empty: all
    Buffer<std::uint8_t> flags;
    Buffer<CornerTerms> terms;  ///< kTermTriangles each
    // Three per triangle.
    Buffer<std::uint32_t> nodes;
    Buffer<std::uint32_t> places;  ///< numbers of their nodes in `chosen`, of others its size; empty: as `nodes`
    TangentReport report;          ///< counts of triangles

    Buffer<NodeCorner> corners;  ///< node by node, ascending by triangle
    // One per chosen node.
    Buffer<std::uint32_t> begin;  ///< of its range of `corners`, where that of the next one begins
    /// Which orientations the triangles that add to it have: kFacesUp, kFacesDown. One more, 0, for nodes
    /// that are not chosen.
    Marks facing;
    /// Corners that only degenerate triangles have, as corners of the mesh, with the corners that they copy, or kNone.
    Growing<Copy> copies;

    explicit VertexCorners(const Allocator* allocator) : copies(allocator) {}

    [[nodiscard]] std::span<const NodeCorner> around(std::size_t place) const {
        return {corners.data() + begin[place], begin[place + 1] - begin[place]};
    }
    [[nodiscard]] std::uint32_t triangleOf(std::size_t t) const {
        return found.empty() ? static_cast<std::uint32_t>(t) : found[t];
    }
    /// In the mesh.
    [[nodiscard]] std::uint32_t halfEdgeOf(std::uint32_t half_edge) const {
        return 3 * triangleOf(half_edge / 3) + half_edge % 3;
    }
    [[nodiscard]] const std::uint32_t* placesOf(std::size_t t) const {
        return (places.empty() ? nodes.data() : places.data()) + 3 * t;
    }
};

VertexCorners readCorners(const VertexPath& path);

/// A plan of the chosen nodes: groups and corners, and of the triangles around them what the report counts. Takes about 210
/// bytes per triangle around these nodes. Throws OutOfMemory.
EvaluationPlan planChosen(const VertexPath& path);

/// One pass (one_pass.cpp), and the vertex path for what it leaves. Writes tangents of the mesh's own pose, but for an angular
/// threshold. `transient`: for what is not needed any more when tangents are written: their own memory, unless somebody looks
/// at it. `range_shift`: log2 of the nodes of a range; 0: what suits the mesh. Throws OutOfMemory.
TangentReport evaluateInOnePass(const NodeSetting& setting, const TangentOutput& out, ScratchBlock& transient,
                                Parallel& parallel, unsigned range_shift = 0);

}  // namespace tspace::mikk
