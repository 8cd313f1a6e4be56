// SPDX-License-Identifier: MIT
#include "check/uv_reading.h"

#include "surface/uv_matrix.h"

namespace tspace {

UvReading plainReading(const ScenePrimitive& primitive, std::size_t uv_set) {
    UvReading reading{.uv_set = uv_set};
    if (uv_set < primitive.uv_sets.size()) reading.uvs = primitive.uv_sets[uv_set].span();
    return reading;
}

UvReading readingOf(const ScenePrimitive& primitive, const TangentUse& use) {
    UvReading reading = plainReading(primitive, use.uv_set);
    const UvMatrix matrix = uvMatrix(use.transform.rotation, use.transform.scale[0], use.transform.scale[1]);
    if (matrix.isIdentity() || reading.uvs.empty()) return reading;
    reading.transformed = true;
    reading.own = transformUvs(reading.uvs, matrix);
    reading.uvs = reading.own;
    return reading;
}

}  // namespace tspace
