// SPDX-License-Identifier: MIT
// An OBJ model as a document of glTF 2.0.
#include "model/obj/obj_writer.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/numbers.h"
#include "core/mesh/pools/unit_lattice.h"
#include "images/codecs.h"
#include "images/image.h"
#include "model/gltf/container.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace tspace::obj {
namespace {

namespace fs = std::filesystem;
using gltf::Json;

constexpr unsigned kArrayBuffer = 34962;
constexpr unsigned kElementArrayBuffer = 34963;
constexpr unsigned kByte = 5120;
constexpr unsigned kShort = 5122;
constexpr unsigned kUnsignedShort = 5123;
constexpr unsigned kUnsignedInt = 5125;
constexpr unsigned kFloat = 5126;

/// The buffer, and the views and accessors into it.
class BufferBuilder {
  public:
    template <class T>
    std::size_t addVertices(const std::vector<T>& values, const char* type) {
        const std::size_t view = addView(values.data(), values.size() * sizeof(T), sizeof(float), kArrayBuffer);
        accessors_.push_back(
            {{"bufferView", view}, {"componentType", kFloat}, {"count", values.size()}, {"type", type}});
        return accessors_.size() - 1;
    }

    /// Adds normals or tangents; elements start at multiples of 4 bytes.
    template <class T>
    std::size_t addUnits(const std::vector<T>& values, const char* type, VectorFormat format) {
        if (format == VectorFormat::float32) return addVertices(values, type);
        const std::vector<std::uint8_t> packed = packUnits(std::span<const T>(values), format);
        has_integers_ = true;
        return addRows(
            packed, values.size(),
            {{"componentType", format == VectorFormat::snorm8 ? kByte : kShort}, {"normalized", true}, {"type", type}});
    }

    std::size_t addPacked(const PackedAttribute& attribute) {
        Json accessor = {{"componentType", static_cast<std::uint32_t>(attribute.part.component)},
                         {"type", attribute.part.type}};
        if (attribute.part.normalized) accessor["normalized"] = true;
        return addRows(attribute.elements, attribute.elements.size() / attribute.part.byte_count, std::move(accessor));
    }

    std::size_t addPositions(const std::vector<Vec3>& positions) {
        const std::size_t accessor = addVertices(positions, "VEC3");
        Vec3 low = positions.front();
        Vec3 high = low;
        for (const Vec3& p : positions) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        accessors_[accessor]["min"] = {low.x, low.y, low.z};
        accessors_[accessor]["max"] = {high.x, high.y, high.z};
        return accessor;
    }

    /// 16-bit indices where they suffice. 65535 is not used: some APIs read it as primitive restart.
    std::size_t addIndices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
        const bool is_short = vertex_count <= 65535;
        std::size_t view = 0;
        if (is_short) {
            const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
            view = addView(narrow.data(), narrow.size() * 2, 2, kElementArrayBuffer);
        } else {
            view = addView(indices.data(), indices.size() * 4, 4, kElementArrayBuffer);
        }
        accessors_.push_back({{"bufferView", view},
                              {"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                              {"count", indices.size()},
                              {"type", "SCALAR"}});
        return accessors_.size() - 1;
    }

    /// Adds a view of numbers, which are turned to little-endian. `target` 0: none.
    std::size_t addView(const void* data, std::size_t byte_count, std::size_t number_bytes, unsigned target) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4, 0);
        Json view = {{"buffer", 0U}, {"byteOffset", bytes_.size()}, {"byteLength", byte_count}};
        if (target != 0) view["target"] = target;
        const auto* first = static_cast<const std::uint8_t*>(data);
        bytes_.insert(bytes_.end(), first, first + byte_count);
        turnLittleEndian(std::span<std::uint8_t>(bytes_).last(byte_count), number_bytes);
        views_.push_back(std::move(view));
        return views_.size() - 1;
    }

    /// Whether KHR_mesh_quantization is needed.
    [[nodiscard]] bool hasIntegers() const { return has_integers_; }
    Bytes takeBytes() { return std::move(bytes_); }
    Json takeViews() { return std::move(views_); }
    Json takeAccessors() { return std::move(accessors_); }

  private:
    /// `count` elements of a few bytes each, which start at multiples of 4 bytes.
    template <class ElementBytes>
    std::size_t addRows(const ElementBytes& elements, std::size_t count, Json accessor) {
        const std::size_t element = elements.size() / count, stride = (element + 3) / 4 * 4;
        Bytes rows(count * stride, 0);
        for (std::size_t i = 0; i < count; ++i)
            std::copy_n(elements.begin() + static_cast<std::ptrdiff_t>(i * element), element,
                        rows.begin() + static_cast<std::ptrdiff_t>(i * stride));
        const std::size_t view = addView(rows.data(), rows.size(), 1, kArrayBuffer);
        if (stride != element) views_[view]["byteStride"] = stride;
        accessor["bufferView"] = view;
        accessor["count"] = count;
        accessors_.push_back(std::move(accessor));
        return accessors_.size() - 1;
    }

    Bytes bytes_ = {};
    Json views_ = Json::array();
    Json accessors_ = Json::array();
    bool has_integers_ = false;
};

/// Images and textures, one per file however often it is used.
class ImageBuilder {
  public:
    ImageBuilder(const Model& model, const Path& output, BufferBuilder& buffer, std::vector<std::string>& sources,
                 std::vector<std::string>& warnings)
        : names_by_uri_(!model.files.areInMemory() && isSameFile(folderOf(output), model.files.folder())),
          flipped_maps_(model.flipped_maps),
          named_(model.files),
          buffer_(buffer),
          sources_(sources),
          warnings_(warnings) {}

    /// Sets material[key] to a reference to the texture; does nothing where the image cannot be read.
    void addReference(const Texture& texture, Json& material, const char* key) {
        if (!texture.used()) return;
        const std::string name = texture.path();
        const auto flipped = flipped_maps_.find(name);
        const bool is_flipped = flipped != flipped_maps_.end() && std::string_view(key) == "normalTexture";
        const auto [entry, is_new] = textures_by_file_.emplace(std::pair(name, is_flipped), -1);
        if (is_new) entry->second = addTexture(texture, is_flipped ? &flipped->second : nullptr);
        if (entry->second >= 0) material[key] = {{"index", static_cast<unsigned>(entry->second)}};
    }

    /// reference() for an image in memory.
    void addMade(const Texture& like, const Bytes& bytes, Json& material, const char* key) {
        images_.push_back(imageJson(fs::path(Path(like.file)), bytes, mimeType(imageFormat(bytes)), false));
        material[key] = {{"index", images_.size() - 1}};
    }

    [[nodiscard]] const Json& images() const { return images_; }

  private:
    /// `flipped`: replaces the file in the output; may be null.
    int addTexture(const Texture& texture, const Bytes* flipped) {
        bool is_added = false;
        const std::optional<Error> failure = tryFile([&] {
            const Path path = named_.resolve(texture.folder, percentEncode(texture.file), "material");
            const Bytes bytes = named_.read(path);
            sources_.push_back(path.string());
            // Told by content, because names can be wrong. Core glTF allows no other formats.
            const ImageFormat format = imageFormat(bytes);
            if (format != ImageFormat::png && format != ImageFormat::jpeg) {
                warnings_.push_back("the texture '" + texture.file + "' was left out: it is neither PNG nor JPEG");
                return;
            }
            // Viewers may show a damaged image, but not one without a valid size.
            const ImageClaim claim = format == ImageFormat::png ? claimOfPng(bytes) : claimOfJpeg(bytes);
            if (claim.size.pixels() == 0) {
                warnings_.push_back("the texture '" + texture.file + "' was left out: its head is broken");
                return;
            }
            images_.push_back(flipped == nullptr ? imageJson(path, bytes, mimeType(format), names_by_uri_)
                                                 : imageJson(path, *flipped, mimeType(imageFormat(*flipped)), false));
            is_added = true;
        });
        if (failure) warnings_.push_back("a texture was left out: " + failure->message);
        return is_added ? static_cast<int>(images_.size()) - 1 : -1;
    }

    Json imageJson(const fs::path& path, const Bytes& bytes, const char* type, bool names_by_uri) {
        Json image = {{"name", Path(path.stem()).string()}};
        // Relative to the model's folder.
        const std::string below = names_by_uri ? pathBelow(named_.folder(), path) : "";
        if (!below.empty()) {
            image["uri"] = percentEncode(below);
        } else {
            image["mimeType"] = type;
            image["bufferView"] = buffer_.addView(bytes.data(), bytes.size(), 1, 0);
        }
        return image;
    }

    const bool names_by_uri_;
    const std::map<std::string, Bytes>& flipped_maps_;
    const NamedFiles& named_;
    BufferBuilder& buffer_;
    std::vector<std::string>& sources_;
    std::vector<std::string>& warnings_;
    std::map<std::pair<std::string, bool>, int> textures_by_file_ = {};  ///< by path, and whether green is inverted
    Json images_ = Json::array();
};

Json rgb(const Vec3& color) { return {color.x, color.y, color.z}; }

/// `images` null: without textures.
Json materialJson(const Material& material, ImageBuilder* images) {
    Json json = Json::object();
    if (!material.name.empty()) json["name"] = material.name;
    if (!material.found) return json;
    Json surface = Json::object();
    const Vec3& color = material.base_color;
    if (material.opacity < 1 || !(color == Vec3{1, 1, 1})) {
        surface["baseColorFactor"] = {color.x, color.y, color.z, material.opacity};
    }
    if (images != nullptr) images->addReference(material.base_color_texture, surface, "baseColorTexture");
    surface["metallicFactor"] = material.metallic;
    surface["roughnessFactor"] = material.roughness;
    json["pbrMetallicRoughness"] = std::move(surface);
    if (images != nullptr && material.made_normal_map) {
        images->addMade(material.normal_texture, *material.made_normal_map, json, "normalTexture");
    } else if (images != nullptr) {
        images->addReference(material.normal_texture, json, "normalTexture");
    }
    if (material.normal_scale != 1 && json.contains("normalTexture")) {
        json["normalTexture"]["scale"] = material.normal_scale;
    }
    if (!(material.emission == Vec3{})) json["emissiveFactor"] = rgb(material.emission);
    if (material.opacity < 1) json["alphaMode"] = "BLEND";
    return json;
}

/// Writes the materials of the file. Faces before any `usemtl` have the default material, which is not written. Primitives
/// without UVs get a copy without textures, because textures of glTF need UVs.
class MaterialNumbers {
  public:
    /// Materials in the order of the file; copies without textures follow.
    MaterialNumbers(const Model& model, const std::vector<FinishedPrimitive>& primitives, ImageBuilder& images,
                    std::vector<std::string>& warnings)
        : numbers_(model.materials.size(), -1), bare_numbers_(numbers_) {
        std::vector<std::uint64_t> bare_triangles(model.materials.size(), 0);
        std::vector<bool> has_uvs(model.materials.size(), false);
        for (const FinishedPrimitive& primitive : primitives) {
            if (!primitive.uvs.empty()) has_uvs[primitive.material] = true;
            if (primitive.uvs.empty()) bare_triangles[primitive.material] += primitive.indices.size() / 3;
        }
        for (std::size_t i = 0; i < model.materials.size(); ++i) {
            if (isDefault(model.materials[i])) continue;
            numbers_[i] = bare_numbers_[i] = add(materialJson(model.materials[i], has_uvs[i] ? &images : nullptr));
        }
        for (std::size_t i = 0; i < model.materials.size(); ++i) {
            const Material& material = model.materials[i];
            const bool has_textures = material.base_color_texture.used() || material.normal_texture.used();
            if (bare_triangles[i] == 0 || !has_textures || isDefault(material)) continue;
            warnings.push_back("the material '" + material.name + "' has textures, but " +
                               std::to_string(bare_triangles[i]) +
                               " triangles with it have no texture coordinates: they get it without textures");
            if (has_uvs[i]) bare_numbers_[i] = add(materialJson(material, nullptr));
        }
    }

    /// Index of a primitive's material; -1: the default.
    [[nodiscard]] int of(const FinishedPrimitive& primitive) const {
        return (primitive.uvs.empty() ? bare_numbers_ : numbers_)[primitive.material];
    }
    [[nodiscard]] const Json& materials() const { return materials_; }

  private:
    static bool isDefault(const Material& material) { return material.name.empty() && !material.found; }

    int add(Json material) {
        materials_.push_back(std::move(material));
        return static_cast<int>(materials_.size()) - 1;
    }

    std::vector<int> numbers_, bare_numbers_;  ///< by Model::materials
    Json materials_ = Json::array();
};

Json primitiveJson(const FinishedPrimitive& primitive, int material, BufferBuilder& buffer) {
    Json attributes = {{"POSITION", buffer.addPositions(primitive.positions)}};
    if (!primitive.normals.empty())
        attributes["NORMAL"] = buffer.addUnits(primitive.normals, "VEC3", primitive.normal_format);
    if (!primitive.tangents.empty())
        attributes["TANGENT"] = buffer.addUnits(primitive.tangents, "VEC4", primitive.tangent_format);
    if (!primitive.bitangents.empty())
        attributes["_BITANGENT"] = buffer.addUnits(primitive.bitangents, "VEC3", primitive.tangent_format);
    for (const PackedAttribute& packed : primitive.packed) attributes[packed.part.attribute] = buffer.addPacked(packed);
    if (!primitive.uvs.empty()) attributes["TEXCOORD_0"] = buffer.addVertices(primitive.uvs, "VEC2");
    Json json = {{"attributes", std::move(attributes)},
                 {"indices", buffer.addIndices(primitive.indices, primitive.positions.size())}};
    if (material >= 0) json["material"] = static_cast<unsigned>(material);
    return json;
}

/// Writes a mesh and a node per shape with faces, in the order of the file.
void addMeshes(const Model& model, const std::vector<FinishedPrimitive>& primitives, const MaterialNumbers& materials,
               BufferBuilder& buffer, Json& root) {
    Json meshes = Json::array();
    Json nodes = Json::array();
    Json roots = Json::array();
    Json translation = Json::array();
    const DVec3& offset = model.offset;
    if (offset.x != 0 || offset.y != 0 || offset.z != 0) translation = {offset.x, offset.y, offset.z};
    for (const std::string& name : model.shape_names) {
        const std::size_t number = meshes.size();
        roots.push_back(number);
        nodes.push_back({{"mesh", number}});
        meshes.push_back(Json::object());
        if (!name.empty()) nodes.back()["name"] = meshes.back()["name"] = name;
        if (!translation.empty()) nodes.back()["translation"] = translation;
        meshes.back()["primitives"] = Json::array();
    }
    for (const FinishedPrimitive& primitive : primitives) {
        meshes[primitive.shape]["primitives"].push_back(primitiveJson(primitive, materials.of(primitive), buffer));
    }
    root["scene"] = 0U;
    root["scenes"] = {{{"nodes", std::move(roots)}}};
    root["nodes"] = std::move(nodes);
    root["meshes"] = std::move(meshes);
}

void addTextures(const ImageBuilder& images, Json& root) {
    if (images.images().empty()) return;
    Json textures = Json::array();
    for (std::size_t i = 0; i < images.images().size(); ++i) textures.push_back({{"source", i}});
    root["textures"] = std::move(textures);
    root["images"] = images.images();
}

/// The document's only buffer: the BIN of a GLB, or a file beside a .gltf.
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
    BufferBuilder buffer;
    ImageBuilder images(model, output, buffer, document.input_files, warnings);
    Json& root = document.json = {{"asset", {{"version", "2.0"}, {"generator", "tspace"}}}};
    const MaterialNumbers materials(model, primitives, images, warnings);
    addMeshes(model, primitives, materials, buffer, root);
    if (!materials.materials().empty()) root["materials"] = materials.materials();
    addTextures(images, root);
    root["accessors"] = buffer.takeAccessors();
    root["bufferViews"] = buffer.takeViews();
    if (buffer.hasIntegers()) root["extensionsUsed"] = root["extensionsRequired"] = {"KHR_mesh_quantization"};
    addBuffer(buffer.takeBytes(), output, document);
    document.files = std::move(model.files);
    return document;
}

}  // namespace tspace::obj
