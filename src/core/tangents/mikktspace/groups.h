// SPDX-License-Identifier: MIT
// Links: which corner of a node lies across each of its edges, worked out for one node alone.
//
// The reference sorts all edges by (lower end, higher end, triangle). Going through them in order, each
// half-edge without a neighbour takes the first later one of the same edge that runs the opposite way and has
// none. Claim: that equals going through the half-edges of an edge in order, each taking the oldest waiting
// opposite one or waiting. Proof: waiters of one edge always run in one direction, else two of them would
// have been linked. Say the first half-edge is linked to j by the reference: all between run its own way, so
// it is still the oldest waiter when j comes, and j takes it. Take the pair out and repeat. An edge's
// half-edges are seen completely from either of its ends, in one (ascending) order, so each node can work alone and both
// ends find equal links. No edge table is needed.
//
// Groups: the corners of a node that share tangents. The links around a node form paths and rings. Going through a
// node's corners in ascending order, each that has no group and a usable UV area opens one, which spreads along the links
// to both sides until it meets the other orientation or another group. (The reference recurses from triangle to triangle;
// on a path or ring that visits the same corners.)
//
// A triangle without UV area takes the orientation of the first group that reaches it, at any of its nodes. Where all its
// nodes have one orientation, the order of groups does not matter. Other such triangles are contested: their nodes are
// grouped together, going through the triangles in the reference's order.
#pragma once

#include <span>

#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

/// Nodes of up to this many corners are paired by comparing all with all, on the stack.
inline constexpr std::uint32_t kSmallNode = 64;

/// For each corner of a node the corner across the edge that leaves the node, and across the edge that arrives: a position
/// in the node's list of corners, or kNone.
struct CornerLinks {
    std::uint32_t* left;
    std::uint32_t* right;
};

/// Links a node of at most kSmallNode corners, in quadratic time.
void linkSmall(std::span<const NodeCorner> around, const CornerLinks& links);

/// Links a node of any size by sorting `half_edges`, scratch for two numbers per corner. O(n log n).
void linkLarge(std::span<const NodeCorner> around, const CornerLinks& links, std::uint64_t* half_edges);

/// The corners of one node and their groups, which are numbered in the order in which the reference opens them.
struct NodeGroups {
    std::span<const NodeCorner> corners;
    const std::uint32_t* group =
        nullptr;              ///< one per corner, or kNone; null: all corners are in group 0, if count is 1
    std::uint32_t count = 0;  ///< number of groups

    [[nodiscard]] std::uint32_t of(std::size_t i) const { return group != nullptr ? group[i] : count == 0 ? kNone : 0; }
};

class Grouping {
  public:
    /// Gives contested triangles their orientation in corners.flags. The arguments must outlive this object.
    Grouping(const VertexPath& path, VertexCorners& corners);

    /// The result is valid until the next call.
    NodeGroups groupsOf(std::size_t place);

  private:
    struct Contested {
        std::uint32_t place;
        std::uint32_t cursor = 0, group_count = 0;
        std::size_t begin = 0;  // in contested_groups_
    };
    void findContested(const Allocator* allocator);
    void spreadContested(const Allocator* allocator);
    bool joinsContested(std::uint32_t triangle, std::uint32_t facing);
    void link(std::size_t place, const CornerLinks& links);
    void applyBucket(std::span<const NodeCorner> around, const CornerLinks& links) const;

    std::span<const std::uint32_t> chosen_;
    const LastBucket& bucket_;
    VertexCorners& corners_;
    Buffer<std::uint32_t> scratch_;       // links and groups of one node
    Buffer<std::uint64_t> half_edges_;    // scratch of linkLarge
    Buffer<std::uint32_t> contested_of_;  // one per chosen node, and one more: its number in contested_, or kNone;
                                          // empty where no triangle is contested
    Growing<Contested> contested_;
    Buffer<std::uint32_t> contested_groups_;
};

// Splits. Inside a group only members whose tangents and bitangents differ by less than the angular threshold are
// averaged; each member has a subset of the group of its own.

/// The cosine of an angular threshold of 0 to 360 degrees, in the reference's arithmetic.
float thresholdCosine(float degrees);

/// Corners of one group, ascending, with those that add nothing.
using Members = std::span<const NodeCorner>;

/// A quick test: true only if every two members are within the threshold. False may also mean that it could not tell.
bool areTogether(Members members, float threshold_cosine);

/// Subsets are quadratic in the size of a group by definition: every member may have another one, and float
/// sums cannot be shared. Above this size, groups that might split would take quadratic time here too.
inline constexpr std::uint32_t kLargestSplitGroup = 4096;

/// Compares all members of a group with each other, as the reference does.
class SplitFinder {
  public:
    SplitFinder(const WeldedMesh& welded, const VertexCorners& corners, float threshold_cosine,
                const Allocator* allocator);

    /// Returns whether the group splits; then rows of its members have been added. Groups of more than kLargestSplitGroup
    /// members that might split stay whole.
    bool splits(Members members, const Vec3& normal);

    Growing<std::uint64_t> rows;  ///< bit b of row a: member b counts for member a
    bool abandoned = false;       ///< some group above kLargestSplitGroup might split, and stayed whole

  private:
    struct Direction {
        Vec3 s, t;
    };
    [[nodiscard]] Direction directionOf(const NodeCorner& corner, const Vec3& normal) const;
    [[nodiscard]] bool isNarrow(Members members) const;

    const WeldedMesh& in_;
    const VertexCorners& corners_;
    float cosine_;
    const Allocator* allocator_;
    Buffer<Direction> directions_;  // one per member
};

}  // namespace tspace::mikk
