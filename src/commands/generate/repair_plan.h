// SPDX-License-Identifier: MIT
// ExistingTangents::repair: which tangents stay, and what of the others is mended.
#pragma once

#include "model/gltf/generate_plan.h"
#include "model/gltf/model.h"

namespace tspace::gltf {

/// Judges the tangents that are there as `check` does, normal maps included. Primitives without an error leave the plan,
/// and their reports say so; what is wrong in the others becomes the mends of their geometries and a note in their
/// reports. Fails as reading the primitives' attributes does.
void planRepair(Model& model, const GenerateOptions& options, GeneratePlan& plan);

}  // namespace tspace::gltf
