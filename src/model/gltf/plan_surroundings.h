// SPDX-License-Identifier: MIT
// Which primitives of a mesh are one surface where normals are made.
#pragma once

#include <span>

#include "model/gltf/generate_plan.h"
#include "model/gltf/model.h"

namespace tspace::gltf {

/// Gives the geometries whose normals are made the triangles of other primitives of their mesh that they are one surface
/// with, and notes it in the reports. A geometry that several meshes draw gets those of the first. Nothing for flat normals,
/// which look at no neighbours, nor with normals_per_primitive.
void planSurroundings(Model& model, const GenerateOptions& options, GeneratePlan& plan);

}  // namespace tspace::gltf
