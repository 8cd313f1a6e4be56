// SPDX-License-Identifier: MIT
// Exports that generate normals, for the entries "tspace" and "tspace/normals".
#include "common.h"

using namespace tspace;
using namespace tspace::js;

namespace {
NormalOptions normal_options;  // of the next call
}  // namespace

const NormalOptions& tspace::js::normalOptions() { return normal_options; }

extern "C" {

TSPACE_JS_EXPORT(setNormalOptions)
void setNormalOptions(std::uint32_t weighting, float crease_angle_deg, const std::uint32_t* groups,
                      std::size_t group_count, bool groups_are_masks, bool weld_positions, std::uint32_t convention,
                      std::uint32_t refine, float denoise, float weld_distance) {
    normal_options = {.weighting = static_cast<NormalWeighting>(weighting),
                      .convention = conventionOf(convention),
                      .crease_angle_deg = crease_angle_deg,
                      .smoothing_groups = {groups, group_count},
                      .smoothing_groups_are_masks = groups_are_masks,
                      .weld_positions = weld_positions,
                      .weld_distance = weld_distance,
                      .refine = refine,
                      .denoise = denoise};
}

/// `out`: receives three floats per corner.
TSPACE_JS_EXPORT(generateNormals) std::uint32_t normals(float* out) {
    auto result = generateNormals(mesh(), normal_options, vec3Span(out, mesh().cornerCount()));
    if (!result) return codeOf(result);
    keep(*result);
    return 0;
}

}  // extern "C"
