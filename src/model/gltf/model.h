// SPDX-License-Identifier: MIT
// Model file in memory: its glTF document, and derived data that is computed on first use.
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

/// Moving a Model keeps references to its document and primitives valid.
class Model {
  public:
    explicit Model(Document&& document);

    /// After changing the document, callers must call `wasEdited` before they use primitives, arrays or scenes again.
    [[nodiscard]] Document& document() { return *document_; }
    [[nodiscard]] DecodedArrays& arrays() { return *arrays_; }

    /// Returns the primitives of the document; they are read once and cached.
    [[nodiscard]] std::vector<Primitive>& primitives();

    /// Returns all primitives as a Scene. It and its arrays stay valid until dropScene(); copies share the arrays.
    [[nodiscard]] const Scene& scene();
    /// Returns a scene that the caller owns, with all primitives or only the given ones.
    [[nodiscard]] Scene sceneOf();
    [[nodiscard]] Scene sceneOf(std::span<const std::size_t> numbers);
    void dropScene() { scene_.reset(); }

    /// Returns the scene with surface looks and placements; `with_images`: with the bytes of the images that pictures
    /// show. The model does not keep the scene.
    [[nodiscard]] DrawnScene drawnScene(bool with_images);
    /// Returns the scene with the inputs of complete materials: image bytes of base color, metalness and emission, and
    /// vertex colors. `with_normal_maps`: also image bytes of normal maps.
    [[nodiscard]] DrawnScene materialScene(bool with_normal_maps);
    /// Returns the scene as posed by its nodes; `with_images`: with the bytes of all images and the vertex colors.
    [[nodiscard]] PosedScene posedScene(bool with_images);

    /// Invalidates primitives and scene, which are read again on next use, and frees their memory.
    void wasEdited();

    /// Makes the model equal to the result of reading its file: compressed geometry is decoded again, since Draco
    /// reorders and rounds vertices and meshopt rotates triangles; the budget is that of a file of this size.
    void reload();

  private:
    std::unique_ptr<Document> document_;
    std::unique_ptr<DecodedArrays> arrays_;
    std::optional<std::vector<Primitive>> primitives_ = {};
    std::int64_t primitive_bytes_ = 0;  ///< bytes charged to the budget for the primitives
    std::optional<Scene> scene_ = {};
};

}  // namespace tspace::gltf
