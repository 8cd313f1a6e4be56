// SPDX-License-Identifier: MIT
// Interprets the alpha channel of a normal map as coverage.
#pragma once

#include <string>
#include <vector>

#include "images/float_image.h"
#include "tspace/map_files.h"

namespace tspace {

/// Removes alpha from an image for which mip levels will be computed. If alpha is coverage, returns the covered part of
/// each texel, and divides colors by alpha if they were premultiplied. An empty result means that all texels are fully
/// covered. Adds sentences about ignored or missing alpha and about automatic decisions to `warnings`.
std::vector<float> takeCoverage(MapAlpha alpha, FloatImage& image, std::vector<std::string>& warnings);

}  // namespace tspace
