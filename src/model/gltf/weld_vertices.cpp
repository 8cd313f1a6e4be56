// SPDX-License-Identifier: MIT
// Refines classes of equal vertices attribute by attribute, 16 bytes at a time.
#include "model/gltf/weld_vertices.h"

#include <array>
#include <cstring>
#include <numeric>
#include <set>
#include <string>

#include "core/base/numbers.h"
#include "core/base/unique_index.h"
#include "model/gltf/packed_layout.h"

namespace tspace::gltf {

namespace {

bool isOfFrames(const std::string& name) {
    return name == "NORMAL" || name == "TANGENT" || name == "_BITANGENT" || isPackedAttribute(name);
}

void refine(const Document& document, const Accessor& accessor, std::vector<std::uint32_t>& class_of) {
    const Bytes bytes = copyElements(document, accessor);
    for (std::size_t begin = 0; begin < accessor.element_bytes; begin += 16) {
        const std::size_t size = std::min<std::size_t>(16, accessor.element_bytes - begin);
        UniqueIndex<std::array<std::uint32_t, 5>> keys(class_of.size());
        for (std::size_t v = 0; v < class_of.size(); ++v) {
            std::array<std::uint32_t, 5> key = {};
            std::memcpy(key.data(), bytes.data() + v * accessor.element_bytes + begin, size);
            if (accessor.component == ComponentType::f32) {
                for (std::uint32_t& word : key)
                    word = weldBits(loadLittleEndian<float>(reinterpret_cast<const std::uint8_t*>(&word)));
            }
            key[4] = class_of[v];
            class_of[v] = keys.indexOf(key);
        }
    }
}

}  // namespace

WeldedVertices weldVertices(const Document& document, const Primitive& primitive) {
    std::set<std::size_t> accessors;
    const auto addAll = [&](const AttributeList& list) {
        for (const auto& [name, accessor] : list) {
            if (!isOfFrames(name)) accessors.insert(accessor);
        }
    };
    addAll(primitive.attributes);
    for (const AttributeList& target : primitive.targets) addAll(target);

    WeldedVertices welded;
    welded.number_of.resize(primitive.vertex_count);
    const Json& object = document.json["meshes"][primitive.mesh]["primitives"][primitive.index];
    if (findExtension(object, "CESIUM_primitive_outline") != nullptr) {
        std::iota(welded.number_of.begin(), welded.number_of.end(), 0u);
    } else {
        for (const std::size_t accessor : accessors)
            refine(document, readAccessor(document, accessor), welded.number_of);
    }
    for (std::uint32_t v = 0; v < welded.number_of.size(); ++v) {
        if (welded.number_of[v] == welded.kept.size()) welded.kept.push_back(v);
    }
    return welded;
}

}  // namespace tspace::gltf
