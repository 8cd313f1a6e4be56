// SPDX-License-Identifier: MIT
// Twelve surfaces: flat and curved, isometric, conformal, stretched, sheared and mirrored UV maps.
#include "surfaces.h"

#include "core/base/vec_math.h"

namespace tspace::accuracy {

namespace {

SurfacePoint planeWarp(const Dual& s, const Dual& t, int) {
    return {{s, t, 0.0}, {s + 0.08 * sin(2 * kPi * t) + 0.05 * sin(2 * kPi * s), t + 0.08 * sin(2 * kPi * s + 1.0)}};
}

SurfacePoint sphereLatLong(const Dual& s, const Dual& t, int) {
    const Dual a = kPi * s, b = (t - 0.5) * (2 * kPi / 3);
    return {{cos(a) * cos(b), sin(a) * cos(b), sin(b)}, {s, t}};
}

void onCubeSphere(const Dual& s, const Dual& t, Dual (&position)[3]) {
    const Dual x = 2 * s - 1, y = 2 * t - 1, size = sqrt(x * x + y * y + 1);
    position[0] = x / size;
    position[1] = y / size;
    position[2] = 1 / size;
}

SurfacePoint cubeSphere(const Dual& s, const Dual& t, int) {
    SurfacePoint point{{}, {s, t}};
    onCubeSphere(s, t, point.position);
    return point;
}

SurfacePoint sphereConformal(const Dual& s, const Dual& t, int) {
    const Dual x = 1.8 * (s - 0.5), y = 1.8 * (t - 0.5), square = x * x + y * y, d = 1 / (1 + square);
    return {{2 * x * d, 2 * y * d, (1 - square) * d}, {s, t}};
}

SurfacePoint torus(const Dual& s, const Dual& t, int) {
    const Dual a = kPi * s, b = 2 * kPi * t, r = 1 + 0.4 * cos(b);
    return {{r * cos(a), r * sin(a), 0.4 * sin(b)}, {s, t}};
}

SurfacePoint cylinderTurned(const Dual& s, const Dual& t, int) {
    const Dual a = kPi * s;
    const double c = std::cos(kPi / 6), d = std::sin(kPi / 6);
    return {{cos(a), sin(a), kPi * t}, {c * s + d * t, c * t - d * s}};
}

SurfacePoint saddle(const Dual& s, const Dual& t, int) {
    const Dual x = 2 * s - 1, y = 2 * t - 1;
    return {{x, y, 0.5 * (x * x - y * y)}, {s, t}};
}

void onBumps(const Dual& s, const Dual& t, Dual (&position)[3]) {
    const Dual x = 2 * s - 1, y = 2 * t - 1;
    position[0] = x;
    position[1] = y;
    position[2] = 0.15 * sin(4 * x + 1) * cos(5 * y);
}

SurfacePoint bumpy(const Dual& s, const Dual& t, int) {
    SurfacePoint point{{}, {s, t}};
    onBumps(s, t, point.position);
    return point;
}

SurfacePoint ribbon(const Dual& s, const Dual& t, int) {
    const Dual a = kPi * s, r = 1.2 * t - 0.3;
    return {{r * cos(a), r * sin(a), 0.3 * a}, {s, t}};
}

SurfacePoint conePolar(const Dual& s, const Dual& t, int) {
    const Dual a = kPi * s, r = 0.25 + 0.75 * t;
    return {{r * cos(a), r * sin(a), 1.5 * r}, {s, t}};
}

SurfacePoint sphereShear(const Dual& s, const Dual& t, int) {
    SurfacePoint point{{}, {s + 0.5 * t + 0.1 * sin(2 * kPi * t), 0.5 * t + 0.3 * t * t + 0.06 * sin(2 * kPi * s)}};
    onCubeSphere(s, t, point.position);
    return point;
}

SurfacePoint bumpyMirror(const Dual& s, const Dual& t, int side) {
    const Dual from = s - 0.5, w = from + 0.06 * sin(2 * kPi * t) * from;
    SurfacePoint point{{}, {side * w, t + 0.05 * sin(4 * kPi * (from * from))}};
    onBumps(s, t, point.position);
    return point;
}

constexpr Surface kSurfaces[] = {
    {.name = "plane-warp", .at = planeWarp, .is_flat = true},
    {"sphere-latlong", sphereLatLong},
    {"cube-sphere", cubeSphere},
    {"sphere-conformal", sphereConformal},
    {"torus", torus},
    {"cylinder-rot30", cylinderTurned},
    {"saddle", saddle},
    {"bumpy", bumpy},
    {"ribbon", ribbon},
    {"cone-polar", conePolar},
    {"sphere-shear", sphereShear},
    {"bumpy-mirror", bumpyMirror, 0.5},
};

}  // namespace

std::span<const Surface> surfaces() { return kSurfaces; }

}  // namespace tspace::accuracy
