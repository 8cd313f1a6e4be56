// SPDX-License-Identifier: MIT
// Texture files as normal maps: two channels become vectors.
#pragma once

#include <string>

#include "images/float_image.h"

namespace tspace {

/// Where the format of a file (KTX2, DDS, EXR) has x and y alone, or its texels look so: puts x, y and a z made of them in red,
/// green and blue. Gives one sentence that says so, and how floats were read (FloatImage::range_text); empty where neither
/// was needed.
std::string readTextureVectors(FloatImage& image);

}  // namespace tspace
