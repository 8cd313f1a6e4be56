// SPDX-License-Identifier: MIT
// Links: the corner of a node across each of its edges, computed for each node independently.
//
// The reference sorts all edges by (lower end, higher end, triangle). In this order, each half-edge without a neighbor
// is linked with the first later half-edge of the same edge that has the opposite direction and no neighbor. Claim:
// this is equivalent to processing the half-edges of an edge in order, where each is linked with the oldest waiting
// opposite one, or waits. Proof: waiting half-edges of an edge always have the same direction, otherwise two of them
// would have been linked. Suppose the reference links the first half-edge to j: all half-edges between have the
// direction of the first, so it is still the oldest waiting one when j is processed, and j is linked with it. Remove
// the pair and repeat. All half-edges of an edge are visible from either of its ends, in the same (ascending) order, so
// each node can be processed independently and both ends find equal links. No edge table is needed.
//
// Groups: the corners of a node that share tangents. The links around a node form paths and rings. The corners of a
// node are processed in ascending order; each that has no group and a usable UV area starts a group, which spreads
// along the links in both directions until it meets the other orientation or another group. (The reference recurses
// from triangle to triangle; on a path or ring that visits the same corners.)
//
// A triangle without UV area adopts the orientation of the first group that reaches it, at any of its nodes. If all its
// nodes have the same orientation, the order of groups does not matter. Other such triangles are contested: their nodes
// are grouped together, by processing the triangles in the reference's order.
#pragma once

#include <span>

#include "core/tangents/mikktspace/last_bucket.h"
#include "core/tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

/// Links of each corner of a node: the corner across the edge that leaves the node, and the corner across the edge that
/// arrives, as indices in the node's list of corners, or kNone.
struct CornerLinks {
    std::uint32_t* left;
    std::uint32_t* right;
};

/// Links the corners of a node by sorting `half_edges`, scratch memory for two numbers per corner. O(n log n).
void linkCorners(std::span<const NodeCorner> around, const CornerLinks& links, std::uint64_t* half_edges);

/// Corners of one node (welded vertex) and the group of each corner. Groups are numbered in the order in which the
/// reference creates them.
struct NodeGroups {
    std::span<const NodeCorner> corners;
    const std::uint32_t* group =
        nullptr;              ///< one per corner, or kNone; null: all corners are in group 0, if count is 1
    std::uint32_t count = 0;  ///< number of groups

    [[nodiscard]] std::uint32_t of(std::size_t i) const { return group != nullptr ? group[i] : count == 0 ? kNone : 0; }
};

class Grouping {
  public:
    /// Determines the orientation of contested triangles, and stores it in corners.flags. A triangle is contested if it
    /// has no UV area, and groups of both orientations may claim it. The arguments must outlive the object.
    Grouping(const VertexPath& path, VertexCorners& corners);

    /// Returns the groups of a node. The result is valid until the next call.
    NodeGroups groupsOf(std::size_t place);

  private:
    struct Contested {
        std::uint32_t place;
        std::uint32_t cursor = 0, group_count = 0;
        std::size_t begin = 0;  // index in contested_groups_
    };
    void findContested(const Allocator* allocator);
    void spreadContested(const Allocator* allocator);
    bool joinsContested(std::uint32_t triangle, std::uint32_t facing);
    void link(std::size_t place, const CornerLinks& links);
    void applyBucket(std::span<const NodeCorner> around, const CornerLinks& links) const;

    std::span<const std::uint32_t> chosen_;
    const LastBucket& bucket_;
    VertexCorners& corners_;
    Buffer<std::uint32_t> scratch_;     // memory for the links and groups of one node
    Buffer<std::uint64_t> half_edges_;  // memory for linkCorners
    // number of each chosen node in contested_, or kNone, with one additional entry; empty if no triangle is contested
    Buffer<std::uint32_t> contested_of_;
    Growing<Contested> contested_;
    Buffer<std::uint32_t> contested_groups_;
};

// Groups that split. Only members whose tangents and bitangents differ by less than the angular threshold are averaged,
// so each member has its own subset of the group.

/// Returns the cosine of an angular threshold of 0 to 360 degrees, in the reference's arithmetic.
float thresholdCosine(float degrees);

/// Corners of one group, ascending, including those that do not contribute.
using Members = std::span<const NodeCorner>;

/// Tests quickly whether every two members are within the threshold. The result true is certain; false means unknown.
bool areTogether(Members members, float threshold_cosine);

/// Maximum number of members of a group that may be split. Subsets take quadratic time and memory: each member may have
/// a different one, and float sums cannot be shared.
inline constexpr std::uint32_t kLargestSplitGroup = 4096;

/// Compares all members of a group with each other, as the reference does.
class SplitFinder {
  public:
    SplitFinder(const WeldedMesh& welded, const VertexCorners& corners, float threshold_cosine,
                const Allocator* allocator);

    /// Returns whether the angular threshold splits the group; if so, appends one row per member to `rows`. A group of
    /// more than kLargestSplitGroup members is never split; if it might have to be, `abandoned` is set.
    bool splits(Members members, const Vec3& normal);

    Growing<std::uint64_t> rows;  ///< bit b of row a: member b contributes to member a
    bool abandoned = false;       ///< a group above kLargestSplitGroup might split, but was not split

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
