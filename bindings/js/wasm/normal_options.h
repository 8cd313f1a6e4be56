// SPDX-License-Identifier: MIT
// Options and reports of normals, for the modules that compute them.
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

/// Stores five numbers in the report, starting at index `first`.
inline void keep(const NormalReport& report, std::size_t first = 0) {
    const std::uint64_t counts[] = {report.face_count, report.degenerate_face_count, report.fallback_corner_count};
    keepCounts(counts, first);
    js::report[first + 3] = double{report.noise};
    js::report[first + 4] = double{report.crease_angle_deg};
}

}  // namespace tspace::js
