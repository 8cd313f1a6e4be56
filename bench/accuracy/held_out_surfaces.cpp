// SPDX-License-Identifier: MIT
// Eight further families. They were not used for tuning any constant of tspace, so they show whether the results hold
// in general.
#include "core/base/vec_math.h"
#include "surfaces.h"

namespace tspace::accuracy {

namespace {

/// Returns a point of a minimal surface with a conformal UV map.
SurfacePoint catenoid(const Dual& s, const Dual& t, int) {
    const Dual a = 1.5 * kPi * s, h = 2.4 * (t - 0.5);
    return {{cosh(h) * cos(a), cosh(h) * sin(a), h}, {s, t}};
}

/// Returns a point of a minimal surface whose stretch increases from the center.
SurfacePoint enneper(const Dual& s, const Dual& t, int) {
    const Dual x = 1.6 * s - 0.8, y = 1.6 * t - 0.8;
    return {{x - x * x * x / 3 + x * y * y, y - y * y * y / 3 + y * x * x, x * x - y * y}, {s, t}};
}

/// Returns a point of a shell: a tube that grows fivefold as it winds.
SurfacePoint shell(const Dual& s, const Dual& t, int) {
    const Dual a = 3 * kPi * s, b = 1.6 * kPi * t, size = exp(0.17 * a), r = 1 + 0.45 * cos(b);
    return {{size * r * cos(a), size * r * sin(a), size * (0.45 * sin(b) + 1.2)}, {s, t}};
}

/// Returns a point of a plane whose texture is twisted about the center.
SurfacePoint swirl(const Dual& s, const Dual& t, int) {
    const Dual x = 2 * s - 1, y = 2 * t - 1, turn = 0.7 * exp(-1.5 * (x * x + y * y));
    return {{x, y, 0.0}, {x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn)}};
}

/// Returns a point of a surface of revolution with constant negative curvature and very uneven stretch.
SurfacePoint tractroid(const Dual& s, const Dual& t, int) {
    const Dual a = kPi * s, h = 0.2 + 2.2 * t;
    return {{cos(a) / cosh(h), sin(a) / cosh(h), h - sinh(h) / cosh(h)}, {s, t}};
}

/// Returns a point of an ellipsoid with three different axes and a sheared UV map.
SurfacePoint ellipsoid(const Dual& s, const Dual& t, int) {
    const Dual a = 1.3 * kPi * s, b = 0.8 * kPi * (t - 0.5);
    return {{1.6 * cos(a) * cos(b), sin(a) * cos(b), 0.6 * sin(b)}, {s + 0.3 * t * t, t - 0.15 * s * s}};
}

/// Returns a point of a hill, on which an uneven grid is projected from above.
SurfacePoint hill(const Dual& s, const Dual& t, int) {
    const Dual x = 2.4 * s - 1.2, y = 2.4 * t - 1.2;
    return {{x, y, 0.8 * exp(-2.0 * (x * x + 0.6 * y * y + 0.5 * x * y))}, {exp(0.8 * s), sinh(1.5 * t)}};
}

/// Returns a point of folds of cloth, whose pattern is mirrored along one of the folds.
SurfacePoint mirroredFolds(const Dual& s, const Dual& t, int side) {
    const Dual from = s - 0.5, x = 2 * s - 1, y = 2 * t - 1;
    return {{x + 0.1 * sin(3 * y), y, 0.12 * sin(5 * x + 2 * y) + 0.1 * cos(3 * y)},
            {side * from * (1.0 + 0.3 * t), t + 0.2 * (from * from) * t}};
}

constexpr Surface kHeldOutSurfaces[] = {
    {"catenoid", catenoid},   {"enneper", enneper},
    {"shell", shell},         {.name = "swirl", .at = swirl, .is_flat = true},
    {"tractroid", tractroid}, {"ellipsoid", ellipsoid},
    {"hill", hill},           {"mirrored-folds", mirroredFolds, 0.5},
};

}  // namespace

std::span<const Surface> heldOutSurfaces() { return kHeldOutSurfaces; }

}  // namespace tspace::accuracy
