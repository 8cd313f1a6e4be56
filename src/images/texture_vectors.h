// SPDX-License-Identifier: MIT
// Converts normal maps whose channels differ from glTF's: moves x, y and z to red, green and blue.
#pragma once

#include <string>

#include "images/float_image.h"

namespace tspace {

/// If a texture file (KTX2, DDS, EXR) stores only x and y according to its format or its texels, stores x, y and the
/// reconstructed z in red, green and blue. Returns one sentence about this and about the conversion of floats
/// (FloatImage::range_text); empty if neither was necessary.
std::string readTextureVectors(FloatImage& image);

/// Parses the value of `--channels`. Its letters name the channels that contain x, y and z: "bgr" reads x from blue, y
/// from green and z from red. A capital letter inverts a channel; with two letters, z is reconstructed. Returns an
/// error message about `letters`, or an empty string.
std::string takeChannels(const std::string& letters, MapLayout& layout);

/// Returns whether alpha contains a component of the vectors.
bool readsAlpha(const MapLayout& layout);
/// Returns the name of a channel in texts.
const char* channelName(MapChannel channel);


/// Moves x, y and z of all texels to red, green and blue. Removes alpha if it contained a component.
void readTexels(const MapLayout& layout, FloatImage& image);

}  // namespace tspace
