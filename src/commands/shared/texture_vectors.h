// SPDX-License-Identifier: MIT
// Normal maps whose channels are not those of glTF: x, y and z are put into red, green and blue.
#pragma once

#include <string>

#include "images/float_image.h"

namespace tspace {

/// Where the format of a file (KTX2, DDS, EXR) has x and y alone, or its texels look so: puts x, y and a z made of them in red,
/// green and blue. Gives one sentence that says so, and how floats were read (FloatImage::range_text); empty where neither
/// was needed.
std::string readTextureVectors(FloatImage& image);

/// Parses the value of `--channels`: "bgr" means z, y and x, a capital letter inverts a channel, and with two letters z is
/// computed. Returns what is wrong with `letters`, or an empty string.
std::string takeChannels(const std::string& letters, MapLayout& layout);

/// Whether alpha holds a component of the vectors.
bool readsAlpha(const MapLayout& layout);

/// Puts x, y and z of all texels into red, green and blue. Alpha is removed if it held one of them.
void readTexels(const MapLayout& layout, FloatImage& image);

}  // namespace tspace
