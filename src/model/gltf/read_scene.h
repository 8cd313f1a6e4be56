// SPDX-License-Identifier: MIT
// Conversion of a document, or a part of it, to a Scene.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "model/gltf/decoded_arrays.h"
#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

// Looks (material data) of a document's primitives, and their placements in the scene by its nodes.

/// Reads the look of the primitive's own material. Fails with invalidFile.
SurfaceLook readLook(const Document& document, const Primitive& primitive);
/// Reads the rest of the look: metalness, roughness and emission. Fails with invalidFile.
void readMetalAndEmission(const Document& document, const Primitive& primitive, SurfaceLook& look);

/// Returns every primitive at each node that draws it, in the default scene, otherwise the first scene, otherwise all
/// nodes. If these nodes draw nothing: all primitives, without a transform. A skinned mesh is placed by the first joint
/// of its skin, which is exact in the bind pose. Each node is visited once, even if the graph has cycles. Fails with
/// invalidFile, and with tooLarge if the budget does not suffice.
std::vector<ScenePlacement> readPlacements(const Document& document, std::span<const Primitive> primitives);

/// Returns how the nodes pose the primitives for each placement of readPlacements, in that order: by skins, and by
/// weights of morph targets. `drawn`: the scene of these primitives. A skin that cannot be read is ignored. Fails like
/// readPlacements.
std::vector<ScenePose> readPoses(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                                 const DrawnScene& drawn);

/// Sets `places` of the scene's primitives. `primitives` must list the same primitives in the same order. Nodes that
/// cannot be read are skipped.
void setPlaces(const Document& document, std::span<const Primitive> primitives, Scene& scene);

/// Returns the images that these looks reference and pictures show: base colors and normal maps.
std::set<std::size_t> imagesOf(std::span<const SurfaceLook> looks);
/// Returns the images of base color, metalness and emission.
std::set<std::size_t> materialImagesOf(std::span<const SurfaceLook> looks);

/// Returns a scene of the given primitives, in their order, with the file's metadata and image names, but without image
/// bytes. `arrays`: decoded arrays of the document.
Scene sceneOf(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives);

/// Reads the bytes of the images that the scene's primitives use for tangents. An image that cannot be read stays
/// empty. `with_unknown_maps`: also reads the images of ScenePrimitive::unknown_maps.
void readImages(const Document& document, Scene& scene, bool with_unknown_maps = false);
/// Reads the bytes of these images.
void readImages(const Document& document, const std::set<std::size_t>& wanted, Scene& scene);

/// Returns the image file of entry `image` of /images; empty if it cannot be read.
Bytes tryReadImage(const Document& document, std::size_t image);

}  // namespace tspace::gltf
