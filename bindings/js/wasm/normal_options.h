// SPDX-License-Identifier: MIT
// Options of normals, for the modules that compute them.
#pragma once

#include "common.h"
#include "tspace/normals.h"

namespace tspace::js {

inline NormalOptions normalOptions(std::uint32_t weighting, float crease_angle_deg, const std::uint32_t* groups,
                                   std::size_t group_count, bool groups_are_masks, bool weld_positions,
                                   std::uint32_t convention, std::uint32_t refine, float denoise, float weld_distance) {
    NormalOptions options;
    options.weighting = static_cast<NormalWeighting>(weighting);
    options.crease_angle_deg = crease_angle_deg;
    options.smoothing_groups = {groups, group_count};
    options.smoothing_groups_are_masks = groups_are_masks;
    options.weld_positions = weld_positions;
    options.convention = conventionOf(convention);
    options.refine = refine;
    options.denoise = denoise;
    options.weld_distance = weld_distance;
    return options;
}

}  // namespace tspace::js
