// SPDX-License-Identifier: MIT
#include "model/gltf/read_scene.h"

#include <set>

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
        if (hasTriangles(primitive.mode) && !result.positions.empty()) result.corners = arrays_.corners(primitive);
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

    /// Empty where the list has no such attribute. `place`: that of the list.
    SharedArray<Vec3> vec3(const AttributeList& list, const char* name, const std::string& place) {
        const auto index = findAttribute(list, name);
        return index ? arrays_.vec3(*index, join(place, name)) : SharedArray<Vec3>();
    }

    const Document& document_;
    DecodedArrays& arrays_;
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

Scene sceneOf(const Document& document, DecodedArrays& arrays, std::span<const Primitive> primitives) {
    Scene scene;
    scene.warnings = document.warnings;
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
