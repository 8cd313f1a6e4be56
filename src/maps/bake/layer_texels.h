// SPDX-License-Identifier: MIT
// The texels of one layer while it is made.
#pragma once

#include <span>
#include <vector>

#include "core/base/memory.h"
#include "maps/texels/texture_sample.h"

namespace tspace {

enum class TexelState : std::uint8_t {
    empty,    ///< no triangle is near
    missing,  ///< a triangle is there, and nothing was met
    known
};

/// How missing texels are made of those around.
enum class Filling {
    mean,  ///< the mean of known neighbours
    copy   ///< one of them: what must not be mixed
};

/// Gives missing texels values, ring by ring from the known ones; nothing where none is known.
void fillMissing(std::span<float> values, std::uint32_t channel_count, std::span<const TexelState> states,
                 const TextureShape& shape, Filling filling);

}  // namespace tspace
