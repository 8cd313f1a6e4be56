// SPDX-License-Identifier: MIT
// UV set, KHR_texture_transform, image and wrap modes of a texture reference.
#include "model/gltf/texture_reference.h"

#include <cstdint>

#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// Reports number UV sets in 32 bits.
std::size_t readUvSet(const Json& object, const std::string& place, std::size_t fallback) {
    constexpr std::size_t kMaxUvSet = 0x7fffffff;
    const std::uint64_t set = readWhole(object, "texCoord", place, fallback);
    if (set > kMaxUvSet) failFile(ErrorCode::invalidFile, "no file has so many UV sets", join(place, "texCoord"));
    return static_cast<std::size_t>(set);
}

/// UV set and transform of a texture reference. The texCoord of KHR_texture_transform goes before its own.
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

/// A member that is an index below `limit`, or nothing. Images do not matter to frames, so a wrong one is no reason to
/// refuse the file.
std::optional<std::size_t> indexBelow(const Json& object, const char* key, std::size_t limit) {
    const Json* value = findMember(object, key);
    if (value == nullptr || !value->is_number_integer()) return {};
    const auto index = value->get<std::int64_t>();
    if (index < 0 || static_cast<std::uint64_t>(index) >= limit) return {};
    return static_cast<std::size_t>(index);
}

/// The texture that a reference names, or null.
const Json* textureOf(const Document& document, const Json& reference) {
    const Json* textures = findMember(document.json, "textures");
    if (textures == nullptr || !textures->is_array()) return nullptr;
    const auto index = indexBelow(reference, "index", textures->size());
    return index ? &(*textures)[*index] : nullptr;
}

/// `source` where there is one: the other formats are alternatives to it.
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

/// `key`: "wrapS" or "wrapT".
TextureWrap wrapOf(const Document& document, const Json& texture, const char* key) {
    constexpr int kClamp = 33071, kMirror = 33648;
    const Json* samplers = findMember(document.json, "samplers");
    if (samplers == nullptr || !samplers->is_array()) return TextureWrap::repeat;
    const auto sampler = indexBelow(texture, "sampler", samplers->size());
    const Json* wrap = sampler ? findMember((*samplers)[*sampler], key) : nullptr;
    if (wrap != nullptr && *wrap == kClamp) return TextureWrap::clamp;
    return wrap != nullptr && *wrap == kMirror ? TextureWrap::mirror : TextureWrap::repeat;
}

}  // namespace

TextureReading readTexture(const Document& document, const Json& texture, const std::string& place) {
    TextureReading reading;
    readUvs(texture, place, reading);
    if (const Json* entry = textureOf(document, texture)) {
        reading.image = imageOf(document, *entry);
        reading.wrap_u = wrapOf(document, *entry, "wrapS");
        reading.wrap_v = wrapOf(document, *entry, "wrapT");
    }
    return reading;
}

}  // namespace tspace::gltf
