// SPDX-License-Identifier: MIT
// Maps beside the normal map: what the high poly's file says of its triangles, and images of layers.
#pragma once

#include <deque>

#include "commands/bake/bake_report.h"
#include "commands/bake/model_surfaces.h"
#include "commands/render/model_picture.h"

namespace tspace {

/// The ids and materials of the triangles of a high poly. Must stay where it is while a bake looks at it.
class HighDetail {
  public:
    /// The models must have been read with these options, and must outlive this. Throws FileError.
    HighDetail(const BakeModels& models, const std::string& path, const BakeFileOptions& options);
    HighDetail(const HighDetail&) = delete;
    HighDetail& operator=(const HighDetail&) = delete;

    /// The requested layers, with the IDs and materials of this object.
    [[nodiscard]] LayerOptions layers() const;
    [[nodiscard]] std::uint64_t idCount() const { return id_count_; }
    /// The first of them.
    [[nodiscard]] const std::vector<BakedId>& ids() const { return listed_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    struct Material {
        PlacedTexture base = {}, metal = {}, emission = {};
        std::vector<Vec4> colors = {};  ///< linear, or empty
    };

    void findNames(BakeIds how);
    void findShells(float weld_distance);
    void listIds(const std::vector<std::string>& names);
    void readMaterials(const std::string& path);
    PlacedTexture placed(std::size_t primitive, const std::optional<TextureReading>& texture, ModelTextures::Use use);
    [[nodiscard]] std::size_t partOf(std::uint32_t triangle) const;
    [[nodiscard]] ShownMaterial materialAt(std::uint32_t triangle, const std::array<double, 3>& weights) const;

    const HighModel& high_;
    const DrawnScene& scene_;
    LayerOptions layers_;
    ModelTextures textures_;
    std::vector<std::uint32_t> ids_ = {};
    std::uint64_t id_count_ = 0;
    std::vector<BakedId> listed_ = {};
    std::deque<std::vector<Vec2>> uvs_ = {};  ///< UVs of the textures, one per vertex
    std::deque<Material> materials_ = {};     ///< one per primitive
    std::vector<std::string> warnings_ = {};
};

/// The PNG of a layer, and what is said of it; `path` is to be set. Colours are told with the sRGB curve in 8 bits, `orm` and ids
/// in 8 bits, others in `bits`. Lets go of the values of the layer. `origin`: of the models, in the world.
std::vector<std::uint8_t> layerPng(BakedLayer& layer, const BakedMap& map, unsigned bits, const DVec3& origin,
                                   BakedLayerFile& file);

namespace report {

Json layerJson(const BakedLayerFile& layer);

}  // namespace report

}  // namespace tspace
