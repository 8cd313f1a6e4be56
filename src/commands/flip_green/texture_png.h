// SPDX-License-Identifier: MIT
#pragma once

#include "images/image.h"
#include "tspace/map_files.h"

namespace tspace {

/// Returns a KTX2 or DDS with inverted green as a PNG, with x, y and z in its colors, and with alpha unless alpha
/// contained x or y. Throws FileError.
FlippedImage flippedTexturePng(ByteSpan bytes);

}  // namespace tspace
