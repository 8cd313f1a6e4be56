// SPDX-License-Identifier: MIT
// Arrays that are decoded once.
#include "model/gltf/decoded_arrays.h"

#include <string_view>
#include <utility>

#include "model/gltf/accessor.h"
#include "model/gltf/packed_frames.h"

namespace tspace::gltf {
namespace {

/// Array together with its reservation in the memory budget.
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

}  // namespace tspace::gltf
