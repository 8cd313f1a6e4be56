// SPDX-License-Identifier: MIT
// Compares the simple implementation of MikkTSpace with stored results of the reference, and the library's `mikktspace`
// with the simple implementation.
#include "core/tangents/mikktspace/plain.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/random_shapes.h"
#include "support/shared_data.h"

namespace tspace::mikk {
namespace {

using test::Outputs;
using test::sameBits;
using test::SimpleMesh;

Outputs plain(const MeshView& mesh, const TangentOptions& options) {
    Outputs outputs(mesh.cornerCount());
    plainMikktspace(mesh, options, outputs.view());
    return outputs;
}

bool engineIsExact(const MeshView& mesh, const TangentOptions& options) {
    Outputs got(mesh.cornerCount());
    return generateTangents(mesh, options, got.view(), {.thread_count = 1}) && sameBits(plain(mesh, options), got);
}

bool sameCounts(const TangentReport& a, const TangentReport& b) {
    const auto counts = [](const TangentReport& r) {
        return std::array{r.triangle_count, r.degenerate_triangle_count, r.degenerate_uv_count, r.mirrored_count,
                          r.group_count,    r.default_corner_count,      r.not_finite_count};
    };
    return counts(a) == counts(b);
}

/// Compares a single call. Unused vertices are added, because the code path for small meshes does not support so many
/// vertices.
bool onePassIsExact(const MeshView& mesh, const TangentOptions& options) {
    std::vector<Vec3> positions(mesh.vertexCount() + 200, Vec3{1, 2, 3}), normals(positions.size(), Vec3{0, 0, 1});
    std::vector<Vec2> uvs(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const bool is_own = v < mesh.vertexCount();
        uvs[v] = is_own ? mesh.uvs[v] : Vec2{static_cast<float>(v), 0};
        if (is_own) positions[v] = mesh.positions[v], normals[v] = mesh.normals[v];
    }
    std::vector<std::uint32_t> indices;
    for (std::size_t c = 0; c < mesh.cornerCount(); ++c) indices.push_back(mesh.indices[c]);
    MeshView larger = mesh;
    larger.positions = {positions.data(), positions.size()};
    larger.normals = {normals.data(), normals.size()};
    larger.uvs = {uvs.data(), uvs.size()};
    larger.indices = IndexView(indices);
    Outputs got(mesh.cornerCount()), small(mesh.cornerCount());
    const Result<TangentReport> report = generateTangents(larger, options, got.view(), {.thread_count = 1});
    const Result<TangentReport> of_small = generateTangents(mesh, options, small.view(), {.thread_count = 1});
    return report && of_small && sameCounts(*report, *of_small) && sameBits(plain(mesh, options), got) &&
           sameBits(small, got);
}

/// Compares the evaluation of a plan, which computes its result differently from a single call.
bool planIsExact(const MeshView& mesh, const TangentOptions& options) {
    Outputs got(mesh.cornerCount());
    const Result<TangentPlan> plan_made = planTangents(mesh, options, {.thread_count = 1});
    return plan_made && evaluateTangents(*plan_made, {mesh.positions, mesh.normals}, got.view(), {.thread_count = 1}) &&
           sameBits(plain(mesh, options), got);
}

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(PlainMikktspace, EveryWordEqualsTheReference) {
    TSPACE_NEEDS_SHARED("golden/mikktspace");
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::shared("golden/mikktspace"))) {
        if (entry.path().extension() != ".tsg") continue;
        test::GoldenMesh golden;
        ASSERT_TRUE(readGolden(entry.path(), golden)) << entry.path();
        if (!hasPromisedBits(golden.shape)) continue;
        const Outputs got = plain(golden.shape.view(), {.convention = conventions::opengl,
                                                        .angular_threshold_deg = golden.angular_threshold_deg});
        for (std::size_t c = 0; c < golden.results.size(); ++c) {
            const test::GoldenResult& want = golden.results[c];
            ASSERT_TRUE(sameBits(want.tangent, xyz(got.tangents[c])) && sameBits(want.sign, got.tangents[c].w) &&
                        sameBits(want.bitangent, got.bitangents[c]) &&
                        sameBits(want.magnitude_s, got.magnitudes_s[c]) &&
                        sameBits(want.magnitude_t, got.magnitudes_t[c]))
                << entry.path() << ", corner " << c;
        }
        ++count;
    }
    EXPECT_GT(count, 300);
}

/// Compares `count` random meshes, starting at number `first`. The environment variables TSPACE_FIRST_MESH and
/// TSPACE_MESHES override them.
void compareRandomMeshes(std::uint64_t first, std::uint64_t count,
                         bool (*isExact)(const MeshView&, const TangentOptions&)) {
    first = setting("TSPACE_FIRST_MESH", first);
    count = setting("TSPACE_MESHES", count);
    std::uint64_t compared = 0;
    for (std::uint64_t number = first; number < first + count; ++number) {
        const auto [shape, threshold] = test::randomCase(number);
        if (!hasPromisedBits(shape)) continue;
        ++compared;
        ASSERT_TRUE(isExact(shape.view(), {.convention = number % 2 == 0 ? conventions::opengl : conventions::gltf,
                                           .ngons = Ngons::skip,
                                           .angular_threshold_deg = threshold,
                                           .pairing = number % 3 == 0 ? Pairing::corrected : Pairing::reference}))
            << "mesh " << number << ", threshold " << threshold;
    }
    EXPECT_GT(compared, count / 2);
}

TEST(PlainMikktspace, TheEngineHasItsBitsOnRandomMeshes) { compareRandomMeshes(0, 1'000'000, engineIsExact); }
TEST(PlainMikktspace, OnePassHasItsBitsOnRandomMeshes) { compareRandomMeshes(2'000'000, 250'000, onePassIsExact); }
TEST(PlainMikktspace, PlansHaveItsBitsOnRandomMeshes) { compareRandomMeshes(1'000'000, 250'000, planIsExact); }

/// Compares larger meshes, whose nodes the library computes by its fast path, in natural and in random order.
TEST(PlainMikktspace, TheEngineHasItsBitsOnRegularMeshes) {
    std::vector<SimpleMesh> shapes{test::grid(40),
                                   test::fan(300),
                                   test::unrolledFan(300),
                                   test::cone(200),
                                   test::collapsed(100),
                                   test::book(200, true),
                                   test::book(200, false),
                                   test::checkerboard(2000),
                                   test::someDegenerate(2000),
                                   test::someWithoutUvArea(2000)};
    for (std::uint32_t columns = 4; columns <= 24; columns += 5) {
        for (std::uint32_t rows = 5; rows <= 60; rows += 11)
            shapes.push_back(test::torus(columns, rows, rows % 2 != 0));
    }
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        for (const float threshold : {180.0f, 30.0f}) {
            const TangentOptions options{.convention = conventions::opengl, .angular_threshold_deg = threshold};
            EXPECT_TRUE(engineIsExact(shapes[i].view(), options)) << "shape " << i << ", threshold " << threshold;
            EXPECT_TRUE(planIsExact(shapes[i].view(), options)) << "shape " << i << ", threshold " << threshold;
        }
        shuffleTriangles(shapes[i], 7);
        EXPECT_TRUE(engineIsExact(shapes[i].view(), {.convention = conventions::opengl})) << "shuffled shape " << i;
    }
}

TEST(PlainMikktspace, FacesThatAreNotTrianglesOrQuadsGetZeros) {
    SimpleMesh shape;
    for (int i = 0; i < 5; ++i)
        shape.addVertex({static_cast<float>(i), static_cast<float>(i * i), 0}, {0, 0, 1}, {static_cast<float>(i), 0});
    shape.addFace({0, 1, 2, 3, 4});
    shape.addFace({0, 1});
    EXPECT_TRUE(engineIsExact(shape.view(), {.convention = conventions::gltf, .ngons = Ngons::skip}));
    EXPECT_EQ(plain(shape.view(), {.convention = conventions::gltf}).tangents[0], Vec4{});
}

}  // namespace
}  // namespace tspace::mikk
