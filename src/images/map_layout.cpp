// SPDX-License-Identifier: MIT
#include "tspace/map_files.h"

#include <algorithm>
#include <cmath>

namespace tspace {
namespace {

/// withoutSrgb converts a channel from sRGB to linear, withSrgb converts it back (IEC 61966-2-1).
double withoutSrgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double withSrgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

float withoutCurve(float channel, MapCurve curve) {
    const double c = std::clamp(static_cast<double>(channel), 0.0, 1.0);
    if (curve == MapCurve::srgb) return static_cast<float>(withoutSrgb(c));
    if (curve == MapCurve::linearized) return static_cast<float>(withSrgb(c));
    return channel;
}

float componentOf(const Vec3& rgb, float alpha, const MapComponent& component, MapCurve curve) {
    float value = alpha;
    if (component.channel == MapChannel::red) value = withoutCurve(rgb.x, curve);
    if (component.channel == MapChannel::green) value = withoutCurve(rgb.y, curve);
    if (component.channel == MapChannel::blue) value = withoutCurve(rgb.z, curve);
    return component.is_inverted ? 1 - value : value;
}

}  // namespace

Vec3 readTexel(const Vec3& rgb, float alpha, const MapLayout& layout) {
    Vec3 texel{componentOf(rgb, alpha, layout.x, layout.curve), componentOf(rgb, alpha, layout.y, layout.curve), 0};
    if (layout.z.channel == MapChannel::none) {
        const float x = 2 * texel.x - 1, y = 2 * texel.y - 1;
        texel.z = 0.5F + 0.5F * std::sqrt(std::max(0.0F, 1 - x * x - y * y));
    } else {
        texel.z = componentOf(rgb, alpha, layout.z, layout.curve);
    }
    return texel;
}

}  // namespace tspace
