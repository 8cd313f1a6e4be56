// SPDX-License-Identifier: MIT
#include "commands/shared/uv_reading.h"

#include "core/base/vec_math.h"
#include "core/mesh/surface/uvs.h"

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

std::vector<Vec2> textureUvs(std::span<const Vec2> uvs, const UvTransform& transform) {
    const SineCosine turn = sineCosine(transform.rotation);
    std::vector<Vec2> result;
    result.reserve(uvs.size());
    for (const Vec2& uv : uvs) {
        const double u = transform.scale[0] * uv.x, v = transform.scale[1] * uv.y;
        result.push_back({static_cast<float>(turn.cosine * u + turn.sine * v + transform.offset[0]),
                          static_cast<float>(turn.cosine * v - turn.sine * u + transform.offset[1])});
    }
    return result;
}

}  // namespace tspace
