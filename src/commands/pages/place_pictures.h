// SPDX-License-Identifier: MIT
// Pictures of locations on models.
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

/// A model that was read for pictures. The lit surfaces are prepared when they are first requested.
class PicturedModel {
  public:
    /// Reads the model. Throws FileError.
    PicturedModel(const std::string& input, const FileOptions& options);
    explicit PicturedModel(DrawnScene&& drawn);
    PicturedModel(const PicturedModel&) = delete;
    PicturedModel& operator=(const PicturedModel&) = delete;

    [[nodiscard]] const Scene& scene() const { return drawn_.scene; }
    [[nodiscard]] const DrawnScene& drawn() const { return drawn_; }
    /// Returns the lit surfaces. `frames`: any value except `computed`. Throws FileError.
    const ModelPicture& lit(RenderFrames frames);

  private:
    DrawnScene drawn_;
    ModelTextures textures_;
    std::unique_ptr<ModelPicture> lit_[2] = {};
};

/// Returns the index of a primitive in a scene, or kNoPrimitive.
std::size_t findPrimitive(const Scene& scene, std::uint32_t mesh, std::uint32_t primitive);

/// Returns the triangles of a primitive that use one of a few vertices, in order.
std::vector<std::size_t> trianglesAt(const ScenePrimitive& primitive, std::span<const std::uint32_t> vertices);

/// Returns the partners of triangles of A; triangles without a partner are omitted.
std::vector<std::size_t> partnersOf(const PrimitivePair& pair, std::span<const std::size_t> triangles);

/// Corners of triangles in world space, and the sum of their normals.
struct PlacePoints {
    PlacePoints() = default;
    PlacePoints(const DrawnMesh& mesh, std::span<const std::size_t> triangles);

    std::vector<DVec3> points = {};
    DVec3 normal = {};
};

/// A view of a location.
struct PlaceView {
    PlacePoints points = {};
    ViewAngles angles = {35, 20};
    double around = 1;  ///< scales the points about their center, so that the picture shows some of the surroundings
    bool is_alone = false;  ///< draws only one mesh, because others hide the location from every side
    bool is_place = false;  ///< part of a primitive, not all of it

    [[nodiscard]] Camera camera(const PictureSize& size) const;
};

/// Returns a camera above triangles of a mesh; slightly oblique, so that relief is visible, and more oblique if other
/// triangles hide them. `triangles`: sorted.
PlaceView viewOver(std::span<const DrawnMesh> meshes, std::size_t mesh, std::span<const std::size_t> triangles);

/// Returns the index of the first mesh that draws a primitive, or nothing if the scene does not draw it.
std::optional<std::size_t> meshOf(const ModelPicture& model, std::size_t primitive);

/// Draws all meshes, or only the mesh with the index `mesh` if view.is_alone is true.
RgbImage drawView(RenderShow show, std::span<const DrawnMesh> meshes, std::span<const ShownSurface* const> surfaces,
                  std::size_t mesh, const PlaceView& view, const PictureSize& size, const DVec3& to_light);

/// A rectangle of a picture, in pixels.
struct PictureBox {
    double left = 0, right = 0, top = 0, bottom = 0;
};

/// Returns the box around a location in a picture, which may extend beyond the picture, or nothing if a part of it is
/// behind the camera. `camera`: camera for `samples` samples per pixel.
std::optional<PictureBox> boxAround(const Camera& camera, const PlacePoints& place, std::uint32_t samples);

/// Draws a rectangle around a location into a picture of kPlaceWidth by kPlaceHeight pixels, with a margin so that it
/// covers no part of the location. Draws nothing if the location fills the picture. `camera`: camera for two samples
/// per pixel.
void drawFrame(RgbImage& image, const Camera& camera, const PlacePoints& place);

/// Returns a PNG of kPlaceWidth by kPlaceHeight pixels that shows the view for which `model` was made, with a frame
/// around the triangles. The camera is above them, where they are most visible; other meshes are omitted if they hide
/// the triangles from every side. Without triangles it shows the whole primitive. Empty if the scene does not draw it.
/// Throws FileError.
std::vector<std::uint8_t> drawPlace(const ModelPicture& model, RenderShow show, std::size_t primitive,
                                    std::span<const std::size_t> triangles);

}  // namespace tspace
