// SPDX-License-Identifier: MIT
// Plots of a study, as SVG.
#pragma once

#include <string>

#include "study.h"

namespace tspace::accuracy {

/// Writes vertex-error.svg, shading-error.svg, normal-error.svg, bevel-tangents.svg and bevel-normals.svg into a
/// folder, which is created if missing. Returns false if one cannot be written.
bool writePlots(const Study& study, const std::string& folder);

}  // namespace tspace::accuracy
