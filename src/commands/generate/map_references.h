// SPDX-License-Identifier: MIT
// Images of a glTF document: finds the textures and materials that use an image, gives some primitives their own image,
// and replaces image files.
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

// Follows references from materials to textures, and from textures to images, in the JSON of a glTF document.

/// Calls visit(name, object) for each reference to a texture: an object with an "index", as in core glTF and in all of
/// its extensions. `name`: name of the member that contains the reference.
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

/// Calls visit(name) for each extension that gives a texture an image in another format.
template <class Visit>
void forSourceExtensions(const Visit& visit) {
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"})
        visit(name);
}

/// Calls visit(number) for each image of the texture: its source, and its alternatives in other formats.
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

/// A primitive, and the use of a normal map in its material.
struct MapUser {
    const Primitive* primitive = nullptr;
    const TangentUse* use = nullptr;
};

class MapReferences {
  public:
    /// Finds the references of a document. `primitives`: all primitives of the document.
    MapReferences(Document& document, std::span<const Primitive> primitives)
        : document_(document), primitives_(primitives) {}

    /// Returns whether only these primitives use the image, so that it can be replaced in place.
    [[nodiscard]] bool isUsedOnlyBy(std::size_t image, std::span<const MapUser> users) const;

    /// Makes the image the only source of all textures that use it, without alternatives in other formats. Its format
    /// must be one that all viewers support. Removes extensions for other formats that no texture uses any more.
    void makeOnlySource(std::size_t image);

    /// Returns why these primitives cannot have an image of their own, as a clause; empty if they can.
    [[nodiscard]] std::string whyNotSeparate(std::span<const MapUser> users) const;

    /// Makes these primitives use another image. Copies their textures, and materials that other primitives use too.
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

// Replaces image files of a glTF document.

/// Replaces image files. Files referenced by the document are never changed: the output has new files.
class ImagePlacer {
  public:
    /// `ending`: suffix of the names of new files, such as "-green-up".
    ImagePlacer(Document& document, Editor& editor, const OutputTarget& target, std::string ending)
        : document_(document), editor_(editor), target_(target), ending_(std::move(ending)) {}

    /// Replaces an image. Images that share one file or buffer view share the new one too. `keeps_old`: the old bytes
    /// are still in use.
    void place(std::size_t image, Bytes&& bytes, bool keeps_old);
    /// Replaces only this image, even if others share its bytes.
    void placeOwn(std::size_t image, Bytes&& bytes) { put(image, std::move(bytes), false, false); }
    /// Adds an entry to /images with these bytes, and copies all other members from the entry `like`. Returns its
    /// index.
    std::size_t add(std::size_t like, Bytes&& bytes);

  private:
    void put(std::size_t image, Bytes&& bytes, bool keeps_old, bool for_all_users);
    void embed(std::size_t image, Bytes&& bytes);
    void putInView(std::size_t image, Bytes&& bytes, bool keeps_old, bool for_all_users);
    void putInFile(std::size_t image, const std::string& uri, Bytes&& bytes, bool for_all_users);
    std::string freeName(const std::string& uri, const Bytes& bytes);

    Document& document_;
    Editor& editor_;
    const OutputTarget& target_;
    std::string ending_;
    std::map<std::size_t, std::size_t> views_ = {};  ///< old buffer view -> new buffer view
    std::map<std::string, std::string> files_ = {};  ///< old URI -> new name
};

/// Adds the file of an image to the list of input files, if the image is in a file.
void noteInputFile(Document& document, std::size_t image);

}  // namespace tspace::gltf
