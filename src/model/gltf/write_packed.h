// SPDX-License-Identifier: MIT
// Packed frames of all primitives that have frames, when everything else is done.
#pragma once

#include <span>

#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "tspace/asset.h"

namespace tspace::gltf {

/// Writes the attributes of `options.pack` from NORMAL and TANGENT as the document has them now, and takes those away
/// that `options.pack_drop` names. Primitives that share both share the packed attributes. Fills frames_packed, packing,
/// normals_dropped and tangents_dropped of the reports; where nothing is written, or something stays that was to go, a
/// note says why. Attributes that have these bits already stay as they are.
void writePackedFrames(Editor& editor, const Document& document, const GenerateOptions& options,
                       std::span<PrimitiveReport> reports);

/// Notes which packed frames stay what they were while the tangents beside them were made anew.
void noteStalePackedFrames(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
