// SPDX-License-Identifier: MIT
// What of the codec is the library's, beside meshoptMissing and decodeMeshopt: bindings have others in its place.
#pragma once

#include "model/gltf/codecs/meshopt.h"

namespace tspace::gltf {

/// Encodes rows in the mode that `coding` says. Empty when the library cannot do it.
Bytes encodeAsItIs(const MeshoptCoding& coding, std::span<const std::uint8_t> rows);

}  // namespace tspace::gltf
