// SPDX-License-Identifier: MIT
// Option --axes of commands for maps in object and world space.
#pragma once

#include <functional>

#include "commands/shared/option_table.h"
#include "tspace/maps.h"

namespace tspace::options {

/// Returns the option: "y-up", "z-up", or three signed axes of the model ("x,-z,y") along which x, y and z of the map
/// point.
Option axesOption(std::function<void(const MapAxes&)> give);

}  // namespace tspace::options
