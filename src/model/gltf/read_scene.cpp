// SPDX-License-Identifier: MIT
#include "model/gltf/read_scene.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "core/base/numbers.h"
#include "images/image.h"
#include "model/gltf/accessor.h"
#include "model/gltf/component_rules.h"
#include "model/gltf/document.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/nodes.h"
#include "model/gltf/packed_frames.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace tspace::gltf {

// Materials for rendering, and transforms of nodes.

namespace {

std::optional<TextureReading> readOwnTexture(const Document& document, const Json& object, const char* key,
                                             const std::string& place) {
    const Json* texture = readObject(object, key, place);
    if (texture == nullptr) return {};
    return readTexture(document, *texture, join(place, key));
}

/// Returns text such as "normalized 8-bit unsigned integers".
std::string componentText(const Accessor& accessor) {
    if (accessor.component == ComponentType::f32) return "floats";
    const bool is_signed = accessor.component == ComponentType::i8 || accessor.component == ComponentType::i16;
    return std::string(accessor.normalized ? "normalized " : "") + std::to_string(8 * bytesOf(accessor.component)) +
           "-bit " + (is_signed ? "signed" : "unsigned") + " integers" +
           (accessor.normalized ? "" : " that are not normalized");
}

/// Reads the first inverse bind matrix of a skin; the identity if there is none, as the specification requires.
Affine readFirstBind(const Document& document, const Json& skin, const std::string& place) {
    const std::size_t count = rootArray(document, "accessors").size();
    const auto index = readIndex(skin, "inverseBindMatrices", place, count, "accessor");
    if (!index) return {};
    const Accessor accessor = readAccessor(document, *index);
    if (accessor.component != ComponentType::f32 || accessor.component_count != 16 || accessor.count == 0) return {};
    const auto elements = hasData(document, accessor) ? viewElements(document, accessor) : std::nullopt;
    if (!elements) return {};
    float m[16];
    for (std::size_t i = 0; i < 16; ++i) m[i] = loadLittleEndian<float>(elements->data + i * sizeof(float));
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

/// Returns the transform with which the first joint of the node's skin places a mesh; nullopt if the node has no skin
/// or the skin has no joints.
std::optional<Affine> boundPlace(const Document& document, const Nodes& nodes, std::size_t node) {
    const Json& skins = rootArray(document, "skins");
    const auto skin = readIndex(nodes[node], "skin", join("/nodes", node), skins.size(), "skin");
    if (!skin) return {};
    const std::string place = join("/skins", *skin);
    const Json& joints = readArray(skins[*skin], "joints", place, false);
    if (joints.empty()) return {};
    const std::size_t joint =
        toIndex(joints[0], join(join(place, "joints"), 0), rootArray(document, "nodes").size(), "node");
    return compose(nodes.world(joint), readFirstBind(document, skins[*skin], place));
}

}  // namespace

SurfaceLook readLook(const Document& document, const Primitive& primitive) {
    SurfaceLook look;
    if (!primitive.material) return look;
    const Json& material = rootArray(document, "materials")[*primitive.material];
    const std::string place = join("/materials", *primitive.material);
    if (const Json* metal = readObject(material, "pbrMetallicRoughness", place)) {
        const std::string metal_place = join(place, "pbrMetallicRoughness");
        double color[4] = {1, 1, 1, 1};
        readNumbers(*metal, "baseColorFactor", metal_place, color);
        for (std::size_t i = 0; i < 4; ++i) look.base_color[i] = static_cast<float>(std::clamp(color[i], 0.0, 1.0));
        look.base_texture = readOwnTexture(document, *metal, "baseColorTexture", metal_place);
    }
    look.normal_texture = readOwnTexture(document, material, "normalTexture", place);
    if (look.normal_texture)
        look.normal_scale = readNumber(material["normalTexture"], "scale", join(place, "normalTexture"), 1);
    if (readString(material, "alphaMode", place) == "MASK")
        look.alpha_cutoff = readNumber(material, "alphaCutoff", place, 0.5);
    look.is_double_sided = readBool(material, "doubleSided", place, false);
    look.is_unlit = isUnlit(document, *primitive.material);
    look.is_blended = readString(material, "alphaMode", place) == "BLEND";
    return look;
}

void readMetalAndEmission(const Document& document, const Primitive& primitive, SurfaceLook& look) {
    if (!primitive.material) return;
    const Json& material = rootArray(document, "materials")[*primitive.material];
    const std::string place = join("/materials", *primitive.material);
    look.metalness = 1;
    if (const Json* metal = readObject(material, "pbrMetallicRoughness", place)) {
        const std::string metal_place = join(place, "pbrMetallicRoughness");
        look.metalness = readNumber(*metal, "metallicFactor", metal_place, 1);
        look.roughness = readNumber(*metal, "roughnessFactor", metal_place, 1);
        look.metal_texture = readOwnTexture(document, *metal, "metallicRoughnessTexture", metal_place);
    }
    readNumbers(material, "emissiveFactor", place, look.emission);
    if (const Json* strength = findExtension(material, "KHR_materials_emissive_strength"))
        look.emission_strength = std::max(0.0, readNumber(*strength, "emissiveStrength", join(place, "extensions"), 1));
    look.emission_texture = readOwnTexture(document, material, "emissiveTexture", place);
}

std::vector<ScenePlacement> readPlacements(const Document& document, std::span<const Primitive> primitives) {
    const std::size_t mesh_count = rootArray(document, "meshes").size();
    std::vector<std::vector<std::size_t>> of_mesh(mesh_count);
    for (std::size_t i = 0; i < primitives.size(); ++i) of_mesh[primitives[i].mesh].push_back(i);
    Nodes nodes(document);
    std::vector<ScenePlacement> placements;
    for (const std::size_t node : nodes.shown()) {
        const auto mesh = readIndex(nodes[node], "mesh", join("/nodes", node), mesh_count, "mesh");
        if (!mesh) continue;
        const Affine place = boundPlace(document, nodes, node).value_or(nodes.world(node));
        const std::vector<Affine> instances = readInstances(document, nodes[node], join("/nodes", node));
        document.memory->take(instances.size() * of_mesh[*mesh].size() * sizeof(ScenePlacement), join("/nodes", node));
        // A name that is not a string is ignored.
        const Json* const given = findMember(nodes[node], "name");
        const std::string name = given != nullptr && given->is_string() ? given->get<std::string>() : std::string();
        for (const Affine& instance : instances) {
            for (const std::size_t primitive : of_mesh[*mesh])
                placements.push_back({primitive, compose(place, instance), name, node, nodes.isVisible(node)});
        }
    }
    if (placements.empty()) {
        for (std::size_t i = 0; i < primitives.size(); ++i) placements.push_back({i});
    }
    return placements;
}

namespace {

/// Adds the weighted morph target offsets of one attribute.
void addOffsets(const ScenePrimitive& primitive, std::span<const double> weights,
                SharedArray<Vec3> SceneMorphTarget::*attribute, std::vector<Vec3>& sums) {
    for (std::size_t i = 0; i < primitive.morph_targets.size() && i < weights.size(); ++i) {
        const SharedArray<Vec3>& offsets = primitive.morph_targets[i].*attribute;
        if (weights[i] == 0 || offsets.size() != primitive.positions.size()) continue;
        sums.resize(primitive.positions.size());
        for (std::size_t v = 0; v < sums.size(); ++v)
            sums[v] = toFloat(toDouble(sums[v]) + weights[i] * toDouble(offsets[v]));
    }
}

/// Returns the morph target weights of a node, or those of its mesh if the node has none.
std::vector<double> morphWeights(const Json& node, const std::string& node_place, const Json& mesh,
                                 const std::string& mesh_place) {
    const bool is_own = findMember(node, "weights") != nullptr;
    std::vector<double> weights;
    for (const Json& weight : readArray(is_own ? node : mesh, "weights", is_own ? node_place : mesh_place, false))
        weights.push_back(weight.is_number() ? weight.get<double>() : 0.0);
    return weights;
}

/// Returns the matrices of a skin's joints, from the rest pose of the mesh to world space; empty if they cannot be
/// read.
std::vector<Affine> jointMatrices(const Document& document, const Nodes& nodes, const Json& skin,
                                  const std::string& place) {
    const std::size_t node_count = rootArray(document, "nodes").size();
    const Json& joints = readArray(skin, "joints", place, false);
    std::vector<Affine> matrices;
    for (std::size_t i = 0; i < joints.size(); ++i)
        matrices.push_back(nodes.world(toIndex(joints[i], join(join(place, "joints"), i), node_count, "node")));
    const auto index =
        readIndex(skin, "inverseBindMatrices", place, rootArray(document, "accessors").size(), "accessor");
    if (!index) return matrices;
    const Accessor accessor = readAccessor(document, *index);
    if (accessor.component != ComponentType::f32 || accessor.component_count != 16 ||
        accessor.count < matrices.size() || !hasData(document, accessor))
        return {};
    const Bytes elements = copyElements(document, accessor);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        float m[16];
        for (std::size_t k = 0; k < 16; ++k)
            m[k] = loadLittleEndian<float>(elements.data() + i * accessor.element_bytes + k * sizeof(float));
        matrices[i] =
            compose(matrices[i], {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}});
    }
    return matrices;
}

/// Returns the weighted joint matrix of each vertex; empty if the primitive has no joints.
std::vector<Affine> blendedBones(DecodedArrays& arrays, const Primitive& primitive, std::span<const Affine> joints) {
    const auto joints_at = primitive.find("JOINTS_0"), weights_at = primitive.find("WEIGHTS_0");
    if (!joints_at || !weights_at || joints.empty()) return {};
    const std::string place = join(primitive.place(), "attributes");
    const SharedArray<Vec4> numbers = arrays.vec4(*joints_at, join(place, "JOINTS_0"));
    const SharedArray<Vec4> weights = arrays.vec4(*weights_at, join(place, "WEIGHTS_0"));
    if (numbers.size() != primitive.vertex_count || weights.size() != numbers.size()) return {};
    std::vector<Affine> result(numbers.size(), Affine{{}, {}, {}, {}});
    for (std::size_t v = 0; v < result.size(); ++v) {
        const float number[4] = {numbers[v].x, numbers[v].y, numbers[v].z, numbers[v].w};
        double weight[4] = {weights[v].x, weights[v].y, weights[v].z, weights[v].w};
        // The weights of CesiumMan have sums down to 0.18, which renderers normalize to 1.
        const double all = weight[0] + weight[1] + weight[2] + weight[3];
        for (double& part : weight) part = all > 0 ? part / all : 0;
        if (!(all > 0)) weight[0] = 1;
        for (std::size_t k = 0; k < 4; ++k) {
            if (weight[k] == 0 || !(number[k] >= 0 && number[k] < static_cast<float>(joints.size()))) continue;
            const Affine& joint = joints[static_cast<std::size_t>(number[k])];
            Affine& sum = result[v];
            sum.x = sum.x + weight[k] * joint.x;
            sum.y = sum.y + weight[k] * joint.y;
            sum.z = sum.z + weight[k] * joint.z;
            sum.origin = sum.origin + weight[k] * joint.origin;
        }
    }
    return result;
}

}  // namespace

std::vector<ScenePose> readPoses(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives,
                                 const DrawnScene& drawn) {
    const Json& meshes = rootArray(document, "meshes");
    const Json& skins = rootArray(document, "skins");
    std::vector<std::vector<std::size_t>> of_mesh(meshes.size());
    for (std::size_t i = 0; i < primitives.size(); ++i) of_mesh[primitives[i].mesh].push_back(i);
    Nodes nodes(document);
    std::vector<ScenePose> poses;
    for (const std::size_t node : nodes.shown()) {
        const std::string node_place = join("/nodes", node);
        const auto mesh = readIndex(nodes[node], "mesh", node_place, meshes.size(), "mesh");
        const auto is_here = [&] {
            return poses.size() < drawn.placements.size() && drawn.placements[poses.size()].node == node;
        };
        if (!mesh || !is_here()) continue;
        const auto skin = readIndex(nodes[node], "skin", node_place, skins.size(), "skin");
        const std::vector<double> weights =
            morphWeights(nodes[node], node_place, meshes[*mesh], join("/meshes", *mesh));
        const std::vector<Affine> joints =
            skin ? jointMatrices(document, nodes, skins[*skin], join("/skins", *skin)) : std::vector<Affine>();
        for (const std::size_t i : of_mesh[*mesh]) {
            const ScenePrimitive& primitive = drawn.scene.primitives[i];
            const bool is_moved = !joints.empty() || std::any_of(weights.begin(), weights.end(),
                                                                 [](double weight) { return weight != 0; });
            constexpr std::uint64_t kVertexBytes = sizeof(Affine) + 3 * sizeof(Vec3);
            document.memory->take(sizeof(ScenePose) + (is_moved ? kVertexBytes * primitive.positions.size() : 0),
                                  primitive.place);
            ScenePose& pose = poses.emplace_back();
            if (!is_moved) continue;
            addOffsets(primitive, weights, &SceneMorphTarget::positions, pose.positions);
            addOffsets(primitive, weights, &SceneMorphTarget::normals, pose.normals);
            addOffsets(primitive, weights, &SceneMorphTarget::tangents, pose.tangents);
            pose.bones = blendedBones(arrays, primitives[i], joints);
        }
        while (is_here()) {
            ScenePose copy = poses[poses.size() - of_mesh[*mesh].size()];
            document.memory->take(
                sizeof(ScenePose) + copy.bones.size() * sizeof(Affine) + 3 * copy.positions.size() * sizeof(Vec3),
                node_place);
            poses.push_back(std::move(copy));
        }
    }
    if (poses.empty()) poses.resize(primitives.size());
    return poses;
}

void setPlaces(const Document& document, std::span<const Primitive> primitives, Scene& scene) {
    std::vector<ScenePlacement> placements;
    if (tryFile([&] { placements = readPlacements(document, primitives); })) return;
    for (const ScenePlacement& placement : placements)
        scene.primitives[placement.primitive].places.push_back(placement.to_world);
}

namespace {

using LookTexture = std::optional<TextureReading> SurfaceLook::*;

std::set<std::size_t> imagesOf(std::span<const SurfaceLook> looks, std::initializer_list<LookTexture> textures) {
    std::set<std::size_t> images;
    for (const SurfaceLook& look : looks) {
        for (const LookTexture texture : textures) {
            if (look.*texture && (look.*texture)->image) images.insert(*(look.*texture)->image);
        }
    }
    return images;
}

}  // namespace

std::set<std::size_t> imagesOf(std::span<const SurfaceLook> looks) {
    return imagesOf(looks, {&SurfaceLook::base_texture, &SurfaceLook::normal_texture});
}

std::set<std::size_t> materialImagesOf(std::span<const SurfaceLook> looks) {
    return imagesOf(looks, {&SurfaceLook::base_texture, &SurfaceLook::metal_texture, &SurfaceLook::emission_texture});
}

namespace {

/// Higher UV sets are ignored: no renderer supports so many, and a file may declare billions.
constexpr std::size_t kMaxUvSets = 64;

class PrimitiveLoader {
  public:
    PrimitiveLoader(const Document& document, DecodedArrays& arrays) : document_(document), arrays_(arrays) {}

    ScenePrimitive load(const Primitive& primitive) {
        ScenePrimitive result;
        result.place = primitive.place();
        result.mesh = primitive.mesh;
        result.primitive = primitive.index;
        result.mesh_name = primitive.mesh_name;
        result.material_name = materialName(document_, primitive);
        result.mode = modeName(primitive.mode);
        result.uses = tangentUses(document_, primitive);
        result.unknown_maps = unknownNormalMaps(document_, primitive);
        result.other_reader = otherTangentReader(document_, primitive);
        const SurfaceKind kind = surfaceKind(document_, primitive);
        result.is_unlit = kind.is_unlit;
        result.is_double_sided = kind.is_double_sided;
        loadAttributes(primitive, result);
        for (const UnreadableTangents& tangents : primitive.unreadable_tangents)
            result.tangent_faults.push_back({tangents.target, tangents.why});
        for (const AttributeFault& fault : primitive.attribute_faults)
            result.attribute_faults.push_back(
                {fault.name, fault.target, fault.why, fault.repair, primitive.vertex_count});
        addComponentFaults(primitive, result);
        result.tangents_not_read = result.tangents.empty() && document_.may_hide_tangents;
        for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
            const AttributeList& list = primitive.targets[i];
            const std::string place = join(join(result.place, "targets"), i);
            result.morph_targets.push_back({.positions = vec3(list, "POSITION", place),
                                            .normals = normals(primitive, list, place),
                                            .tangents = vec3(list, "TANGENT", place)});
        }
        for (const StoredPacking& stored : findPacked(document_, primitive))
            result.packed.push_back(loadPacked(primitive, stored));
        if (hasTriangles(primitive.mode) && !result.positions.empty()) result.corners = arrays_.corners(primitive);
        return result;
    }

  private:
    void addComponentFaults(const Primitive& primitive, ScenePrimitive& result) const {
        for (const auto& [name, index] : primitive.attributes) {
            const Accessor accessor = readAccessor(document_, index);
            const ComponentRule* const rule = violatedRule(accessor, name);
            if (rule == nullptr) continue;
            if (name != "NORMAL") {
                result.component_faults.push_back({name, componentText(accessor), rule->allowed, accessor.count});
                continue;
            }
            result.attribute_faults.push_back(
                {.name = name,
                 .why =
                     "are unsigned integers, which glTF does not allow. They are used unchanged, so no normal points "
                     "toward -x, -y or -z; if they encode (n + 1) / 2, all of them are wrong",
                 .vertex_count = primitive.vertex_count});
        }
    }

    void loadAttributes(const Primitive& primitive, ScenePrimitive& result) {
        const AttributeList& list = primitive.attributes;
        const std::string place = join(result.place, "attributes");
        result.positions = vec3(list, "POSITION", place);
        if (const auto index = primitive.find("POSITION"))
            result.position_step = stepOf(readAccessor(document_, *index));
        result.normals = normals(primitive, list, place);
        result.normal_scales = primitive.normal_scales;
        if (const auto index = primitive.find("TANGENT"))
            result.tangents = arrays_.vec4(*index, join(place, "TANGENT"));
        for (std::size_t set = 0; set < kMaxUvSets; ++set) {
            const std::string name = "TEXCOORD_" + std::to_string(set);
            const auto index = primitive.find(name);
            if (!index) continue;
            SharedArray<Vec2> uvs = arrays_.vec2(*index, join(place, name));
            if (uvs.empty()) continue;
            result.uv_sets.resize(set + 1);
            result.uv_sets[set] = std::move(uvs);
        }
    }

    ScenePacked loadPacked(const Primitive& primitive, const StoredPacking& stored) {
        ScenePacked packed{stored.layout->format, stored.attribute, stored.fault};
        if (!stored.fault.empty()) return packed;
        packed.words = arrays_.packedWords(primitive, *stored.layout);
        return packed;
    }

    /// Returns an attribute, or an empty array if the list does not contain it. `place`: JSON pointer of the list.
    SharedArray<Vec3> vec3(const AttributeList& list, const char* name, const std::string& place) {
        const auto index = findAttribute(list, name);
        return index ? arrays_.vec3(*index, join(place, name)) : SharedArray<Vec3>();
    }

    SharedArray<Vec3> normals(const Primitive& primitive, const AttributeList& list, const std::string& place) {
        const auto index = findAttribute(list, "NORMAL");
        return index ? arrays_.normals(primitive, *index, join(place, "NORMAL")) : SharedArray<Vec3>();
    }

    const Document& document_;
    DecodedArrays& arrays_;
};

/// Returns whether the image is a TGA, which no glTF viewer shows. Imported models may reference TGA files. The
/// JavaScript module does not support TGA.
bool isUnsupportedTga([[maybe_unused]] const Document& document, [[maybe_unused]] const Bytes& bytes) {
#ifdef TSPACE_SMALL
    return false;
#else
    return !document.imported && imageFormat(bytes) == ImageFormat::tga;
#endif
}

Bytes readImageBytes(const Document& document, const Json& image, const std::string& place) {
    const auto view = readIndex(image, "bufferView", place, rootArray(document, "bufferViews").size(), "buffer view");
    if (view) {
        const BufferView range = readBufferView(document, *view);
        const Buffer& buffer = document.buffers[range.buffer];
        if (buffer.source == BufferSource::absent || range.byte_count == 0) return {};
        const auto bytes = buffer.bytes.range(range.begin, range.byte_count);
        return Bytes(bytes.begin(), bytes.end());
    }
    const std::string uri = readString(image, "uri", place);
    if (uriKind(uri) == UriKind::data) return decodeDataUri(uri, join(place, "uri")).bytes;
    if (uri.empty()) return {};
    const std::string why = document.files.whyNotRead(uri, join(place, "uri"));
    if (!why.empty()) failFile(ErrorCode::invalidFile, why, join(place, "uri"));
    return document.files.read(document.files.resolve(uri, join(place, "uri")));
}

}  // namespace

Bytes tryReadImage(const Document& document, std::size_t image) {
    Bytes bytes;
    tryFile([&] { bytes = readImageBytes(document, rootArray(document, "images")[image], join("/images", image)); });
    if (isUnsupportedTga(document, bytes)) return {};
    return bytes;
}

void readImages(const Document& document, Scene& scene, bool with_unknown_maps) {
    std::set<std::size_t> wanted;
    const auto add = [&](const std::vector<TangentUse>& uses) {
        for (const TangentUse& use : uses) {
            if (use.image) wanted.insert(*use.image);
        }
    };
    for (const ScenePrimitive& primitive : scene.primitives) {
        add(primitive.uses);
        if (with_unknown_maps) add(primitive.unknown_maps);
    }
    readImages(document, wanted, scene);
}

void readImages(const Document& document, const std::set<std::size_t>& wanted, Scene& scene) {
    std::set<std::string> files;
    const Json& list = rootArray(document, "images");
    for (const std::size_t i : wanted) {
        const std::string place = join("/images", i);
        const std::string uri = readString(list[i], "uri", place);
        const std::optional<Error> failure = tryFile([&] {
            const Bytes bytes = readImageBytes(document, list[i], place);
            if (isUnsupportedTga(document, bytes)) {
                scene.images[i].why_empty = "glTF does not allow TGA images";
                return;
            }
            // A file that several entries reference is charged once.
            const bool is_file = !uri.empty() && uriKind(uri) == UriKind::path;
            if (is_file && files.insert(uri).second) document.memory->allow(bytes.size());
            document.memory->take(bytes.size(), place);
            scene.images[i].bytes.assign(bytes.begin(), bytes.end());
        });
        if (!failure) continue;
        // A missing image is not an error; only tooLarge is passed on.
        if (failure->code == ErrorCode::tooLarge) throw FileError{*failure};
        scene.images[i].why_empty = failure->message;
        scene.images[i].is_unavailable = !uri.empty() && !document.files.areNone();
    }
}

Scene sceneOf(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives) {
    Scene scene;
    scene.warnings = document.warnings;
    for (const auto& warning : {document.scaled_normals, document.invalid_normals}) {
        if (warning) scene.normals_warnings.push_back(warning->number);
    }
    scene.memory = document.memory;
    scene.format = formatOf(document);
    scene.generator = generatorOf(document);
    PrimitiveLoader loader(document, arrays);
    for (const Primitive& primitive : primitives) scene.primitives.push_back(loader.load(primitive));
    const Json& list = rootArray(document, "images");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string place = join("/images", i);
        SceneImage& image = scene.images.emplace_back();
        image.name = readString(list[i], "name", place);
        const std::string uri = readString(list[i], "uri", place);
        if (uriKind(uri) != UriKind::data) image.uri = uri;
    }
    return scene;
}

}  // namespace tspace::gltf
