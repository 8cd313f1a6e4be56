// SPDX-License-Identifier: MIT
// DDS and KTX2 around levels of blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "images/image.h"

namespace tspace {

/// Levels of BC5, the largest first: each half as wide and high as the one before, rounded down, and 1 at least.
struct Bc5Texture {
    std::uint32_t width = 0, height = 0;
    bool is_signed = false;
    std::vector<std::vector<std::uint8_t>> levels = {};
};

/// With the head of Direct3D 10.
std::vector<std::uint8_t> writeDds(const Bc5Texture& texture);
/// Not packed once more; linear, rows from the top.
std::vector<std::uint8_t> writeKtx2(const Bc5Texture& texture);

}  // namespace tspace
