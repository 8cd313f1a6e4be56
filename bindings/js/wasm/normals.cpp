// SPDX-License-Identifier: MIT
// The module of the entry "tspace/normals": normals of noisy meshes, automatic hard edges, and winding.
#include "tspace/normals.h"
#include "common.h"
#include "tspace/winding.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

TSPACE_JS_EXPORT(measurePositionNoise) std::uint32_t measureNoise() {
    auto result = measurePositionNoise(mesh());
    if (!result) return codeOf(result);
    keep(*result);
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
    keep(*result);
    return 0;
}

}  // extern "C"
