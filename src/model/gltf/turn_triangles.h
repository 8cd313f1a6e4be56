// SPDX-License-Identifier: MIT
// Turns triangles by their index lists. Attributes and morph targets stay as they are, so vertices keep their numbers.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"

namespace tspace::gltf {

/// New index lists for the primitives of which triangles are turned: triangles, also where there were strips, fans or no
/// lists. Primitives that draw the same triangles of the same vertices share a new list if they shared the old one.
///
/// new_file    as for Editor
/// primitives  those of the document, which are to be read anew afterwards
/// turned      of each primitive: one per triangle, 1 to turn it; or empty: none of them
void turnTriangles(Document& document, const std::string& new_file, std::span<const Primitive> primitives,
                   std::span<const std::vector<std::uint8_t>> turned);

}  // namespace tspace::gltf
