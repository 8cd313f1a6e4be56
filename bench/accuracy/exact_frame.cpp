// SPDX-License-Identifier: MIT
// Exact frames from the derivatives along s and t.
#include "surfaces.h"

namespace tspace::accuracy {

namespace {

constexpr double kDegrees = 57.29577951308232;

/// Inverse of the derivative of (u, v) by (s, t).
struct Inverse {
    double su, sv, tu, tv, determinant;

    explicit Inverse(const Dual (&uv)[2]) : determinant(uv[0].ds * uv[1].dt - uv[0].dt * uv[1].ds) {
        su = uv[1].dt / determinant;
        sv = -uv[0].dt / determinant;
        tu = -uv[1].ds / determinant;
        tv = uv[0].ds / determinant;
    }
};

SurfacePoint pointOf(const Surface& surface, double s, double t, int side) {
    return surface.at(Dual(s, 1, 0), Dual(t, 0, 1), side);
}

}  // namespace

DVec3 ExactFrame::tangentAcross(const DVec3& n) const { return unit(tangent - (dot(n, tangent) / dot(n, n)) * n); }

ExactFrame exactFrame(const Surface& surface, double s, double t, int side) {
    const SurfacePoint point = pointOf(surface, s, t, side);
    const Dual(&p)[3] = point.position;
    const DVec3 along_s{p[0].ds, p[1].ds, p[2].ds}, along_t{p[0].dt, p[1].dt, p[2].dt};
    const Inverse inverse(point.uv);
    ExactFrame frame;
    frame.position = {p[0].value, p[1].value, p[2].value};
    frame.normal = unit(cross(along_s, along_t));
    frame.tangent = inverse.su * along_s + inverse.tu * along_t;
    frame.bitangent = inverse.sv * along_s + inverse.tv * along_t;
    frame.u = point.uv[0].value;
    frame.v = point.uv[1].value;
    frame.sign = inverse.determinant < 0 ? -1 : 1;
    return frame;
}

void findUv(const Surface& surface, double u, double v, int side, double& s, double& t) {
    for (int step = 0; step < 8; ++step) {
        const SurfacePoint point = pointOf(surface, s, t, side);
        const double du = u - point.uv[0].value, dv = v - point.uv[1].value;
        if (du * du + dv * dv < 1e-28) return;
        const Inverse inverse(point.uv);
        s += inverse.su * du + inverse.sv * dv;
        t += inverse.tu * du + inverse.tv * dv;
    }
}

double angleDeg(const DVec3& a, const DVec3& b) {
    const double product = dot(a, b), turn = length(cross(a, b));
    if (!std::isfinite(product) || !std::isfinite(turn) || (product == 0 && turn == 0)) return 180;
    return kDegrees * std::atan2(turn, product);
}

}  // namespace tspace::accuracy
