// SPDX-License-Identifier: MIT
// What of the codec is the library's, beside dracoMissing and decodeDraco: bindings have others in its place.
#pragma once

#include "model/gltf/codecs/draco.h"

namespace tspace::gltf {

/// What is wrong with the head of Draco data; empty when nothing is.
std::string dracoHeaderFault(std::span<const std::uint8_t> data);
/// The method of data whose head is right: this one, or the sequential one.
bool isEdgebreaker(std::span<const std::uint8_t> data);

/// Encodes points and triangles in their order, attributes by their rounding, and fills the ids. False when the library
/// cannot do it.
bool encodeDracoAsItIs(DracoMesh& mesh, Bytes& data);

}  // namespace tspace::gltf
