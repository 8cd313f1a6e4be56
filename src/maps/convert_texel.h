// SPDX-License-Identifier: MIT
// One texel, from one frame and reading to another.
#pragma once

#include <optional>

#include "maps/shading.h"

namespace tspace {

/// The numbers that come out.
struct TexelNumbers {
    unsigned bits = 16;  ///< 8, 16, or 32: no integers
    /// With 8 bits: the angle to the texels around, in radians. Filtering gives a longer one more weight among them.
    double spread = 0;
    [[nodiscard]] unsigned most() const { return (1U << bits) - 1; }  ///< of 8 or 16
};

struct ConvertedTexel {
    Vec3 texel = {};
    double change_deg = 0;  ///< between what it shows, and what the texel before would show on the new side
    bool is_below_horizon = false;
};

/// The nearest channels for a vector as an image stores it.
Vec3 channelsOf(const DVec3& stored, const TexelNumbers& numbers);

/// Nothing where there is no answer: a frame that is singular or not finite, a texel without direction.
std::optional<ConvertedTexel> convertTexel(const Vec3& texel, const ShadingFrame& from, const MapReading& from_reading,
                                           const ShadingFrame& to, const MapReading& to_reading,
                                           const TexelNumbers& numbers);

}  // namespace tspace
