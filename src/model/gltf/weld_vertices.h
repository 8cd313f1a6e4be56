// SPDX-License-Identifier: MIT
// Finds vertices that differ in their frames alone.
#pragma once

#include <cstdint>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

struct WeldedVertices {
    std::vector<std::uint32_t> kept = {};       ///< the first vertex of each class of equal ones, ascending
    std::vector<std::uint32_t> number_of = {};  ///< per vertex: its index in `kept`
};

/// Vertices are equal where all attributes are, those of morph targets too, except NORMAL, TANGENT, _BITANGENT and packed
/// frames. Floats are compared by bits, with -0 equal to 0. Primitives with CESIUM_primitive_outline, whose lists name
/// vertices, keep all. Linear.
WeldedVertices weldVertices(const Document& document, const Primitive& primitive);

}  // namespace tspace::gltf
