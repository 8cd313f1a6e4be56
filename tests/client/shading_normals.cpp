// SPDX-License-Identifier: MIT
// shading_normals MODEL OUT SIZE: writes the shading normals of `tspace render`, with normal maps interpreted as in
// three.js, seen from the front without perspective: SIZE x SIZE pixels of four floats, the last of which is 1 where
// there is a surface. Corners of triangles are rounded as in Chromium's software rasterizer, so that the same points of
// a surface are compared.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "commands/render/model_picture.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"

using namespace tspace;  // NOLINT: a small program

namespace {

/// Corners are rounded to 1 / kPixelParts of a pixel, as in SwiftShader (its SUBPIXEL_BITS is 4). If eight texels fall
/// into one pixel, this rounding alone changes normals by 0.2 degrees.
constexpr double kPixelParts = 16;

/// Returns a triangle as Chromium's software rasterizer sees it, without perspective.
SeenTriangle roundedTriangle(const DrawnMesh& mesh, std::size_t triangle, const Camera& camera) {
    std::array<SeenPoint, 3> points;
    for (std::size_t k = 0; k < 3; ++k) {
        SeenPoint& point = points[k];
        point = camera.see(mesh.to_world.point(toDouble(mesh.positions[mesh.corners[3 * triangle + k]])));
        point.x = std::floor(point.x * kPixelParts + 0.5) / kPixelParts;
        point.y = std::floor(point.y * kPixelParts + 0.5) / kPixelParts;
    }
    return SeenTriangle(points);
}

std::vector<float> normalsOf(const std::string& path, std::uint32_t size) {
    const DrawnScene drawn = readDrawnScene(path, {.memory_limit_bytes = kNoMemoryLimit}, true);
    ModelTextures textures(drawn.scene, std::uint64_t{1} << 26);
    const ModelPicture model(drawn, RenderShow::mapped, {}, *findMapReading("three"), &textures);
    const Camera camera = Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) {
            for (const DrawnMesh& mesh : model.meshes()) {
                for (const std::uint32_t vertex : mesh.corners)
                    visit(mesh.to_world.point(toDouble(mesh.positions[vertex])));
            }
        },
        {}, 0, size, size);
    WorkLimit effort(std::uint64_t{1} << 40);
    const VisibleTriangles visible(model.meshes(), camera, size, size, effort);
    std::vector<float> pixels;
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const std::uint32_t number = visible.row(y)[x];
            if (number == VisibleTriangles::kNone) {
                pixels.insert(pixels.end(), {0, 0, 0, 0});
                continue;
            }
            const VisibleTriangles::Place place = visible.placeOf(number);
            const DrawnMesh& mesh = model.meshes()[place.mesh];
            const SeenTriangle rounded = roundedTriangle(mesh, place.triangle, camera);
            // The thinnest triangles vanish when their corners are rounded; then the exact corners are used.
            const SeenTriangle seen = rounded.isSeen() ? rounded : visible.seen(place);
            const Affine& to_world = mesh.to_world;
            const SurfacePoint point{.triangle = place.triangle,
                                     .weights = seen.weightsAt(x + 0.5, y + 0.5),
                                     .is_back = seen.isFront() == (to_world.determinant() < 0)};
            const Vec3 normal = toFloat(mappedNormal(*model.surfaces()[place.mesh], to_world, point));
            pixels.insert(pixels.end(), {normal.x, normal.y, normal.z, 1});
        }
    }
    return pixels;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    std::vector<float> pixels;
    try {
        pixels = normalsOf(argv[1], static_cast<std::uint32_t>(std::atoi(argv[3])));
    } catch (const FileError& failure) {
        std::fprintf(stderr, "shading_normals: %s\n", failure.error.message.c_str());
        return 3;
    }
    std::ofstream file(argv[2], std::ios::binary);
    file.write(reinterpret_cast<const char*>(pixels.data()),
               static_cast<std::streamsize>(pixels.size() * sizeof(float)));
    return file.good() ? 0 : 4;
}
