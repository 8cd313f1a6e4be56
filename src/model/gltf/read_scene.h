// SPDX-License-Identifier: MIT
// A document, or a part of it, as a Scene.
#pragma once

#include <set>
#include <span>

#include "model/gltf/decoded_arrays.h"
#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

/// These primitives, in their order, and what the file says of itself; names of images, but no bytes. `arrays`: of
/// the document.
Scene sceneOf(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives);

/// Reads the bytes of the images that the scene's primitives use for tangents. One that cannot be read stays empty.
void readImages(const Document& document, Scene& scene);
/// The same of these images.
void readImages(const Document& document, const std::set<std::size_t>& wanted, Scene& scene);

/// The image file of entry `image` of /images; empty where it cannot be had.
Bytes tryReadImage(const Document& document, std::size_t image);

}  // namespace tspace::gltf
