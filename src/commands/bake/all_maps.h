// SPDX-License-Identifier: MIT
// Maps other than the normal map: attributes of the high poly's triangles from its file, and images of the baked
// layers.
#pragma once

#include <deque>

#include "commands/bake/bake_report.h"
#include "commands/bake/model_surfaces.h"
#include "commands/render/model_picture.h"

namespace tspace {

/// IDs and materials of the triangles of a high poly. Must not be moved while a bake uses it.
class HighDetail {
  public:
    /// Reads the attributes of the high poly. `options` are those with which the models were read. The models must
    /// outlive this object. Throws FileError.
    HighDetail(const BakeModels& models, const std::string& path, const BakeFileOptions& options);
    HighDetail(const HighDetail&) = delete;
    HighDetail& operator=(const HighDetail&) = delete;

    /// Returns the requested layers, with the IDs and materials of this object.
    [[nodiscard]] LayerOptions layers() const;
    [[nodiscard]] std::uint64_t idCount() const { return id_count_; }
    /// Returns the IDs that the report lists: the first ones, at most 256.
    [[nodiscard]] const std::vector<BakedId>& ids() const { return listed_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    struct Material {
        PlacedTexture base = {}, metal = {}, emission = {};
        std::vector<Vec4> colors = {};  ///< linear vertex colors; empty if the primitive has none
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
    std::deque<Material> materials_ = {};     ///< materials of the high poly, one per primitive
    std::vector<std::string> warnings_ = {};
};

/// Encodes a layer as PNG and describes it in the returned report entry, except `path`. Colors are written with the
/// sRGB curve in 8 bits, `orm` and IDs in 8 bits, other layers in `bits` bits. Frees the values of the layer. `origin`:
/// origin of the models in world space.
std::vector<std::uint8_t> layerPng(BakedLayer& layer, const BakedMap& map, unsigned bits, const DVec3& origin,
                                   BakedLayerFile& file);

namespace report {

Json layerJson(const BakedLayerFile& layer);

}  // namespace report

}  // namespace tspace
