// SPDX-License-Identifier: MIT
#include "commands/shared/page/place_pictures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "commands/render/model_picture.h"
#include "commands/shared/page/page_parts.h"
#include "commands/shared/picture/colors.h"
#include "core/base/vec_math.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

constexpr std::uint32_t kPlaceSamples = 2;
constexpr Vec3 kOutline{0.90f, 0.05f, 0.45f};

DVec3 placeOfCorner(const DrawnMesh& mesh, std::size_t corner) {
    return mesh.to_world.point(toDouble(mesh.positions[mesh.corners[corner]]));
}

/// From where a direction is looked at.
ViewAngles anglesOf(DVec3 direction) {
    if (!normalize(direction)) return {35, 20};
    const double flat = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const double yaw = polarAngle(direction.z, std::fabs(direction.x)),
                 pitch = polarAngle(flat, std::fabs(direction.y));
    constexpr double kDegrees = 180 / kPi;
    return {kDegrees * (direction.x < 0 ? -yaw : yaw), kDegrees * (direction.y < 0 ? -pitch : pitch)};
}

/// Corners of triangles in the world, and the sum of their normals.
struct PlacePoints {
    PlacePoints(const DrawnMesh& mesh, std::span<const std::size_t> triangles) {
        for (const std::size_t triangle : triangles) {
            const DVec3 a = placeOfCorner(mesh, 3 * triangle), b = placeOfCorner(mesh, 3 * triangle + 1),
                        c = placeOfCorner(mesh, 3 * triangle + 2);
            normal = normal + cross(b - a, c - a);
            points.insert(points.end(), {a, b, c});
        }
        if (mesh.to_world.determinant() < 0) normal = -1.0 * normal;
    }

    std::vector<DVec3> points = {};
    DVec3 normal = {};
};

/// A camera that holds the points, scaled by `around` about their centre.
Camera cameraOver(const PlacePoints& place, const ViewAngles& angles, double around, std::uint32_t width,
                  std::uint32_t height) {
    DVec3 centre;
    for (const DVec3& point : place.points) centre = centre + (1 / static_cast<double>(place.points.size())) * point;
    return Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) {
            for (const DVec3& point : place.points) visit(centre + around * (point - centre));
        },
        angles, 30, width, height);
}

/// The view of a place.
struct PlaceView {
    ViewAngles angles = {35, 20};
    double around = 1;
    bool is_alone = false;  ///< without other meshes, which hide it from every side
};

/// A camera over the triangles, a little aside, so that relief is seen; farther aside where other triangles hide them.
PlaceView viewOver(std::span<const DrawnMesh> meshes, std::size_t mesh, std::span<const std::size_t> triangles,
                   const PlacePoints& place) {
    constexpr ViewAngles kTurns[] = {{12, 8}, {-30, 8}, {40, 8}, {12, 40}, {12, -40}, {-65, 8}, {70, 8}};
    constexpr std::uint32_t kWidth = 80, kHeight = 60, kEnoughSamples = 60;
    constexpr std::size_t kMostTriangles = 2000000;  // of more, no small pictures are drawn first
    const ViewAngles over = anglesOf(place.normal);
    PlaceView best{.around = 2.5, .is_alone = true};
    std::size_t most = 0, triangle_count = 0;
    for (const DrawnMesh& drawn : meshes) triangle_count += drawn.corners.size() / 3;
    for (const ViewAngles& turn : kTurns) {
        const ViewAngles angles{over.yaw_deg + turn.yaw_deg, std::clamp(over.pitch_deg + turn.pitch_deg, -90.0, 90.0)};
        if (&turn == kTurns) best.angles = angles;
        if (triangle_count > kMostTriangles) return {angles, best.around, false};
        Effort effort(std::uint64_t{1} << 28);
        const VisibleTriangles visible(meshes, cameraOver(place, angles, best.around, kWidth, kHeight), kWidth, kHeight,
                                       effort);
        std::size_t count = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (const std::uint32_t number : visible.row(y)) {
                if (number == VisibleTriangles::kNone) continue;
                const VisibleTriangles::Place seen = visible.placeOf(number);
                count += seen.mesh == mesh && std::binary_search(triangles.begin(), triangles.end(), seen.triangle);
            }
        }
        if (count > most) best = {angles, best.around, false};
        most = std::max(most, count);
        if (most >= kEnoughSamples) break;
    }
    return best;
}

void drawOutline(RgbImage& image, const Camera& camera, const DVec3& from, const DVec3& to) {
    const SeenPoint a = camera.see(from), b = camera.see(to);
    if (!(a.w > camera.leastW()) || !(b.w > camera.leastW())) return;
    const double ax = a.x / a.w / kPlaceSamples, ay = a.y / a.w / kPlaceSamples, bx = b.x / b.w / kPlaceSamples,
                 by = b.y / b.w / kPlaceSamples;
    const double steps = std::max(std::fabs(bx - ax), std::fabs(by - ay));
    if (!(steps < 4 * kPlaceWidth)) return;
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
        const double t = steps < 1 ? 0 : i / steps;
        fillRect(image, static_cast<std::int64_t>(std::floor(ax + t * (bx - ax))),
                 static_cast<std::int64_t>(std::floor(ay + t * (by - ay))), 1, 1, kOutline);
    }
}

}  // namespace

PicturedModel::PicturedModel(const std::string& input, const FileOptions& options)
    : PicturedModel(readDrawnScene(input, options, true)) {}

PicturedModel::PicturedModel(DrawnScene&& drawn)
    : drawn_(std::move(drawn)), textures_(drawn_.scene, std::uint64_t{1} << 26) {
    showHeights(Method::mikktspace, {}, drawn_);
}

const ModelPicture& PicturedModel::lit(RenderFrames frames) {
    std::unique_ptr<ModelPicture>& picture = lit_[frames == RenderFrames::stored ? 1 : 0];
    if (!picture) {
        picture = std::make_unique<ModelPicture>(drawn_, RenderShow::lit, FrameChoice{.frames = frames}, MapReading{},
                                                 &textures_);
    }
    return *picture;
}

std::size_t findPrimitive(const Scene& scene, std::uint32_t mesh, std::uint32_t primitive) {
    const auto found = std::find_if(
        scene.primitives.begin(), scene.primitives.end(),
        [&](const ScenePrimitive& candidate) { return candidate.mesh == mesh && candidate.primitive == primitive; });
    return found == scene.primitives.end() ? kNoPrimitive : static_cast<std::size_t>(found - scene.primitives.begin());
}

std::vector<std::size_t> trianglesAt(const ScenePrimitive& primitive, std::span<const std::uint32_t> vertices) {
    std::vector<std::size_t> triangles;
    for (std::size_t i = 0; i < primitive.corners.size() / 3; ++i) {
        const std::span<const std::uint32_t> corners = primitive.corners.span().subspan(3 * i, 3);
        if (std::find_first_of(corners.begin(), corners.end(), vertices.begin(), vertices.end()) != corners.end())
            triangles.push_back(i);
    }
    return triangles;
}

std::vector<std::size_t> partnersOf(const PrimitivePair& pair, std::span<const std::size_t> triangles) {
    std::vector<std::size_t> partners;
    for (const TrianglePair& two : pair.triangles) {
        if (std::binary_search(triangles.begin(), triangles.end(), two.a)) partners.push_back(two.b);
    }
    return partners;
}

std::vector<std::uint8_t> drawPlace(const ModelPicture& model, RenderShow show, std::size_t primitive,
                                    std::span<const std::size_t> triangles) {
    const std::span<const ShownSurface* const> surfaces = model.surfaces();
    const auto surface = std::find(surfaces.begin(), surfaces.end(), &model.surfaceOf(primitive).shown);
    if (surface == surfaces.end()) return {};
    const auto number = static_cast<std::size_t>(surface - surfaces.begin());
    const DrawnMesh& mesh = model.meshes()[number];
    std::vector<std::size_t> held(triangles.begin(), triangles.end());
    std::sort(held.begin(), held.end());
    if (triangles.empty()) {
        held.resize(mesh.corners.size() / 3);
        std::iota(held.begin(), held.end(), std::size_t{0});
    }
    const PlacePoints place(mesh, held);
    const PlaceView view = triangles.empty() ? PlaceView{} : viewOver(model.meshes(), number, held, place);
    const Camera camera =
        cameraOver(place, view.angles, view.around, kPlaceWidth * kPlaceSamples, kPlaceHeight * kPlaceSamples);
    const std::size_t first = view.is_alone ? number : 0, count = view.is_alone ? 1 : surfaces.size();
    Effort effort(std::uint64_t{1} << 30);
    Parallel parallel({});
    DVec3 to_light = -0.45 * camera.right() + 0.65 * camera.up() + 0.8 * camera.back();
    normalize(to_light);
    SurfacePicture picture =
        drawSurfaces(show, model.meshes().subspan(first, count), surfaces.subspan(first, count), camera, to_light,
                     {kPlaceWidth, kPlaceHeight, kPlaceSamples}, effort, parallel);
    for (const std::size_t triangle : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            drawOutline(picture.image, camera, placeOfCorner(mesh, 3 * triangle + k),
                        placeOfCorner(mesh, 3 * triangle + (k + 1) % 3));
        }
    }
    return encodePicture(picture.image);
}

}  // namespace tspace
