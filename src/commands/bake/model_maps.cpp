// SPDX-License-Identifier: MIT
#include "commands/bake/model_surfaces.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "model/gltf/container.h"
#include "model/gltf/editor.h"
#include "model/gltf/json_access.h"
#include "model/gltf/material_needs.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace tspace {
namespace {

using gltf::Document;
using gltf::Editor;

/// Returns how many times materials reference a texture.
std::size_t referencesTo(const Json& value, std::size_t texture) {
    std::size_t count = 0;
    if (value.is_object()) {
        const Json* const index = value.find("index");
        if (index != nullptr && index->is_number_unsigned() && index->get<std::size_t>() == texture) ++count;
    }
    for (const Json& child : value) count += referencesTo(child, texture);
    return count;
}

/// Returns the VRM 0.x property of a slot, or null if there is none.
const char* vrmPropertyOf(MapSlot slot) {
    switch (slot) {
        case MapSlot::normal: return "_BumpMap";
        case MapSlot::color: return "_MainTex";
        case MapSlot::emission: return "_EmissionMap";
        default: return nullptr;
    }
}

/// Returns how many times VRM 0.x references a texture: its materials by index, and its thumbnail.
std::size_t vrmReferencesTo(const Json& json, std::size_t texture) {
    const Json* const vrm = gltf::findExtension(json, "VRM");
    if (vrm == nullptr || !vrm->is_object()) return 0;
    const auto isTexture = [&](const Json& number) {
        return number.is_number_unsigned() && number.get<std::size_t>() == texture;
    };
    const Json* const meta = vrm->find("meta");
    const Json* const thumbnail = meta == nullptr || !meta->is_object() ? nullptr : meta->find("texture");
    std::size_t count = thumbnail != nullptr && isTexture(*thumbnail) ? 1 : 0;
    const Json* const materials = vrm->find("materialProperties");
    if (materials == nullptr || !materials->is_array()) return count;
    for (const Json& material : *materials) {
        const Json* const textures = material.is_object() ? material.find("textureProperties") : nullptr;
        if (textures == nullptr || !textures->is_object()) continue;
        for (const Json& number : *textures) count += isTexture(number) ? 1 : 0;
    }
    return count;
}

std::optional<std::size_t> indexIn(const Json& object, const char* key, std::size_t limit) {
    const Json* const index = object.find(key);
    if (index == nullptr || !index->is_number_unsigned() || index->get<std::size_t>() >= limit) return {};
    return index->get<std::size_t>();
}

/// Key of a texture reference in a material, and whether it is inside pbrMetallicRoughness.
struct SlotReference {
    const char* key;
    bool is_in_pbr;
};

std::vector<SlotReference> referencesOf(MapSlot slot) {
    constexpr SlotReference kOcclusion{"occlusionTexture", false}, kMetal{"metallicRoughnessTexture", true};
    switch (slot) {
        case MapSlot::normal: break;
        case MapSlot::occlusion: return {kOcclusion};
        case MapSlot::metal: return {kMetal};
        case MapSlot::occlusion_and_metal: return {kMetal, kOcclusion};
        case MapSlot::color: return {{"baseColorTexture", true}};
        case MapSlot::emission: return {{"emissiveTexture", false}};
    }
    return {{"normalTexture", false}};
}

/// Returns the object that contains a reference, and creates it if necessary.
Json& holderOf(Json& material, const SlotReference& reference) {
    if (!reference.is_in_pbr) return material;
    Json& pbr = material["pbrMetallicRoughness"];
    if (!pbr.is_object()) pbr = Json::object();
    return pbr;
}

/// Sets neutral factors, because the map already contains the factors of the high poly.
void setFactors(Json& material, MapSlot slot) {
    switch (slot) {
        case MapSlot::color: {
            Json& factor = holderOf(material, {"", true})["baseColorFactor"];
            const bool has_alpha = factor.is_array() && factor.size() == 4;
            const Json alpha = has_alpha ? factor[3] : Json(1.0);
            factor = Json::array({1.0, 1.0, 1.0, alpha});
            break;
        }
        case MapSlot::metal:
        case MapSlot::occlusion_and_metal:
            for (const char* factor : {"metallicFactor", "roughnessFactor"})
                holderOf(material, {"", true})[factor] = 1.0;
            break;
        case MapSlot::emission: material["emissiveFactor"] = Json::array({1.0, 1.0, 1.0}); break;
        default: break;
    }
}

class MapPlacing {
  public:
    MapPlacing(Document& document, Editor& editor, const gltf::OutputTarget& target)
        : document_(document), editor_(editor), target_(target) {
        for (const char* list : {"images", "textures", "materials"}) {
            if (!document.json.contains(list)) document.json[list] = Json::array();
            if (!document.json[list].is_array())
                failFile(ErrorCode::invalidFile, "it must be an array", std::string("/").append(list));
        }
        for (const Json& mesh : gltf::rootArray(document, "meshes")) {
            for (const Json& primitive : mesh.at("primitives")) {
                if (const auto material = materialOf(primitive)) ++users_[*material];
            }
        }
    }

    /// Makes the map the texture of its materials. Returns true if a .gltf references the map as a separate file.
    bool place(const ModelMap& map) {
        const std::vector<std::size_t> materials = assignMaterials(map);
        const std::optional<std::size_t> old = oldTexture(materials, map.slot);
        const std::optional<std::string> name = relativeUri(map.path);
        const std::size_t image = placeImage(map, name, old);
        const std::size_t texture = old ? *old : append("textures", Json{{"source", image}});
        // The map was baked for the sampler of the old texture, so that sampler is kept.
        if (!old) setWrap(document_.json["textures"][texture], map);
        for (std::size_t i = 0; i < materials.size(); ++i) {
            for (const SlotReference& reference : referencesOf(map.slot))
                showMap(materials[i], map.primitives[i], texture, reference);
            setFactors(document_.json["materials"][materials[i]], map.slot);
            showInVrm(materials[i], map.slot, texture);
        }
        editor_.touch();
        if (name) document_.new_files[*name] = map.png;
        return name.has_value();
    }

  private:
    [[nodiscard]] std::optional<std::size_t> materialOf(const Json& primitive) const {
        return indexIn(primitive, "material", document_.json["materials"].size());
    }

    std::size_t append(const char* list, Json entry) {
        Json& entries = document_.json[list];
        entries.push_back(std::move(entry));
        return entries.size() - 1;
    }

    [[nodiscard]] bool showsInVrm(std::size_t material, MapSlot slot, std::size_t texture) const {
        const char* const property = vrmPropertyOf(slot);
        const Json* const entry = gltf::vrmMaterial(document_, material);
        const Json* const textures = entry == nullptr ? nullptr : entry->find("textureProperties");
        if (property == nullptr || textures == nullptr || !textures->is_object()) return false;
        return indexIn(*textures, property, texture + 1) == texture;
    }

    void setWrap(Json& texture, const ModelMap& map) {
        if (map.wrap_u == TextureWrap::repeat && map.wrap_v == TextureWrap::repeat) return;
        Json& samplers = document_.json["samplers"];
        if (!samplers.is_array()) samplers = Json::array();
        const auto number = [](TextureWrap wrap) {
            return wrap == TextureWrap::repeat ? 10497 : wrap == TextureWrap::clamp ? 33071 : 33648;
        };
        samplers.push_back(Json{{"wrapS", number(map.wrap_u)}, {"wrapT", number(map.wrap_v)}});
        texture["sampler"] = samplers.size() - 1;
    }

    /// Assigns a material to each primitive of the map. A material that is also used by primitives without this map is
    /// copied.
    std::vector<std::size_t> assignMaterials(const ModelMap& map) {
        std::vector<std::optional<std::size_t>> before;
        std::map<std::size_t, std::size_t> users;
        for (const MappedPrimitive& primitive : map.primitives) {
            before.push_back(materialOf(editor_.primitive(primitive.mesh, primitive.primitive)));
            if (before.back()) ++users[*before.back()];
        }
        std::map<std::size_t, std::size_t> users_before = users_;
        std::map<std::optional<std::size_t>, std::size_t> given;
        std::vector<std::size_t> materials;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const auto [known, is_new] = given.try_emplace(before[i], 0);
            if (is_new)
                known->second = ownMaterial(before[i], before[i] && users[*before[i]] == users_before[*before[i]]);
            materials.push_back(known->second);
            if (before[i]) --users_[*before[i]];
            ++users_[known->second];
            editor_.primitive(map.primitives[i].mesh, map.primitives[i].primitive)["material"] = known->second;
        }
        return materials;
    }

    std::size_t ownMaterial(std::optional<std::size_t> before, bool is_alone) {
        if (!before) return append("materials", Json::object());
        if (is_alone) return *before;
        // VRM 0.x describes materials in the order of the glTF materials.
        if (gltf::vrmMaterial(document_, *before) != nullptr) {
            Json& all = document_.json["extensions"]["VRM"]["materialProperties"];
            if (all.size() == document_.json["materials"].size()) {
                Json entry = all[*before];
                all.push_back(std::move(entry));
            }
        }
        Json copy = document_.json["materials"][*before];
        return append("materials", std::move(copy));
    }

    void showInVrm(std::size_t material, MapSlot slot, std::size_t texture) {
        const char* const property = vrmPropertyOf(slot);
        if (property == nullptr || gltf::vrmMaterial(document_, material) == nullptr) return;
        Json& entry = document_.json["extensions"]["VRM"]["materialProperties"][material];
        if (!entry["textureProperties"].is_object()) entry["textureProperties"] = Json::object();
        entry["textureProperties"][property] = texture;
        if (slot != MapSlot::normal) return;
        if (!entry["keywordMap"].is_object()) entry["keywordMap"] = Json::object();
        entry["keywordMap"]["_NORMALMAP"] = true;
        if (!entry["floatProperties"].is_object()) entry["floatProperties"] = Json::object();
        entry["floatProperties"]["_BumpScale"] = 1.0;
    }

    /// Returns the texture that every one of `materials` references in `slot`; nullopt if they differ or have none, or
    /// if anything else uses the texture or its image.
    [[nodiscard]] std::optional<std::size_t> oldTexture(const std::vector<std::size_t>& materials, MapSlot slot) const {
        const std::vector<SlotReference> references = referencesOf(slot);
        const Json& json = document_.json;
        std::optional<std::size_t> texture;
        std::set<std::size_t> seen;
        for (const std::size_t material : materials) {
            if (!seen.insert(material).second) continue;
            for (const SlotReference& wanted : references) {
                const Json* holder = &json["materials"][material];
                if (wanted.is_in_pbr) holder = holder->find("pbrMetallicRoughness");
                const Json* const reference = holder == nullptr ? nullptr : holder->find(wanted.key);
                if (reference == nullptr) return {};
                const auto shown = indexIn(*reference, "index", json["textures"].size());
                if (!shown || (texture && *texture != *shown)) return {};
                texture = shown;
            }
        }
        if (!texture || referencesTo(json["materials"], *texture) != seen.size() * references.size()) return {};
        std::size_t own = 0;
        for (const std::size_t material : seen) own += showsInVrm(material, slot, *texture) ? 1 : 0;
        if (vrmReferencesTo(json, *texture) != own) return {};
        const Json& entry = json["textures"][*texture];
        const auto image = indexIn(entry, "source", json["images"].size());
        if (!image || entry.contains("extensions")) return {};
        const auto shows = [&](const Json& other) { return indexIn(other, "source", *image + 1) == image; };
        const auto count = std::count_if(json["textures"].begin(), json["textures"].end(), shows);
        return count == 1 ? texture : std::nullopt;
    }

    /// Appends the image, or replaces the image of an old texture.
    std::size_t placeImage(const ModelMap& map, const std::optional<std::string>& name,
                           std::optional<std::size_t> old) {
        std::optional<std::size_t> old_view;
        std::size_t at = document_.json["images"].size();
        if (old) {
            at = document_.json["textures"][*old]["source"].get<std::size_t>();
            old_view = indexIn(document_.json["images"][at], "bufferView", rootArray(document_, "bufferViews").size());
            document_.json["images"][at] = Json::object();
        } else {
            append("images", Json::object());
        }
        if (old_view) editor_.releaseView(*old_view);
        Json image = Json::object();
        image["name"] = stemOf(map.path);
        if (name) {
            image["uri"] = percentEncode(*name);
        } else {
            image["mimeType"] = "image/png";
            image["bufferView"] = editor_.storeBlob(map.png, std::nullopt);
        }
        document_.json["images"][at] = std::move(image);
        return at;
    }

    /// Returns the URI by which a .gltf references the file; nullopt if the file is not in its folder or below.
    [[nodiscard]] std::optional<std::string> relativeUri(const std::string& path) const {
        if (target_.container == gltf::Container::glb) return {};
        std::string name = pathBelow(folderOf(target_.path), path);
        if (name.empty() || gltf::referencesFile(document_, name)) return {};
        return name;
    }

    void showMap(std::size_t material, const MappedPrimitive& primitive, std::size_t texture,
                 const SlotReference& slot) {
        Json& reference = holderOf(document_.json["materials"][material], slot)[slot.key];
        const bool is_normal = std::string_view(slot.key) == "normalTexture";
        if (is_normal && primitive.had_map && reference.is_object()) {
            reference["index"] = texture;
            reference.erase("scale");
            return;
        }
        reference = Json{{"index", texture}};
        if (primitive.uv_set != 0) reference["texCoord"] = primitive.uv_set;
        const UvTransform& transform = primitive.transform;
        const bool moves = transform.offset[0] != 0 || transform.offset[1] != 0;
        if (!moves && !transform.changesFrames()) return;
        Json& extension = reference["extensions"]["KHR_texture_transform"];
        extension["offset"] = Json::array({transform.offset[0], transform.offset[1]});
        extension["rotation"] = transform.rotation;
        extension["scale"] = Json::array({transform.scale[0], transform.scale[1]});
        Json& used = document_.json["extensionsUsed"];
        if (std::find(used.begin(), used.end(), "KHR_texture_transform") == used.end())
            used.push_back("KHR_texture_transform");
    }

    Document& document_;
    Editor& editor_;
    const gltf::OutputTarget& target_;
    std::map<std::size_t, std::size_t> users_ = {};  ///< number of primitives that use each material
};

}  // namespace

void addModelWithMaps(ModelWithMaps&& model, AtomicOutput& model_files, AtomicOutput& map_files,
                      std::vector<std::string>& warnings) {
    Document& document = model.model.document();
    const gltf::OutputTarget target = gltf::outputTarget(document, model.output, model_files.isStream());
    gltf::convertContainer(document, target, true, warnings);
    Editor editor(document, gltf::freeFileName(document, target, ".tspace.bin"));
    MapPlacing placing(document, editor, target);
    for (const ModelMap& map : model.maps) {
        if (!placing.place(map)) map_files.add(map.path, std::span<const std::uint8_t>(map.png));
    }
    editor.finish();
    gltf::writeDocument(document, target, model_files, warnings, {.thread_count = 1});
}

}  // namespace tspace
