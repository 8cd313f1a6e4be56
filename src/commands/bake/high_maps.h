// SPDX-License-Identifier: MIT
// The normal maps that a high poly shows itself, which are baked through.
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

/// The high poly's maps as needed by a bake. The maps refer to the images, which may only be moved as a whole.
struct HighMaps {
    std::vector<FloatImage> images = {};
    std::vector<HighMap> maps = {};
    std::vector<BakedHighMap> reports = {};  ///< one per map
    std::vector<std::string> warnings = {};
};

/// Reads maps as primitives name them, each image once.
class HighMapReading {
  public:
    /// The scene must have its images, and must stay.
    HighMapReading(const Scene& scene, const BakeFileOptions& options) : scene_(scene), options_(options) {}

    /// How a primitive shows its normal map; null where it shows none, or one that cannot be baked through (a warning says why).
    const TangentUse* find(const ScenePrimitive& primitive);
    /// The number of the map of a use that find() gave, which `triangle_count` more triangles show.
    std::uint32_t numberOf(const ScenePrimitive& primitive, const TangentUse& use, std::size_t triangle_count);
    [[nodiscard]] HighMaps take() { return std::move(made_); }

  private:
    using Key = std::tuple<std::size_t, double, bool, TextureWrap, TextureWrap>;
    struct Image {
        std::optional<std::size_t> number = {};  ///< in HighMaps::images; nothing: it is not used
        bool is_grey = false;
        Green green = Green::up;  ///< direction of green according to its texels
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
