// SPDX-License-Identifier: MIT
// Reads model files of any format.
#include "model/read/read_scene.h"

#include <utility>

#include "model/gltf/load_document.h"
#include "model/gltf/model.h"
#include "model/gltf/read_scene.h"
#include "model/imported/import_document.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/obj/obj_primitives.h"
#include "model/obj/obj_reader.h"

namespace tspace::gltf {

// Selection of the source: the caller's bytes, the importer, or the file.

Document loadDocument(const Path& path, const FileOptions& options, const Execution& execution,
                      const Progress& progress) {
    if (options.content.data() != nullptr)
        return parseDocument(Bytes(options.content.begin(), options.content.end()), path, options);
    if (isImportedFormat(path)) return importDocument(path, options, progress);
    return parseDocument(readFile(path, {}, execution), path, options);
}

}  // namespace tspace::gltf

namespace tspace {

// Selection of the reader by the file name.

namespace {

gltf::Model readModel(const std::string& input, const FileOptions& options) {
    gltf::Document document = gltf::loadDocument(input, options);
    gltf::checkRequiredExtensions(document);
    return gltf::Model(std::move(document));
}

}  // namespace

Scene readScene(const std::string& input, const FileOptions& options, bool with_images) {
    // An OBJ file has no magic number, so it is recognized by its name only.
    if (lowerExtension(input) == ".obj") {
        const obj::Model model = obj::readModel(input, options);
        return obj::sceneOf(model, obj::collectPrimitives(model), with_images);
    }
    gltf::Model model = readModel(input, options);
    Scene scene = model.sceneOf();
    if (with_images) {
        gltf::readImages(model.document(), scene);
        gltf::setPlaces(model.document(), model.primitives(), scene);
    }
    return scene;
}

namespace {

DrawnScene readObjScene(const std::string& input, const FileOptions& options, bool with_images) {
    obj::Model model = obj::readModel(input, options);
    std::vector<obj::ObjPrimitive> primitives = obj::collectPrimitives(model);
    valueOrThrow(obj::completeNormals(model, primitives, {}));
    return obj::drawnSceneOf(model, primitives, with_images);
}

}  // namespace

DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images) {
    if (lowerExtension(input) == ".obj") return readObjScene(input, options, with_images);
    return readModel(input, options).drawnScene(with_images);
}

DrawnScene readMaterialScene(const std::string& input, const FileOptions& options, bool with_normal_maps) {
    if (lowerExtension(input) == ".obj") return readObjScene(input, options, true);
    return readModel(input, options).materialScene(with_normal_maps);
}

PosedScene readPosedScene(const std::string& input, const FileOptions& options, bool with_images) {
    if (lowerExtension(input) != ".obj") return readModel(input, options).posedScene(with_images);
    PosedScene posed{.drawn = readObjScene(input, options, with_images)};
    posed.poses.resize(posed.drawn.placements.size());
    return posed;
}

}  // namespace tspace
