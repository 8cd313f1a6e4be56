// SPDX-License-Identifier: MIT
#include "model/gltf/model.h"

#include <utility>

#include "model/gltf/accessor.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/load_document.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/read_scene.h"

namespace tspace::gltf {

Model::Model(Document&& document)
    : document_(std::make_unique<Document>(std::move(document))), arrays_(std::make_unique<DecodedArrays>(*document_)) {
}

std::vector<Primitive>& Model::primitives() {
    if (!primitives_) {
        const std::int64_t left = document_->memory->left();
        primitives_ = readPrimitives(*document_);
        primitive_bytes_ = left - document_->memory->left();
        warnOfNormals(*document_, *primitives_);
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

namespace {

/// Returns COLOR_0 of each primitive; empty for primitives without it.
std::vector<SharedArray<Vec4>> colorsOf(const Document& document, DecodedArrays& arrays,
                                        std::span<const Primitive> primitives) {
    std::vector<SharedArray<Vec4>> all(primitives.size());
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const auto accessor = primitives[i].find("COLOR_0");
        if (!accessor || primitives[i].vertex_count == 0) continue;
        const std::string place = join(join(primitives[i].place(), "attributes"), "COLOR_0");
        if (readAccessor(document, *accessor).component_count == 4) {
            all[i] = arrays.vec4(*accessor, place);
            continue;
        }
        const SharedArray<Vec3> opaque = arrays.vec3(*accessor, place);
        document.memory->take(opaque.size() * sizeof(Vec4), place);
        std::vector<Vec4> values;
        for (const Vec3& color : opaque) values.push_back({color.x, color.y, color.z, 1});
        all[i] = SharedArray<Vec4>(std::move(values));
    }
    return all;
}

}  // namespace

DrawnScene Model::materialScene(bool with_normal_maps) {
    DrawnScene drawn = drawnScene(false);
    for (std::size_t i = 0; i < drawn.looks.size(); ++i)
        readMetalAndEmission(*document_, primitives()[i], drawn.looks[i]);
    std::set<std::size_t> images = materialImagesOf(drawn.looks);
    if (with_normal_maps) images.merge(imagesOf(drawn.looks));
    readImages(*document_, images, drawn.scene);
    drawn.colors = colorsOf(*document_, *arrays_, primitives());
    return drawn;
}

PosedScene Model::posedScene(bool with_images) {
    PosedScene posed{.drawn = drawnScene(with_images)};
    if (with_images) posed.drawn.colors = colorsOf(*document_, *arrays_, primitives());
    posed.poses = readPoses(*document_, *arrays_, primitives(), posed.drawn);
    return posed;
}

void Model::wasEdited() {
    dropScene();
    arrays_->forget();
    if (primitives_) document_->memory->release(static_cast<std::uint64_t>(primitive_bytes_));
    primitives_.reset();
}

void Model::reload() {
    wasEdited();
    Document& document = *document_;
    std::uint64_t stored = 0;
    for (const Buffer& buffer : document.buffers) {
        if (buffer.hasStoredBytes()) stored += buffer.bytes.size();
    }
    document.memory = std::make_shared<MemoryBudget>(document.options.memory_limit_bytes);
    // The output JSON does not exist yet; its length is estimated as that of the input.
    document.memory->allow(stored + document.input_bytes);
    document.memory->take(stored, {});
    for (Buffer& buffer : document.buffers) {
        if (buffer.source != BufferSource::decoded) continue;
        buffer.source = BufferSource::absent;
        buffer.bytes = {};
    }
    document.imported = document.may_hide_tangents = false;
    document.warnings.clear();
    document.scaled_normals.reset();
    document.invalid_normals.reset();
    checkRequiredExtensions(document);
    document.views_without_data.clear();
    document.elements.clear();
    document.draco_roundings.clear();
    decodeMeshoptViews(document);
    decodeDracoPrimitives(document);
}

}  // namespace tspace::gltf
