// SPDX-License-Identifier: MIT
// Files far from the origin. Assimp reads every number as a float, so the offset that floats cannot hold is taken out of the
// file's coordinates before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/vec_math.h"

namespace tspace::import {

struct NearFile {
    std::vector<char> bytes = {};  ///< the file with other coordinates
    DVec3 offset = {};             ///< offset subtracted from coordinates that are nearer to it than to the origin
};

/// Whether nearOrigin reads such files: PLY and STL.
bool isReadInDouble(const std::string& path);

/// The file with one offset taken out, in double, of the vertices of every geometry that is nearer to it than to the origin.
/// Nothing where the coordinates that are far from the origin have no more digits than floats, whatever their type is, and where
/// the file is broken or not as the readers here expect it. An
/// offset may be of no use, where vertices are far from each other; it is zero, and there are no bytes, where none is far from
/// the origin.
std::optional<NearFile> nearOrigin(const std::string& path);

}  // namespace tspace::import
