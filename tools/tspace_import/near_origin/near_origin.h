// SPDX-License-Identifier: MIT
// Files far from the origin. Assimp reads every number as a float, so an offset that floats cannot represent is
// subtracted from the file's coordinates first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/vec_math.h"

namespace tspace::import {

struct NearFile {
    std::vector<char> bytes = {};  ///< the file with changed coordinates
    DVec3 offset = {};             ///< offset subtracted from coordinates that are closer to it than to the origin
};

/// Returns whether nearOrigin supports the format: PLY and STL.
bool isReadInDouble(const std::string& path);

/// Returns the file with an offset subtracted, in double precision, from the vertices of every geometry that is closer
/// to the offset than to the origin. The offset may be useless if geometries are far from each other. If no geometry is
/// far from the origin, `offset` is zero and `bytes` empty. Returns nullopt if the coordinates (of the geometries that
/// are far from the origin, if any are) have no more digits than floats, whatever their type. Also if the file is
/// corrupt or has a layout that the readers do not support.
std::optional<NearFile> nearOrigin(const std::string& path);

}  // namespace tspace::import
