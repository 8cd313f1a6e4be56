// SPDX-License-Identifier: MIT
// Putting computed frames into the document: new tangents and normals, and, where vertices were split, every
// other attribute, morph target and index list with them.
#pragma once

#include <span>

#include "model/gltf/editor.h"
#include "model/gltf/generate_plan.h"
#include "model/gltf/pool_elements.h"
#include "model/gltf/vertex_numbers.h"

namespace tspace::gltf {

/// Changes the document so that the pool's primitives have the frames in `elements`, whose bytes it takes. Without a
/// split only TANGENT (and NORMAL and _BITANGENT where they were made) changes, in the primitives and in those morph
/// targets that move positions or normals (their offsets are floats). Fills action and vertices_after of the reports of
/// the pool's primitives. `numbers`: takes what extensions say about vertices that were split along.
void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives, const Pool& pool,
                 PoolElements&& elements, VertexNumbers& numbers, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
