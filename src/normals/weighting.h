// SPDX-License-Identifier: MIT
// How much a face counts in the mean at one of its corners.
#pragma once

#include <cstdint>

#include "normals/topology.h"
#include "tspace/normals.h"

namespace tspace {

/// The weight of a corner of a face that is not degenerate. A face that visits a point with several corners
/// in a row (a collapsed edge) counts once, at the first of them: the others weigh 0. `factor` is what the
/// face normals were multiplied with. O(1), summed over the corners of a face.
double cornerWeight(const MeshView& mesh, const FaceTable& faces, const PointTable& points, NormalWeighting weighting,
                    double factor, std::uint32_t corner);

}  // namespace tspace
