// SPDX-License-Identifier: MIT
// Vertices that only their frames keep apart.
#pragma once

#include <cstdint>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

struct WeldedVertices {
    std::vector<std::uint32_t> kept = {};       ///< the first vertex of each, ascending
    std::vector<std::uint32_t> number_of = {};  ///< per vertex: which of them it becomes
};

/// Vertices are one where all attributes are equal, those of morph targets too, but for NORMAL, TANGENT, _BITANGENT and
/// packed frames. Floats are compared by their bits, but -0 equals 0. Primitives with CESIUM_primitive_outline, whose lists
/// name vertices, keep all. Linear.
WeldedVertices weldVertices(const Document& document, const Primitive& primitive);

}  // namespace tspace::gltf
