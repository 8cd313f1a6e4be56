// SPDX-License-Identifier: MIT
// Shapes of the tests for linear time, with the names that the table shows.
#include <utility>

#include "core/tangents/shapes.h"
#include "mesh.h"

namespace tspace::bench {

namespace {

struct HardMesh {
    const char* name;
    test::SimpleMesh (*make)(std::size_t triangles);
};

constexpr HardMesh kHardMeshes[] = {
    {"closed fan", test::fan},
    {"open fan", test::unrolledFan},
    {"cone, one apex UV for each face", test::cone},
    {"all triangles collapsed", test::collapsed},
    {"1 % position-degenerate", test::someDegenerate},
    {"book of faces on one edge, one direction", [](std::size_t n) { return test::book(n, false); }},
    {"K different corners at one position", test::duplicatesWithOtherNormals},
    {"crafted quicksort order", test::sortKiller},
    {"checkerboard of mirrored UVs", test::checkerboard},
};

}  // namespace

std::vector<std::string> hardMeshNames() {
    std::vector<std::string> names;
    for (const HardMesh& mesh : kHardMeshes) names.emplace_back(mesh.name);
    return names;
}

Mesh hardMesh(const std::string& name, std::size_t triangles) {
    for (const HardMesh& mesh : kHardMeshes) {
        if (name != mesh.name) continue;
        test::SimpleMesh shape = mesh.make(triangles);
        return {.positions = std::move(shape.positions),
                .normals = std::move(shape.normals),
                .uvs = std::move(shape.uvs),
                .indices = std::move(shape.indices),
                .face_sizes = std::move(shape.face_sizes)};
    }
    return {};
}

}  // namespace tspace::bench
