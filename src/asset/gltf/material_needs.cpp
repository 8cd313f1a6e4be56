// SPDX-License-Identifier: MIT
// Finding what asks for tangents: normalTexture, KHR_materials_clearcoat, KHR_materials_anisotropy, each with its UV
// set, KHR_texture_transform and image.
#include "asset/gltf/material_needs.h"

#include <algorithm>
#include <set>
#include <utility>

#include "asset/file_error.h"
#include "asset/gltf/texture_reference.h"

namespace tspace::gltf {

namespace {

bool isUnlit(const Json& material) { return findExtension(material, "KHR_materials_unlit") != nullptr; }

/// Microsoft Flight Simulator's models say of the file, in `asset`, or of a material whose convention normal maps follow.
bool declaresGreenDown(const Json& object) {
    const Json* extension = findExtension(object, "ASOBO_normal_map_convention");
    const Json* convention =
        extension == nullptr || !extension->is_object() ? nullptr : findMember(*extension, "tangent_space_convention");
    return convention != nullptr && convention->is_string() && convention->text() == "DirectX";
}

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
        const TextureReading reading = readTexture(document_, *texture, use.place);
        use.uv_set = reading.uv_set;
        use.transform = reading.transform;
        use.image = reading.image;
        use.wrap_u = reading.wrap_u;
        use.wrap_v = reading.wrap_v;
        // What is no number counts for nothing, as in viewers: tangents do not depend on it.
        if (const Json* scale = findMember(*texture, "scale"); scale != nullptr && scale->is_number())
            use.scale = scale->get<double>();
        use.is_declared_down = declaresGreenDown(rootArray(document_, "materials")[material_]);
        if (const Json* asset = findMember(document_.json, "asset"); asset != nullptr && !use.is_declared_down)
            use.is_declared_down = declaresGreenDown(*asset);
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
