// SPDX-License-Identifier: MIT
// PLY files far from the origin. Assimp reads every number as a float, so the offset that floats cannot hold is taken out
// before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/vec_math.h"

namespace tspace::import {

struct NearPly {
    std::vector<char> bytes = {};  ///< the file with other coordinates
    DVec3 offset = {};             ///< what was taken out of them
};

/// The file with the middle of its vertices taken out of their coordinates, in double. Nothing where these are floats in the
/// file, which have nothing more to give, and where the vertices are not the first element with x, y and z as single numbers.
std::optional<NearPly> nearOrigin(const std::string& path);

}  // namespace tspace::import
