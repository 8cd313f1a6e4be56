// SPDX-License-Identifier: MIT
// The vertex path: nodes whose corners are listed after all and grouped node by node. It takes those that one pass
// leaves complex: several groups, fans of too many parts, triangles without UV area that groups of both orientations
// reach, sums that do not show that nothing splits, corners of degenerate triangles, the reference's last bucket. And
// it takes all nodes, to make a plan.
#pragma once

#include <cstddef>
#include <span>

#include "tangents/method_kind.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/evaluation_plan.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/last_bucket.h"
#include "tangents/mikktspace/node_sums.h"

namespace tspace::mikk {

/// What to compute of the nodes of a mesh.
struct NodeSetting : WeldedMesh {  ///< nodes.vertex() must be valid
    const TangentOptions& options;
    const LastBucket& bucket;
    TangentOutput out;

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
    bool are_all = false;  ///< `chosen` are all nodes
    Parallel& parallel;
};

enum TriangleFlag : std::uint8_t {
    kPositive = 1,   ///< positive UV area (after quads were made uniform): the orientation of the triangle's groups
    kAny = 2,        ///< no usable UV area: joins groups of either orientation, opens none, adds nothing
    kGrouped = 4,    ///< used while grouping: some corner of this kAny triangle has a group
    kContested = 8,  ///< groups.h
    kNearContested = 16,  ///< at a node of contested ones
    kDegenerate = 32,
};

/// In NodeCorner::common, beside marks: the orientation of the triangle.
inline constexpr std::uint32_t kIsUp = 0x10000, kIsDown = 0x20000;

/// A corner of a triangle that is not degenerate. Those of a node lie side by side.
struct NodeCorner {
    const float* s;                ///< its row of CornerTerms::s
    std::uint32_t next, previous;  ///< nodes
    std::uint32_t slot;            ///< corner of the mesh
    std::uint32_t common;          ///< marks, and kIsUp or kIsDown; kAddsNothing for one without UV area

    static constexpr std::uint32_t kAddsNothing = ~0u;
    [[nodiscard]] bool addsNothing() const { return common == kAddsNothing; }
    /// Its row of CornerTerms::t.
    [[nodiscard]] const float* t() const {
        constexpr std::size_t kFromS = offsetof(CornerTerms, t) - offsetof(CornerTerms, s);
        return reinterpret_cast<const float*>(reinterpret_cast<const std::byte*>(s) + kFromS);
    }
};

struct VertexCorners {
    // One per triangle around a chosen node.
    Buffer<std::uint32_t> found;  ///< their numbers in the mesh, ascending; empty: all
    Buffer<std::uint8_t> flags;
    Buffer<CornerTerms> terms;  ///< kTermTriangles each; the rows of those without UV area are kNothing
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
    /// 3 * the triangle's number in `found` + k.
    [[nodiscard]] std::uint32_t halfEdgeOf(const NodeCorner& corner) const {
        const auto bytes = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(corner.s) -
                                                    reinterpret_cast<const std::byte*>(terms.data()));
        const std::size_t block = bytes / sizeof(CornerTerms), row = bytes % sizeof(CornerTerms) / sizeof terms[0].s[0];
        return static_cast<std::uint32_t>(kTermCorners * block + row);
    }
    [[nodiscard]] std::uint32_t numberOf(const NodeCorner& corner) const { return halfEdgeOf(corner) / 3; }
    [[nodiscard]] const std::uint32_t* placesOf(std::size_t t) const {
        return (places.empty() ? nodes.data() : places.data()) + 3 * t;
    }
};

/// `source`, tangents_only: terms without t and lengths_t.
VertexCorners readCorners(const VertexPath& path, const CornerSource& source);

/// Writes the results of all corners at chosen nodes, by methods that estimate nothing. The report counts triangles around
/// these nodes, and their groups and corners. Takes about 210 bytes per triangle around these nodes. Throws OutOfMemory.
TangentReport writeNodes(const VertexPath& path);

/// A plan of the chosen nodes.
EvaluationPlan planChosen(const VertexPath& path, PlanUse use);

}  // namespace tspace::mikk
