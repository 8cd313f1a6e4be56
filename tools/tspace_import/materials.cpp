// SPDX-License-Identifier: MIT
// Converts base color, metalness, roughness and normal map. Images are embedded or referenced by name.
#include "materials.h"

#include <assimp/material.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "model/io/legacy_text.h"
#include "repair.h"

namespace tspace::import {
namespace {

std::string percentEncoded(const std::string& text) {
    constexpr const char* kHex = "0123456789ABCDEF";
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_plain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') ||
                              (byte >= 'A' && byte <= 'Z') || byte == '/' || byte == '.' || byte == '-' ||
                              byte == '_' || byte == '~';
        if (is_plain) {
            out += c;
        } else {
            out += '%';
            out += kHex[byte >> 4];
            out += kHex[byte & 15];
        }
    }
    return out;
}

/// Returns a path below the model's folder. Files from other locations (absolute, of another system, above the folder)
/// are searched next to the model by their name.
std::string localName(const std::string& path) {
    const std::filesystem::path plain = std::filesystem::path(withSlashes(path)).lexically_normal();
    const bool leads_away =
        plain.is_absolute() || path.find(':') != std::string::npos || plain.string().starts_with("..");
    return leads_away ? plain.filename().string() : plain.string();
}

const char* mediaType(const std::uint8_t* bytes, std::size_t count) {
    if (count > 3 && bytes[0] == 0x89 && bytes[1] == 'P') return "image/png";
    if (count > 3 && bytes[0] == 0xff && bytes[1] == 0xd8) return "image/jpeg";
    return nullptr;
}

class MaterialWriter {
  public:
    MaterialWriter(GlbBuilder& builder, const aiScene& scene) : builder_(builder), scene_(scene) {}

    Json material(const aiMaterial& source) {
        Json material = Json::object();
        aiString name;
        if (source.Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name.length > 0) material["name"] = name.C_Str();
        Json& pbr = material["pbrMetallicRoughness"] = Json::object();
        aiColor4D color(1, 1, 1, 1);
        if (source.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
            source.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS) {
            pbr["baseColorFactor"] = {unitInterval(color.r, 1), unitInterval(color.g, 1), unitInterval(color.b, 1),
                                      unitInterval(color.a, 1)};
        }
        float metallic = 0, roughness = 1;
        source.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
        source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
        pbr["metallicFactor"] = unitInterval(metallic, 0);
        pbr["roughnessFactor"] = unitInterval(roughness, 1);
        for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
            if (pbr.contains("baseColorTexture")) break;
            if (std::optional<Json> texture = reference(source, type)) pbr["baseColorTexture"] = std::move(*texture);
        }
        // Height maps (bump) are not normal maps, and are ignored.
        for (const aiTextureType type : {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA}) {
            if (material.contains("normalTexture")) break;
            if (std::optional<Json> texture = reference(source, type)) material["normalTexture"] = std::move(*texture);
        }
        int two_sided = 0;
        if (source.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS && two_sided != 0) material["doubleSided"] = true;
        return material;
    }

  private:
    std::optional<Json> reference(const aiMaterial& source, aiTextureType type) {
        aiString path;
        if (source.GetTexture(type, 0, &path) != AI_SUCCESS || path.length == 0) return {};
        const std::optional<std::size_t> texture = textureFor(path.C_Str());
        if (!texture) return {};
        Json json = {{"index", *texture}};
        int uv_set = 0;
        if (source.Get(AI_MATKEY_UVWSRC(type, 0), uv_set) == AI_SUCCESS && uv_set > 0) json["texCoord"] = uv_set;
        aiUVTransform transform;
        if (source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == AI_SUCCESS) addTransform(transform, json);
        return json;
    }

    /// Adds the transform of a texture, converted because v points up in Assimp and down in glTF (v' = 1 - v).
    /// Rotations are ignored, because they would have a different pivot.
    void addTransform(const aiUVTransform& t, Json& json) {
        if (!isFinite(&t.mScaling.x, 2) || !isFinite(&t.mTranslation.x, 2)) return;
        if (t.mScaling.x == 1 && t.mScaling.y == 1 && t.mTranslation.x == 0 && t.mTranslation.y == 0) return;
        json["extensions"]["KHR_texture_transform"] = {
            {"offset", {t.mTranslation.x, 1 - t.mScaling.y - t.mTranslation.y}},
            {"scale", {t.mScaling.x, t.mScaling.y}}};
        Json& used = builder_.json()["extensionsUsed"];
        if (used.is_null()) used = Json::array({"KHR_texture_transform"});
    }

    std::optional<std::size_t> textureFor(const std::string& path) {
        const auto known = textures_.find(path);
        if (known != textures_.end()) return known->second;
        const std::optional<Json> image = imageFor(path);
        std::optional<std::size_t> texture;
        if (image) texture = builder_.append("textures", {{"source", builder_.append("images", *image)}});
        return textures_[path] = texture;
    }

    std::optional<Json> imageFor(const std::string& path) {
        const aiTexture* embedded = scene_.GetEmbeddedTexture(path.c_str());
        if (embedded == nullptr) return Json{{"uri", percentEncoded(localName(path))}};
        // Raw pixels are skipped, because they would need an encoder; files usually embed PNG and JPEG.
        if (embedded->mHeight != 0) return {};
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
        const char* type = mediaType(bytes, embedded->mWidth);
        if (type == nullptr) return {};
        return Json{
            {"bufferView", builder_.addView(std::as_bytes(std::span(bytes, embedded->mWidth)), 1, gltf::kNoTarget)},
            {"mimeType", type}};
    }

    GlbBuilder& builder_;
    const aiScene& scene_;
    std::map<std::string, std::optional<std::size_t>> textures_ = {};
};

}  // namespace

void addMaterials(GlbBuilder& builder, const aiScene& scene) {
    MaterialWriter writer(builder, scene);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i)
        builder.append("materials", writer.material(*scene.mMaterials[i]));
}

}  // namespace tspace::import
