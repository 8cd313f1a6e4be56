// SPDX-License-Identifier: MIT
// Reading of model files of any format.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>

#include "model/gltf/document.h"
#include "model/gltf/model.h"
#include "model/io/memory_budget.h"
#include "model/io/path.h"
#include "model/obj/obj_reader.h"
#include "model/scene/scene.h"
#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/generate.h"
#include "tspace/mesh.h"

namespace tspace::gltf {

// Models as glTF documents: glTF itself, and the importer's result for other formats.

/// Reads the file, or FileOptions::content, like parseDocument. `progress` is called while the importer reads a file of
/// another format. Throws FileError.
Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution = {.thread_count = 1},
                      const Progress& progress = {});

}  // namespace tspace::gltf

namespace tspace {

// Conversion of any model file to a Scene.

/// A model file of any format, read once for several scenes. Each scene is computed with the whole memory budget of the
/// file, and independent of earlier ones. Functions throw FileError.
class ModelFile {
  public:
    /// Reads a model. An OBJ file has no magic number, so it is recognized by its name only. `progress` is called while
    /// the importer reads a file of another format.
    ModelFile(const std::string& input, const FileOptions& options, const Execution& execution = {.thread_count = 1},
              const Progress& progress = {});
    explicit ModelFile(gltf::Model&& model);

    /// Returns the primitives; `with_images`: also the image bytes of every TangentUse; an unreadable image is not an
    /// error. Fails with tooLarge if the arrays of a small file are far larger than the file.
    [[nodiscard]] Scene scene(bool with_images);
    /// Returns the scene with placements and looks; `with_images`: also the bytes of images that pictures need. Faces
    /// of an OBJ file that have no normals get the normals that generateFile computes.
    [[nodiscard]] DrawnScene drawnScene(bool with_images);
    /// Returns the result of drawnScene, with everything that materials use: images of base color, metalness and
    /// emission, and vertex colors as stored. `with_normal_maps`: normal maps too. OBJ has only base color images.
    [[nodiscard]] DrawnScene materialScene(bool with_normal_maps);
    /// Returns the result of drawnScene, with all textures of materials, and with the pose stored in the file.
    [[nodiscard]] PosedScene posedScene(bool with_images);

    [[nodiscard]] bool isObj() const { return std::holds_alternative<obj::Model>(model_); }
    /// Returns the model for changes, after which the object must not be used.
    [[nodiscard]] gltf::Model& gltf();
    [[nodiscard]] obj::Model& obj();

  private:
    /// Frees the arrays that earlier calls decoded, and restores the budget.
    void startAnew();
    [[nodiscard]] DrawnScene drawnObj(bool with_images);

    std::variant<gltf::Model, obj::Model> model_;
    std::shared_ptr<MemoryBudget> memory_;
    std::int64_t left_ = 0;  ///< bytes that the budget had left after reading
};

// Return one scene of a model file, like the functions scene, drawnScene and posedScene of ModelFile.

Scene readScene(const std::string& input, const FileOptions& options, bool with_images);
DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images);
PosedScene readPosedScene(const std::string& input, const FileOptions& options, bool with_images);

}  // namespace tspace
