// SPDX-License-Identifier: MIT
#include "commands/pages/place_pictures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "commands/pages/page_parts.h"
#include "commands/render/model_picture.h"
#include "commands/shared/picture/colors.h"
#include "core/base/vec_math.h"
#include "maps/rays/map_surfaces.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

constexpr PictureSize kPlaceSize{kPlaceWidth, kPlaceHeight, 2};
constexpr Vec3 kFrame{0.90f, 0.05f, 0.45f};

DVec3 placeOfCorner(const DrawnMesh& mesh, std::size_t corner) {
    return mesh.to_world.point(toDouble(mesh.positions[mesh.corners[corner]]));
}

/// Returns the view angles of a camera in this direction from the center.
ViewAngles anglesOf(DVec3 direction) {
    if (!normalize(direction)) return {35, 20};
    const double flat = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const double yaw = polarAngle(direction.z, std::fabs(direction.x)),
                 pitch = polarAngle(flat, std::fabs(direction.y));
    constexpr double kDegrees = 180 / kPi;
    return {kDegrees * (direction.x < 0 ? -yaw : yaw), kDegrees * (direction.y < 0 ? -pitch : pitch)};
}

/// Returns the factor, from 1.2 to 2.5, by which the picture of a location is larger than the location itself, so that
/// it shows surroundings but little beyond the mesh.
double aroundOf(const DrawnMesh& mesh, const PlacePoints& place) {
    constexpr double kMax = 2.5, kMin = 1.2;
    PositionBox whole, part;
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) whole.add(placeOfCorner(mesh, corner));
    for (const DVec3& point : place.points) part.add(point);
    const double size = part.diagonal();
    return size > 0 ? std::clamp(kMin * whole.diagonal() / size, kMin, kMax) : kMax;
}

}  // namespace

PlacePoints::PlacePoints(const DrawnMesh& mesh, std::span<const std::size_t> triangles) {
    for (const std::size_t triangle : triangles) {
        const DVec3 a = placeOfCorner(mesh, 3 * triangle), b = placeOfCorner(mesh, 3 * triangle + 1),
                    c = placeOfCorner(mesh, 3 * triangle + 2);
        normal = normal + cross(b - a, c - a);
        points.insert(points.end(), {a, b, c});
    }
    if (mesh.to_world.determinant() < 0) normal = -1.0 * normal;
}

Camera PlaceView::camera(const PictureSize& size) const {
    DVec3 center;
    for (const DVec3& point : points.points) center = center + (1 / static_cast<double>(points.points.size())) * point;
    return Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) {
            for (const DVec3& point : points.points) visit(center + around * (point - center));
        },
        angles, 30, size.width * size.samples, size.height * size.samples);
}

PlaceView viewOver(std::span<const DrawnMesh> meshes, std::size_t mesh, std::span<const std::size_t> triangles) {
    constexpr ViewAngles kTurns[] = {{12, 8}, {-30, 8}, {40, 8}, {12, 40}, {12, -40}, {-65, 8}, {70, 8}};
    constexpr PictureSize kGlance{80, 60, 1};
    constexpr std::size_t kEnoughSamples = 60;
    // With more triangles in the scene, the first angle is used without drawing it in a small size.
    constexpr std::size_t kMaxTriangles = 2000000;
    PlaceView best{.points = PlacePoints(meshes[mesh], triangles), .is_alone = true, .is_place = true};
    best.around = aroundOf(meshes[mesh], best.points);
    const ViewAngles over = anglesOf(best.points.normal);
    PlaceView view = best;
    view.is_alone = false;
    std::size_t most = 0, triangle_count = 0;
    for (const DrawnMesh& drawn : meshes) triangle_count += drawn.corners.size() / 3;
    for (const ViewAngles& turn : kTurns) {
        view.angles = {over.yaw_deg + turn.yaw_deg, std::clamp(over.pitch_deg + turn.pitch_deg, -90.0, 90.0)};
        if (&turn == kTurns) best.angles = view.angles;
        if (triangle_count > kMaxTriangles) return view;
        WorkLimit work_limit(std::uint64_t{1} << 28);
        const VisibleTriangles visible(meshes, view.camera(kGlance), kGlance.width, kGlance.height, work_limit);
        std::size_t count = 0;
        for (std::uint32_t y = 0; y < kGlance.height; ++y) {
            for (const std::uint32_t number : visible.row(y)) {
                if (number == VisibleTriangles::kNone) continue;
                const VisibleTriangles::Place seen = visible.placeOf(number);
                count += seen.mesh == mesh && std::binary_search(triangles.begin(), triangles.end(), seen.triangle);
            }
        }
        if (count > most) best = view;
        most = std::max(most, count);
        if (most >= kEnoughSamples) break;
    }
    return best;
}

std::optional<std::size_t> meshOf(const ModelPicture& model, std::size_t primitive) {
    const std::span<const ShownSurface* const> surfaces = model.surfaces();
    const auto surface = std::find(surfaces.begin(), surfaces.end(), &model.surfaceOf(primitive).shown);
    if (surface == surfaces.end()) return {};
    return static_cast<std::size_t>(surface - surfaces.begin());
}

RgbImage drawView(RenderShow show, std::span<const DrawnMesh> meshes, std::span<const ShownSurface* const> surfaces,
                  std::size_t mesh, const PlaceView& view, const PictureSize& size, const DVec3& to_light) {
    const std::size_t first = view.is_alone ? mesh : 0, count = view.is_alone ? 1 : surfaces.size();
    WorkLimit work_limit(std::uint64_t{1} << 30);
    Parallel parallel({});
    return drawSurfaces(show, meshes.subspan(first, count), surfaces.subspan(first, count), view.camera(size), to_light,
                        size, work_limit, parallel)
        .image;
}

std::optional<PictureBox> boxAround(const Camera& camera, const PlacePoints& place, std::uint32_t samples) {
    PictureBox box{.left = HUGE_VAL, .right = -HUGE_VAL, .top = HUGE_VAL, .bottom = -HUGE_VAL};
    for (const DVec3& point : place.points) {
        const SeenPoint seen = camera.see(point);
        if (!(seen.w > camera.minW())) return {};
        const double x = seen.x / seen.w / samples, y = seen.y / seen.w / samples;
        box.left = std::min(box.left, x);
        box.right = std::max(box.right, x);
        box.top = std::min(box.top, y);
        box.bottom = std::max(box.bottom, y);
    }
    return box;
}

void drawFrame(RgbImage& image, const Camera& camera, const PlacePoints& place) {
    constexpr double kBeside = 4, kMinSide = 14, kMaxPart = 0.9;
    const std::optional<PictureBox> box = boxAround(camera, place, kPlaceSize.samples);
    if (!box) return;
    auto [left, right, top, bottom] = *box;
    const double wide = std::max(0.0, kMinSide - (right - left)) / 2 + kBeside,
                 high = std::max(0.0, kMinSide - (bottom - top)) / 2 + kBeside;
    left = std::floor(std::clamp(left - wide, 0.0, image.width - 1.0));
    right = std::floor(std::clamp(right + wide, 0.0, image.width - 1.0));
    top = std::floor(std::clamp(top - high, 0.0, image.height - 1.0));
    bottom = std::floor(std::clamp(bottom + high, 0.0, image.height - 1.0));
    // A frame that surrounds nearly the whole picture is omitted.
    if (!(right - left < kMaxPart * image.width) && !(bottom - top < kMaxPart * image.height)) return;
    const auto x = static_cast<std::int64_t>(left), y = static_cast<std::int64_t>(top),
               width = static_cast<std::int64_t>(right - left) + 1,
               height = static_cast<std::int64_t>(bottom - top) + 1;
    fillRect(image, x, y, width, 1, kFrame);
    fillRect(image, x, y + height - 1, width, 1, kFrame);
    fillRect(image, x, y, 1, height, kFrame);
    fillRect(image, x + width - 1, y, 1, height, kFrame);
}

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
    const std::optional<std::size_t> number = meshOf(model, primitive);
    if (!number) return {};
    const DrawnMesh& mesh = model.meshes()[*number];
    std::vector<std::size_t> held(triangles.begin(), triangles.end());
    std::sort(held.begin(), held.end());
    if (triangles.empty()) {
        held.resize(mesh.corners.size() / 3);
        std::iota(held.begin(), held.end(), std::size_t{0});
    }
    const PlaceView view =
        triangles.empty() ? PlaceView{.points = PlacePoints(mesh, held)} : viewOver(model.meshes(), *number, held);
    const Camera camera = view.camera(kPlaceSize);
    DVec3 to_light = -0.45 * camera.right() + 0.65 * camera.up() + 0.8 * camera.back();
    normalize(to_light);
    RgbImage image = drawView(show, model.meshes(), model.surfaces(), *number, view, kPlaceSize, to_light);
    if (view.is_place) drawFrame(image, camera, view.points);
    return encodePicture(image);
}

}  // namespace tspace
