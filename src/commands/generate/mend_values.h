// SPDX-License-Identifier: MIT
// Tangents that stay: what the format forbids in them is mended, and nothing else.
#pragma once

#include <span>
#include <vector>

#include "model/gltf/editor.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/model.h"

namespace tspace::gltf {

/// Primitives whose tangents stay and lie in one accessor, where these have values that no tangent may have
/// (hasSoundValues) at some vertex, used by triangles or not. Tangents along N count where a material reads
/// them: elsewhere they may be normals for outlines.
std::vector<std::vector<std::size_t>> findBrokenValues(Model& model, const GeneratePlan& plan);

/// Mends them, in the format that they have, and says so in the reports. All other elements keep their bits.
void mendBrokenValues(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                      std::span<const std::vector<std::size_t>> groups, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
