// SPDX-License-Identifier: MIT
// Images that show the effect of encoding errors.
#pragma once

#include <cstdint>
#include <vector>

#include "codes.h"

namespace tspace::bench {

struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> gray;  ///< from the top row downward
};

/// Returns a picture with two rows, a sphere and a torus, each with a normal map and mirrored UVs on one half. The left
/// column is shaded with float frames. There is one further column per encoding, with 100 times the difference from the
/// left column.
Picture differencePicture(const std::vector<Code>& codes, int size);

}  // namespace tspace::bench
