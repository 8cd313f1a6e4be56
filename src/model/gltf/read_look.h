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

/// Every primitive at each node that draws it, in the default scene, else the first scene, else all nodes. Where those
/// draw nothing: all primitives, without a transform. A skinned mesh stands where the first joint of its skin puts it,
/// which is exact in the bind pose. Each node is visited once, whatever the graph. Fails with invalidFile, and with
/// tooLarge where the budget does not suffice.
std::vector<ScenePlacement> readPlacements(const Document& document, std::span<const Primitive> primitives);

/// Sets `places` of the scene's primitives, which must be these, in this order. Nodes that cannot be read draw nothing.
void tellPlaces(const Document& document, std::span<const Primitive> primitives, Scene& scene);

/// The images that these looks name.
std::set<std::size_t> imagesOf(std::span<const SurfaceLook> looks);

}  // namespace tspace::gltf
