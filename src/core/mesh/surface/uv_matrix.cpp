// SPDX-License-Identifier: MIT
// From a texture transform to the matrix that its frames need.
#include "core/mesh/surface/uv_matrix.h"

#include <algorithm>
#include <cmath>

#include "core/base/angle.h"

namespace tspace {

namespace {

/// Files write a quarter turn as a float, or with a few digits.
double snapped(double value) {
    constexpr double kClose = 1e-6;
    if (std::fabs(value) < kClose) return 0;
    if (std::fabs(value) > 1 - kClose * kClose) return value < 0 ? -1 : 1;
    return value;
}

}  // namespace

UvMatrix uvMatrix(double rotation, double scale_u, double scale_v) {
    const SineCosine turn = sineCosine(rotation);
    const double sine = snapped(turn.sine), cosine = snapped(turn.cosine);
    if (scale_u == 0) scale_u = 1;
    if (scale_v == 0) scale_v = 1;
    if (sine == 0 || cosine == 0) {
        scale_u = std::copysign(1.0, scale_u);
        scale_v = std::copysign(1.0, scale_v);
    } else {
        const double common = std::max(std::fabs(scale_u), std::fabs(scale_v));
        scale_u /= common;
        scale_v /= common;
    }
    // + 0.0: no negative zeros, which would differ between equal matrices.
    return {cosine * scale_u, sine * scale_v + 0.0, -sine * scale_u + 0.0, cosine * scale_v};
}

std::vector<Vec2> transformUvs(StridedSpan<const Vec2> uvs, const UvMatrix& matrix) {
    std::vector<Vec2> result;
    result.reserve(uvs.count);
    for (std::size_t i = 0; i < uvs.count; ++i) {
        const Vec2& uv = uvs[i];
        result.push_back({static_cast<float>(matrix.uu * uv.x + matrix.uv * uv.y),
                          static_cast<float>(matrix.vu * uv.x + matrix.vv * uv.y)});
    }
    return result;
}

}  // namespace tspace
