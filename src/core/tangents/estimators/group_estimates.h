// SPDX-License-Identifier: MIT
// The methods `fast` and `best` for all groups of a mesh in one pose.
#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/base/range_lists.h"
#include "tspace/tangents.h"

namespace tspace::estimators {

/// Bitangent and lengths of a group, or their sums, for outputs in addition to tangents.
struct GroupRest {
    float t[4] = {0, 0, 0, 0};  ///< bitangent, followed by |dP/du|
    float length_t = 0;         ///< |dP/dv|
    float weight = 0;           ///< weight of the sum
};

/// Output for `count` groups: for group g, three floats at tangents + g * tangent_stride, and bitangent and lengths in
/// rest[g]. Groups without triangles get 0.
struct GroupEstimates {
    std::byte* tangents = nullptr;
    std::size_t tangent_stride = 0;
    GroupRest* rest = nullptr;  ///< may be null
    std::size_t count = 0;
};

/// Estimates all groups. Positions, normals and UVs are nonempty, with one entry per vertex. All corners of a group
/// have the same normal. `refine` steps follow the fit of `best`. Sums are in the order of triangles. `to`: outputs of
/// consecutive ranges of groups. Scratch memory: up to 1 MB per task, and that of RangeLists; with refinement steps, 32
/// or 64 bytes per group. Linear. Throws OutOfMemory.
void estimateGroups(Method method, unsigned refine, const TriangleGroups& triangles, const Pose& pose,
                    const StridedSpan<const Vec2>& uvs, const InputScale& scale, std::span<const GroupEstimates> to,
                    const Execution& execution, Parallel& parallel);

}  // namespace tspace::estimators
