// SPDX-License-Identifier: MIT
// Removes attributes: tangents that no material needs, and those that cannot be read.
#pragma once

#include <span>

#include "model/gltf/editor.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// True when the primitive or one of its morph targets has tangents that can be removed. They cannot where a morph
/// target has nothing else: an empty target is not valid, and removing it would renumber the weights.
bool canStripTangents(const Primitive& primitive);

/// Removes TANGENT from the primitives whose report says `removed`, and from their morph targets. Data without other
/// uses is freed.
void stripTangents(Editor& editor, std::span<const Primitive> primitives, std::span<const PrimitiveReport> reports);

/// Removes every Primitive::unreadable_tangents, before new tangents are stored. Primitives without new tangents become
/// `removed`: the tangent deltas of their morph targets must go too.
void removeUnreadableTangents(Editor& editor, std::span<const Primitive> primitives, GeneratePlan& plan);
/// Notes the removal in the reports; call when all tangents are computed.
void noteUnreadableTangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports);

/// Removes the name of an attribute from a primitive and from its Draco extension. The accessor still counts as used.
void eraseAttribute(Editor& editor, const Primitive& primitive, const char* name);

}  // namespace tspace::gltf
