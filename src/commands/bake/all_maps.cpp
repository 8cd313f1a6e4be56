// SPDX-License-Identifier: MIT
#include "commands/bake/all_maps.h"

#include <algorithm>
#include <numeric>

#include "commands/shared/map_image_file.h"
#include "commands/shared/picture/colors.h"
#include "commands/shared/uv_reading.h"
#include "core/base/disjoint_sets.h"
#include "core/base/near_positions.h"
#include "core/base/weld.h"
#include "images/float_image.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"

namespace tspace {
namespace {

/// Maximum number of IDs listed in the report. All IDs are counted.
constexpr std::size_t kMaxListedIds = 256;

std::array<std::uint8_t, 3> bytesOf(const Vec3& color) {
    return {roundedChannel(color.x), roundedChannel(color.y), roundedChannel(color.z)};
}

std::uint64_t maxPixels(std::uint64_t memory_limit) {
    constexpr std::uint64_t kPixelBytes = 32;
    return memory_limit == 0 ? kMaxModelMapPixels : std::max<std::uint64_t>(memory_limit / kPixelBytes, 1);
}

}  // namespace

HighDetail::HighDetail(const BakeModels& models, const std::string& path, const BakeFileOptions& options)
    : high_(models.high), scene_(models.high_scene), layers_(options.layers),
      textures_(models.high_scene.scene, maxPixels(options.file.memory_limit_bytes)) {
    if (shows(layers_, MapLayer::id)) {
        if (options.ids == BakeIds::shell) {
            findShells(options.map.rays.weld_distance);
        } else {
            findNames(options.ids);
        }
    }
    if (showsMaterials(layers_)) readMaterials(path);
    warnings_.insert(warnings_.end(), textures_.warnings.begin(), textures_.warnings.end());
}

LayerOptions HighDetail::layers() const {
    LayerOptions layers = layers_;
    layers.ids = ids_;
    if (!materials_.empty()) {
        layers.material = [this](std::uint32_t triangle, const std::array<double, 3>& weights) {
            return materialAt(triangle, weights);
        };
    }
    return layers;
}

void HighDetail::findNames(BakeIds how) {
    std::map<std::string, std::uint32_t> numbers;
    std::vector<std::string> names;
    ids_.resize(high_.triangleCount());
    for (std::size_t i = 0; i < high_.parts.size(); ++i) {
        const ScenePlacement& placement = scene_.placements[high_.parts[i].placement];
        const ScenePrimitive& primitive = scene_.scene.primitives[placement.primitive];
        const std::string& name = how == BakeIds::material      ? primitive.material_name
                                  : placement.node_name.empty() ? primitive.mesh_name
                                                                : placement.node_name;
        const auto [entry, is_new] = numbers.try_emplace(name, static_cast<std::uint32_t>(names.size()));
        if (is_new) names.push_back(name);
        const std::size_t end = i + 1 < high_.parts.size() ? high_.parts[i + 1].first_triangle : ids_.size();
        std::fill(ids_.begin() + high_.parts[i].first_triangle, ids_.begin() + static_cast<std::ptrdiff_t>(end),
                  entry->second);
    }
    id_count_ = names.size();
    listIds(names);
}

void HighDetail::findShells(float weld_distance) {
    const std::size_t triangles = high_.triangleCount();
    Parallel parallel({.thread_count = 1});
    const NearMesh near(high_.mesh.view(), weld_distance, nullptr, parallel);
    const Buffer<std::uint32_t> roots = weldPositions(near.view(), nullptr, parallel);
    const auto pointOf = [&](std::size_t corner) {
        const std::uint32_t vertex = high_.mesh.indices[corner];
        return roots.empty() ? vertex : roots[vertex];
    };
    // Shells are connected components of triangles that share positions, computed with disjoint sets.
    std::vector<std::uint32_t> shells(high_.mesh.positions.size());
    std::iota(shells.begin(), shells.end(), 0u);
    for (std::size_t i = 0; i < triangles; ++i) {
        joinSets(shells.data(), pointOf(3 * i), pointOf(3 * i + 1));
        joinSets(shells.data(), pointOf(3 * i), pointOf(3 * i + 2));
    }
    constexpr std::uint32_t kNoNumber = 0xffffffffu;
    std::vector<std::uint32_t> numbers(high_.mesh.positions.size(), kNoNumber);
    ids_.resize(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        std::uint32_t& number = numbers[rootOf(shells.data(), pointOf(3 * i))];
        if (number == kNoNumber) number = static_cast<std::uint32_t>(id_count_++);
        ids_[i] = number;
    }
    listIds({});
}

void HighDetail::listIds(const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < std::min<std::size_t>(id_count_, kMaxListedIds); ++i)
        listed_.push_back(
            {i < names.size() ? names[i] : std::string(), bytesOf(idColor(static_cast<std::uint32_t>(i)))});
}

PlacedTexture HighDetail::placed(std::size_t primitive, const std::optional<TextureReading>& texture,
                                 ModelTextures::Use use) {
    const ScenePrimitive& source = scene_.scene.primitives[primitive];
    PlacedTexture map = textures_.find(source, texture, use, false);
    if (map.image == nullptr) return map;
    if (scene_.scene.memory) scene_.scene.memory->take(source.positions.size() * sizeof(Vec2), source.place);
    map.uvs = uvs_.emplace_back(textureUvs(source.uv_sets[texture->uv_set].span(), texture->transform));
    return map;
}

void HighDetail::readMaterials(const std::string& path) {
    // Vertex colors are linear in glTF; other formats store them as sRGB bytes.
    const bool is_linear = isGltfName(path);
    for (std::size_t i = 0; i < scene_.scene.primitives.size(); ++i) {
        Material& material = materials_.emplace_back();
        if (scene_.scene.primitives[i].corners.empty()) continue;
        const SurfaceLook& look = scene_.looks[i];
        if (shows(layers_, MapLayer::color)) {
            material.base = placed(i, look.base_texture, ModelTextures::Use::color);
            if (i < scene_.colors.size()) {
                const SharedArray<Vec4>& colors = scene_.colors[i];
                if (scene_.scene.memory)
                    scene_.scene.memory->take(colors.size() * sizeof(Vec4), scene_.scene.primitives[i].place);
                material.colors.assign(colors.begin(), colors.end());
            }
        }
        if (shows(layers_, MapLayer::orm)) material.metal = placed(i, look.metal_texture, ModelTextures::Use::factors);
        if (shows(layers_, MapLayer::emission))
            material.emission = placed(i, look.emission_texture, ModelTextures::Use::color);
        const auto light = [](float stored) {
            return static_cast<float>(srgbToLight(std::clamp(static_cast<double>(stored), 0.0, 1.0)));
        };
        for (Vec4& color : material.colors) {
            if (!is_linear) color = {light(color.x), light(color.y), light(color.z), color.w};
        }
    }
}

std::size_t HighDetail::partOf(std::uint32_t triangle) const {
    const auto after =
        std::upper_bound(high_.parts.begin(), high_.parts.end(), triangle,
                         [](std::uint32_t number, const HighPart& part) { return number < part.first_triangle; });
    return static_cast<std::size_t>(after - high_.parts.begin()) - 1;
}

ShownMaterial HighDetail::materialAt(std::uint32_t triangle, const std::array<double, 3>& weights) const {
    const HighPart& part = high_.parts[partOf(triangle)];
    const ScenePlacement& placement = scene_.placements[part.placement];
    const ScenePrimitive& primitive = scene_.scene.primitives[placement.primitive];
    const Material& material = materials_[placement.primitive];
    const SurfaceLook& look = scene_.looks[placement.primitive];
    std::array<std::uint32_t, 3> vertices{};
    for (std::size_t i = 0; i < 3; ++i)
        vertices[i] =
            primitive.corners[placedCorner(placement.to_world, 3 * std::size_t{triangle - part.first_triangle} + i)];
    const auto sample = [&](const PlacedTexture& map) {
        return map.image == nullptr ? Vec3{1, 1, 1} : sampleAt(map, vertices, weights);
    };
    const Vec3 base = sample(material.base), metal = sample(material.metal), emission = sample(material.emission);
    ShownMaterial shown;
    shown.color = {look.base_color[0] * base.x, look.base_color[1] * base.y, look.base_color[2] * base.z};
    if (!material.colors.empty()) {
        Vec3 color{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec4& of_vertex = material.colors[vertices[i]];
            color = color + static_cast<float>(weights[i]) * Vec3{of_vertex.x, of_vertex.y, of_vertex.z};
        }
        shown.color = {shown.color.x * color.x, shown.color.y * color.y, shown.color.z * color.z};
    }
    shown.roughness = static_cast<float>(look.roughness) * metal.y;
    shown.metalness = static_cast<float>(look.metalness) * metal.z;
    shown.emission = {static_cast<float>(look.emission[0]) * emission.x,
                      static_cast<float>(look.emission[1]) * emission.y,
                      static_cast<float>(look.emission[2]) * emission.z};
    return shown;
}

namespace report {
namespace {

std::string colorText(const std::array<std::uint8_t, 3>& color) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t byte : color) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    }
    return text;
}

}  // namespace

Json layerJson(const BakedLayerFile& layer) {
    Json ids = Json::array();
    for (const BakedId& id : layer.ids) ids.push_back({{"name", id.name}, {"color", colorText(id.color)}});
    return {{"map", layerName(layer.layer)},
            {"path", layer.path},
            {"bits", layer.bits},
            {"srgb", layer.is_srgb},
            {"black", Json::array({layer.least[0], layer.least[1], layer.least[2]})},
            {"white", Json::array({layer.most[0], layer.most[1], layer.most[2]})},
            {"idCount", layer.id_count},
            {"ids", ids}};
}

}  // namespace report

std::vector<std::uint8_t> layerPng(BakedLayer& layer, const BakedMap& map, unsigned bits, const DVec3& origin,
                                   BakedLayerFile& file) {
    file.layer = layer.layer;
    file.is_srgb = layer.layer == MapLayer::color || layer.layer == MapLayer::emission;
    const bool has_bytes = file.is_srgb || layer.layer == MapLayer::orm || layer.layer == MapLayer::id;
    file.bits = has_bytes ? 8 : bits;
    file.least = layer.least;
    file.most = layer.most;
    if (layer.layer == MapLayer::position) {
        const double moved[] = {origin.x, origin.y, origin.z};
        for (std::size_t i = 0; i < 3; ++i) {
            file.least[i] += moved[i];
            file.most[i] += moved[i];
        }
    }
    const std::vector<float> values = std::exchange(layer.values, {});
    std::optional<std::vector<std::uint8_t>> png;
    if (has_bytes) {
        RgbImage image{.width = map.width, .height = map.height};
        image.rgb.reserve(values.size());
        for (const float value : values) image.rgb.push_back(file.is_srgb ? lightToSrgb(value) : roundedChannel(value));
        png = encodeByName(file.path, image);
    } else {
        FloatImage image{.width = map.width, .height = map.height, .bits = bits};
        image.texels.reserve(values.size() / layer.channel_count);
        for (std::size_t i = 0; i + layer.channel_count <= values.size(); i += layer.channel_count) {
            const bool is_gray = layer.channel_count == 1;
            image.texels.push_back({values[i], values[is_gray ? i : i + 1], values[is_gray ? i : i + 2]});
        }
        png = encodeByName(file.path, image, bits);
    }
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace cannot write PNG");
    return *std::move(png);
}

}  // namespace tspace
