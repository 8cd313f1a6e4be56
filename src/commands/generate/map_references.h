// SPDX-License-Identifier: MIT
// Which materials of a glTF document show which image as a normal map, and giving some primitives an image of their own.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "model/gltf/document.h"
#include "model/gltf/primitive_reader.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

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

    /// Has all textures that show the image name it as their only source, as those of the formats that all viewers read.
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

}  // namespace tspace::gltf
