// SPDX-License-Identifier: MIT
// A model prepared for pictures: its surfaces, their frames and textures, and height maps converted to normal maps.
// Also functions that draw it.
#pragma once

#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands/shared/picture/draw_surfaces.h"
#include "commands/shared/picture/legend.h"
#include "images/image.h"
#include "model/scene/scene.h"
#include "tspace/render.h"
#include "tspace/tangents.h"

namespace tspace {

/// Frames to compare with the frames of a primitive: one per corner, zero where there is none. Empty lists: no
/// comparison.
struct OtherFrames {
    std::vector<Vec3> normals = {};
    std::vector<Vec4> tangents = {};
};

/// Tangents that a picture needs, and their source.
struct FrameChoice {
    RenderFrames frames = RenderFrames::automatic;
    Method method = Method::mikktspace;
    bool always = false;   ///< compute tangents even if no normal map uses them
    bool compare = false;  ///< compute the tangents of the method too, for a comparison
    /// Frames to compare with in `error`, instead of those of the method: one entry per primitive, or an empty list.
    std::span<const OtherFrames> others = {};
    Execution execution = {};
};

/// Computes tangents with `method` for a primitive, one per corner, as a glTF file stores them: along the UVs of the
/// texture that needs them, sanitized. Empty if the primitive has no UVs that the method needs, or no triangles.
/// `normals`: normals of the primitive. Throws FileError.
std::vector<Vec4> computeCornerTangents(const ScenePrimitive& primitive, const CornerValues<Vec3>& normals,
                                        Method method, const Execution& execution);

/// The textures of a model, each decoded once.
class ModelTextures {
  public:
    ModelTextures(const Scene& scene, std::uint64_t most_pixels) : scene_(scene), most_pixels_(most_pixels) {}

    enum class Use : std::uint8_t {
        normals,
        color,   ///< stored as sRGB, converted to linear
        factors  ///< roughness and metalness, stored linearly
    };
    struct Wanted {
        std::size_t image = 0;
        Use use = Use::normals;
        bool alpha = false;

        auto operator<=>(const Wanted&) const = default;
    };
    /// Returns null if the texture cannot be used; a warning then states the reason.
    const PictureTexture* read(const Wanted& wanted);
    /// Returns the texture of a material without its UVs, which textureUvs computes from its transform. The result has
    /// no image if the material has no such texture, or if the primitive lacks its UV set.
    PlacedTexture find(const ScenePrimitive& primitive, const std::optional<TextureReading>& texture, Use use,
                       bool alpha);

    std::vector<std::string> warnings = {};

  private:
    std::optional<PictureTexture> decode(const Wanted& wanted);

    const Scene& scene_;
    std::uint64_t most_pixels_;
    std::map<Wanted, std::optional<PictureTexture>> images_ = {};
};

/// One primitive with its computed frames and textures.
struct ModelSurface {
    std::vector<Vec3> flat_normals = {};  ///< one per corner, if the file has no normals
    std::vector<Vec4> computed = {};      ///< computed tangents, one per corner
    std::vector<Vec2> base_uvs = {}, normal_uvs = {};
    std::vector<UvSide> sides = {};
    std::vector<std::uint32_t> islands = {};
    std::vector<Vec3> uv_positions = {};  ///< (u, -v, 0) of each vertex, for pictures of the UV map
    ShownSurface shown = {};
};

/// A primitive in the pose of one of its nodes.
struct PosedSurface {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> normals = {};                  ///< one per vertex, or per corner if the file has no normals
    std::vector<Vec4> tangents = {}, expected = {};  ///< one per vertex or per corner, as in the unposed surface
    ShownSurface shown = {};
};

/// The meshes of a model in their poses, prepared for drawing one kind of picture (RenderShow). References the scene
/// and the textures, which must outlive it.
class ModelPicture {
  public:
    /// Prepares all primitives that have triangles. `poses`: one per placement, or none. Throws FileError.
    ModelPicture(const DrawnScene& drawn, RenderShow show, const FrameChoice& choice, const MapReading& reading,
                 ModelTextures* textures, std::span<const ScenePose> poses = {});

    [[nodiscard]] std::span<const DrawnMesh> meshes() const { return meshes_; }
    /// Returns the surfaces, one per mesh.
    [[nodiscard]] std::span<const ShownSurface* const> surfaces() const { return shown_; }
    /// Returns the number of corners in the file, counting each primitive once.
    [[nodiscard]] std::uint64_t cornerCount() const;
    [[nodiscard]] const ModelSurface& surfaceOf(std::size_t primitive) const { return surfaces_[primitive]; }
    [[nodiscard]] TangentSources tangentSources() const;
    [[nodiscard]] Legend legend() const { return legendOf(show_, tangentSources(), choice_.method); }

  private:
    void prepare(std::size_t primitive);
    void prepareTextures(std::size_t primitive);
    void prepareFrames(std::size_t primitive);
    void place();
    const PosedSurface& pose(std::size_t primitive, const ScenePose& pose);

    const DrawnScene& drawn_;
    RenderShow show_;
    FrameChoice choice_;
    MapReading reading_;
    ModelTextures* textures_;
    std::span<const ScenePose> poses_;
    std::deque<ModelSurface> surfaces_ = {};  ///< prepared primitives, in the order of the scene
    std::deque<PosedSurface> posed_ = {};
    std::vector<DrawnMesh> meshes_ = {};
    std::vector<const ShownSurface*> shown_ = {};
};

// A whole model in a picture.

/// Draws a model. Size, camera, light and execution are those of `options`; options.show must be the view for which
/// `model` was made. With options.legend the legend occupies the lowest rows. Throws FileError (tooLarge).
SurfacePicture drawModel(const ModelPicture& model, const RenderOptions& options);

/// Joins two pictures of equal size with a line between them.
RgbImage sideBySide(const RgbImage& left, const RgbImage& right);

/// Encodes an 8-bit PNG. Throws FileError (unsupportedFile) if this build cannot write PNG.
std::vector<std::uint8_t> encodePicture(const RgbImage& image);

// Height maps of OBJ (map_bump) are drawn as the normal maps that generate computes from them.

/// Replaces height maps of OBJ (map_bump) in `drawn` by normal maps, as generate does. Height maps that cannot be
/// converted are omitted, with a warning. `method`: method of the tangents with which the maps are used. Throws
/// FileError.
std::vector<std::string> showHeights(Method method, const Execution& execution, DrawnScene& drawn);

}  // namespace tspace
