// SPDX-License-Identifier: MIT
// Findings on images that are no normal maps as glTF reads them.
#pragma once

#include <optional>
#include <string>

#include "commands/check/map_content.h"
#include "tspace/check.h"

namespace tspace {

/// `--channels`, `--encoding` and all else that makes convert-map read a layout; empty for the default.
std::string layoutOptions(const MapLayout& layout);

/// `name`: of the image, with quotes. `file`: its name in a command line. `green_is_down`: the channel that holds y is also
/// inverted. `can_mend`: generate --mend-maps writes an image of this format anew. Nothing for normals.
std::optional<Finding> contentFinding(const std::string& name, const std::string& file, const MapLook& look,
                                      bool green_is_down, bool can_mend = true);

}  // namespace tspace
