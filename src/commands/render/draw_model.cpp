// SPDX-License-Identifier: MIT
#include "commands/render/draw_model.h"

#include "commands/shared/picture/legend.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// Twice: for the camera's direction, and for its distance.
void visitPoints(const ModelPicture& model, Effort& effort, bool is_uv,
                 const std::function<void(const DVec3&)>& visit) {
    for (const DrawnMesh& mesh : model.meshes()) {
        effort.spend(1 + 2 * mesh.corners.size());
        for (const std::uint32_t vertex : mesh.corners) visit(mesh.to_world.point(toDouble(mesh.positions[vertex])));
    }
    if (!is_uv) return;
    visit({0, 0, 0});
    visit({1, -1, 0});
}

}  // namespace

SurfacePicture drawModel(const ModelPicture& model, const RenderOptions& options) {
    const bool is_uv = options.show == RenderShow::uv;
    // Under the heat map stands its scale.
    const std::uint32_t scale_rows = options.show == RenderShow::error ? heatScaleRows(options.width) : 0;
    const std::uint32_t height = scale_rows + 16 <= options.height ? options.height - scale_rows : options.height;
    const std::uint64_t samples = std::uint64_t{options.width} * options.samples * options.height * options.samples;
    constexpr std::uint64_t kSteps = std::uint64_t{1} << 28, kMostLayers = 100, kCornerSteps = 64;
    Effort effort(kSteps + kMostLayers * samples + kCornerSteps * model.cornerCount());
    const ViewAngles angles = is_uv ? ViewAngles{} : ViewAngles{options.yaw_deg, options.pitch_deg};
    const Camera camera = Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) { visitPoints(model, effort, is_uv, visit); }, angles,
        is_uv ? 0 : options.field_of_view_deg, options.width * options.samples, height * options.samples);
    const DVec3 light = toDouble(options.to_light);
    DVec3 to_light = light.x * camera.right() + light.y * camera.up() + light.z * camera.back();
    normalize(to_light);
    Parallel parallel(options.execution);
    SurfacePicture picture = drawSurfaces(options.show, model.meshes(), model.surfaces(), camera, to_light,
                                          {options.width, height, options.samples}, effort, parallel);
    if (height != options.height) {
        picture.image.height = options.height;
        picture.image.rgb.resize(std::size_t{3} * options.width * options.height);
        drawHeatScale(picture.image);
    }
    if (is_uv) drawUvSquare(picture.image, camera, options.samples);
    return picture;
}

}  // namespace tspace
