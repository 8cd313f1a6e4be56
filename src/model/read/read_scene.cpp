// SPDX-License-Identifier: MIT
// Chooses the reader by the name of the file.
#include "model/read/read_scene.h"

#include "model/gltf/primitive_reader.h"
#include "model/gltf/read_look.h"
#include "model/gltf/read_scene.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/obj/obj_reader.h"
#include "model/obj/read_scene.h"
#include "model/read/load_document.h"

namespace tspace {

Scene readScene(const std::string& input, const FileOptions& options, bool with_images) {
    // An OBJ file has no magic word, so only its name tells it.
    if (lowerExtension(input) == ".obj") {
        const obj::Model model = obj::readModel(input, options);
        return obj::sceneOf(model, obj::collectPrimitives(model), with_images);
    }
    gltf::Document document = gltf::loadDocument(input, options);
    gltf::checkRequiredExtensions(document);
    const std::vector<gltf::Primitive> primitives = gltf::readPrimitives(document);
    Scene scene = gltf::sceneOf(document, primitives);
    if (with_images) {
        gltf::readImages(document, scene);
        gltf::tellPlaces(document, primitives, scene);
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
    gltf::Document document = gltf::loadDocument(input, options);
    gltf::checkRequiredExtensions(document);
    const std::vector<gltf::Primitive> primitives = gltf::readPrimitives(document);
    DrawnScene drawn{.scene = gltf::sceneOf(document, primitives)};
    for (const gltf::Primitive& primitive : primitives) drawn.looks.push_back(gltf::readLook(document, primitive));
    drawn.placements = gltf::readPlacements(document, primitives);
    if (with_images) gltf::readImages(document, gltf::imagesOf(drawn.looks), drawn.scene);
    return drawn;
}

}  // namespace tspace
