// SPDX-License-Identifier: MIT
// The functions of the codec that call the library, beside meshoptMissing and decodeMeshopt. WebAssembly modules have
// others in their place (bindings/js/wasm).
#pragma once

#include "model/gltf/codecs/meshopt.h"

namespace tspace::gltf {

/// Encodes rows in the mode that `coding` says. Empty when the library cannot do it.
Bytes encodeAsItIs(const MeshoptCoding& coding, std::span<const std::uint8_t> rows);

}  // namespace tspace::gltf
