// SPDX-License-Identifier: MIT
// Shapes, as signed distance functions.
#include <algorithm>
#include <cmath>

#include "core/base/vec_math.h"
#include "scans.h"

namespace tspace::accuracy {

namespace {

double larger(double a, double b) { return a > b ? a : b; }

double blend(double a, double b, double width) {
    const double h = std::clamp(0.5 + 0.5 * (b - a) / width, 0.0, 1.0);
    return b + h * (a - b) - width * h * (1 - h);
}
double ellipsoid(const DVec3& p, const DVec3& center, const DVec3& radii) {
    const DVec3 q = p - center;
    const DVec3 a{q.x / radii.x, q.y / radii.y, q.z / radii.z}, b{a.x / radii.x, a.y / radii.y, a.z / radii.z};
    return length(b) > 0 ? length(a) * (length(a) - 1) / length(b) : -1;
}
double box(const DVec3& p, const DVec3& half) {
    const DVec3 q{std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
    return length(DVec3{larger(q.x, 0), larger(q.y, 0), larger(q.z, 0)}) + std::min(larger(q.x, larger(q.y, q.z)), 0.0);
}
double cylinder(double radius, double height, double most_radius, double half_height) {
    return box({radius, height, 0}, {most_radius, half_height, 1});
}
double radiusOf(double x, double y) { return std::sqrt(x * x + y * y); }
/// Rotates a point, so that nothing is aligned with the grid.
DVec3 turned(const DVec3& p) {
    constexpr double c = 0.921060994, s = 0.389418342, d = 0.764842187, t = 0.644217687;
    const double y = s * p.x + c * p.y;
    return {c * p.x - s * p.y, d * y - t * p.z, t * y + d * p.z};
}

double blob(const DVec3& p) {
    double d = ellipsoid(p, {0, 0.35, 0}, {0.33, 0.42, 0.38});
    d = blend(d, ellipsoid(p, {0, -0.55, 0}, {0.75, 0.35, 0.4}), 0.25);
    d = blend(d, ellipsoid(p, {0, -0.1, 0}, {0.2, 0.35, 0.2}), 0.12);
    d = blend(d, ellipsoid(p, {0, 0.32, 0.4}, {0.07, 0.12, 0.1}), 0.06);
    for (const double side : {-1.0, 1.0}) {
        d = blend(d, ellipsoid(p, {side * 0.33, 0.33, 0}, {0.05, 0.1, 0.08}), 0.05);
        d = -blend(-d, ellipsoid(p, {side * 0.14, 0.45, 0.38}, {0.07, 0.05, 0.06}), 0.05);
    }
    return d;
}
double torus(const DVec3& at) {
    const DVec3 p = turned(at);
    return radiusOf(radiusOf(p.x, p.y) - 0.6, p.z) - 0.25;
}
double roundedBox(const DVec3& at) { return box(turned(at), {0.4, 0.3, 0.5}) - 0.2; }

double part(const DVec3& at) {
    const DVec3 p = turned(at);
    double d = box(p, {0.6, 0.4, 0.3});
    d = larger(d, 0.2 - radiusOf(p.x - 0.2, p.y));
    d = std::min(d, cylinder(radiusOf(p.y, p.z), p.x + 0.45, 0.22, 0.4));
    return larger(d, -box(p - DVec3{-0.1, 0.4, 0.3}, {0.15, 0.15, 0.15}));
}
double gear(const DVec3& at) {
    const DVec3 p = turned(at);
    const double radius = radiusOf(p.x, p.y);
    double d = cylinder(radius, p.z, 0.6, 0.2);
    for (int tooth = 0; tooth < 12; ++tooth) {
        const auto [sine, cosine] = sineCosine(kPi / 6 * tooth);
        d = std::min(d, box({cosine * p.x + sine * p.y - 0.65, cosine * p.y - sine * p.x, p.z}, {0.15, 0.07, 0.2}));
    }
    return larger(d, 0.2 - radius);
}

constexpr Shape kShapes[] = {
    {"blob", blob}, {"torus", torus}, {"rounded box", roundedBox}, {"part", part, true}, {"gear", gear, true}};

// Held-out shapes, which were not used for tuning the library.

double segment(const DVec3& p, const DVec3& a, const DVec3& b) {
    const DVec3 along = b - a, to = p - a;
    return length(to - std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0) * along);
}
double hand(const DVec3& at) {
    const DVec3 p = turned(at);
    double d = box(p - DVec3{0, -0.3, 0}, {0.28, 0.25, 0.06}) - 0.12;
    for (int finger = 0; finger < 4; ++finger) {
        const double x = -0.3 + 0.2 * finger, top = 0.62 - 0.1 * (finger - 1.5) * (finger - 1.5);
        d = blend(d, segment(p, {x, -0.1, 0}, {1.4 * x, top, 0.08 * finger - 0.1}) - 0.085, 0.07);
    }
    return blend(d, segment(p, {0.3, -0.45, 0}, {0.75, 0, 0.25}) - 0.1, 0.12);
}
double ripples(const DVec3& at) {
    const DVec3 p = turned(at);
    const auto [x_sine, x_cosine] = sineCosine(7 * p.x);
    const auto [y_sine, y_cosine] = sineCosine(7 * p.y);
    const auto [z_sine, z_cosine] = sineCosine(7 * p.z);
    return 0.7 * (length(p) - 0.72 + 0.05 * (x_sine * y_cosine + y_sine * z_cosine + z_sine * x_cosine));
}
/// Returns the signed distance to two intersecting rings.
double links(const DVec3& at) {
    const DVec3 p = turned(at), q = p - DVec3{0.25, 0, 0}, r = p + DVec3{0.3, 0, 0};
    return blend(radiusOf(radiusOf(q.x, q.y) - 0.45, q.z) - 0.17, radiusOf(radiusOf(r.x, r.z) - 0.4, r.y) - 0.13, 0.08);
}

double nut(const DVec3& at) {
    const DVec3 p = turned(at);
    double d = std::fabs(p.z) - 0.35;
    for (int side = 0; side < 6; ++side) {
        const auto [sine, cosine] = sineCosine(kPi / 3 * side);
        d = larger(d, cosine * p.x + sine * p.y - 0.7);
    }
    const double radius = radiusOf(p.x, p.y);
    d = larger(d, 0.8 * (radius - 0.74) + 0.6 * (std::fabs(p.z) - 0.31));  // chamfer all around
    return larger(d, 0.38 - radius);
}
double steps(const DVec3& at) {
    const DVec3 p = turned(at);
    double d = 1;
    for (int step = 0; step < 4; ++step)
        d = std::min(d, box(p - DVec3{0.15 * step - 0.15, 0.2 * step - 0.45, 0}, {0.6 - 0.15 * step, 0.1, 0.5}));
    return std::min(d, box(p - DVec3{0.1, -0.1, 0}, {0.35, 0.45, 0.2}));
}
double bracket(const DVec3& at) {
    const DVec3 p = turned(at);
    double d = std::min(box(p - DVec3{0, -0.45, 0}, {0.65, 0.13, 0.4}), box(p - DVec3{-0.52, 0, 0}, {0.13, 0.58, 0.4}));
    d = larger(d, 0.16 - radiusOf(p.x - 0.3, p.z));
    d = larger(d, 0.18 - radiusOf(p.y - 0.25, p.z));
    return std::min(d, cylinder(radiusOf(p.x - 0.05, p.z), p.y + 0.3, 0.12, 0.25));
}

constexpr Shape kHeldOut[] = {{"hand", hand},     {"ripples", ripples},   {"links", links},
                              {"nut", nut, true}, {"steps", steps, true}, {"bracket", bracket, true}};

// Shapes of drawnMeshes(), whose triangles do not come from a grid.

double lathed(const DVec3& p) { return radiusOf(radiusOf(p.x, p.y) - 0.6, p.z) - 0.25; }
double filleted(const DVec3& p) { return cylinder(radiusOf(p.x, p.y), p.z, 0.64, 0.64) - 0.16; }
double capped(const DVec3& p) { return cylinder(radiusOf(p.x, p.y), p.z, 0.8, 0.8); }
double slab(const DVec3& p) { return box(p, {0.8, 0.6, 0.2}); }

constexpr Shape kDrawn[] = {{"lathed", lathed}, {"filleted", filleted}, {"capped", capped, true}, {"slab", slab, true}};

DVec3 differences(const Shape& shape, const DVec3& p) {
    constexpr double h = 1e-4;
    const auto along = [&](const DVec3& d) { return (shape.distance(p + d) - shape.distance(p - d)) / (2 * h); };
    return {along({h, 0, 0}), along({0, h, 0}), along({0, 0, h})};
}

}  // namespace

DVec3 Shape::normalAt(const DVec3& p) const {
    DVec3 slope = differences(*this, p);
    // At equal distance from two faces, the differences may cancel out.
    if (!(length(slope) > 0)) slope = differences(*this, p + DVec3{1e-4, 2e-4, 3e-4});
    return (1 / length(slope)) * slope;
}

DVec3 Shape::nearest(DVec3 p) const {
    for (int step = 0; step < 4; ++step) {
        const DVec3 slope = differences(*this, p);
        p = p - (distance(p) / larger(dot(slope, slope), 0.1)) * slope;
    }
    return p;
}

std::span<const Shape> shapes() { return kShapes; }

std::span<const Shape> heldOutShapes() { return kHeldOut; }
std::span<const Shape> drawnShapes() { return kDrawn; }

}  // namespace tspace::accuracy
