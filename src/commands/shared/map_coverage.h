// SPDX-License-Identifier: MIT
// Alpha of a normal map as coverage.
#pragma once

#include <string>
#include <vector>

#include "images/float_image.h"
#include "tspace/map_files.h"

namespace tspace {

/// Takes alpha out of an image whose levels will be made. Returns how much of each texel is surface, where alpha says that; colors that
/// were multiplied by alpha are divided by it. Empty: all of every texel. Adds a sentence on what was found to `warnings`, but
/// for what was asked for.
std::vector<float> takeCoverage(MapAlpha alpha, FloatImage& image, std::vector<std::string>& warnings);

}  // namespace tspace
