// SPDX-License-Identifier: MIT
// Packed tangent frames that the primitives of a glTF file have.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/packed_layout.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// Attributes of one format.
struct StoredPacking {
    const PackedLayout* layout = nullptr;
    std::string attribute = {};  ///< the first of them, or the one that `fault` is about
    /// Why they are not valid packed frames, half a sentence about `attribute`; empty when they are.
    std::string fault = {};
};

/// The formats of which the primitive has an attribute, in the order of FrameFormat.
std::vector<StoredPacking> findPacked(const Document& document, const Primitive& primitive);

/// The attribute with the primitive's only frames: packed ones without valid NORMAL and TANGENT beside them. Empty when
/// the primitive has others, or none.
std::string packedAlone(const Document& document, const Primitive& primitive);

/// The words, without padding, of a format without fault. Fails as copyElements.
Bytes readPackedWords(const Document& document, const Primitive& primitive, const PackedLayout& layout);

/// Removes the attributes in Primitive::miscounted that packing as `pack` makes anew; fails with invalidFile where there
/// are others. Returns whether the document changed.
bool removeMiscounted(Document& document, std::span<Primitive> primitives, std::optional<FrameFormat> pack);

}  // namespace tspace::gltf
