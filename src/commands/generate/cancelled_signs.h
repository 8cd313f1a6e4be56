// SPDX-License-Identifier: MIT
// ExistingTangents::replace gives right signs to what rendered right with inverted ones, because green of the normal map
// points down.
#pragma once

#include <string>

#include "commands/generate/flip_maps.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/model.h"

namespace tspace::gltf {

/// A warning where tangents are to be replaced whose signs a normal map makes up for, or may, and that map stays as it is;
/// else empty. Judges as `check` does, but only where signs look inverted. Fails as reading the attributes does.
std::string warnOfCancelledSigns(Model& model, const GeneratePlan& plan, const MapFlips& flips,
                                 const GenerateOptions& options);

}  // namespace tspace::gltf
