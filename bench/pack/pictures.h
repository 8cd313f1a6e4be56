// SPDX-License-Identifier: MIT
// What the errors of codes do to a picture.
#pragma once

#include <cstdint>
#include <vector>

#include "codes.h"

namespace tspace::bench {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> grey;  ///< from the top row downwards
};

/// Two rows, a sphere and a torus, each with a normal map and with mirrored UVs on one half; from the left, shaded with
/// frames in floats, then for each code 100 times the difference from that.
Picture differencePicture(const std::vector<Code>& codes, int size);

}  // namespace tspace::bench
