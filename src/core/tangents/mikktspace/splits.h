// SPDX-License-Identifier: MIT
// Splits. Inside a group only members whose tangents and bitangents differ by less than the angular threshold are
// averaged; each member has a subset of the group of its own.
#pragma once

#include <span>

#include "core/tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

/// Cosine of an angular threshold in degrees, in the reference's arithmetic: for 0 to 360.
float thresholdCosine(float degrees);

/// Corners of one group, ascending, those that add nothing too.
using Members = std::span<const NodeCorner>;

/// Whether it is plain that every two members are within the threshold. No may also mean that it is not plain.
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
    bool abandoned = false;       ///< some large group might split

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
