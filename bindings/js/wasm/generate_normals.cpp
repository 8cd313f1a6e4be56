// SPDX-License-Identifier: MIT
// Export that generates normals, for the entries "tspace" and "tspace/normals".
#include "normal_options.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// `out`: receives three floats per corner.
TSPACE_JS_EXPORT(generateNormals)
std::uint32_t normals(std::uint32_t weighting, float crease_angle_deg, const std::uint32_t* groups,
                      std::size_t group_count, bool groups_are_masks, bool weld_positions, std::uint32_t convention,
                      std::uint32_t refine, float denoise, float weld_distance, float* out) {
    const auto options = normalOptions(weighting, crease_angle_deg, groups, group_count, groups_are_masks,
                                       weld_positions, convention, refine, denoise, weld_distance);
    auto result = generateNormals(mesh(), options, vec3Span(out, mesh().cornerCount()));
    if (!result) return codeOf(result);
    keep(*result);
    return 0;
}

}  // extern "C"
