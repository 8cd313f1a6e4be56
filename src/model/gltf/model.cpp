// SPDX-License-Identifier: MIT
#include "model/gltf/model.h"

#include <utility>

#include "model/gltf/draco_primitives.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/read_look.h"
#include "model/gltf/read_scene.h"

namespace tspace::gltf {

Model::Model(Document&& document)
    : document_(std::make_unique<Document>(std::move(document))),
      arrays_(std::make_unique<DecodedArrays>(*document_)) {}

std::vector<Primitive>& Model::primitives() {
    if (!primitives_) {
        const std::int64_t left = document_->memory->left();
        primitives_ = readPrimitives(*document_);
        primitive_bytes_ = left - document_->memory->left();
    }
    return *primitives_;
}

const Scene& Model::scene() {
    if (!scene_) scene_ = sceneOf();
    return *scene_;
}

Scene Model::sceneOf() { return scene_ ? *scene_ : gltf::sceneOf(*document_, *arrays_, primitives()); }

Scene Model::sceneOf(std::span<const std::size_t> numbers) {
    std::vector<Primitive> chosen;
    for (const std::size_t number : numbers) chosen.push_back(primitives()[number]);
    return gltf::sceneOf(*document_, *arrays_, chosen);
}

DrawnScene Model::drawnScene(bool with_images) {
    DrawnScene drawn{.scene = sceneOf()};
    for (const Primitive& primitive : primitives()) drawn.looks.push_back(readLook(*document_, primitive));
    drawn.placements = readPlacements(*document_, primitives());
    if (with_images) readImages(*document_, imagesOf(drawn.looks), drawn.scene);
    return drawn;
}

void Model::wasEdited() {
    dropScene();
    arrays_->forget();
    if (primitives_) document_->memory->release(static_cast<std::uint64_t>(primitive_bytes_));
    primitives_.reset();
}

void Model::readAnew() {
    wasEdited();
    Document& document = *document_;
    std::uint64_t stored = 0;
    for (const Buffer& buffer : document.buffers) {
        if (buffer.hasStoredBytes()) stored += buffer.bytes.size();
    }
    document.memory = std::make_shared<MemoryBudget>(document.options.memory_limit_bytes);
    // Its JSON is not written yet, and is about as long as what was read.
    document.memory->allow(stored + document.input_bytes);
    document.memory->take(stored, {});
    for (Buffer& buffer : document.buffers) {
        if (buffer.source != BufferSource::decoded) continue;
        buffer.source = BufferSource::absent;
        buffer.bytes = {};
    }
    document.imported = document.may_hide_tangents = false;
    document.warnings.clear();
    checkRequiredExtensions(document);
    document.views_without_data.clear();
    document.elements.clear();
    document.draco_roundings.clear();
    decodeMeshoptViews(document);
    decodeDracoPrimitives(document);
}

}  // namespace tspace::gltf
