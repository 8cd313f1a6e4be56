// SPDX-License-Identifier: MIT
// What is said of images that are no normal maps as glTF reads them.
#pragma once

#include <optional>
#include <string>

#include "commands/check/map_content.h"
#include "tspace/check.h"

namespace tspace {

/// `--channels`, `--encoding` and all else that makes convert-map read a layout; empty for the default.
std::string layoutOptions(const MapLayout& layout);

/// `name`: of the image, with quotes. `file`: what a command line calls it. `green_is_down`: what is in the place of y is
/// inverted besides. Nothing for normals.
std::optional<Finding> contentFinding(const std::string& name, const std::string& file, const MapLook& look,
                                      bool green_is_down);

}  // namespace tspace
