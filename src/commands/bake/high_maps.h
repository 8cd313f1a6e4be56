// SPDX-License-Identifier: MIT
// Normal maps of the high poly, whose details are baked too.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "images/float_image.h"
#include "model/scene/scene.h"
#include "tspace/bake_file.h"

namespace tspace {

/// Normal maps of the high poly in the form in which a bake samples them. `maps` refer to `images`, so move the object
/// only as a whole.
struct HighMaps {
    std::vector<FloatImage> images = {};
    std::vector<HighMap> maps = {};
    std::vector<BakedHighMap> reports = {};  ///< one per map
    std::vector<std::string> warnings = {};
};

/// Reads the normal maps of primitives, each image once.
class HighMapReading {
  public:
    /// The scene must contain its images and outlive this object.
    HighMapReading(const Scene& scene, const BakeFileOptions& options) : scene_(scene), options_(options) {}

    /// Returns how a primitive uses its normal map. Null if it has no normal map, or if the map cannot be baked, which
    /// adds a warning.
    const TangentUse* find(const ScenePrimitive& primitive);
    /// Returns the index in HighMaps::maps for a `use` that find() returned. Adds `triangle_count` to the number of
    /// triangles with this map.
    std::uint32_t numberOf(const ScenePrimitive& primitive, const TangentUse& use, std::size_t triangle_count);
    [[nodiscard]] HighMaps take() { return std::move(made_); }

  private:
    using Key = std::tuple<std::size_t, double, bool, TextureWrap, TextureWrap>;
    struct Image {
        std::optional<std::size_t> number = {};  ///< index in HighMaps::images; none: unused
        bool is_gray = false;
        Green green = Green::up;  ///< direction of green, determined from the texels
        bool shows_green = false;
    };

    const Image& imageOf(std::size_t number);
    [[nodiscard]] std::string nameOf(std::size_t image) const;

    const Scene& scene_;
    const BakeFileOptions& options_;
    std::map<std::size_t, Image> images_ = {};
    std::map<Key, std::uint32_t> numbers_ = {};
    HighMaps made_ = {};
};

}  // namespace tspace
