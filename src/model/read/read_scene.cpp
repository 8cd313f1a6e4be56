// SPDX-License-Identifier: MIT
// Reading of model files of any format.
#include "model/read/read_scene.h"

#include <utility>

#include "model/gltf/load_document.h"
#include "model/gltf/read_scene.h"
#include "model/imported/import_document.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/obj/obj_primitives.h"

namespace tspace::gltf {

// Chooses between the caller's bytes, the importer and the file.

Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution,
                      const Progress& progress) {
    if (options.content.data() != nullptr)
        return parseDocument(Bytes(options.content.begin(), options.content.end()), path, options);
    if (isImportedFormat(path)) return importDocument(path, options, progress);
    return parseDocument(readFile(path, {}, execution), path, options);
}

}  // namespace tspace::gltf

namespace tspace {
namespace {

using AnyModel = std::variant<gltf::Model, obj::Model>;

AnyModel read(const std::string& input, const FileOptions& options, const Execution& execution,
              const Progress& progress) {
    if (lowerExtension(input) == ".obj") return obj::readModel(input, options);
    gltf::Document document = gltf::loadDocument(input, options, execution, progress);
    gltf::checkRequiredExtensions(document);
    return gltf::Model(std::move(document));
}

std::shared_ptr<MemoryBudget> memoryOf(AnyModel& model) {
    if (gltf::Model* const gltf = std::get_if<gltf::Model>(&model)) return gltf->document().memory;
    return std::get<obj::Model>(model).memory;
}

}  // namespace

ModelFile::ModelFile(const std::string& input, const FileOptions& options, const Execution& execution,
                     const Progress& progress)
    : model_(read(input, options, execution, progress)), memory_(memoryOf(model_)), left_(memory_->left()) {}

ModelFile::ModelFile(gltf::Model&& model)
    : model_(std::move(model)), memory_(memoryOf(model_)), left_(memory_->left()) {}

gltf::Model& ModelFile::gltf() {
    startAnew();
    return std::get<gltf::Model>(model_);
}

obj::Model& ModelFile::obj() {
    startAnew();
    return std::get<obj::Model>(model_);
}

void ModelFile::startAnew() {
    if (gltf::Model* const model = std::get_if<gltf::Model>(&model_)) model->wasEdited();
    memory_->restore(left_);
}

Scene ModelFile::scene(bool with_images) {
    if (isObj()) return obj::sceneOf(obj(), obj::collectPrimitives(obj()), with_images);
    gltf::Model& model = gltf();
    Scene scene = model.sceneOf();
    if (with_images) {
        gltf::readImages(model.document(), scene, true);
        gltf::setPlaces(model.document(), model.primitives(), scene);
    }
    return scene;
}

DrawnScene ModelFile::drawnObj(bool with_images) {
    obj::Model model = obj();  // a copy, to which normals are added
    std::vector<obj::ObjPrimitive> primitives = obj::collectPrimitives(model);
    valueOrThrow(obj::completeNormals(model, primitives, {}));
    return obj::drawnSceneOf(model, primitives, with_images);
}

DrawnScene ModelFile::drawnScene(bool with_images) {
    return isObj() ? drawnObj(with_images) : gltf().drawnScene(with_images);
}

DrawnScene ModelFile::materialScene(bool with_normal_maps) {
    return isObj() ? drawnObj(true) : gltf().materialScene(with_normal_maps);
}

PosedScene ModelFile::posedScene(bool with_images) {
    if (!isObj()) return gltf().posedScene(with_images);
    PosedScene posed{.drawn = drawnObj(with_images)};
    posed.poses.resize(posed.drawn.placements.size());
    return posed;
}

Scene readScene(const std::string& input, const FileOptions& options, bool with_images) {
    return ModelFile(input, options).scene(with_images);
}

DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images) {
    return ModelFile(input, options).drawnScene(with_images);
}

PosedScene readPosedScene(const std::string& input, const FileOptions& options, bool with_images) {
    return ModelFile(input, options).posedScene(with_images);
}

}  // namespace tspace
