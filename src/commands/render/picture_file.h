// SPDX-License-Identifier: MIT
// A picture as the bytes of a file.
#pragma once

#include <cstdint>
#include <vector>

#include "images/image.h"

namespace tspace {

/// A PNG of 8 bits. Throws FileError (unsupportedFile) where this build writes none.
std::vector<std::uint8_t> encodePicture(const RgbImage& image);

}  // namespace tspace
