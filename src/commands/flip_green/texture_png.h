// SPDX-License-Identifier: MIT
#pragma once

#include "images/image.h"
#include "tspace/map_files.h"

namespace tspace {

/// Returns a KTX2 or DDS with inverted green as a PNG: x, y and z, and alpha if it is not one of them. Throws
/// FileError.
FlippedImage flippedTexturePng(ByteSpan bytes);

}  // namespace tspace
