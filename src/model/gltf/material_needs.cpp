// SPDX-License-Identifier: MIT
// Finds the uses of tangents (normalTexture, KHR_materials_clearcoat, KHR_materials_anisotropy), each with its UV set,
// KHR_texture_transform and image.
#include "model/gltf/material_needs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

#include "core/base/ascii.h"
#include "model/gltf/packed_layout.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

/// Reads a UV set index. Fails beyond 31 bits, because reports store UV sets in 32 bits.
std::size_t readUvSet(const Json& object, const std::string& place, std::size_t fallback) {
    constexpr std::size_t kMaxUvSet = 0x7fffffff;
    const std::uint64_t set = readWhole(object, "texCoord", place, fallback);
    if (set > kMaxUvSet)
        failFile(ErrorCode::invalidFile, "the number of the UV set is too large", join(place, "texCoord"));
    return static_cast<std::size_t>(set);
}

/// Reads the UV set and the transform of a texture reference. The texCoord of KHR_texture_transform overrides that of
/// the reference.
void readUvs(const Json& texture, const std::string& place, TextureReading& reading) {
    reading.uv_set = readUvSet(texture, place, 0);
    const Json* extensions = readObject(texture, "extensions", place);
    if (extensions == nullptr) return;
    const std::string extension_place = join(place, "extensions");
    const Json* transform = readObject(*extensions, "KHR_texture_transform", extension_place);
    if (transform == nullptr) return;
    const std::string transform_place = join(extension_place, "KHR_texture_transform");
    reading.uv_set = readUvSet(*transform, transform_place, reading.uv_set);
    readNumbers(*transform, "offset", transform_place, reading.transform.offset);
    reading.transform.rotation = readNumber(*transform, "rotation", transform_place, 0);
    readNumbers(*transform, "scale", transform_place, reading.transform.scale);
}

/// Returns a member that is an index below `limit`, or nullopt if there is none. An invalid index is not an error,
/// because frames do not depend on images.
std::optional<std::size_t> indexBelow(const Json& object, const char* key, std::size_t limit) {
    const Json* value = findMember(object, key);
    if (value == nullptr || !value->is_number_integer()) return {};
    const auto index = value->get<std::int64_t>();
    if (index < 0 || static_cast<std::uint64_t>(index) >= limit) return {};
    return static_cast<std::size_t>(index);
}

/// Returns the texture that a reference names, or null.
const Json* textureOf(const Document& document, const Json& reference) {
    const Json* textures = findMember(document.json, "textures");
    if (textures == nullptr || !textures->is_array()) return nullptr;
    const auto index = indexBelow(reference, "index", textures->size());
    return index ? &(*textures)[*index] : nullptr;
}

/// Returns the image of a texture. `source` has priority, because other formats are alternatives to it.
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

/// Returns the member `key` ("wrapS" or "wrapT") of the sampler of a texture, or null.
const Json* samplerMember(const Document& document, const Json& texture, const char* key) {
    const Json* samplers = findMember(document.json, "samplers");
    if (samplers == nullptr || !samplers->is_array()) return nullptr;
    const auto sampler = indexBelow(texture, "sampler", samplers->size());
    return sampler ? findMember((*samplers)[*sampler], key) : nullptr;
}

TextureWrap wrapOf(const Document& document, const Json& texture, const char* key) {
    constexpr int kClamp = 33071, kMirror = 33648;
    const Json* wrap = samplerMember(document, texture, key);
    if (wrap != nullptr && *wrap == kClamp) return TextureWrap::clamp;
    return wrap != nullptr && *wrap == kMirror ? TextureWrap::mirror : TextureWrap::repeat;
}

bool readsLevels(const Document& document, const Json& texture) {
    constexpr int kNearest = 9728, kLinear = 9729;
    const Json* filter = samplerMember(document, texture, "minFilter");
    return filter == nullptr || (*filter != kNearest && *filter != kLinear);
}

}  // namespace

TextureReading readTexture(const Document& document, const Json& texture, const std::string& place) {
    TextureReading reading;
    readUvs(texture, place, reading);
    if (const Json* entry = textureOf(document, texture)) {
        reading.image = imageOf(document, *entry);
        reading.wrap_u = wrapOf(document, *entry, "wrapS");
        reading.wrap_v = wrapOf(document, *entry, "wrapT");
        reading.reads_levels = readsLevels(document, *entry);
    }
    return reading;
}

const Json* vrmMaterial(const Document& document, std::size_t material) {
    const Json* vrm = findExtension(document.json, "VRM");
    const Json* all = vrm == nullptr ? nullptr : findMember(*vrm, "materialProperties");
    if (all == nullptr || !all->is_array() || material >= all->size()) return nullptr;
    const Json& entry = (*all)[material];
    const Json* shader = findMember(entry, "shader");
    const bool is_as_in_gltf = shader != nullptr && *shader == "VRM_USE_GLTFSHADER";
    return is_as_in_gltf || !entry.is_object() ? nullptr : &entry;
}

namespace {

/// Returns whether a material extension reads no tangents, or has its uses of tangents collected in this file. Any
/// other extension may read tangents.
bool isKnownExtension(const std::string& name) {
    static const std::set<std::string> kKnown{"ASOBO_normal_map_convention",
                                              "KHR_materials_unlit",
                                              "KHR_materials_clearcoat",
                                              "KHR_materials_anisotropy",
                                              "KHR_materials_sheen",
                                              "KHR_materials_transmission",
                                              "KHR_materials_volume",
                                              "KHR_materials_ior",
                                              "KHR_materials_specular",
                                              "KHR_materials_emissive_strength",
                                              "KHR_materials_iridescence",
                                              "KHR_materials_dispersion",
                                              "KHR_materials_diffuse_transmission",
                                              "KHR_materials_volume_scatter",
                                              "KHR_materials_pbrSpecularGlossiness",
                                              "KHR_materials_common",
                                              "KHR_techniques_webgl",
                                              "KHR_xmp",
                                              "KHR_xmp_json_ld"};
    return kKnown.count(name) != 0;
}

/// Material extensions that shade with normals and take precedence over KHR_materials_unlit, which is then only a
/// fallback for readers without them.
constexpr std::array kOverridesUnlit{"VRMC_materials_mtoon"};

/// Returns the normal map of a material in VRM 0.x, or null.
const Json* vrmNormalMap(const Document& document, std::size_t material) {
    const Json* entry = vrmMaterial(document, material);
    const Json* textures = entry == nullptr ? nullptr : findMember(*entry, "textureProperties");
    return textures == nullptr ? nullptr : findMember(*textures, "_BumpMap");
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// Calls visit(key, texture, place) for each texture reference in an object, at any depth. If visit returns true, the
/// members of the reference are not visited.
template <class Visit>
void forTextures(const Json& object, const std::string& place, const Visit& visit) {
    if (object.is_array()) {
        for (std::size_t i = 0; i < object.size(); ++i) forTextures(object[i], join(place, i), visit);
        return;
    }
    if (!object.is_object()) return;
    for (const auto& [key, value] : object.items()) {
        const std::string own_place = join(place, key);
        if (findMember(value, "index") != nullptr && visit(key, value, own_place)) continue;
        forTextures(value, own_place, visit);
    }
}

/// Returns whether an object contains, at any depth, a texture reference whose name indicates a normal or bump map.
bool namesNormalMap(const Json& object) {
    bool is_found = false;
    forTextures(object, {}, [&](const std::string& key, const Json&, const std::string&) {
        const std::string name = lowerAscii(key);
        is_found = is_found || contains(name, "normal") || contains(name, "bump");
        return is_found;
    });
    return is_found;
}

std::vector<std::string> extensionsOf(const Json& object) {
    std::vector<std::string> names;
    const Json* extensions = findMember(object, "extensions");
    if (extensions == nullptr || !extensions->is_object()) return names;
    for (const auto& [name, value] : extensions->items()) names.push_back(name);
    return names;
}

/// Returns whether a name suggests hand-authored surface directions (flow maps, hair, brushed metal).
bool suggestsFlow(const std::string& text) {
    const std::string name = lowerAscii(text);
    static constexpr std::array kWords{"tangent", "flow", "aniso", "hair", "brush"};
    return std::any_of(kWords.begin(), kWords.end(), [&](const char* word) {
        // _BITANGENT is tspace's own attribute.
        return name.find(word) != std::string::npos && name.find("bitangent") == std::string::npos;
    });
}

/// Returns whether the extras of an object suggest hand-authored directions. Examines the names and texts of their
/// members.
bool mentionsFlow(const Json& object) {
    const Json* extras = findMember(object, "extras");
    if (extras == nullptr || !extras->is_object()) return false;
    for (const auto& [name, value] : extras->items()) {
        const bool is_off = value.is_null() || (value.is_boolean() && !value.get<bool>());
        if (!is_off && (suggestsFlow(name) || (value.is_string() && suggestsFlow(value.get<std::string>()))))
            return true;
    }
    return false;
}

/// Returns whether normal maps are declared as green-down: models for Microsoft Flight Simulator do so in `asset` or in
/// a material.
bool declaresGreenDown(const Json& object) {
    const Json* extension = findExtension(object, "ASOBO_normal_map_convention");
    const Json* convention =
        extension == nullptr || !extension->is_object() ? nullptr : findMember(*extension, "tangent_space_convention");
    return convention != nullptr && convention->is_string() && convention->text() == "DirectX";
}

std::string materialName(const Document& document, std::size_t material) {
    return readString(rootArray(document, "materials")[material], "name", join("/materials", material));
}

/// Collects the uses of one material.
class MaterialUses {
  public:
    MaterialUses(const Document& document, std::size_t material, bool only_in_variant, std::vector<TangentUse>& uses)
        : document_(document), material_(material), only_in_variant_(only_in_variant), uses_(uses),
          first_(uses.size()) {}

    /// Collects the textures of unknown extensions that are named like normal maps.
    void collectUnknown() {
        const Json& material = rootArray(document_, "materials")[material_];
        for (const std::string& name : extensionsOf(material)) {
            if (isKnownExtension(name)) continue;
            const std::string place = join(join(join("/materials", material_), "extensions"), name);
            forTextures(*findExtension(material, name.c_str()), place,
                        [&](const std::string& key, const Json& texture, const std::string& own_place) {
                            if (!contains(lowerAscii(key), "normal")) return false;
                            const std::string needed_by = key + " of the material extension " + name;
                            if (tryFile([&] { addReference(texture, own_place, needed_by); })) uses_.pop_back();
                            return true;
                        });
        }
    }

    void collect() {
        const Json& material = rootArray(document_, "materials")[material_];
        const std::string place = join("/materials", material_);
        const bool has_map = addTexture(material, place, "normalTexture", "normalTexture");
        // The image is not recorded: commands that change normal maps update references only in glTF materials, not in
        // VRM properties.
        if (!has_map && vrmNormalMap(document_, material_) != nullptr)
            add("normalTexture", join("/extensions/VRM/materialProperties", material_) + "/textureProperties/_BumpMap");
        if (isUnlit(document_, material_)) {
            // The uses are discarded; they were read because malformed textures are rejected for unlit materials too.
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
        if (const Json* anisotropy = readObject(*extensions, "KHR_materials_anisotropy", extension_place))
            addAnisotropy(*anisotropy, join(extension_place, "KHR_materials_anisotropy"));
    }

  private:
    TangentUse& add(std::string needed_by, std::string place) {
        TangentUse& use = uses_.emplace_back();
        use.needed_by = std::move(needed_by);
        use.place = std::move(place);
        use.material = material_;
        use.material_name = materialName(document_, material_);
        use.only_in_variant = only_in_variant_;
        return use;
    }

    /// Adds the use of the texture that `object` references by `key`. Returns false if there is no such member.
    bool addTexture(const Json& object, const std::string& place, const char* key, const char* needed_by) {
        const Json* texture = readObject(object, key, place);
        if (texture == nullptr) return false;
        addReference(*texture, join(place, key), needed_by);
        return true;
    }

    void addReference(const Json& texture, std::string place, std::string needed_by) {
        TangentUse& use = add(std::move(needed_by), std::move(place));
        const TextureReading reading = readTexture(document_, texture, use.place);
        use.uv_set = reading.uv_set;
        use.transform = reading.transform;
        use.image = reading.image;
        use.wrap_u = reading.wrap_u;
        use.wrap_v = reading.wrap_v;
        use.reads_levels = reading.reads_levels;
        // A scale that is not a number is ignored, as in viewers: tangents do not depend on it.
        if (const Json* scale = findMember(texture, "scale"); scale != nullptr && scale->is_number())
            use.scale = scale->get<double>();
        use.is_declared_down = declaresGreenDown(rootArray(document_, "materials")[material_]);
        if (const Json* asset = findMember(document_.json, "asset"); asset != nullptr && !use.is_declared_down)
            use.is_declared_down = declaresGreenDown(*asset);
    }

    void addAnisotropy(const Json& anisotropy, const std::string& place) {
        if (addTexture(anisotropy, place, "anisotropyTexture", "anisotropy")) return;
        if (readNumber(anisotropy, "anisotropyStrength", place, 0) == 0) return;
        TangentUse& use = add("anisotropy", place);
        use.has_texture = false;
        // A use without a texture has no UVs of its own and takes those of the material's first use.
        if (uses_.size() - 1 == first_) return;
        use.uv_set = uses_[first_].uv_set;
        use.transform = uses_[first_].transform;
    }

    const Document& document_;
    std::size_t material_;
    bool only_in_variant_;
    std::vector<TangentUse>& uses_;
    std::size_t first_;  ///< index of the first use of this material
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
        // Exporters keep mappings to deleted materials; viewers then use the primitive's own material.
        const std::uint64_t material = readWhole(mappings[i], "material", join(place + "/mappings", i), count);
        if (material >= count) continue;
        const auto index = static_cast<std::size_t>(material);
        if (seen.insert(index).second) materials.push_back(index);
    }
    return materials;
}

std::vector<TangentUse> tangentUses(const Document& document, const Primitive& primitive) {
    std::vector<TangentUse> uses;
    if (primitive.material) MaterialUses(document, *primitive.material, false, uses).collect();
    for (const std::size_t material : variantMaterials(document, primitive)) {
        if (material != primitive.material) MaterialUses(document, material, true, uses).collect();
    }
    // Textures determine the direction of tangents, so uses before the first texture (only a factor) take its UVs.
    const auto texture = std::find_if(uses.begin(), uses.end(), [](const TangentUse& use) { return use.has_texture; });
    if (texture == uses.end()) return uses;
    for (auto use = uses.begin(); use != texture; ++use) {
        use->uv_set = texture->uv_set;
        use->transform = texture->transform;
    }
    return uses;
}

std::vector<TangentUse> unknownNormalMaps(const Document& document, const Primitive& primitive) {
    std::vector<TangentUse> uses;
    if (primitive.material) MaterialUses(document, *primitive.material, false, uses).collectUnknown();
    for (const std::size_t material : variantMaterials(document, primitive)) {
        if (material != primitive.material) MaterialUses(document, material, true, uses).collectUnknown();
    }
    return uses;
}

std::string otherTangentReader(const Document& document, const Primitive& primitive) {
    std::vector<std::size_t> materials = variantMaterials(document, primitive);
    if (primitive.material) materials.insert(materials.begin(), *primitive.material);
    for (const std::size_t material : materials) {
        const Json& object = rootArray(document, "materials")[material];
        for (const std::string& name : extensionsOf(object)) {
            if (!isKnownExtension(name)) return "the material extension " + name;
        }
        if (mentionsFlow(object)) return "extras of the material";
    }
    const Json& mesh = document.json["meshes"][primitive.mesh];
    const Json& object = mesh["primitives"][primitive.index];
    if (mentionsFlow(object)) return "extras of the primitive";
    if (mentionsFlow(mesh)) return "extras of the mesh";
    for (const auto& [name, accessor] : primitive.attributes) {
        if (name[0] == '_' && !isPackedAttribute(name) && suggestsFlow(name)) return "the attribute " + name;
    }
    for (const std::string& name : extensionsOf(object)) {
        if (suggestsFlow(name)) return "the extension " + name;
    }
    return {};
}

bool isUnlit(const Document& document, std::size_t material) {
    const Json& object = rootArray(document, "materials")[material];
    if (findExtension(object, "KHR_materials_unlit") == nullptr || vrmNormalMap(document, material) != nullptr)
        return false;
    const std::vector<std::string> names = extensionsOf(object);
    return std::none_of(names.begin(), names.end(), [&](const std::string& name) {
        if (std::find(kOverridesUnlit.begin(), kOverridesUnlit.end(), name) != kOverridesUnlit.end()) return true;
        return !isKnownExtension(name) && namesNormalMap(*findExtension(object, name.c_str()));
    });
}

SurfaceKind surfaceKind(const Document& document, const Primitive& primitive) {
    std::vector<std::size_t> materials = variantMaterials(document, primitive);
    if (primitive.material) materials.push_back(*primitive.material);
    const auto all = [&](auto&& test) {
        return !materials.empty() && std::all_of(materials.begin(), materials.end(), test);
    };
    const auto is_double_sided = [&](std::size_t material) {
        const Json* value = findMember(rootArray(document, "materials")[material], "doubleSided");
        return value != nullptr && value->is_boolean() && value->get<bool>();
    };
    return {.is_unlit = all([&](std::size_t material) { return isUnlit(document, material); }),
            .is_double_sided = all(is_double_sided)};
}

std::string materialName(const Document& document, const Primitive& primitive) {
    return primitive.material ? materialName(document, *primitive.material) : std::string();
}

// Notes on conflicting textures, on texture transforms, and on their animations.

namespace {

/// Maximum number of notes per primitive: a file may have any number of variants.
constexpr std::size_t kMaxDifferences = 8;

/// Returns why tangents for `first` do not fit `other`.
std::string difference(const TangentUse& first, const TangentUse& other) {
    if (first.uv_set != other.uv_set) {
        return "follow TEXCOORD_" + std::to_string(first.uv_set) + " for " + textureName(first) + ", but " +
               textureName(other) + " uses TEXCOORD_" + std::to_string(other.uv_set);
    }
    return "fit the KHR_texture_transform of " + textureName(first) + ", but " + textureName(other) +
           " is rotated or mirrored differently";
}

void addDifferences(const std::vector<TangentUse>& uses, TextureTransform reading, std::vector<std::string>& notes) {
    std::size_t count = 0;
    for (const TangentUse& use : uses) {
        if (haveSameTangents(uses[0], use, reading) || ++count > kMaxDifferences) continue;
        notes.push_back("the tangents " + difference(uses[0], use));
    }
    if (count > kMaxDifferences)
        notes.push_back("the tangents do not fit " + std::to_string(count - kMaxDifferences) + " more textures");
}

void addTransform(const TangentUse& use, TextureTransform reading, std::vector<std::string>& notes) {
    const UvMatrix matrix = uvMatrixOf(use, TextureTransform::apply);
    if (matrix.isIdentity()) return;
    notes.push_back(kTransformNote + std::string(matrix.mirrors() ? "mirrors " : "rotates ") + textureName(use) +
                    (reading == TextureTransform::apply
                         ? ": the tangents follow the transformed UVs"
                         : ": as requested, the tangents follow the UVs before the transform"));
}

void addAnimations(const std::vector<TangentUse>& uses, const std::set<std::string>& animated,
                   std::vector<std::string>& notes) {
    for (const TangentUse& use : uses) {
        const std::string transform = use.place + "/extensions/KHR_texture_transform/";
        if (animated.count(transform + "rotation") == 0 && animated.count(transform + "scale") == 0) continue;
        notes.push_back("an animation changes the KHR_texture_transform of " + textureName(use) +
                        ": the tangents match only the static transform in the material");
        return;
    }
}

}  // namespace

UvMatrix uvMatrixOf(const TangentUse& use, TextureTransform reading) {
    if (reading == TextureTransform::ignore) return {};
    return uvMatrix(use.transform.rotation, use.transform.scale[0], use.transform.scale[1]);
}

bool haveSameTangents(const TangentUse& a, const TangentUse& b, TextureTransform reading) {
    return a.uv_set == b.uv_set && uvMatrixOf(a, reading) == uvMatrixOf(b, reading);
}

std::set<std::string> animatedPointers(const Document& document) {
    std::set<std::string> pointers;
    for (const Json& animation : rootArray(document, "animations")) {
        const Json* channels = findMember(animation, "channels");
        if (channels == nullptr || !channels->is_array()) continue;
        for (const Json& channel : *channels) {
            const Json* target = findMember(channel, "target");
            const Json* extension = target == nullptr ? nullptr : findExtension(*target, "KHR_animation_pointer");
            const Json* pointer = extension == nullptr ? nullptr : findMember(*extension, "pointer");
            if (pointer != nullptr && pointer->is_string()) pointers.insert(pointer->get<std::string>());
        }
    }
    return pointers;
}

std::vector<std::string> notesOf(const std::vector<TangentUse>& uses, const std::set<std::string>& animated,
                                 TextureTransform reading, bool computed) {
    std::vector<std::string> notes;
    if (uses.empty()) return notes;
    if (computed) addTransform(uses[0], reading, notes);
    addDifferences(uses, reading, notes);
    addAnimations(uses, animated, notes);
    return notes;
}

}  // namespace tspace::gltf
