// SPDX-License-Identifier: MIT
// Taking away attributes: tangents that nobody needs, or nobody can read.
#pragma once

#include <span>

#include "model/gltf/editor.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// True when the primitive or one of its morph targets has tangents, and they can go. They cannot where a morph target
/// moves nothing else: an empty target is not allowed, and taking it away would renumber the weights.
bool canStripTangents(const Primitive& primitive);

/// Takes TANGENT out of the primitives whose report says `removed`, and of their morph targets. Data that nothing else
/// uses go too.
void stripTangents(Editor& editor, std::span<const Primitive> primitives, std::span<const PrimitiveReport> reports);

/// Takes every Primitive::unreadable_tangents away, before new ones are stored. Primitives of which nothing is computed
/// become `removed`: what morph targets add to tangents has to go with these.
void removeUnreadableTangents(Editor& editor, std::span<const Primitive> primitives, GeneratePlan& plan);
/// Says so in the reports, when everything is computed.
void noteUnreadableTangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports);

/// Takes the name of an attribute out of a primitive, and of the list of what its Draco data hold. Its accessor still
/// counts as used.
void eraseAttribute(Editor& editor, const Primitive& primitive, const char* name);

}  // namespace tspace::gltf
