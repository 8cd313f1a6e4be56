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

/// Returns the file with one offset subtracted, in double precision, from the vertices of every geometry that is closer
/// to it than to the origin. Returns nullopt if the coordinates that are far from the origin have no more digits than
/// floats, whatever their type, and if the file is corrupt or not as these readers expect. An offset may be useless if
/// vertices are far from each other; it is zero, without bytes, if none is far from the origin.
std::optional<NearFile> nearOrigin(const std::string& path);

}  // namespace tspace::import
