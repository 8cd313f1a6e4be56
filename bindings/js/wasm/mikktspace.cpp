// SPDX-License-Identifier: MIT
// The module of the entry "tspace/mikktspace": one method.
#include "common.h"

using namespace tspace;
using namespace tspace::js;

namespace {
TangentOptions tangent_options;  // of the next call
}  // namespace

extern "C" {

/// Has the parameters of setTangentOptions in the module of the entry "tspace".
TSPACE_JS_EXPORT(setTangentOptions)
void setTangentOptions(std::uint32_t, float threshold_deg, std::uint32_t pairing, std::uint32_t,
                       std::uint32_t convention, std::uint32_t, std::uint32_t, bool normalize_normals) {
    tangent_options = {.convention = conventionOf(convention),
                       .ngons = Ngons::skip,
                       .normalize_normals = normalize_normals,
                       .angular_threshold_deg = threshold_deg,
                       .pairing = static_cast<Pairing>(pairing)};
}

/// `out`: receives four floats per corner; `has_tangent`: receives a byte per corner, or null.
TSPACE_JS_EXPORT(generateTangents) std::uint32_t generate(float* out, std::uint8_t* has_tangent) {
    auto result = generateTangents(mesh(), tangent_options, outputOf(out, has_tangent, mesh().cornerCount()));
    if (result) keep(*result);
    return codeOf(result);
}

}  // extern "C"
