// SPDX-License-Identifier: MIT
// Edits attributes and index lists: sets, removes and repairs attributes, and flips triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "tspace/generate.h"
#include "tspace/pack.h"

namespace tspace::gltf {

/// Index that selects the attributes of the primitive, instead of those of a morph target.
inline constexpr std::ptrdiff_t kBase = -1;

// Sets one attribute of the primitives that share it.

struct SharedAttribute {
    std::span<const Primitive> primitives = {};  ///< all primitives of the document, as read when `numbers` were chosen
    std::span<const std::size_t> numbers = {};   ///< indices of the primitives that share the attribute, or lack it
    std::ptrdiff_t target = kBase;
    std::string name = {};
    /// Existing elements may be kept, or overwritten in place.
    bool may_reuse = true;
    /// Accessor of a removed attribute that only these primitives used; its entry is reused.
    std::optional<std::size_t> spare = {};
};

/// Sets the attribute in all primitives `numbers`. Returns false if the document already has exactly these bits.
bool setAttribute(Editor& editor, const Document& document, const SharedAttribute& attribute, ElementData&& data);

/// Returns the format of an accessor of floats or of normalized signed integers.
VectorFormat unitFormatOf(const Accessor& accessor);

// Removes attributes: tangents that no material needs, and attributes that cannot be read.

/// Returns true if the primitive or one of its morph targets has tangents that can be removed. Tangents cannot be
/// removed if a morph target has no other attribute: an empty target is invalid, and removing the target would renumber
/// the weights.
bool canStripTangents(const Primitive& primitive);

/// Removes TANGENT from the primitives whose action is `removed`, and from their morph targets. Frees data without
/// other uses.
void stripTangents(Editor& editor, std::span<const Primitive> primitives, std::span<const PrimitiveReport> reports);

/// Removes an attribute that cannot be read from the primitive, or from a morph target if `target` is not kBase.
void removeUnreadable(Editor& editor, const Primitive& primitive, std::ptrdiff_t target, const std::string& name,
                      std::size_t accessor);

/// Repairs Primitive::attribute_faults of the chosen primitives as AttributeRepair specifies. Adds a warning for each
/// repair. Read the primitives again afterwards. Returns which primitives lost their normals. `chosen` and the result
/// have one entry per primitive.
std::vector<bool> repairAttributes(Document& document, const std::string& new_file,
                                   std::span<const Primitive> primitives, const std::vector<bool>& chosen,
                                   std::vector<std::string>& warnings);

/// Removes the name of an attribute from a primitive and from its Draco extension. The accessor still counts as used.
void eraseAttribute(Editor& editor, const Primitive& primitive, const char* name);

// Flips triangles in their index lists. Attributes and morph targets are unchanged, so vertices keep their numbers.

/// Writes new index lists for the primitives with flipped triangles. The new lists are triangle lists, also for strips,
/// fans and primitives without indices. Primitives that draw the same triangles of the same vertices share a new list
/// if they shared the old one.
///
/// new_file    name of the buffer file for new data, see Editor (model/gltf/editor.h)
/// primitives  primitives of the document; read them again afterwards
/// flipped     per primitive: one entry per triangle, 1 to flip it; or empty: no triangle is flipped
void flipTriangles(Document& document, const std::string& new_file, std::span<const Primitive> primitives,
                   std::span<const std::vector<std::uint8_t>> flipped);

/// Returns whether normals need to be scaled to length 1 and can be. Scaled unsigned normals would still have wrong
/// directions, and their lengths would no longer reveal it.
bool canScaleNormals(const Document& document, const Primitive& primitive);

/// Scales normals to length 1 in the primitives for which canScaleNormals returns true, and scales the offsets of morph
/// targets accordingly. Floats and normalized signed integers keep their format, other formats become floats; normals
/// that have unit length keep their bits. Parameters as for flipTriangles.
void writeUnitNormals(Document& document, const std::string& new_file, std::span<const Primitive> primitives);

}  // namespace tspace::gltf
