// SPDX-License-Identifier: MIT
// The functions of the codec that call the library, beside dracoMissing and decodeDraco. WebAssembly modules
// have others in their place (bindings/js/wasm).
#pragma once

#include "model/gltf/codecs/draco.h"

namespace tspace::gltf {

/// The fault of a Draco header as a sentence; empty when it is valid.
std::string dracoHeaderFault(std::span<const std::uint8_t> data);
/// Whether data with a valid header uses the Edgebreaker method; else it is sequential.
bool isEdgebreaker(std::span<const std::uint8_t> data);

/// Encodes points and triangles in their order, attributes by their rounding, and fills the ids. False when the library
/// cannot do it.
bool encodeDracoAsItIs(DracoMesh& mesh, Bytes& data);

}  // namespace tspace::gltf
