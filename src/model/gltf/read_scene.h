// SPDX-License-Identifier: MIT
// A document, or a part of it, as a Scene.
#pragma once

#include <set>
#include <span>
#include <vector>

#include "model/gltf/decoded_arrays.h"
#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

// How the primitives of a document look, and where its nodes put them.

/// Reads the look of the primitive's own material. Fails with invalidFile.
SurfaceLook readLook(const Document& document, const Primitive& primitive);
/// Reads the rest of the look: metalness, roughness and emission. Fails with invalidFile.
void readMetalAndEmission(const Document& document, const Primitive& primitive, SurfaceLook& look);

/// Every primitive at each node that draws it, in the default scene, else the first scene, else all nodes. Where those
/// draw nothing: all primitives, without a transform. A skinned mesh stands where the first joint of its skin puts it,
/// which is exact in the bind pose. Each node is visited once, whatever the graph. Fails with invalidFile, and with
/// tooLarge where the budget does not suffice.
std::vector<ScenePlacement> readPlacements(const Document& document, std::span<const Primitive> primitives);

/// How the nodes pose the primitives at the places of readPlacements, in that order: by skins, and by weights of morph targets. `drawn`: of these
/// primitives. A skin that cannot be read moves nothing. Fails as readPlacements.
std::vector<ScenePose> readPoses(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                                 const DrawnScene& drawn);

/// Sets `places` of the scene's primitives, which must be these, in this order. Nodes that cannot be read draw nothing.
void tellPlaces(const Document& document, std::span<const Primitive> primitives, Scene& scene);

/// The images that these looks name and pictures show: base colours and normal maps.
std::set<std::size_t> imagesOf(std::span<const SurfaceLook> looks);
/// Images of base color, metalness and emission.
std::set<std::size_t> materialImagesOf(std::span<const SurfaceLook> looks);

/// These primitives, in their order, and what the file says of itself; names of images, but no bytes. `arrays`: of
/// the document.
Scene sceneOf(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives);

/// Reads the bytes of the images that the scene's primitives use for tangents. One that cannot be read stays empty.
void readImages(const Document& document, Scene& scene);
/// Reads the bytes of these images.
void readImages(const Document& document, const std::set<std::size_t>& wanted, Scene& scene);

/// The image file of entry `image` of /images; empty where it cannot be had.
Bytes tryReadImage(const Document& document, std::size_t image);

}  // namespace tspace::gltf
