// SPDX-License-Identifier: MIT
#include "page/finding_pictures.h"

#include <algorithm>
#include <cmath>

#include "asset/file_error.h"
#include "asset/read/read_scene.h"
#include "core/angle.h"
#include "core/unit.h"
#include "picture/legend.h"
#include "render/model_picture.h"
#include "render/picture_file.h"

namespace tspace {

namespace {

constexpr std::uint32_t kFindingWidth = 320, kFindingHeight = 240, kFindingSamples = 2;
constexpr Vec3 kOutline{0.90f, 0.05f, 0.45f};

/// What a second picture shows.
enum class Mend { none, newFrames, otherGreen };

Mend mendOf(FindingCode code) {
    switch (code) {
        case FindingCode::tangentsMissing:
        case FindingCode::tangentsNotFinite:
        case FindingCode::tangentsNotUnit:
        case FindingCode::tangentsNotOrthogonal:
        case FindingCode::signsNotOne:
        case FindingCode::signsMixed:
        case FindingCode::signsInverted:
        case FindingCode::signsWrong:
        case FindingCode::mirroredSeamAveraged:
        case FindingCode::uvSeamAveraged:
        case FindingCode::directionsWrong:
        case FindingCode::uvSetWrong:
        case FindingCode::textureTransformIgnored:
        case FindingCode::splitFramesDiffer:
            return Mend::newFrames;
        case FindingCode::greenFlipped:
            return Mend::otherGreen;
        default:
            return Mend::none;
    }
}

/// Triangles of a mesh, by number: those that the finding is about; all of them where it names no vertex.
std::vector<std::size_t> namedTriangles(const DrawnMesh& mesh, const Finding& finding) {
    std::vector<std::size_t> triangles;
    for (std::size_t i = 0; i < mesh.corners.size() / 3; ++i) {
        const std::span<const std::uint32_t> corners = mesh.corners.subspan(3 * i, 3);
        const bool is_named = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
            return std::find(finding.vertices.begin(), finding.vertices.end(), vertex) != finding.vertices.end();
        });
        if (is_named || finding.vertices.empty()) triangles.push_back(i);
    }
    return triangles;
}

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

/// Over the middle of the triangles, a little aside, so that relief is seen.
Camera cameraOver(const DrawnMesh& mesh, std::span<const std::size_t> triangles, bool is_whole) {
    DVec3 normal;
    std::vector<DVec3> points;
    for (const std::size_t triangle : triangles) {
        const DVec3 a = placeOfCorner(mesh, 3 * triangle), b = placeOfCorner(mesh, 3 * triangle + 1),
                    c = placeOfCorner(mesh, 3 * triangle + 2);
        normal = normal + cross(b - a, c - a);
        points.insert(points.end(), {a, b, c});
    }
    if (mesh.to_world.determinant() < 0) normal = -1.0 * normal;
    const ViewAngles over = is_whole ? ViewAngles{35, 20} : anglesOf(normal);
    const ViewAngles angles{over.yaw_deg + (is_whole ? 0 : 12), std::clamp(over.pitch_deg + 8, -90.0, 90.0)};
    DVec3 centre;
    for (const DVec3& point : points) centre = centre + (1 / static_cast<double>(points.size())) * point;
    const double around = is_whole ? 1 : 2.5;
    return Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) {
            for (const DVec3& point : points) visit(centre + around * (point - centre));
        },
        angles, 30, kFindingWidth * kFindingSamples, kFindingHeight * kFindingSamples);
}

void drawOutline(RgbImage& image, const Camera& camera, const DVec3& from, const DVec3& to) {
    const SeenPoint a = camera.see(from), b = camera.see(to);
    if (!(a.w > camera.leastW()) || !(b.w > camera.leastW())) return;
    const double ax = a.x / a.w / kFindingSamples, ay = a.y / a.w / kFindingSamples, bx = b.x / b.w / kFindingSamples,
                 by = b.y / b.w / kFindingSamples;
    const double steps = std::max(std::fabs(bx - ax), std::fabs(by - ay));
    if (!(steps < 4 * kFindingWidth)) return;
    for (int i = 0; i <= static_cast<int>(steps); ++i) {
        const double t = steps < 1 ? 0 : i / steps;
        fillRect(image, static_cast<std::int64_t>(std::floor(ax + t * (bx - ax))),
                 static_cast<std::int64_t>(std::floor(ay + t * (by - ay))), 1, 1, kOutline);
    }
}

}  // namespace

struct FindingPictures::Model {
    Model(const std::string& input, const FileOptions& options)
        : drawn(readDrawnScene(input, options, true)), textures(drawn.scene, std::uint64_t{1} << 26) {}

    const ModelPicture& pictureOf(RenderFrames frames, Green green) {
        std::unique_ptr<ModelPicture>& picture = pictures[frames == RenderFrames::computed ? 1
                                                          : green == Green::down           ? 2
                                                                                           : 0];
        if (!picture) {
            picture = std::make_unique<ModelPicture>(drawn, RenderShow::lit, FrameChoice{.frames = frames},
                                                     MapReading{.green = green}, &textures);
        }
        return *picture;
    }

    DrawnScene drawn;
    ModelTextures textures;
    std::unique_ptr<ModelPicture> pictures[3] = {};
};

FindingPictures::FindingPictures(const std::string& input, const FileOptions& options)
    : model_(std::make_unique<Model>(input, options)) {}

FindingPictures::~FindingPictures() = default;

FindingPicture FindingPictures::draw(const Finding& finding) {
    FindingPicture result;
    if (finding.place.empty()) return result;
    const std::vector<ScenePrimitive>& primitives = model_->drawn.scene.primitives;
    const auto primitive = std::find_if(primitives.begin(), primitives.end(), [&](const ScenePrimitive& candidate) {
        return candidate.mesh == finding.mesh && candidate.primitive == finding.primitive;
    });
    if (primitive == primitives.end()) return result;
    const auto drawWith = [&](RenderFrames frames, Green green) {
        const ModelPicture& model = model_->pictureOf(frames, green);
        const std::span<const DrawnMesh> meshes = model.meshes();
        const auto mesh = std::find_if(meshes.begin(), meshes.end(), [&](const DrawnMesh& candidate) {
            return candidate.positions.data() == primitive->positions.data() &&
                   candidate.corners.data() == primitive->corners.data();
        });
        if (mesh == meshes.end()) return std::vector<std::uint8_t>{};
        const std::vector<std::size_t> triangles = namedTriangles(*mesh, finding);
        const bool is_whole = finding.vertices.empty() || triangles.empty();
        const Camera camera = cameraOver(*mesh, triangles, is_whole);
        Effort effort(std::uint64_t{1} << 30);
        Parallel parallel({});
        DVec3 to_light = -0.45 * camera.right() + 0.65 * camera.up() + 0.8 * camera.back();
        normalize(to_light);
        SurfacePicture picture = drawSurfaces(RenderShow::lit, meshes, model.surfaces(), camera, to_light,
                                              {kFindingWidth, kFindingHeight, kFindingSamples}, effort, parallel);
        for (std::size_t i = 0; !is_whole && i < triangles.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                drawOutline(picture.image, camera, placeOfCorner(*mesh, 3 * triangles[i] + k),
                            placeOfCorner(*mesh, 3 * triangles[i] + (k + 1) % 3));
            }
        }
        return encodePicture(picture.image);
    };
    const Mend mend = mendOf(finding.code);
    const bool lacks = finding.code == FindingCode::tangentsMissing;
    result.before = drawWith(lacks ? RenderFrames::stored : RenderFrames::automatic, Green::up);
    if (mend == Mend::newFrames) result.after = drawWith(RenderFrames::computed, Green::up);
    if (mend == Mend::otherGreen) result.after = drawWith(RenderFrames::automatic, Green::down);
    return result;
}

}  // namespace tspace
