// SPDX-License-Identifier: MIT
// Converts normal maps whose channels differ from glTF's: moves x, y and z to red, green and blue.
#pragma once

#include <string>

#include "images/float_image.h"

namespace tspace {

/// Returns the number of texels that are not finite, and how they were filled, as a clause; empty if it is 0.
std::string notFiniteText(std::uint64_t count);

/// Returns one sentence about the conversion of floats (FloatImage::range_text), texels that are not finite, and layers
/// that were not read, and clears these properties; empty if there is nothing to say.
std::string takeRemarks(FloatImage& image);

/// If a texture file (KTX2, DDS, EXR) stores only x and y according to its format or its texels, stores x, y and the
/// reconstructed z in red, green and blue. Returns one sentence about this, and with the
/// text of takeRemarks; empty if there is nothing to say.
std::string readTextureVectors(FloatImage& image);

/// Returns the name of a channel in texts.
const char* channelName(MapChannel channel);

/// Parses the value of `--channels`. Its letters name the channels that contain x, y and z: "bgr" reads x from blue, y
/// from green and z from red. A capital letter inverts a channel; with two letters, z is reconstructed. Returns an
/// error message about `letters`, or an empty string.
std::string takeChannels(const std::string& letters, MapLayout& layout);

/// Returns whether alpha contains a component of the vectors.
bool readsAlpha(const MapLayout& layout);

/// Moves x, y and z of all texels to red, green and blue. Removes alpha if it contained a component.
void readTexels(const MapLayout& layout, FloatImage& image);

}  // namespace tspace
