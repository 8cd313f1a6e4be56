// SPDX-License-Identifier: MIT
// Converts an OBJ model to a glTF 2.0 document.
#include "model/obj/obj_writer.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/mesh/pools/unit_lattice.h"
#include "images/codecs.h"
#include "images/image.h"
#include "model/gltf/container.h"
#include "model/gltf/document_builder.h"
#include "model/io/file_error.h"
#include "model/io/named_files.h"
#include "model/io/uri.h"

namespace tspace::obj {
namespace {

namespace fs = std::filesystem;
using gltf::Json;

using gltf::ComponentType;
using gltf::DocumentBuilder;

template <class T>
std::size_t addVertices(const std::vector<T>& values, const char* type, DocumentBuilder& builder) {
    return builder.addFloats(values, values.size(), type, gltf::kVertexTarget);
}

/// Adds `count` small elements, each aligned to 4 bytes.
template <class ElementBytes>
std::size_t addRows(const ElementBytes& elements, std::size_t count, Json accessor, DocumentBuilder& builder) {
    const std::size_t element = elements.size() / count, stride = (element + 3) / 4 * 4;
    Bytes rows(count * stride, 0);
    for (std::size_t i = 0; i < count; ++i)
        std::copy_n(elements.begin() + static_cast<std::ptrdiff_t>(i * element), element,
                    rows.begin() + static_cast<std::ptrdiff_t>(i * stride));
    const std::size_t view = builder.addView(std::as_bytes(std::span(rows)), 1, gltf::kVertexTarget);
    if (stride != element) builder.json()["bufferViews"][view]["byteStride"] = stride;
    accessor["bufferView"] = view;
    accessor["count"] = count;
    return builder.append("accessors", std::move(accessor));
}

/// Adds normals or tangents.
template <class T>
std::size_t addUnits(const std::vector<T>& values, const char* type, VectorFormat format, DocumentBuilder& builder) {
    if (format == VectorFormat::float32) return addVertices(values, type, builder);
    for (const char* list : {"extensionsRequired", "extensionsUsed"})
        builder.json()[list] = Json::array({"KHR_mesh_quantization"});
    const auto component =
        static_cast<std::uint32_t>(format == VectorFormat::snorm8 ? ComponentType::i8 : ComponentType::i16);
    return addRows(packUnits(std::span<const T>(values), format), values.size(),
                   {{"componentType", component}, {"normalized", true}, {"type", type}}, builder);
}

std::size_t addPacked(const PackedAttribute& attribute, DocumentBuilder& builder) {
    Json accessor = {{"componentType", static_cast<std::uint32_t>(attribute.part.component)},
                     {"type", attribute.part.type}};
    if (attribute.part.normalized) accessor["normalized"] = true;
    const std::size_t count = attribute.elements.size() / attribute.part.byte_count;
    return addRows(attribute.elements, count, std::move(accessor), builder);
}

/// Collects the images and textures of the document: one per file, regardless of the number of uses.
class ImageBuilder {
  public:
    ImageBuilder(const Model& model, const Path& output, DocumentBuilder& builder, std::vector<std::string>& sources,
                 std::vector<std::string>& warnings)
        : names_by_uri_(!model.files.areInMemory() && isSameFile(folderOf(output), model.files.folder())),
          flipped_maps_(model.flipped_maps), named_(model.files), builder_(builder), sources_(sources),
          warnings_(warnings) {}

    /// Sets material[key] to a reference to the texture; does nothing if the image cannot be read.
    void addReference(const Texture& texture, Json& material, const char* key) {
        if (!texture.used()) return;
        const std::string name = texture.path();
        const auto flipped = flipped_maps_.find(name);
        const bool is_flipped = flipped != flipped_maps_.end() && std::string_view(key) == "normalTexture";
        const auto [entry, is_new] = textures_by_file_.emplace(std::pair(name, is_flipped), -1);
        if (is_new) entry->second = addTexture(texture, is_flipped ? &flipped->second : nullptr);
        if (entry->second >= 0) material[key] = {{"index", static_cast<unsigned>(entry->second)}};
    }

    /// Sets material[key] to a reference to an image in memory, like addReference().
    void addConverted(const Texture& like, const Bytes& bytes, Json& material, const char* key) {
        const fs::path path = Path(like.file);
        material[key] = {{"index", append(imageJson(path, bytes, mimeType(imageFormat(bytes)), false))}};
    }

  private:
    /// Adds a texture and returns its index; -1 if its image cannot be used. `flipped`: bytes that replace the file in
    /// the output; may be null.
    int addTexture(const Texture& texture, const Bytes* flipped) {
        int number = -1;
        const std::optional<Error> failure = tryFile([&] {
            const Path path = named_.resolve(texture.folder, percentEncode(texture.file), "material");
            const Bytes read = named_.read(path);
            sources_.push_back(path.string());
            const Bytes& bytes = flipped == nullptr ? read : *flipped;
            // The format is determined by content, because names can be wrong. Core glTF allows only PNG and JPEG.
            const ImageFormat format = imageFormat(bytes);
            if (format != ImageFormat::png && format != ImageFormat::jpeg) {
                warnings_.push_back("the texture '" + texture.file + "' was ignored: it is neither PNG nor JPEG");
                return;
            }
            // Viewers may show a damaged image, but not one with an invalid size.
            const ImageClaim claim = format == ImageFormat::png ? claimOfPng(bytes) : claimOfJpeg(bytes);
            if (claim.size.pixels() == 0) {
                warnings_.push_back("the texture '" + texture.file + "' was ignored: its header is invalid");
                return;
            }
            number =
                static_cast<int>(append(imageJson(path, bytes, mimeType(format), names_by_uri_ && flipped == nullptr)));
        });
        if (failure) warnings_.push_back("a texture was ignored: " + failure->message);
        return number;
    }

    /// Adds an image and its texture, which has the same index, and returns this index.
    std::size_t append(Json image) {
        return builder_.append("textures", {{"source", builder_.append("images", std::move(image))}});
    }

    Json imageJson(const fs::path& path, const Bytes& bytes, const char* type, bool names_by_uri) {
        Json image = {{"name", Path(path.stem()).string()}};
        // The URI is relative to the model's folder.
        const std::string below = names_by_uri ? pathBelow(named_.folder(), path) : "";
        if (!below.empty()) {
            image["uri"] = percentEncode(below);
        } else {
            image["mimeType"] = type;
            image["bufferView"] = builder_.addView(std::as_bytes(std::span(bytes)), 1, gltf::kNoTarget);
        }
        return image;
    }

    const bool names_by_uri_;
    const std::map<std::string, Bytes>& flipped_maps_;
    const NamedFiles& named_;
    DocumentBuilder& builder_;
    std::vector<std::string>& sources_;
    std::vector<std::string>& warnings_;
    /// index of each texture; key: path, and whether green is inverted
    std::map<std::pair<std::string, bool>, int> textures_by_file_ = {};
};

Json rgb(const Vec3& color) { return {color.x, color.y, color.z}; }

/// Returns the JSON of a material. `images` may be null: without textures.
Json materialJson(const Material& material, ImageBuilder* images) {
    Json json = Json::object();
    if (!material.name.empty()) json["name"] = material.name;
    if (!material.found) return json;
    Json surface = Json::object();
    const Vec3& color = material.base_color;
    if (material.opacity < 1 || !(color == Vec3{1, 1, 1}))
        surface["baseColorFactor"] = {color.x, color.y, color.z, material.opacity};
    if (images != nullptr) images->addReference(material.base_color_texture, surface, "baseColorTexture");
    surface["metallicFactor"] = material.metallic;
    surface["roughnessFactor"] = material.roughness;
    json["pbrMetallicRoughness"] = std::move(surface);
    if (images != nullptr && material.converted_normal_map) {
        images->addConverted(material.normal_texture, *material.converted_normal_map, json, "normalTexture");
    } else if (images != nullptr) {
        images->addReference(material.normal_texture, json, "normalTexture");
    }
    if (material.normal_scale != 1 && json.contains("normalTexture"))
        json["normalTexture"]["scale"] = material.normal_scale;
    if (!(material.emission == Vec3{})) json["emissiveFactor"] = rgb(material.emission);
    if (material.opacity < 1) json["alphaMode"] = "BLEND";
    return json;
}

/// Writes the materials of the file. Faces before any `usemtl` use the default material, which is not written.
/// Primitives without UVs get a copy without textures, because textures require UVs in glTF.
class MaterialNumbers {
  public:
    /// Adds the materials in file order, followed by copies without textures.
    MaterialNumbers(const Model& model, const std::vector<FinishedPrimitive>& primitives, ImageBuilder& images,
                    DocumentBuilder& builder, std::vector<std::string>& warnings)
        : numbers_(model.materials.size(), -1), bare_numbers_(numbers_) {
        const auto add = [&](const Material& material, ImageBuilder* textures) {
            return static_cast<int>(builder.append("materials", materialJson(material, textures)));
        };
        std::vector<std::uint64_t> bare_triangles(model.materials.size(), 0);
        std::vector<bool> has_uvs(model.materials.size(), false);
        for (const FinishedPrimitive& primitive : primitives) {
            if (!primitive.mesh.uvs.empty()) has_uvs[primitive.material] = true;
            if (primitive.mesh.uvs.empty()) bare_triangles[primitive.material] += primitive.mesh.indices.size() / 3;
        }
        for (std::size_t i = 0; i < model.materials.size(); ++i) {
            if (isDefault(model.materials[i])) continue;
            numbers_[i] = bare_numbers_[i] = add(model.materials[i], has_uvs[i] ? &images : nullptr);
        }
        for (std::size_t i = 0; i < model.materials.size(); ++i) {
            const Material& material = model.materials[i];
            const bool has_textures = material.base_color_texture.used() || material.normal_texture.used();
            if (bare_triangles[i] == 0 || !has_textures || isDefault(material)) continue;
            warnings.push_back(
                "the material '" + material.name + "' has textures, but " + std::to_string(bare_triangles[i]) +
                (bare_triangles[i] == 1 ? " triangle with this material has" : " triangles with this material have") +
                " no texture coordinates; for such triangles, the output has a copy of the material without textures");
            if (has_uvs[i]) bare_numbers_[i] = add(material, nullptr);
        }
    }

    /// Returns the index of a primitive's material; -1: the default material.
    [[nodiscard]] int of(const FinishedPrimitive& primitive) const {
        return (primitive.mesh.uvs.empty() ? bare_numbers_ : numbers_)[primitive.material];
    }

  private:
    static bool isDefault(const Material& material) { return material.name.empty() && !material.found; }

    std::vector<int> numbers_, bare_numbers_;  ///< indexed like Model::materials
};

Json primitiveJson(const FinishedPrimitive& primitive, int material, DocumentBuilder& builder) {
    const OwnedMesh& mesh = primitive.mesh;
    Json attributes = {
        {"POSITION", builder.addFloats(mesh.positions, mesh.positions.size(), "VEC3", gltf::kVertexTarget, true)}};
    if (!mesh.normals.empty()) attributes["NORMAL"] = addUnits(mesh.normals, "VEC3", primitive.normal_format, builder);
    if (!mesh.tangents.empty())
        attributes["TANGENT"] = addUnits(mesh.tangents, "VEC4", primitive.tangent_format, builder);
    if (!primitive.bitangents.empty())
        attributes["_BITANGENT"] = addUnits(primitive.bitangents, "VEC3", primitive.tangent_format, builder);
    for (const PackedAttribute& packed : primitive.packed)
        attributes[packed.part.attribute] = addPacked(packed, builder);
    if (!mesh.uvs.empty()) attributes["TEXCOORD_0"] = addVertices(mesh.uvs, "VEC2", builder);
    Json json = {{"attributes", std::move(attributes)},
                 {"indices", builder.addIndices(mesh.indices, mesh.positions.size())}};
    if (material >= 0) json["material"] = static_cast<unsigned>(material);
    return json;
}

/// Writes a mesh and a node per shape with faces, in file order.
void addMeshes(const Model& model, const std::vector<FinishedPrimitive>& primitives, const MaterialNumbers& materials,
               DocumentBuilder& builder) {
    Json roots = Json::array();
    const DVec3& offset = model.offset;
    for (const std::string& name : model.shape_names) {
        Json mesh = Json::object();
        if (!name.empty()) mesh["name"] = name;
        Json node = {{"mesh", roots.size()}};
        if (!name.empty()) node["name"] = name;
        if (offset.x != 0 || offset.y != 0 || offset.z != 0) node["translation"] = {offset.x, offset.y, offset.z};
        mesh["primitives"] = Json::array();
        builder.append("meshes", std::move(mesh));
        roots.push_back(builder.append("nodes", std::move(node)));
    }
    for (const FinishedPrimitive& primitive : primitives) {
        Json json = primitiveJson(primitive, materials.of(primitive), builder);
        builder.json()["meshes"][primitive.shape]["primitives"].push_back(std::move(json));
    }
    builder.json()["scene"] = 0U;
    builder.json()["scenes"] = {{{"nodes", std::move(roots)}}};
}

/// Adds the document's only buffer: BIN of a GLB, or a file next to a .gltf.
void addBuffer(Bytes&& bytes, const Path& output, gltf::Document& document) {
    Json entry = {{"byteLength", bytes.size()}};
    gltf::Buffer& buffer = document.buffers.emplace_back();
    buffer.bytes = gltf::BufferBytes(std::move(bytes));
    buffer.own = buffer.edited = true;
    if (document.container == gltf::Container::glb) {
        buffer.source = gltf::BufferSource::bin;
    } else {
        buffer.source = gltf::BufferSource::file;
        buffer.path = stemOf(output) + ".bin";
        entry["uri"] = percentEncode(buffer.path.string());
        document.style.indent = 2;
    }
    document.json["buffers"] = Json::array({std::move(entry)});
}

}  // namespace

gltf::Document toDocument(Model&& model, const std::vector<FinishedPrimitive>& primitives, const Path& output,
                          std::vector<std::string>& warnings) {
    gltf::Document document;
    document.container = isGlbOutput(output) ? gltf::Container::glb : gltf::Container::gltf;
    document.input_bytes = model.input_bytes;
    document.input_files = std::move(model.input_files);
    document.memory = model.memory;
    DocumentBuilder builder(Json::object({{"version", "2.0"}, {"generator", "tspace"}}));
    ImageBuilder images(model, output, builder, document.input_files, warnings);
    const MaterialNumbers materials(model, primitives, images, builder, warnings);
    addMeshes(model, primitives, materials, builder);
    for (const char* member : {"asset", "scene", "scenes", "nodes", "meshes", "materials", "textures", "images",
                               "accessors", "bufferViews", "extensionsRequired", "extensionsUsed"}) {
        if (builder.json().contains(member)) document.json[member] = std::move(builder.json()[member]);
    }
    addBuffer(std::move(builder.bytes()), output, document);
    document.files = std::move(model.files);
    return document;
}

}  // namespace tspace::obj
