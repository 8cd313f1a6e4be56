// SPDX-License-Identifier: MIT
// Finding what asks for tangents: normalTexture, KHR_materials_clearcoat, KHR_materials_anisotropy, each with its UV
// set, KHR_texture_transform and image.
#include "asset/gltf/material_needs.h"

#include <algorithm>
#include <set>
#include <utility>

#include "asset/file_error.h"

namespace tspace::gltf {

namespace {

/// Reports number UV sets in 32 bits.
std::size_t readUvSet(const Json& object, const std::string& place, std::size_t fallback) {
    constexpr std::size_t kMaxUvSet = 0x7fffffff;
    const std::size_t set = readSize(object, "texCoord", place, fallback);
    if (set > kMaxUvSet) failFile(ErrorCode::invalidFile, "no file has so many UV sets", join(place, "texCoord"));
    return set;
}

/// Two numbers; `pair` stays as it is when the member is absent.
void readPair(const Json& object, const char* key, const std::string& place, double (&pair)[2]) {
    const Json* value = findMember(object, key);
    if (value == nullptr) return;
    if (!value->is_array() || value->size() != 2 || !(*value)[0].is_number() || !(*value)[1].is_number())
        failFile(ErrorCode::invalidFile, std::string("'") + key + "' is not an array of two numbers", join(place, key));
    for (std::size_t i = 0; i < 2; ++i) pair[i] = (*value)[i].get<double>();
}

/// UV set and transform of a texture reference. The texCoord of KHR_texture_transform goes before its own.
void readUvs(const Json& texture, const std::string& place, TangentUse& use) {
    use.uv_set = readUvSet(texture, place, 0);
    const Json* extensions = readObject(texture, "extensions", place);
    if (extensions == nullptr) return;
    const std::string extension_place = join(place, "extensions");
    const Json* transform = readObject(*extensions, "KHR_texture_transform", extension_place);
    if (transform == nullptr) return;
    const std::string transform_place = join(extension_place, "KHR_texture_transform");
    use.uv_set = readUvSet(*transform, transform_place, use.uv_set);
    readPair(*transform, "offset", transform_place, use.transform.offset);
    use.transform.rotation = readNumber(*transform, "rotation", transform_place, 0);
    readPair(*transform, "scale", transform_place, use.transform.scale);
}

/// A member that is an index below `limit`, or nothing. Images do not matter to frames, so a wrong one is no reason to
/// refuse the file.
std::optional<std::size_t> indexBelow(const Json& object, const char* key, std::size_t limit) {
    const Json* value = findMember(object, key);
    if (value == nullptr || !value->is_number_integer()) return {};
    const auto index = value->get<std::int64_t>();
    if (index < 0 || static_cast<std::uint64_t>(index) >= limit) return {};
    return static_cast<std::size_t>(index);
}

/// The texture that a reference names, or null.
const Json* textureOf(const Document& document, const Json& reference) {
    const Json* textures = findMember(document.json, "textures");
    if (textures == nullptr || !textures->is_array()) return nullptr;
    const auto index = indexBelow(reference, "index", textures->size());
    return index ? &(*textures)[*index] : nullptr;
}

/// `source` where there is one: the other formats are alternatives to it.
std::optional<std::size_t> imageOf(const Document& document, const Json& texture) {
    const Json* images = findMember(document.json, "images");
    if (images == nullptr || !images->is_array()) return {};
    if (const auto source = indexBelow(texture, "source", images->size())) return source;
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"}) {
        const Json* extension = findExtension(texture, name);
        if (extension == nullptr) continue;
        if (const auto source = indexBelow(*extension, "source", images->size())) return source;
    }
    return {};
}

/// `key`: "wrapS" or "wrapT".
TextureWrap wrapOf(const Document& document, const Json& texture, const char* key) {
    constexpr int kClamp = 33071, kMirror = 33648;
    const Json* samplers = findMember(document.json, "samplers");
    if (samplers == nullptr || !samplers->is_array()) return TextureWrap::repeat;
    const auto sampler = indexBelow(texture, "sampler", samplers->size());
    const Json* wrap = sampler ? findMember((*samplers)[*sampler], key) : nullptr;
    if (wrap != nullptr && *wrap == kClamp) return TextureWrap::clamp;
    return wrap != nullptr && *wrap == kMirror ? TextureWrap::mirror : TextureWrap::repeat;
}

bool isUnlit(const Json& material) { return findExtension(material, "KHR_materials_unlit") != nullptr; }

/// Collects the uses of one material.
class MaterialUses {
  public:
    MaterialUses(const Document& document, std::size_t material, bool only_in_variant, std::vector<TangentUse>& uses)
        : document_(document),
          material_(material),
          only_in_variant_(only_in_variant),
          uses_(uses),
          first_(uses.size()) {}

    void collect() {
        const Json& material = rootArray(document_, "materials")[material_];
        const std::string place = join("/materials", material_);
        addTexture(material, place, "normalTexture", "normalTexture");
        if (isUnlit(material)) {
            // Malformed textures are refused as anywhere else.
            uses_.resize(first_);
            return;
        }
        const Json* extensions = readObject(material, "extensions", place);
        if (extensions == nullptr) return;
        const std::string extension_place = join(place, "extensions");
        if (const Json* coat = readObject(*extensions, "KHR_materials_clearcoat", extension_place)) {
            addTexture(*coat, join(extension_place, "KHR_materials_clearcoat"), "clearcoatNormalTexture",
                       "clearcoatNormalTexture");
        }
        if (const Json* anisotropy = readObject(*extensions, "KHR_materials_anisotropy", extension_place)) {
            addAnisotropy(*anisotropy, join(extension_place, "KHR_materials_anisotropy"));
        }
    }

  private:
    TangentUse& add(const char* needed_by, std::string place) {
        TangentUse& use = uses_.emplace_back();
        use.needed_by = needed_by;
        use.place = std::move(place);
        use.material = material_;
        use.only_in_variant = only_in_variant_;
        return use;
    }

    /// Returns false when there is no such texture.
    bool addTexture(const Json& object, const std::string& place, const char* key, const char* needed_by) {
        const Json* texture = readObject(object, key, place);
        if (texture == nullptr) return false;
        TangentUse& use = add(needed_by, join(place, key));
        readUvs(*texture, use.place, use);
        if (const Json* entry = textureOf(document_, *texture)) {
            use.image = imageOf(document_, *entry);
            use.wrap_u = wrapOf(document_, *entry, "wrapS");
            use.wrap_v = wrapOf(document_, *entry, "wrapT");
        }
        return true;
    }

    void addAnisotropy(const Json& anisotropy, const std::string& place) {
        if (addTexture(anisotropy, place, "anisotropyTexture", "anisotropy")) return;
        if (readNumber(anisotropy, "anisotropyStrength", place, 0) == 0) return;
        TangentUse& use = add("anisotropy", place);
        // Without a texture of its own it has no UVs of its own either: it turns with the material's other tangents.
        if (uses_.size() - 1 == first_) return;
        use.uv_set = uses_[first_].uv_set;
        use.transform = uses_[first_].transform;
    }

    const Document& document_;
    std::size_t material_;
    bool only_in_variant_;
    std::vector<TangentUse>& uses_;
    std::size_t first_;  ///< where those of this material begin
};

}  // namespace

std::vector<std::size_t> variantMaterials(const Document& document, const Primitive& primitive) {
    std::vector<std::size_t> materials;
    const Json& object = document.json["meshes"][primitive.mesh]["primitives"][primitive.index];
    const Json* variants = findExtension(object, "KHR_materials_variants");
    if (variants == nullptr) return materials;
    const std::string place = primitive.place() + "/extensions/KHR_materials_variants";
    const Json& mappings = readArray(*variants, "mappings", place);
    std::set<std::size_t> seen;
    const std::size_t count = rootArray(document, "materials").size();
    for (std::size_t i = 0; i < mappings.size(); ++i) {
        // Exporters leave mappings to materials that they dropped. Viewers then keep the primitive's own material.
        const std::size_t material = readSize(mappings[i], "material", join(place + "/mappings", i), count);
        if (material < count && seen.insert(material).second) materials.push_back(material);
    }
    return materials;
}

std::vector<TangentUse> tangentUses(const Document& document, const Primitive& primitive) {
    std::vector<TangentUse> uses;
    if (primitive.material) MaterialUses(document, *primitive.material, false, uses).collect();
    for (const std::size_t material : variantMaterials(document, primitive)) {
        if (material != primitive.material) MaterialUses(document, material, true, uses).collect();
    }
    return uses;
}

SurfaceKind surfaceKind(const Document& document, const Primitive& primitive) {
    std::vector<std::size_t> materials = variantMaterials(document, primitive);
    if (primitive.material) materials.push_back(*primitive.material);
    const Json& list = rootArray(document, "materials");
    const auto all = [&](auto&& test) {
        return !materials.empty() && std::all_of(materials.begin(), materials.end(),
                                                 [&](std::size_t material) { return test(list[material]); });
    };
    return {.is_unlit = all(isUnlit), .is_double_sided = all([](const Json& material) {
                                          const Json* value = findMember(material, "doubleSided");
                                          return value != nullptr && value->is_boolean() && value->get<bool>();
                                      })};
}

std::string materialName(const Document& document, const Primitive& primitive) {
    if (!primitive.material) return {};
    return readString(rootArray(document, "materials")[*primitive.material], "name",
                      join("/materials", *primitive.material));
}

}  // namespace tspace::gltf
