// SPDX-License-Identifier: MIT
// Effect of encoding errors on a rendered image.
#pragma once

#include <cstdint>
#include <vector>

#include "codes.h"

namespace tspace::bench {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> gray;  ///< from the top row downward
};

/// Two rows, a sphere and a torus, each with a normal map and mirrored UVs on one half; from the left: shaded with
/// float frames, then for each encoding 100 times the difference from that.
Picture differencePicture(const std::vector<Code>& codes, int size);

}  // namespace tspace::bench
