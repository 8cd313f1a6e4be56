// SPDX-License-Identifier: MIT
// Texels of one layer during baking.
#pragma once

#include <span>
#include <vector>

#include "core/base/memory.h"
#include "maps/texels/texture_sample.h"

namespace tspace {

enum class TexelState : std::uint8_t {
    empty,    ///< no triangle is near the texel
    missing,  ///< a triangle covers the texel, but the ray hit nothing
    known
};

/// Rule by which missing texels are computed from their neighbors.
enum class Filling {
    mean,  ///< mean of the known neighbors
    copy   ///< copy of one known neighbor, for values that must not be mixed
};

/// Fills missing texels ring by ring, starting from the known ones. Does nothing if no texel is known.
void fillMissing(std::span<float> values, std::uint32_t channel_count, std::span<const TexelState> states,
                 const TextureShape& shape, Filling filling);

}  // namespace tspace
