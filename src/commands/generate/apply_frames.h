// SPDX-License-Identifier: MIT
// Writes computed frames into a glTF document.
#pragma once

#include <span>

#include "commands/generate/generate_plan.h"
#include "commands/generate/pool_elements.h"
#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "model/gltf/vertex_numbers.h"
#include "tspace/generate.h"

namespace tspace::gltf {

/// Removes every Primitive::unreadable_tangents; call before new tangents are stored. The action of primitives without
/// new tangents becomes `removed`, so that the tangent deltas of their morph targets are removed too.
void removeUnreadableTangents(Editor& editor, std::span<const Primitive> primitives, GeneratePlan& plan);
/// Adds notes on tangents that removeUnreadableTangents removed; call after all tangents have been computed.
void noteUnreadableTangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports);

// Writes new tangents and normals into the document. If vertices were split, updates every other attribute, morph
// target and index list too.

/// Changes the document so that the pool's primitives have the frames in `elements`, whose bytes are moved. Without a
/// split, changes only TANGENT (and NORMAL and _BITANGENT if they were computed) of the primitives, and of the morph
/// targets that move positions or normals (with offsets as floats). Fills action and vertices_after in the reports of
/// the pool's primitives. `numbers`: updates the vertex indices in extensions after a split.
void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                 PoolElements&& elements, VertexNumbers& numbers, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
