// SPDX-License-Identifier: MIT
// shading_normals MODEL OUT SIZE: the normals that `tspace render` shades, read as three.js reads normal maps, from the
// front without perspective: SIZE x SIZE pixels of four floats, the last of which is 1 where there is a surface.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "asset/file_error.h"
#include "asset/read/read_scene.h"
#include "render/model_picture.h"

using namespace tspace;  // NOLINT: a small program

namespace {

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
    Effort effort(std::uint64_t{1} << 40);
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
            const SeenTriangle seen = visible.seen(place);
            const Affine& to_world = model.meshes()[place.mesh].to_world;
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
