// SPDX-License-Identifier: MIT
// Putting computed frames into the document: new tangents and normals, and, where vertices were split, every
// other attribute, morph target and index list with them.
#pragma once

#include <span>

#include "asset/gltf/editor.h"
#include "asset/gltf/generate_plan.h"
#include "generate/primitive.h"

namespace tspace::gltf {

/// Changes the document so that the pool's primitives have `frames`. Without a split only TANGENT (and NORMAL
/// where it was generated) changes. Fills action and vertices_after of the reports of the pool's primitives.
void applyFrames(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                 const Pool& pool, const PoolFrames& frames, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
