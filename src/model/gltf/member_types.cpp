// SPDX-License-Identifier: MIT
#include "model/gltf/member_types.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "model/gltf/json_access.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

enum class MemberType { text, boolean, integer, number, object, texts, integers, numbers, objects };

/// Members with one type. A path consists of keys; "*" matches all elements of an array and all members of an object,
/// and "a|b" the members a and b.
struct MemberRule {
    std::string_view path;
    MemberType type;
};

// Containers come before their members, so that the outermost wrong type is reported.
constexpr MemberRule kMemberRules[] = {
    {"asset", MemberType::object},
    {"asset/version|minVersion|generator|copyright", MemberType::text},
    {"extensionsUsed|extensionsRequired", MemberType::texts},
    {"accessors|animations|buffers|bufferViews|cameras|images|materials|meshes|nodes|samplers|scenes|skins|textures",
     MemberType::objects},
    {"accessors|animations|buffers|bufferViews|cameras|images|materials|meshes|nodes|samplers|scenes|skins|textures/*/"
     "name",
     MemberType::text},
    {"extensions", MemberType::object},
    {"accessors|bufferViews|buffers|images|materials|meshes|nodes|skins|textures/*/extensions", MemberType::object},
    {"scene", MemberType::integer},
    {"scenes/*/nodes", MemberType::integers},
    {"nodes/*/children", MemberType::integers},
    {"nodes/*/camera|mesh|skin", MemberType::integer},
    {"nodes/*/matrix|rotation|scale|translation|weights", MemberType::numbers},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing", MemberType::object},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes", MemberType::object},
    {"nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*", MemberType::integer},
    {"meshes/*/weights", MemberType::numbers},
    {"meshes/*/primitives", MemberType::objects},
    {"meshes/*/primitives/*/extensions", MemberType::object},
    {"meshes/*/primitives/*/attributes", MemberType::object},
    {"meshes/*/primitives/*/attributes/*", MemberType::integer},
    {"meshes/*/primitives/*/indices|material|mode", MemberType::integer},
    {"meshes/*/primitives/*/targets", MemberType::objects},
    {"meshes/*/primitives/*/targets/*/*", MemberType::integer},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants|KHR_draco_mesh_compression", MemberType::object},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings", MemberType::objects},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/material", MemberType::integer},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/variants", MemberType::integers},
    {"extensions/KHR_materials_variants", MemberType::object},
    {"extensions/KHR_materials_variants/variants", MemberType::objects},
    {"extensions/KHR_materials_variants/variants/*/name", MemberType::text},
    {"meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/name", MemberType::text},
    {"accessors/*/bufferView|byteOffset|componentType|count", MemberType::integer},
    {"accessors/*/type", MemberType::text},
    {"accessors/*/normalized", MemberType::boolean},
    {"accessors/*/min|max", MemberType::numbers},
    {"accessors/*/sparse", MemberType::object},
    {"accessors/*/sparse/count", MemberType::integer},
    {"accessors/*/sparse/indices|values", MemberType::object},
    {"accessors/*/sparse/indices|values/bufferView|byteOffset|componentType", MemberType::integer},
    {"bufferViews/*/buffer|byteOffset|byteLength|byteStride|target", MemberType::integer},
    {"buffers/*/byteLength", MemberType::integer},
    {"buffers/*/uri", MemberType::text},
    {"images/*/uri|mimeType", MemberType::text},
    {"images/*/bufferView", MemberType::integer},
    {"textures/*/sampler|source", MemberType::integer},
    {"textures/*/extensions/KHR_texture_basisu|EXT_texture_webp|EXT_texture_avif|MSFT_texture_dds", MemberType::object},
    {"textures/*/extensions/KHR_texture_basisu|EXT_texture_webp|EXT_texture_avif|MSFT_texture_dds/source",
     MemberType::integer},
    {"samplers/*/magFilter|minFilter|wrapS|wrapT", MemberType::integer},
    {"materials/*/alphaMode", MemberType::text},
    {"materials/*/alphaCutoff", MemberType::number},
    {"materials/*/doubleSided", MemberType::boolean},
    {"materials/*/emissiveFactor", MemberType::numbers},
    {"materials/*/pbrMetallicRoughness", MemberType::object},
    {"materials/*/pbrMetallicRoughness/baseColorFactor", MemberType::numbers},
    {"materials/*/pbrMetallicRoughness/metallicFactor|roughnessFactor", MemberType::number},
    {"cameras/*/type", MemberType::text},
    {"cameras/*/perspective|orthographic", MemberType::object},
    {"cameras/*/perspective|orthographic/aspectRatio|yfov|xmag|ymag|zfar|znear", MemberType::number},
    {"skins/*/inverseBindMatrices|skeleton", MemberType::integer},
    {"skins/*/joints", MemberType::integers},
    {"animations/*/channels|samplers", MemberType::objects},
    {"animations/*/channels/*/sampler", MemberType::integer},
    {"animations/*/channels/*/target", MemberType::object},
    {"animations/*/channels/*/target/node", MemberType::integer},
    {"animations/*/channels/*/target/path", MemberType::text},
    {"animations/*/samplers/*/input|output", MemberType::integer},
    {"animations/*/samplers/*/interpolation", MemberType::text},
};

// Members of the objects that refer to textures.
constexpr MemberRule kTextureMemberRules[] = {
    {"index|texCoord", MemberType::integer},
    {"scale|strength", MemberType::number},
    {"extensions", MemberType::object},
    {"extensions/KHR_texture_transform", MemberType::object},
    {"extensions/KHR_texture_transform/offset|scale", MemberType::numbers},
    {"extensions/KHR_texture_transform/rotation", MemberType::number},
    {"extensions/KHR_texture_transform/texCoord", MemberType::integer},
};

const char* jsonTypeName(const Json& value) {
    if (value.is_null()) return "null";
    if (value.is_boolean()) return "true or false";
    if (value.is_string()) return "a string";
    if (value.is_array()) return "an array";
    if (value.is_object()) return "an object";
    return value.is_number_float() && value.get<double>() != std::floor(value.get<double>()) ? "a fraction"
                                                                                             : "a number";
}

/// Returns the type of the elements of an array type.
MemberType elementMemberType(MemberType type) {
    switch (type) {
        case MemberType::texts: return MemberType::text;
        case MemberType::integers: return MemberType::integer;
        case MemberType::numbers: return MemberType::number;
        default: return MemberType::object;
    }
}

bool isListType(MemberType type) { return type >= MemberType::texts; }

bool hasMemberType(MemberType type, const Json& value) {
    switch (type) {
        case MemberType::text: return value.is_string();
        case MemberType::boolean: return value.is_boolean();
        case MemberType::integer:
            return value.is_number() &&
                   (!value.is_number_float() || value.get<double>() == std::floor(value.get<double>()));
        case MemberType::number: return value.is_number() || value.is_null();
        case MemberType::object: return value.is_object();
        case MemberType::numbers: return value.is_array() || value.is_null();
        default: return value.is_array();
    }
}

const char* memberTypeName(MemberType type) {
    constexpr const char* kNames[] = {
        "a string",           "true or false",       "an integer",           "a number",
        "an object",          "an array of strings", "an array of integers", "an array of numbers",
        "an array of objects"};
    return kNames[static_cast<std::size_t>(type)];
}

/// A member or element, and the objects and arrays that contain it.
struct MemberPlace {
    const MemberPlace* parent = nullptr;
    std::string_view key = {};
    std::size_t index = 0;  ///< used if the key is empty

    [[nodiscard]] std::string pointer() const {
        if (parent == nullptr) return {};
        return key.empty() ? join(parent->pointer(), index) : join(parent->pointer(), std::string(key));
    }
};

void checkMemberValue(const Json& value, MemberType type, const MemberPlace& place) {
    const auto fail = [](const std::string& subject, MemberType expected, const Json& found, const MemberPlace& at) {
        failFile(ErrorCode::invalidFile,
                 subject + " is not " + memberTypeName(expected) + " but " + jsonTypeName(found), at.pointer());
    };
    // An element of an array has no key. Keys are quoted, because files choose the keys of some objects.
    const std::string name = place.key.empty() ? "the entry" : inQuotes(place.key);
    if (!hasMemberType(type, value)) fail(name, type, value, place);
    if (!isListType(type)) return;
    std::size_t index = 0;
    for (const Json& element : value) {
        if (!hasMemberType(elementMemberType(type), element))
            fail("an entry of " + name, elementMemberType(type), element, {&place, {}, index});
        ++index;
    }
}

void checkPath(const Json& value, std::string_view path, MemberType type, const MemberPlace& place) {
    if (path.empty()) return checkMemberValue(value, type, place);
    const std::size_t end = std::min(path.find('/'), path.size());
    std::string_view keys = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    if (keys == "*" && value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) checkPath(value[i], path, type, {&place, {}, i});
    } else if (keys == "*") {
        if (!value.is_object()) return;
        for (const auto& [key, member] : value.items()) checkPath(member, path, type, {&place, key, 0});
    } else {
        while (!keys.empty()) {
            const std::string_view key = keys.substr(0, keys.find('|'));
            keys.remove_prefix(std::min(key.size() + 1, keys.size()));
            if (const Json* member = value.find(key)) checkPath(*member, path, type, {&place, key, 0});
        }
    }
}

/// Checks the members of `object` that refer to textures.
void checkTextureMembers(const Json& object, const MemberPlace& place) {
    if (!object.is_object()) return;
    for (const auto& [key, value] : object.items()) {
        if (!key.ends_with("Texture")) continue;
        const MemberPlace at{&place, key, 0};
        checkMemberValue(value, MemberType::object, at);
        for (const MemberRule& rule : kTextureMemberRules) checkPath(value, rule.path, rule.type, at);
    }
}

void checkMaterialMembers(const Json& material, const MemberPlace& place) {
    checkTextureMembers(material, place);
    if (const Json* rough = material.find("pbrMetallicRoughness"))
        checkTextureMembers(*rough, {&place, "pbrMetallicRoughness", 0});
    const Json* extensions = material.find("extensions");
    if (extensions == nullptr || !extensions->is_object()) return;
    const MemberPlace inner{&place, "extensions", 0};
    for (const auto& [name, extension] : extensions->items()) {
        if (!name.starts_with("KHR_materials_")) continue;
        const MemberPlace at{&inner, name, 0};
        checkMemberValue(extension, MemberType::object, at);
        checkTextureMembers(extension, at);
    }
}

}  // namespace

void checkMemberTypes(const Json& root) {
    const MemberPlace top;
    for (const MemberRule& rule : kMemberRules) checkPath(root, rule.path, rule.type, top);
    if (const Json* materials = root.find("materials")) {
        const MemberPlace list{&top, "materials", 0};
        for (std::size_t i = 0; i < materials->size(); ++i) checkMaterialMembers((*materials)[i], {&list, {}, i});
    }
}

}  // namespace tspace::gltf
