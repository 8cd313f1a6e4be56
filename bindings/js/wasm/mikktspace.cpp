// SPDX-License-Identifier: MIT
// The module of the entry "tspace/mikktspace": one method.
#include "common.h"

using namespace tspace;
using namespace tspace::js;

extern "C" {

/// `out`: receives four floats per corner; `has_tangent`: receives a byte per corner, or null.
TSPACE_JS_EXPORT(generateTangents)
std::uint32_t generate(std::uint32_t, float threshold_deg, std::uint32_t pairing, std::uint32_t,
                       std::uint32_t convention, std::uint32_t, std::uint32_t, bool normalize_normals, float* out,
                       std::uint8_t* has_tangent) {
    TangentOptions options;
    options.angular_threshold_deg = threshold_deg;
    options.pairing = static_cast<Pairing>(pairing);
    options.ngons = Ngons::skip;
    options.convention = conventionOf(convention);
    options.normalize_normals = normalize_normals;
    auto result = generateTangents(mesh(), options, outputOf(out, has_tangent, mesh().cornerCount()));
    if (result) keep(*result);
    return codeOf(result);
}

}  // extern "C"
