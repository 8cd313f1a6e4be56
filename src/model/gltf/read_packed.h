// SPDX-License-Identifier: MIT
// Packed frames that a primitive has.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/packed_layout.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// Attributes of one format.
struct StoredPacking {
    const PackedLayout* layout = nullptr;
    std::string attribute = {};  ///< the first of them, or the one that `fault` is about
    /// Why they are no packed frames, half a sentence about `attribute`; empty: they are.
    std::string fault = {};
};

/// The formats of which the primitive has an attribute, in the order of FrameFormat.
std::vector<StoredPacking> findPacked(const Document& document, const Primitive& primitive);

/// The attribute whose packed frames are the only ones that the primitive has: there are no fit NORMAL and TANGENT beside
/// them. Empty: it has others, or none.
std::string packedAlone(const Document& document, const Primitive& primitive);

/// The words, without padding, of a format without fault. Fails as copyElements.
Bytes readPackedWords(const Document& document, const Primitive& primitive, const PackedLayout& layout);

/// Takes Primitive::miscounted out of the document where packing in `pack` makes them anew, and fails with invalidFile
/// where there are others. Returns whether the document changed.
bool removeMiscounted(Document& document, std::span<Primitive> primitives, std::optional<FrameFormat> pack);

}  // namespace tspace::gltf
