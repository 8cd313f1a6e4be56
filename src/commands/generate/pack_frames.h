// SPDX-License-Identifier: MIT
// Writes packed frames for all primitives that have frames; the last edit of a run.
#pragma once

#include <span>

#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "tspace/generate.h"

namespace tspace::gltf {

/// Writes the attributes of `options.pack` from NORMAL and TANGENT as they are in the document now, and removes those
/// that `options.pack_drop` names. Primitives that share both share the packed attributes. Fills frames_packed, packing,
/// normals_dropped and tangents_dropped of the reports; a note says why where nothing is written, or where an attribute
/// stays although it was to be removed. Attributes that have these bits already stay as they are.
void writePackedFrames(Editor& editor, const Document& document, const GenerateOptions& options,
                       std::span<PrimitiveReport> reports);

/// Notes packed frames that stay although the tangents beside them were computed anew.
void noteStalePackedFrames(const Document& document, std::span<const Primitive> primitives,
                           const GenerateOptions& options, std::span<PrimitiveReport> reports);

}  // namespace tspace::gltf
