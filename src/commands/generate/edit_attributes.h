// SPDX-License-Identifier: MIT
// Edits of attributes and index lists: attributes set, removed and repaired, triangles turned.
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

inline constexpr std::ptrdiff_t kBase = -1;  ///< in place of a morph target: the attributes themselves

// Sets one attribute of the primitives that share it.

struct SharedAttribute {
    std::span<const Primitive> primitives = {};  ///< all of the document, as it was when `numbers` were chosen
    std::span<const std::size_t> numbers = {};   ///< the primitives that share the attribute, or lack it
    std::ptrdiff_t target = kBase;
    std::string name = {};
    /// Whether existing elements may stay, or be overwritten in place.
    bool may_stay = true;
    /// An accessor that only these primitives used, for an attribute that was removed: its entry is re-used.
    std::optional<std::size_t> spare = {};
};

/// Sets the attribute in all of `numbers`. Returns false when the document has exactly these bits already.
bool setAttribute(Editor& editor, const Document& document, const SharedAttribute& attribute, ElementData&& data);

/// The format of an accessor of floats, or of normalised signed integers.
VectorFormat unitFormatOf(const Accessor& accessor);

// Removes attributes: tangents that no material needs, and those that cannot be read.

/// True when the primitive or one of its morph targets has tangents that can be removed. They cannot where a morph
/// target has nothing else: an empty target is not valid, and removing it would renumber the weights.
bool canStripTangents(const Primitive& primitive);

/// Removes TANGENT from the primitives whose report says `removed`, and from their morph targets. Data without other
/// uses is freed.
void stripTangents(Editor& editor, std::span<const Primitive> primitives, std::span<const PrimitiveReport> reports);

/// Removes an attribute that cannot be read from the primitive or, unless `target` is kBase, from a morph target.
void removeUnreadable(Editor& editor, const Primitive& primitive, std::ptrdiff_t target, const std::string& name,
                      std::size_t accessor);

/// Repairs Primitive::attribute_faults as AttributeRepair says, but in primitives that no command can repair; reports each
/// repair in `warnings`. The model was edited then. Returns the primitives that lost their normals, one entry per primitive.
std::vector<bool> repairAttributes(Document& document, const std::string& new_file,
                                   std::span<const Primitive> primitives, std::vector<std::string>& warnings);

/// Removes the name of an attribute from a primitive and from its Draco extension. The accessor still counts as used.
void eraseAttribute(Editor& editor, const Primitive& primitive, const char* name);

// Turns triangles by their index lists. Attributes and morph targets stay as they are, so vertices keep their numbers.

/// New index lists for the primitives of which triangles are turned: triangles, also where there were strips, fans or no
/// lists. Primitives that draw the same triangles of the same vertices share a new list if they shared the old one.
///
/// new_file    as for Editor
/// primitives  those of the document, which are to be read anew afterwards
/// turned      of each primitive: one per triangle, 1 to turn it; or empty: none of them
void turnTriangles(Document& document, const std::string& new_file, std::span<const Primitive> primitives,
                   std::span<const std::vector<std::uint8_t>> turned);

/// Writes the normals that Primitive::normal_scales is about with length 1, and what morph targets add to them scaled alike.
/// Floats and normalised integers stay what they are, others become floats; all other normals keep their bits. Parameters as
/// for turnTriangles.
void writeUnitNormals(Document& document, const std::string& new_file, std::span<const Primitive> primitives);

}  // namespace tspace::gltf
