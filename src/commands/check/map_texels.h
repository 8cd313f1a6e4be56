// SPDX-License-Identifier: MIT
// Texels of a map: their bytes, places on the surface, and vectors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/base/vec_math.h"
#include "maps/texels/gray.h"
#include "tspace/map_files.h"
#include "tspace/span.h"

namespace tspace {

/// Red, green, blue and alpha of a texel.
using TexelBytes = std::array<std::uint8_t, 4>;

/// A sample of the map at a point of a triangle.
struct TexelOnSurface {
    Vec3 normal = {};  ///< normal of the mesh, possibly rotated by a node; unit
    TexelBytes texel = {};
    double weight = 0;  ///< weight of the sample: the surface area that it represents
    Vec2 uv = {};
};

/// Distance between neighboring values in [-1, 1] as stored in 8 bits.
inline constexpr double kByteStep = 1.0 / 127.5;

inline double signedValue(std::uint8_t channel) { return static_cast<double>(channel) * kByteStep - 1; }

/// Returns the channel that stores a value of -1 to 1.
inline std::uint8_t storedValue(double value) {
    return static_cast<std::uint8_t>(std::clamp(127.5 * (value + 1) + 0.5, 0.0, 255.0));
}

/// Decodes texels by a layout. Each of the 256 values of a channel is decoded once.
class LayoutReader {
  public:
    explicit LayoutReader(const MapLayout& layout) : layout_(layout) {
        for (unsigned i = 0; i < values_.size(); ++i) {
            const float c = static_cast<float>(i) / 255.0F;
            values_[i] = 2 * static_cast<double>(readTexel({c, 0, 0}, 1, {.curve = layout.curve}).x) - 1;
        }
    }

    [[nodiscard]] DVec3 vector(const TexelBytes& texel) const {
        DVec3 v{component(texel, layout_.x), component(texel, layout_.y), 0};
        v.z = layout_.z.channel == MapChannel::none ? std::sqrt(std::max(0.0, 1 - v.x * v.x - v.y * v.y))
                                                    : component(texel, layout_.z);
        return v;
    }

  private:
    [[nodiscard]] double component(const TexelBytes& texel, const MapComponent& component) const {
        const std::uint8_t channel = texel[static_cast<std::size_t>(component.channel)];
        const double value = component.channel == MapChannel::alpha ? signedValue(channel) : values_[channel];
        return component.is_inverted ? -value : value;
    }

    MapLayout layout_;
    std::array<double, 256> values_ = {};
};

}  // namespace tspace
