// SPDX-License-Identifier: MIT
// A model file in memory: its glTF document, and beside that what is made of it once, when it is first asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/gltf/decoded_arrays.h"
#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

/// Moving it leaves references to its document and primitives valid.
class Model {
  public:
    explicit Model(Document&& document);

    /// Whoever changes the document calls `wasEdited` before primitives, arrays or scenes are asked for again.
    [[nodiscard]] Document& document() { return *document_; }
    [[nodiscard]] DecodedArrays& arrays() { return *arrays_; }

    /// Like readPrimitives, cached.
    [[nodiscard]] std::vector<Primitive>& primitives();

    /// All primitives as a Scene, which stays, and so do its arrays, until dropScene. Copies of it share the arrays.
    [[nodiscard]] const Scene& scene();
    /// Returns a scene that the caller owns: all primitives, or only these.
    [[nodiscard]] Scene sceneOf();
    [[nodiscard]] Scene sceneOf(std::span<const std::size_t> numbers);
    void dropScene() { scene_.reset(); }

    /// The scene with looks and places, and `with_images` the bytes of those images that pictures show. The model does not
    /// keep it.
    [[nodiscard]] DrawnScene drawnScene(bool with_images);
    /// Like scene, with everything that materials use: the image bytes of base color, metalness and emission, and vertex
    /// colors.
    [[nodiscard]] DrawnScene materialScene(bool with_normal_maps);
    /// Returns the scene as posed by its nodes; `with_images`: with the bytes of all images and the vertex colors.
    [[nodiscard]] PosedScene posedScene(bool with_images);

    /// Primitives and scene are made anew when they are next asked for, and their old memory is free again.
    void wasEdited();

    /// Makes the model what a reader of its file would get: compressed geometry is decoded again, since Draco reorders and
    /// rounds vertices and meshopt turns triangles; the budget is that of a file of this size.
    void readAnew();

  private:
    std::unique_ptr<Document> document_;
    std::unique_ptr<DecodedArrays> arrays_;
    std::optional<std::vector<Primitive>> primitives_ = {};
    std::int64_t primitive_bytes_ = 0;  ///< bytes charged to the budget for the primitives
    std::optional<Scene> scene_ = {};
};

}  // namespace tspace::gltf
