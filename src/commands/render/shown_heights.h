// SPDX-License-Identifier: MIT
// Height maps of OBJ (map_bump) as pictures show them: as the normal maps that generate makes of them.
#pragma once

#include <string>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/tangents.h"

namespace tspace {

/// Puts normal maps that are made of heights into `drawn`. A map of which none can be made is left out, and a warning says so.
/// `method`: whose tangents they are read with. Throws FileError.
std::vector<std::string> showHeights(Method method, const Execution& execution, DrawnScene& drawn);

}  // namespace tspace
