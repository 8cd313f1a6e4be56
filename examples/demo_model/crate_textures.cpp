// SPDX-License-Identifier: MIT
// Textures of the crate: a height field of grooves, rivets and plates, its normal map, and paint that follows it. Uses
// only sqrt from libm, so that the texels are equal on every machine.
#include <algorithm>
#include <cmath>

#include "crate.h"

namespace crate {
namespace {

struct Point {
    double x, y;  ///< meters from the center of the side: right, down
};

double smoothstep(double low, double high, double value) {
    const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

double length(double x, double y) { return std::sqrt(x * x + y * y); }

// Signed distances to shapes, negative inside. After "2D distance functions" by Inigo Quilez.

double roundedBox(Point p, double half_width, double half_height, double radius) {
    const double x = std::abs(p.x) - half_width + radius, y = std::abs(p.y) - half_height + radius;
    return length(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0) - radius;
}

double disc(Point p, double radius) { return length(p.x, p.y) - radius; }

double segment(Point p, Point a, Point b, double radius) {
    const double x = b.x - a.x, y = b.y - a.y;
    const double t = std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y), 0.0, 1.0);
    return length(p.x - a.x - t * x, p.y - a.y - t * y) - radius;
}

// The following functions return heights in meters. `distance`: from an outline, in meters.

double plate(double distance, double height) { return height * smoothstep(0.006, -0.006, distance); }

double groove(double distance) { return -0.006 * smoothstep(0.009, 0.002, std::abs(distance)); }

double rivet(Point p) {
    constexpr double kRadius = 0.014;
    const double t = 1 - (p.x * p.x + p.y * p.y) / (kRadius * kRadius);
    return t > 0 ? 0.6 * kRadius * std::sqrt(t) : 0;
}

/// Returns the signed distance to the nearest multiple of `step`.
double repeat(double value, double step) { return value - step * std::floor(value / step + 0.5); }

/// Returns the height of rivets on the square |x| = r or |y| = r.
double rivetFrame(Point p) {
    constexpr double kRow = 0.39, kStep = 0.13;
    const bool on_column = std::abs(p.x) > std::abs(p.y);
    const double along = on_column ? p.y : p.x, away = std::abs(on_column ? p.x : p.y);
    return away < kRow + 0.02 ? rivet({repeat(along, kStep), away - kRow}) : 0;
}

double panel(Point p) { return roundedBox(p, 0.355, 0.355, 0.06); }

double letterT(Point p) {
    return std::min(roundedBox({p.x, p.y + 0.09}, 0.13, 0.032, 0.008),
                    roundedBox({p.x, p.y - 0.02}, 0.032, 0.13, 0.008));
}

/// Returns the height of a tread plate: short bars, rotated by a right angle from cell to cell.
double tread(Point p) {
    constexpr double kCell = 0.085;
    const double column = std::floor(p.x / kCell), row = std::floor(p.y / kCell);
    const Point local{p.x - (column + 0.5) * kCell, p.y - (row + 0.5) * kCell};
    const double turn = std::fmod(std::abs(column + row), 2) < 0.5 ? 1 : -1;
    return segment(local, {-0.022, -0.022 * turn}, {0.022, 0.022 * turn}, 0.006);
}

/// Returns the height of the details that only this side has.
double detail(Side side, Point p) {
    const double inside = smoothstep(-0.03, -0.04, panel(p));
    switch (side) {
        case Side::top: return inside * 0.6 * plate(tread(p), 0.006);
        case Side::front: {
            if (std::abs(p.y) > 0.21) {
                return 0;
            }
            const double slat = repeat(p.y, 0.06) / 0.06;
            return smoothstep(0.005, -0.005, std::abs(p.x) - 0.2) * smoothstep(0.5, 0.42, std::abs(slat)) * 0.016 *
                   (slat - 0.5);
        }
        case Side::under:
            return inside * groove(std::min(std::abs(p.x - p.y), std::abs(p.x + p.y)) * 0.7071067811865476);
        case Side::back: {
            const double pipe = 1 - repeat(p.x - 0.05, 0.1) * repeat(p.x - 0.05, 0.1) / (0.03 * 0.03);
            return pipe > 0 && std::abs(p.x) < 0.3 ? smoothstep(0.29, 0.27, std::abs(p.y)) * 0.015 * std::sqrt(pipe)
                                                   : 0;
        }
        case Side::right: {
            // The eight bolts are symmetric, so the position is mirrored into one eighth of the circle.
            double x = std::abs(p.x), y = std::abs(p.y);
            if (y > x) {
                std::swap(x, y);
            }
            const double bolt = rivet({x - 0.2217, y - 0.0918});
            return plate(disc(p, 0.28), 0.01) + groove(disc(p, 0.19)) + plate(disc(p, 0.07), 0.012) +
                   groove(disc(p, 0.04)) + bolt;
        }
        case Side::left: return groove(disc(p, 0.27)) + plate(letterT(p), 0.012);
    }
    return 0;
}

double height(Side side, Point p) {
    if (isMirrored(side)) {
        p.x = std::abs(p.x);
    }
    return groove(panel(p)) + plate(panel(p) + 0.018, 0.006) + rivetFrame(p) + detail(side, p);
}

/// Returns a value in 0..1, constant over a cell of the integer grid.
double noiseAt(std::int64_t x, std::int64_t y) {
    std::uint64_t bits =
        static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^ static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu;
    bits = (bits ^ (bits >> 29)) * 0xBF58476D1CE4E5B9u;
    bits = (bits ^ (bits >> 32)) * 0x94D049BB133111EBu;
    return static_cast<double>(bits >> 40) / static_cast<double>(1u << 24);
}

/// Returns smooth noise with features of about 1 / `frequency` meters.
double noise(Point p, double frequency) {
    const double x = p.x * frequency, y = p.y * frequency;
    const double column = std::floor(x), row = std::floor(y);
    const auto i = static_cast<std::int64_t>(column), j = static_cast<std::int64_t>(row);
    const double s = smoothstep(0, 1, x - column), t = smoothstep(0, 1, y - row);
    return std::lerp(std::lerp(noiseAt(i, j), noiseAt(i + 1, j), s),
                     std::lerp(noiseAt(i, j + 1), noiseAt(i + 1, j + 1), s), t);
}

struct Color {
    double r, g, b;  ///< sRGB values, 0..1
};

Color mix(Color a, Color b, double t) {
    return {std::lerp(a.r, b.r, t), std::lerp(a.g, b.g, t), std::lerp(a.b, b.b, t)};
}

Color paint(Side side, Point p) {
    constexpr Color kFrame{0.25, 0.27, 0.30}, kPaint{0.88, 0.44, 0.12}, kPale{0.90, 0.87, 0.80};
    constexpr Color kSteel{0.62, 0.63, 0.65}, kDirt{0.10, 0.09, 0.08};
    if (isMirrored(side)) {
        p.x = std::abs(p.x);
    }
    Color color = mix(kFrame, kPaint, smoothstep(0.002, -0.002, panel(p)));
    if (side == Side::left) {
        color = mix(color, kPale, smoothstep(0.002, -0.002, letterT(p)));
    }
    if (side == Side::right) {
        color = mix(color, kFrame, smoothstep(0.002, -0.002, disc(p, 0.19)));
    }
    if (side == Side::top) {
        color = mix(color, kSteel, 0.5 * smoothstep(0.002, -0.002, std::max(tread(p), panel(p) + 0.035)));
    }
    const double shift = 3 * static_cast<int>(side);  // noise offset, so that each side is worn in other places
    const double grain = 0.6 * noise({p.x + shift, p.y}, 23) + 0.4 * noise({p.x, p.y + shift + 7}, 91);
    const double edge = smoothstep(0.41, 0.47, std::max(std::abs(p.x), std::abs(p.y)));
    color = mix(color, kSteel, smoothstep(0.80, 0.84, grain + 0.22 * edge));
    color = mix(color, kSteel, rivetFrame(p) > 0 ? 0.8 : 0.0);
    const double deep = std::clamp(-height(side, p) / 0.006, 0.0, 1.0);
    return mix(color, kDirt, std::clamp(0.75 * deep + 0.25 * (1 - grain), 0.0, 1.0));
}

/// Returns the side whose part of the texture contains a position, including its gutter.
Side sideAt(double u, double v) {
    if (u < 0.5) {
        return u < 0.25 ? (v < 0.5 ? Side::top : Side::front) : (v < 0.5 ? Side::under : Side::back);
    }
    return v < 0.5 ? Side::right : Side::left;
}

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5); }

}  // namespace

Textures makeTextures(int size) {
    const double pixel = 1 / (size * kUvPerMeter);  // meters per texel
    Textures result;
    result.base_color.size = result.normal.size = size;
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const double u = (column + 0.5) / size, v = (row + 0.5) / size;
            const Side side = sideAt(u, v);
            const Place place = placeOf(side);
            const Point p{(u - place.u) / kUvPerMeter, (v - place.v) / kUvPerMeter};
            const Color color = paint(side, p);
            for (const double value : {color.r, color.g, color.b}) {
                result.base_color.rgb.push_back(toByte(value));
            }
            // Slopes from central differences over two texels; green points up, against v.
            const double slope_u = (height(side, {p.x + pixel, p.y}) - height(side, {p.x - pixel, p.y})) / (2 * pixel);
            const double slope_v = (height(side, {p.x, p.y + pixel}) - height(side, {p.x, p.y - pixel})) / (2 * pixel);
            const double scale = 1 / std::sqrt(slope_u * slope_u + slope_v * slope_v + 1);
            for (const double value : {-slope_u * scale, slope_v * scale, scale}) {
                result.normal.rgb.push_back(toByte(0.5 * value + 0.5));
            }
        }
    }
    return result;
}

}  // namespace crate
