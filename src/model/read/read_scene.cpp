// SPDX-License-Identifier: MIT
// Chooses the reader by the name of the file.
#include "model/read/read_scene.h"

#include <utility>

#include "model/gltf/model.h"
#include "model/gltf/read_look.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/obj/obj_reader.h"
#include "model/obj/read_scene.h"
#include "model/read/load_document.h"

namespace tspace {

namespace {

gltf::Model readModel(const std::string& input, const FileOptions& options) {
    gltf::Document document = gltf::loadDocument(input, options);
    gltf::checkRequiredExtensions(document);
    return gltf::Model(std::move(document));
}

}  // namespace

Scene readScene(const std::string& input, const FileOptions& options, bool with_images) {
    // An OBJ file has no magic word, so only its name tells it.
    if (lowerExtension(input) == ".obj") {
        const obj::Model model = obj::readModel(input, options);
        return obj::sceneOf(model, obj::collectPrimitives(model), with_images);
    }
    gltf::Model model = readModel(input, options);
    Scene scene = model.sceneOf();
    if (with_images) {
        gltf::readImages(model.document(), scene);
        gltf::tellPlaces(model.document(), model.primitives(), scene);
    }
    return scene;
}

DrawnScene readDrawnScene(const std::string& input, const FileOptions& options, bool with_images) {
    if (lowerExtension(input) == ".obj") {
        obj::Model model = obj::readModel(input, options);
        std::vector<obj::ObjPrimitive> primitives = obj::collectPrimitives(model);
        valueOrThrow(obj::completeNormals(model, primitives, {}));
        return obj::drawnSceneOf(model, primitives, with_images);
    }
    return readModel(input, options).drawnScene(with_images);
}

}  // namespace tspace
