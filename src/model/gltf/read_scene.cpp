// SPDX-License-Identifier: MIT
#include "model/gltf/read_scene.h"

#include <map>
#include <set>
#include <tuple>

#include "model/gltf/accessor.h"
#include "model/gltf/document.h"
#include "model/gltf/material_needs.h"
#include "model/gltf/read_packed.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace tspace::gltf {

namespace {

/// Sets beyond are not looked at: no renderer has so many, and a file may claim billions.
constexpr std::size_t kMaxUvSets = 64;

/// Attributes as float vectors, each accessor decoded once.
template <class Vec>
class VectorCache {
  public:
    using Decode = std::vector<Vec> (*)(const Document&, const Accessor&, const std::string& place);
    explicit VectorCache(Decode decode) : decode_(decode) {}

    /// Empty where the list has no such attribute. `place`: that of the list.
    SharedArray<Vec> read(const Document& document, const AttributeList& list, const std::string& name,
                          const std::string& place, MemoryBudget& budget) {
        for (const auto& [key, index] : list) {
            if (key != name) continue;
            const auto found = arrays_.find(index);
            if (found != arrays_.end()) return found->second;
            const Accessor accessor = readAccessor(document, index);
            budget.take(std::uint64_t{accessor.count} * sizeof(Vec), accessor.place());
            return arrays_.emplace(index, decode_(document, accessor, join(place, name))).first->second;
        }
        return {};
    }

  private:
    Decode decode_;
    std::map<std::size_t, SharedArray<Vec>> arrays_ = {};
};

/// Between neighbouring numbers of an accessor of whole numbers; 0 for floats.
double stepOf(const Accessor& accessor) {
    if (accessor.component == ComponentType::f32) return 0;
    if (!accessor.normalized) return 1;
    switch (accessor.component) {
        case ComponentType::i8:
            return 1.0 / 127;
        case ComponentType::u8:
            return 1.0 / 255;
        case ComponentType::i16:
            return 1.0 / 32767;
        default:
            return 1.0 / 65535;
    }
}

class PrimitiveLoader {
  public:
    explicit PrimitiveLoader(const Document& document) : document_(document), budget_(*document.memory) {}

    ScenePrimitive load(const Primitive& primitive) {
        ScenePrimitive result;
        result.place = primitive.place();
        result.mesh = primitive.mesh;
        result.primitive = primitive.index;
        result.mesh_name = primitive.mesh_name;
        result.material_name = materialName(document_, primitive);
        result.mode = modeName(primitive.mode);
        result.uses = tangentUses(document_, primitive);
        result.other_reader = otherTangentReader(document_, primitive);
        const SurfaceKind kind = surfaceKind(document_, primitive);
        result.is_unlit = kind.is_unlit;
        result.is_double_sided = kind.is_double_sided;
        loadAttributes(primitive, result);
        for (const UnreadableTangents& tangents : primitive.unreadable_tangents)
            result.tangent_faults.push_back({tangents.target, tangents.why});
        result.tangents_not_read = result.tangents.empty() && document_.may_hide_tangents;
        for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
            const AttributeList& list = primitive.targets[i];
            const std::string place = join(join(result.place, "targets"), i);
            result.morph_targets.push_back({.positions = vec3(list, "POSITION", place),
                                            .normals = vec3(list, "NORMAL", place),
                                            .tangents = vec3(list, "TANGENT", place)});
        }
        for (const StoredPacking& stored : findPacked(document_, primitive))
            result.packed.push_back(loadPacked(primitive, stored));
        if (hasTriangles(primitive.mode) && !result.positions.empty()) result.corners = corners(primitive);
        return result;
    }

  private:
    void loadAttributes(const Primitive& primitive, ScenePrimitive& result) {
        const AttributeList& list = primitive.attributes;
        const std::string place = join(result.place, "attributes");
        result.positions = vec3(list, "POSITION", place);
        if (const auto index = primitive.find("POSITION"))
            result.position_step = stepOf(readAccessor(document_, *index));
        result.normals = vec3(list, "NORMAL", place);
        result.tangents = vec4_.read(document_, list, "TANGENT", place, budget_);
        for (std::size_t set = 0; set < kMaxUvSets; ++set) {
            SharedArray<Vec2> uvs = vec2_.read(document_, list, "TEXCOORD_" + std::to_string(set), place, budget_);
            if (uvs.empty()) continue;
            result.uv_sets.resize(set + 1);
            result.uv_sets[set] = std::move(uvs);
        }
    }

    ScenePacked loadPacked(const Primitive& primitive, const StoredPacking& stored) {
        ScenePacked packed{stored.layout->format, stored.attribute, stored.fault};
        if (!stored.fault.empty()) return packed;
        std::vector<std::size_t> accessors;
        for (const PackedPart& part : stored.layout->parts) accessors.push_back(*primitive.find(part.attribute));
        auto& words = words_[accessors];
        if (words.empty()) {
            budget_.take(std::uint64_t{2} * primitive.vertex_count * frameBytes(packed.format), primitive.place());
            const Bytes bytes = readPackedWords(document_, primitive, *stored.layout);
            words = std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        }
        packed.words = words;
        return packed;
    }

    SharedArray<Vec3> vec3(const AttributeList& list, const char* name, const std::string& place) {
        return vec3_.read(document_, list, name, place, budget_);
    }

    SharedArray<std::uint32_t> corners(const Primitive& primitive) {
        const std::size_t no_indices = rootArray(document_, "accessors").size();
        const CornerKey key{primitive.indices.value_or(no_indices), primitive.vertex_count, primitive.mode};
        const auto found = corners_.find(key);
        if (found != corners_.end()) return found->second;
        takeCorners(primitive);
        return corners_.emplace(key, readTriangleCorners(document_, primitive)).first->second;
    }

    /// The corners, and what looking at them takes for a while.
    void takeCorners(const Primitive& primitive) {
        const std::uint64_t corners = std::uint64_t{3} * primitive.triangleCount();
        budget_.take(corners * sizeof(std::uint32_t), primitive.place());
        budget_.require(checkBytes(corners, primitive.vertex_count, primitive.find("TANGENT").has_value()),
                        primitive.place());
    }

    using CornerKey = std::tuple<std::size_t, std::size_t, Mode>;

    const Document& document_;
    MemoryBudget& budget_;
    VectorCache<Vec2> vec2_{decodeVec2};
    VectorCache<Vec3> vec3_{decodeVec3};
    VectorCache<Vec4> vec4_{decodeVec4};
    std::map<CornerKey, SharedArray<std::uint32_t>> corners_ = {};
    std::map<std::vector<std::size_t>, SharedArray<std::uint8_t>> words_ = {};  ///< by the accessors that hold them
};

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
    if (uri.empty() || uriKind(uri) == UriKind::otherScheme) return {};
    return document.files.read(document.files.resolve(uri, join(place, "uri")));
}

}  // namespace

Bytes tryReadImage(const Document& document, std::size_t image) {
    Bytes bytes;
    tryFile([&] { bytes = readImageBytes(document, rootArray(document, "images")[image], join("/images", image)); });
    return bytes;
}

void readImages(const Document& document, Scene& scene) {
    std::set<std::size_t> wanted;
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            if (use.image) wanted.insert(*use.image);
        }
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
            // A file that many entries name has its bytes once.
            const bool is_file = !uri.empty() && uriKind(uri) == UriKind::path;
            if (is_file && files.insert(uri).second) document.memory->allow(bytes.size());
            document.memory->take(bytes.size(), place);
            scene.images[i].bytes.assign(bytes.begin(), bytes.end());
        });
        // The geometry is none the worse for it.
        if (failure && failure->code == ErrorCode::tooLarge) throw FileError{*failure};
    }
}

Scene sceneOf(const Document& document, std::span<const Primitive> primitives) {
    Scene scene;
    scene.warnings = document.warnings;
    scene.memory = document.memory;
    scene.format = formatOf(document);
    scene.generator = generatorOf(document);
    PrimitiveLoader loader(document);
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
