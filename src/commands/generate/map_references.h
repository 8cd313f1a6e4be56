// SPDX-License-Identifier: MIT
// Images of a glTF document: which textures and materials show one, giving some primitives one of their own, and putting new
// files in the place of old ones.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/gltf/container.h"
#include "model/gltf/document.h"
#include "model/gltf/editor.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

// From materials to textures, and from textures to images, in the JSON of a glTF document.

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

/// A primitive, and what in its material shows a normal map.
struct MapUser {
    const Primitive* primitive = nullptr;
    const TangentUse* use = nullptr;
};

class MapReferences {
  public:
    /// `primitives`: all of the document.
    MapReferences(Document& document, std::span<const Primitive> primitives)
        : document_(document), primitives_(primitives) {}

    /// Whether nothing but these primitives shows the image, which may then be replaced where it is.
    [[nodiscard]] bool isOfAlone(std::size_t image, std::span<const MapUser> users) const;

    /// Has all textures that show the image name it as their only source, as those of the formats that all viewers read. The file needs no
    /// extension for other formats any more where none of its textures has one.
    void namePlainly(std::size_t image);

    /// Half a sentence: why these primitives cannot have an image that others do not see. Empty: they can.
    [[nodiscard]] std::string whyNotApart(std::span<const MapUser> users) const;

    /// Has these primitives show another image. Textures, and materials that others use too, are copied for it.
    void redirect(std::span<const MapUser> users, std::size_t to_image);

  private:
    struct Slot {
        std::size_t material = 0;
        bool is_coat = false;

        auto operator<=>(const Slot&) const = default;
    };
    [[nodiscard]] Slot slotOf(const MapUser& user) const;
    [[nodiscard]] Json& jsonOf(const Primitive& primitive) const;
    [[nodiscard]] bool shows(const Primitive& primitive, std::size_t material) const;
    [[nodiscard]] bool isShared(std::size_t material, std::span<const MapUser> users) const;
    Json& reference(const Slot& slot) const;
    static void setSource(Json& texture, std::size_t image);

    Document& document_;
    std::span<const Primitive> primitives_;
};

// New image files in the place of those of a glTF document.

/// Puts one image file in the place of another. Files beside the document are never changed: the output has new ones.
class ImagePlacer {
  public:
    /// `ending`: of the names of new files, "-green-up".
    ImagePlacer(Document& document, Editor& editor, const OutputTarget& target, std::string ending)
        : document_(document), editor_(editor), target_(target), ending_(std::move(ending)) {}

    /// Images that have their bytes from one place get one new place. `keeps_old`: somebody else still needs what the image
    /// had.
    void place(std::size_t image, Bytes&& bytes, bool keeps_old);
    /// Replaces only this image.
    void placeOwn(std::size_t image, Bytes&& bytes) { put(image, std::move(bytes), false, false); }
    /// A new entry of /images, otherwise like entry `like`. Returns its index.
    std::size_t add(std::size_t like, Bytes&& bytes);

  private:
    void put(std::size_t image, Bytes&& bytes, bool keeps_old, bool is_of_all);
    void takeIn(std::size_t image, Bytes&& bytes);
    void putInView(std::size_t image, Bytes&& bytes, bool keeps_old, bool is_of_all);
    void putInFile(std::size_t image, const std::string& uri, Bytes&& bytes, bool is_of_all);
    std::string freeName(const std::string& uri, const Bytes& bytes);

    Document& document_;
    Editor& editor_;
    const OutputTarget& target_;
    std::string ending_;
    std::map<std::size_t, std::size_t> views_ = {};  ///< from views to those that took their place
    std::map<std::string, std::string> files_ = {};  ///< from URIs to new names
};

/// The file of an image, if it lies in one, is part of the input.
void noteInputFile(Document& document, std::size_t image);

}  // namespace tspace::gltf
