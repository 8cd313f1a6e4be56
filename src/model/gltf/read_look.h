// SPDX-License-Identifier: MIT
// How the primitives of a document look, and where its nodes put them.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/drawn_scene.h"

namespace tspace::gltf {

/// Of the primitive's own material. Fails with invalidFile.
SurfaceLook readLook(const Document& document, const Primitive& primitive);

/// Every primitive at each node of the file's scene that draws it: the scene that it names, else its first, else all
/// nodes. Where that draws nothing, all primitives without a transform. A mesh with a skin stands where the first joint
/// of the skin puts it, which is where all of them do in the pose that it was bound in. Nodes are taken once each,
/// whatever graph they make. Fails with invalidFile, and with tooLarge where the budget does not have the places.
std::vector<ScenePlacement> readPlacements(const Document& document, std::span<const Primitive> primitives);

/// Sets `places` of the scene's primitives, which are these, in this order. Nodes that cannot be read put nothing anywhere.
void tellPlaces(const Document& document, std::span<const Primitive> primitives, Scene& scene);

/// The images that these looks name.
std::set<std::size_t> imagesOf(std::span<const SurfaceLook> looks);

}  // namespace tspace::gltf
