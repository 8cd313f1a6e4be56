// SPDX-License-Identifier: MIT
// From materials to textures, and from textures to images, in the JSON of a glTF document.
#pragma once

#include <cstddef>
#include <string>

#include "model/gltf/document.h"

namespace tspace::gltf {

/// Calls visit(name, object) for each reference to a texture: an object with an "index", as in glTF itself and in all of
/// its extensions. `name`: that of the member it is.
template <class Visit>
void forTextureReferences(Json& value, const Visit& visit, const std::string& name = {}) {
    if (value.is_array()) {
        for (Json& element : value) forTextureReferences(element, visit);
    }
    if (!value.is_object()) return;
    if (value.contains("index")) visit(name, value);
    for (const auto& [key, member] : value.items()) forTextureReferences(member, visit, key);
}

inline bool isNormalMap(const std::string& name) { return name == "normalTexture" || name == "clearcoatNormalTexture"; }

/// Calls visit(name) for each extension that gives a texture its image in another format.
template <class Visit>
void forSourceExtensions(const Visit& visit) {
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"})
        visit(name);
}

/// Calls visit(number) for each image that the texture may show: its source, and those in other formats.
template <class Visit>
void forSources(Json& texture, const Visit& visit) {
    if (!texture.is_object()) return;
    if (texture.contains("source")) visit(texture["source"]);
    forSourceExtensions([&](const char* name) {
        if (findExtension(texture, name) == nullptr) return;
        Json& extension = texture["extensions"][name];
        if (extension.is_object() && extension.contains("source")) visit(extension["source"]);
    });
}

inline bool isNumber(const Json& value, std::size_t number) {
    return value.is_number_unsigned() && value.get<std::size_t>() == number;
}

}  // namespace tspace::gltf
