// SPDX-License-Identifier: MIT
// Writes packed frames for all primitives that have frames. This is the last edit of a run.
#pragma once

#include <span>

#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "tspace/generate.h"

namespace tspace::gltf {

/// Packs the current NORMAL and TANGENT of the document into the attributes of `options.pack`, and removes the
/// attributes that `options.pack_drop` selects. Primitives that share NORMAL and TANGENT share the packed attributes.
/// Fills frames_packed, packing, normals_dropped and tangents_dropped of the reports; a note gives the reason if
/// nothing is packed, or if an attribute is kept although it was to be removed. Packed attributes that already have
/// these bits are not rewritten.
void writePackedFrames(Editor& editor, const Document& document, const GenerateOptions& options,
                       std::span<PrimitiveReport> reports);

/// Adds notes about packed frames that are kept although the tangents of their primitive were recomputed.
void noteStalePackedFrames(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
