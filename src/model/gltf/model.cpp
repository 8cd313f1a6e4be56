// SPDX-License-Identifier: MIT
#include "model/gltf/model.h"

#include <string_view>
#include <utility>

#include "model/gltf/accessor.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/packed.h"
#include "model/gltf/read_scene.h"

namespace tspace::gltf {

namespace {

/// An array, and what the budget was charged for it.
template <class T>
struct Charged {
    Charged(std::shared_ptr<MemoryBudget> budget, std::uint64_t byte_count, const std::string& place)
        : memory(std::move(budget)), bytes(byte_count) {
        memory->take(bytes, place);
    }
    Charged(const Charged&) = delete;
    Charged& operator=(const Charged&) = delete;
    ~Charged() { memory->release(bytes); }

    std::shared_ptr<MemoryBudget> memory;
    std::uint64_t bytes;
    std::vector<T> values = {};
};

}  // namespace

template <class T, class Key>
std::optional<SharedArray<T>> DecodedArrays::known(const std::map<Key, Known<T>>& table, const Key& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = table.find(key);
    if (found == table.end()) return {};
    std::shared_ptr<const std::vector<T>> array = found->second.lock();
    if (array == nullptr) return {};
    return SharedArray<T>(std::move(array));
}

template <class T, class Key, class Decode>
SharedArray<T> DecodedArrays::make(std::map<Key, Known<T>>& table, const Key& key, std::uint64_t bytes,
                                   const std::string& place, const Decode& decode) {
    const auto charged = std::make_shared<Charged<T>>(document_.memory, bytes, place);
    charged->values = decode();
    SharedArray<T> array(std::shared_ptr<const std::vector<T>>(charged, &charged->values));
    const std::lock_guard lock(mutex_);
    table[key] = array.watch();
    return array;
}

template <class Vec, class Decode>
SharedArray<Vec> DecodedArrays::vectors(std::map<std::size_t, Known<Vec>>& table, std::size_t index,
                                        const std::string& place, const Decode& decode) {
    if (const auto array = known(table, index)) return *array;
    const Accessor accessor = readAccessor(document_, index);
    return make(table, index, std::uint64_t{accessor.count} * sizeof(Vec), accessor.place(),
                [&] { return decode(document_, accessor, place); });
}

SharedArray<Vec2> DecodedArrays::vec2(std::size_t accessor, const std::string& place) {
    return vectors(vec2_, accessor, place, decodeVec2);
}

SharedArray<Vec3> DecodedArrays::vec3(std::size_t accessor, const std::string& place) {
    return vectors(vec3_, accessor, place, decodeVec3);
}

SharedArray<Vec4> DecodedArrays::vec4(std::size_t accessor, const std::string& place) {
    return vectors(vec4_, accessor, place, decodeVec4);
}

SharedArray<Vec3> DecodedArrays::normals(const Primitive& primitive, std::size_t index, const std::string& place) {
    if (primitive.normal_scales == nullptr) return vec3(index, place);
    const std::pair key(*primitive.find("NORMAL"), index);
    if (const auto array = known(scaled_normals_, key)) return *array;
    const Accessor accessor = readAccessor(document_, index);
    return make(scaled_normals_, key, std::uint64_t{accessor.count} * sizeof(Vec3), accessor.place(), [&] {
        std::vector<Vec3> values = decodeVec3(document_, accessor, place);
        scaleNormals(primitive, values);
        return values;
    });
}

DecodedArrays::CornerKey DecodedArrays::keyOf(const Primitive& primitive) const {
    const std::size_t no_indices = rootArray(document_, "accessors").size();
    return {primitive.indices.value_or(no_indices), primitive.vertex_count, primitive.mode};
}

SharedArray<std::uint32_t> DecodedArrays::corners(const Primitive& primitive) {
    const CornerKey key = keyOf(primitive);
    if (const auto array = known(corners_, key)) return *array;
    const std::uint64_t count = std::uint64_t{3} * primitive.triangleCount();
    return make(corners_, key, count * sizeof(std::uint32_t), primitive.place(), [&] {
        document_.memory->require(checkBytes(count, primitive.vertex_count, primitive.find("TANGENT").has_value()),
                                  primitive.place());
        return readTriangleCorners(document_, primitive);
    });
}

SharedArray<std::uint8_t> DecodedArrays::packedWords(const Primitive& primitive, const PackedLayout& layout) {
    std::vector<std::size_t> key;
    for (const PackedPart& part : layout.parts) key.push_back(*primitive.find(part.attribute));
    if (const auto array = known(words_, key)) return *array;
    const std::uint64_t bytes = std::uint64_t{2} * primitive.vertex_count * frameBytes(layout.format);
    return make(words_, key, bytes, primitive.place(), [&] {
        const Bytes words = readPackedWords(document_, primitive, layout);
        return std::vector<std::uint8_t>(words.begin(), words.end());
    });
}

SharedArray<Vec2> DecodedArrays::borrowUvs(const Primitive& primitive, std::size_t uv_set) {
    if (const auto accessor = primitive.find("TEXCOORD_" + std::to_string(uv_set))) {
        if (const auto array = known(vec2_, *accessor)) return *array;
    }
    return readUvs(document_, primitive, uv_set);
}

SharedArray<Vec3> DecodedArrays::borrowVec3(const Primitive& primitive, const char* attribute) {
    const auto accessor = primitive.find(attribute);
    if (accessor && std::string_view(attribute) == "NORMAL" && primitive.normal_scales != nullptr) {
        if (const auto array = known(scaled_normals_, {*accessor, *accessor})) return *array;
    } else if (accessor) {
        if (const auto array = known(vec3_, *accessor)) return *array;
    }
    return readVec3(document_, primitive, attribute);
}

SharedArray<Vec4> DecodedArrays::borrowTangents(const Primitive& primitive) {
    if (const auto accessor = primitive.find("TANGENT")) {
        if (const auto array = known(vec4_, *accessor)) return *array;
    }
    return readTangents(document_, primitive);
}

SharedArray<std::uint32_t> DecodedArrays::borrowCorners(const Primitive& primitive) {
    if (const auto array = known(corners_, keyOf(primitive))) return *array;
    return readTriangleCorners(document_, primitive);
}

std::vector<std::uint32_t> DecodedArrays::copyCorners(const Primitive& primitive) {
    if (const auto array = known(corners_, keyOf(primitive))) return {array->begin(), array->end()};
    return readTriangleCorners(document_, primitive);
}

void DecodedArrays::forget() {
    const std::lock_guard lock(mutex_);
    vec2_.clear();
    vec3_.clear();
    vec4_.clear();
    scaled_normals_.clear();
    corners_.clear();
    words_.clear();
}

Model::Model(Document&& document)
    : document_(std::make_unique<Document>(std::move(document))),
      arrays_(std::make_unique<DecodedArrays>(*document_)) {}

std::vector<Primitive>& Model::primitives() {
    if (!primitives_) {
        const std::int64_t left = document_->memory->left();
        primitives_ = readPrimitives(*document_);
        primitive_bytes_ = left - document_->memory->left();
        std::string scaled = scaledNormalsText(*primitives_);
        std::vector<std::string>& warnings = document_->warnings;
        std::erase_if(warnings, [](const std::string& warning) { return warning.rfind(kNormalLengths, 0) == 0; });
        if (!scaled.empty())
            warnings.push_back(std::move(scaled) +
                               ". They were scaled to it before anything was computed from them; the file has them as "
                               "before (tspace generate --repair writes unit normals)");
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

DrawnScene Model::materialScene(bool with_normal_maps) {
    DrawnScene drawn = drawnScene(false);
    for (std::size_t i = 0; i < drawn.looks.size(); ++i)
        readMetalAndEmission(*document_, primitives()[i], drawn.looks[i]);
    std::set<std::size_t> images = materialImagesOf(drawn.looks);
    if (with_normal_maps) images.merge(imagesOf(drawn.looks));
    readImages(*document_, images, drawn.scene);
    for (const Primitive& primitive : primitives()) {
        SharedArray<Vec4>& colors = drawn.colors.emplace_back();
        const auto accessor = primitive.find("COLOR_0");
        if (!accessor || primitive.vertex_count == 0) continue;
        const std::string place = join(join(primitive.place(), "attributes"), "COLOR_0");
        if (readAccessor(*document_, *accessor).component_count == 4) {
            colors = arrays_->vec4(*accessor, place);
            continue;
        }
        const SharedArray<Vec3> opaque = arrays_->vec3(*accessor, place);
        document_->memory->take(opaque.size() * sizeof(Vec4), place);
        std::vector<Vec4> values;
        for (const Vec3& color : opaque) values.push_back({color.x, color.y, color.z, 1});
        colors = SharedArray<Vec4>(std::move(values));
    }
    return drawn;
}

PosedScene Model::posedScene(bool with_images) {
    PosedScene posed{.drawn = with_images ? materialScene(true) : drawnScene(false)};
    posed.poses = readPoses(*document_, *arrays_, primitives(), posed.drawn.scene);
    return posed;
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
