// SPDX-License-Identifier: MIT
// Finding the texture that asks for tangents: normalTexture, KHR_materials_clearcoat,
// KHR_materials_anisotropy.
#include "asset/gltf/material_needs.h"

#include "asset/file_error.h"

namespace tspace::gltf {

namespace {

/// Reports number UV sets in 32 bits.
std::size_t readUvSet(const Json& object, const std::string& place, std::size_t fallback) {
    constexpr std::size_t kMaxUvSet = 0x7fffffff;
    const std::size_t set = readSize(object, "texCoord", place, fallback);
    if (set > kMaxUvSet)
        failFile(ErrorCode::invalidFile, "no file has so many UV sets", join(place, "texCoord"));
    return set;
}

/// texCoord of a texture reference; the one of KHR_texture_transform goes first.
std::size_t uvSetOf(const Json& texture, const std::string& place) {
    const std::size_t own = readUvSet(texture, place, 0);
    const Json* extensions = readObject(texture, "extensions", place);
    if (extensions == nullptr) return own;
    const std::string transform_place = join(place, "extensions");
    const Json* transform = readObject(*extensions, "KHR_texture_transform", transform_place);
    if (transform == nullptr) return own;
    return readUvSet(*transform, join(transform_place, "KHR_texture_transform"), own);
}

TangentNeed needOf(const Json& material, const std::string& place) {
    if (const Json* normal = readObject(material, "normalTexture", place)) {
        return {"normalTexture", uvSetOf(*normal, join(place, "normalTexture"))};
    }
    const Json* extensions = readObject(material, "extensions", place);
    if (extensions == nullptr) return {};
    const std::string extension_place = join(place, "extensions");
    if (const Json* coat = readObject(*extensions, "KHR_materials_clearcoat", extension_place)) {
        const std::string coat_place = join(extension_place, "KHR_materials_clearcoat");
        if (const Json* normal = readObject(*coat, "clearcoatNormalTexture", coat_place)) {
            return {"clearcoatNormalTexture", uvSetOf(*normal, join(coat_place, "clearcoatNormalTexture"))};
        }
    }
    if (const Json* anisotropy = readObject(*extensions, "KHR_materials_anisotropy", extension_place)) {
        const std::string anisotropy_place = join(extension_place, "KHR_materials_anisotropy");
        const Json* texture = readObject(*anisotropy, "anisotropyTexture", anisotropy_place);
        if (texture != nullptr)
            return {"anisotropy", uvSetOf(*texture, join(anisotropy_place, "anisotropyTexture"))};
        if (readNumber(*anisotropy, "anisotropyStrength", anisotropy_place, 0) != 0) return {"anisotropy", 0};
    }
    return {};
}

}  // namespace

TangentNeed tangentNeed(const Document& document, const Primitive& primitive) {
    const Json& materials = rootArray(document, "materials");
    TangentNeed need;
    if (primitive.material)
        need = needOf(materials[*primitive.material], join("/materials", *primitive.material));
    if (need.needed()) return need;
    const Json& object = document.json["meshes"][primitive.mesh]["primitives"][primitive.index];
    const Json* variants = findExtension(object, "KHR_materials_variants");
    if (variants == nullptr) return need;
    const std::string place = primitive.place() + "/extensions/KHR_materials_variants";
    const Json& mappings = readArray(*variants, "mappings", place);
    for (std::size_t i = 0; i < mappings.size(); ++i) {
        const auto material = readIndex(mappings[i], "material", join(join(place, "mappings"), i),
                                        materials.size(), "material");
        if (!material) continue;
        need = needOf(materials[*material], join("/materials", *material));
        if (need.needed()) return need;
    }
    return need;
}

std::string materialName(const Document& document, const Primitive& primitive) {
    if (!primitive.material) return {};
    return readString(rootArray(document, "materials")[*primitive.material], "name",
                      join("/materials", *primitive.material));
}

}  // namespace tspace::gltf
