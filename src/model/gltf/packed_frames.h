// SPDX-License-Identifier: MIT
// Packed tangent frames in the primitives of a glTF file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/packed_layout.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// Attributes of one packing format.
struct StoredPacking {
    const PackedLayout* layout = nullptr;
    std::string attribute = {};  ///< the first attribute of the format, or the one that `fault` is about
    /// Reason why the attributes are not valid packed frames, as a clause about `attribute`; empty if they are valid.
    std::string fault = {};
};

/// Returns the formats for which the primitive has an attribute, in the order of FrameFormat.
std::vector<StoredPacking> findPacked(const Document& document, const Primitive& primitive);

/// Returns the first valid packed attribute of a primitive that lacks NORMAL or TANGENT, so that its packed frames are
/// its only frames. Returns an empty text for other primitives.
std::string packedAlone(const Document& document, const Primitive& primitive);

/// Returns the words, without padding, of a format without a fault. Fails like copyElements.
Bytes readPackedWords(const Document& document, const Primitive& primitive, const PackedLayout& layout);

/// Removes the attributes in Primitive::miscounted that packing as `pack` replaces; fails with invalidFile if there are
/// others. Returns whether the document changed.
bool removeMiscounted(Document& document, std::span<Primitive> primitives, std::optional<FrameFormat> pack);

}  // namespace tspace::gltf
