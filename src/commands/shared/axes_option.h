// SPDX-License-Identifier: MIT
// The option --axes of commands on maps in object and world space.
#pragma once

#include <functional>

#include "commands/shared/option_table.h"
#include "tspace/maps.h"

namespace tspace::options {

/// "y-up", "z-up", or three axes of the model with a sign each ("x,-z,y"): what x, y and z of the map point along.
Option axesOption(std::function<void(const MapAxes&)> give);

}  // namespace tspace::options
