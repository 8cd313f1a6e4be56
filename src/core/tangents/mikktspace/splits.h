// SPDX-License-Identifier: MIT
// Splits. Inside a group only members whose tangents and bitangents differ by less than the angular threshold are
// averaged; each member has a subset of the group of its own.
#pragma once

#include <span>

#include "core/tangents/mikktspace/vertex_path.h"

namespace tspace::mikk {

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
