// SPDX-License-Identifier: MIT
// Pictures of places on models.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/diff/pair_primitives.h"
#include "commands/render/model_picture.h"

namespace tspace {

/// A model that was read for pictures. How it is lit is prepared when it is first asked for.
class PicturedModel {
  public:
    /// Throws FileError.
    PicturedModel(const std::string& input, const FileOptions& options);
    explicit PicturedModel(DrawnScene&& drawn);
    PicturedModel(const PicturedModel&) = delete;
    PicturedModel& operator=(const PicturedModel&) = delete;

    [[nodiscard]] const Scene& scene() const { return drawn_.scene; }
    [[nodiscard]] const DrawnScene& drawn() const { return drawn_; }
    /// `frames`: not computed. Throws FileError.
    const ModelPicture& lit(RenderFrames frames);

  private:
    DrawnScene drawn_;
    ModelTextures textures_;
    std::unique_ptr<ModelPicture> lit_[2] = {};
};

/// Number of a primitive in a scene; kNoPrimitive: it is not there.
std::size_t findPrimitive(const Scene& scene, std::uint32_t mesh, std::uint32_t primitive);

/// Triangles of a primitive that have one of a few vertices, in their order.
std::vector<std::size_t> trianglesAt(const ScenePrimitive& primitive, std::span<const std::uint32_t> vertices);

/// Partners of triangles of A; those without one are left out.
std::vector<std::size_t> partnersOf(const PrimitivePair& pair, std::span<const std::size_t> triangles);

/// Corners of triangles in the world, and the sum of their normals.
struct PlacePoints {
    PlacePoints() = default;
    PlacePoints(const DrawnMesh& mesh, std::span<const std::size_t> triangles);

    std::vector<DVec3> points = {};
    DVec3 normal = {};
};

/// The view of a place.
struct PlaceView {
    PlacePoints points = {};
    ViewAngles angles = {35, 20};
    double around = 1;  ///< scales the points about their center, so that some of what surrounds them is in the picture
    bool is_alone = false;  ///< without other meshes, which hide it from every side
    bool is_place = false;  ///< a part of a primitive

    [[nodiscard]] Camera camera(const PictureSize& size) const;
};

/// A camera over triangles of a mesh, sorted, a little aside, so that relief is seen; farther aside where other triangles hide them.
PlaceView viewOver(std::span<const DrawnMesh> meshes, std::size_t mesh, std::span<const std::size_t> triangles);

/// Number of the first mesh that draws a primitive; nothing where the scene does not draw it.
std::optional<std::size_t> meshOf(const ModelPicture& model, std::size_t primitive);

/// Draws all meshes or, where the view is alone, the one with this number.
RgbImage drawView(RenderShow show, std::span<const DrawnMesh> meshes, std::span<const ShownSurface* const> surfaces,
                  std::size_t mesh, const PlaceView& view, const PictureSize& size, const DVec3& to_light);

/// Draws a rectangle around a place into a picture of kPlaceWidth by kPlaceHeight pixels, beside it, so that it hides nothing of it.
/// Nothing where the place fills the picture. `camera`: of two samples per pixel.
void drawFrame(RgbImage& image, const Camera& camera, const PlacePoints& place);

/// A PNG of kPlaceWidth by kPlaceHeight pixels that shows what `model` was made for, with a frame around the triangles. The camera stands over them,
/// where they are seen best; other meshes are left out where they hide them from every side. Without triangles it sees all
/// of the primitive. Empty where the scene does not draw it. Throws FileError.
std::vector<std::uint8_t> drawPlace(const ModelPicture& model, RenderShow show, std::size_t primitive,
                                    std::span<const std::size_t> triangles);

}  // namespace tspace
