// SPDX-License-Identifier: MIT
// The module of the entry "tspace/normals": normals of noisy meshes, automatic hard edges, and winding.
#include "common.h"
#include "tspace/normals.h"
#include "tspace/winding.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// The report contains sigma, kink share, noise, and mean edge length.
TSPACE_JS_EXPORT(measurePositionNoise) std::uint32_t measureNoise() {
    auto result = measurePositionNoise(mesh());
    if (!result) return codeOf(result);
    js::report[0] = double{result->sigma};
    js::report[1] = double{result->kink_share};
    js::report[2] = double{result->noise};
    js::report[3] = result->mean_edge;
    return 0;
}

/// `turned`: receives one byte per face.
TSPACE_JS_EXPORT(mendWinding)
std::uint32_t mend(bool use_normals, bool weld_positions, std::uint32_t convention, float weld_distance,
                   std::uint8_t* turned) {
    const WindingOptions options{.convention = conventionOf(convention),
                                 .use_normals = use_normals,
                                 .weld_positions = weld_positions,
                                 .weld_distance = weld_distance};
    auto result = mendWinding(mesh(), options, {turned, mesh().faceCount(), 1});
    if (!result) return codeOf(result);
    const std::uint64_t counts[] = {
        result->face_count,        result->turned_count,           result->conflict_count_before,
        result->conflict_count_after, result->component_count,     result->turned_component_count,
        result->by_normals_count,  result->by_volume_count,        result->by_nesting_count,
        result->by_winding_number_count, result->by_majority_count, result->small_count,
        result->one_sided_count};
    keepCounts(counts);
    return 0;
}

}  // extern "C"
