// SPDX-License-Identifier: MIT
// How long vectors of normal maps of 8 bits may be. CMake target tspace::maps.
#pragma once

#include <cstdint>

namespace tspace {

/// How long the vectors of maps of 8 bits may be, of which there are so few that a longer or shorter one often points better.
enum class TexelLengths : std::uint32_t {
    even = 0,  ///< 0.9 to 1: means of several texels, as in smaller levels, are nearly as right as those of 16 bits
    free = 1,  ///< 0.7 to 1.1: the first level errs by up to a third less, and smaller ones lean to the longer texels
};

}  // namespace tspace
