// SPDX-License-Identifier: MIT
#pragma once

#include "images/image.h"
#include "tspace/map_files.h"

namespace tspace {

/// A KTX2 or DDS with green inverted as a PNG: x, y and z, and alpha where that is none of them. Throws FileError.
FlippedImage flippedTexturePng(ByteSpan bytes);

}  // namespace tspace
