// SPDX-License-Identifier: MIT
// Whether the tangents of one mesh are good, and why not. Knows no file: `check` makes findings of it, and repair asks
// it what to keep.
#pragma once

#include <string>

#include "check/direction_cones.h"
#include "check/surface.h"
#include "check/tally.h"
#include "check/tangent_view.h"
#include "tspace/check.h"

namespace tspace {

struct FrameHealth {
    // Values on their own. Counted: vertices that triangles use.
    Tally not_finite;          ///< tangent or w
    Tally not_unit;            ///< and finite
    double far_from_unit = 0;  ///< share of the surface with lengths below 0.9 or above 1.1
    Tally not_orthogonal;      ///< finite, not zero, with a usable N
    double parallel = 0;       ///< share of the surface with tangents nearly parallel to N
    Tally sign_not_one;
    bool sign_vanishes = false;  ///< some |w| is below 0.5
    Tally signs_mixed;           ///< triangles

    // Against the UVs. All zero where there are none.
    Tally signs_wrong;             ///< vertices whose triangles agree with each other, but not with w
    bool all_signs_wrong = false;  ///< on nearly all of the surface
    Tally mirrored_seams;          ///< vertices where mirrored and other triangles share a tangent
    Tally uv_seams;                ///< vertices with the mean tangent of both sides of a UV seam
    Tally directions_wrong;        ///< the other vertices whose tangents are off by more than direction_deg
    double far_directions = 0;     ///< share of the surface where a direction is off by more than error_deg
    Tally frames_differ;  ///< vertices equal to another but for the tangent, which MikkTSpace would give the same
};

/// Looks at tangents that follow mesh.uvs. Without normals or UVs nothing is looked at but values.
/// Expected near-linear time. Fails where generateTangents does, which is for lack of memory.
Result<FrameHealth> examineTangents(const TangentView& mesh, const CheckOptions& options);

/// The same from what is known already of the mesh's surface.
Result<FrameHealth> examineTangents(const TangentView& mesh, const Surface& surface, const CheckOptions& options);

/// What there is to say about it: findings without a place.
std::vector<Finding> tangentFindings(const FrameHealth& health, const CheckOptions& options);

/// Why these tangents surely render wrong: the message of the first finding that is an error. Empty: they are good
/// enough to be kept.
std::string whyTangentsAreWrong(const FrameHealth& health, const CheckOptions& options);

// The steps of examineTangents, one per file.
void examineValues(const TangentView& mesh, const Surface& surface, const CheckOptions& options, FrameHealth& health);
void examineSigns(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                  std::span<const float> directions, FrameHealth& health);
void examineDirections(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                       std::span<const float> directions, FrameHealth& health);
Result<Done> examineSplits(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                           FrameHealth& health);

}  // namespace tspace
