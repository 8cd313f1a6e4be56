// SPDX-License-Identifier: MIT
// Computed frames as edits of a file.
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

/// Removes every Primitive::unreadable_tangents, before new tangents are stored. Primitives without new tangents become
/// `removed`: the tangent deltas of their morph targets must go too.
void removeUnreadableTangents(Editor& editor, std::span<const Primitive> primitives, GeneratePlan& plan);
/// Notes the removal in the reports; call when all tangents are computed.
void noteUnreadableTangents(std::span<const Primitive> primitives, std::span<PrimitiveReport> reports);

// Putting computed frames into the document: new tangents and normals, and, where vertices were split, every
// other attribute, morph target and index list with them.

/// Changes the document so that the pool's primitives have the frames in `elements`, whose bytes it takes. Without a
/// split only TANGENT (and NORMAL and _BITANGENT where they were made) changes, in the primitives and in those morph
/// targets that move positions or normals (their offsets are floats). Fills action and vertices_after of the reports of
/// the pool's primitives. `numbers`: takes what extensions say about vertices that were split along.
void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives, const PoolPlan& pool,
                 PoolElements&& elements, VertexNumbers& numbers, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
