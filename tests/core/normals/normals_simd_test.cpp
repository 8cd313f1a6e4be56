// SPDX-License-Identifier: MIT
// Neither the SIMD target nor the code path (the fast one for triangles, or the general one) may change a normal.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "support/simple_mesh.h"
#include "support/thread_team.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

using test::SimpleMesh;

constexpr SimdTarget kTargets[] = {SimdTarget::sse2, SimdTarget::avx2, SimdTarget::avx512, SimdTarget::neon,
                                   SimdTarget::best};
const NormalOptions kKinds[] = {{.weighting = NormalWeighting::angle},
                                {.weighting = NormalWeighting::area},
                                {.weighting = NormalWeighting::angleArea},
                                {.weighting = NormalWeighting::uniform},
                                {.weighting = NormalWeighting::best, .refine = 1},
                                {.weighting = NormalWeighting::best, .refine = 2},
                                {.weighting = NormalWeighting::best, .denoise = 4}};

struct Outcome {
    std::vector<Vec3> normals;
    NormalReport report;
};

Outcome compute(const MeshView& mesh, const NormalOptions& options, const Execution& execution = {}) {
    Outcome outcome{std::vector<Vec3>(mesh.cornerCount()), {}};
    const Result<NormalReport> report = generateNormals(mesh, options, outcome.normals, execution);
    EXPECT_TRUE(report.ok());
    if (report) outcome.report = *report;
    return outcome;
}

void expectSameBits(const Outcome& a, const Outcome& b) {
    ASSERT_EQ(a.normals.size(), b.normals.size());
    EXPECT_EQ(std::memcmp(a.normals.data(), b.normals.data(), a.normals.size() * sizeof(Vec3)), 0);
    EXPECT_EQ(a.report.degenerate_face_count, b.report.degenerate_face_count);
    EXPECT_EQ(a.report.fallback_corner_count, b.report.fallback_corner_count);
}

/// Returns a bent sheet of 2 * side^2 triangles. Its first and last columns have equal positions, as at a UV seam.
SimpleMesh sheet(std::uint32_t side, float size = 1, Vec3 stretch = {1, 1, 1}) {
    SimpleMesh mesh;
    const auto n = static_cast<float>(side);
    for (std::uint32_t i = 0; i <= side; ++i) {
        for (std::uint32_t j = 0; j <= side; ++j) {
            const float u = 6.2831853f * static_cast<float>(i % side) / n, v = static_cast<float>(j) / n;
            mesh.positions.push_back(
                {size * stretch.x * std::cos(u) * (1 + v * v), size * stretch.y * std::sin(u), size * stretch.z * v});
        }
    }
    for (std::uint32_t i = 0; i < side; ++i) {
        for (std::uint32_t j = 0; j < side; ++j) {
            const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    return mesh;
}

SimpleMesh withBackSides(SimpleMesh mesh) {
    for (std::size_t i = 0, count = mesh.indices.size(); i < count; i += 3)
        mesh.indices.insert(mesh.indices.end(), {mesh.indices[i], mesh.indices[i + 2], mesh.indices[i + 1]});
    return mesh;
}

SimpleMesh withBrokenValues(SimpleMesh mesh) {
    for (std::size_t v = 0; v < mesh.positions.size(); v += 53)
        mesh.positions[v].y = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t v = 7; v < mesh.positions.size(); v += 61)
        mesh.positions[v].x = std::numeric_limits<float>::infinity();
    for (std::size_t v = 9; v < mesh.positions.size(); v += 29) mesh.positions[v] = mesh.positions[v - 1];
    return mesh;
}

SimpleMesh randomMesh() {
    std::mt19937 random(11);
    SimpleMesh mesh;
    for (int v = 0; v < 6000; ++v) {
        const auto coordinate = [&] { return static_cast<float>(random() % 24); };
        const float x = coordinate(), y = coordinate();
        mesh.positions.push_back({x, y, coordinate()});
    }
    for (int i = 0; i < 3 * 7001; ++i) mesh.indices.push_back(random() % 6000);
    return mesh;
}

std::vector<SimpleMesh> soundMeshes() {
    return {sheet(40),    sheet(40, 1e-19f),           sheet(40, 1e-37f),          sheet(40, 1e19f), sheet(9, 1e38f),
            randomMesh(), sheet(40, 1, {1, 1, 1e-6f}), sheet(40, 1, {1, 1e5f, 1}), sheet(200)};
}

std::vector<SimpleMesh> meshes() {
    std::vector<SimpleMesh> all = soundMeshes();
    all.push_back(withBackSides(sheet(30)));
    all.push_back(withBackSides(sheet(30, 1e-30f)));
    all.push_back(withBrokenValues(sheet(40)));
    // The following meshes are so large that they are processed in ranges of points, whose number depends on the number
    // of threads.
    all.push_back(withBackSides(sheet(190)));
    all.push_back(withBrokenValues(sheet(200)));
    return all;
}

TEST(Simd, EveryTargetGivesTheNormalsOfPlainCode) {
    for (const SimpleMesh& mesh : meshes()) {
        for (NormalOptions options : kKinds) {
            const Outcome plain = compute(mesh.view(), options, {.simd = SimdTarget::scalar});
            for (const SimdTarget target : kTargets) {
                for (const unsigned threads : {1u, 3u}) {
                    SCOPED_TRACE(static_cast<int>(target));
                    const Execution execution{.executor = test::threadTeam(threads), .simd = target};
                    expectSameBits(plain, compute(mesh.view(), options, execution));
                }
            }
        }
    }
}

/// These meshes have both hard and soft edges: angles of the random mesh are arbitrary, angles between faces of the
/// sheets are small, and those between faces and their back sides are 180 degrees.
TEST(HardEdges, GiveTheSameBitsForAnyTargetAndNumberOfThreads) {
    for (const SimpleMesh& mesh : {randomMesh(), withBackSides(sheet(60)), withBrokenValues(sheet(100))}) {
        std::vector<NormalOptions> kinds(std::begin(kKinds), std::end(kKinds));
        kinds.push_back({.weighting = NormalWeighting::max});
        for (NormalOptions options : kinds) {
            options.crease_angle_deg = 40;
            const Outcome plain = compute(mesh.view(), options, {.simd = SimdTarget::scalar});
            for (const SimdTarget target : kTargets) {
                SCOPED_TRACE(static_cast<int>(target));
                expectSameBits(plain, compute(mesh.view(), options, {.thread_count = 3, .simd = target}));
            }
        }
    }
}

/// Without indices, the vertices are divided into other ranges of points than with indices.
TEST(HardEdges, DoNotDependOnWhichVerticesArePoints) {
    for (const SimpleMesh& mesh : {sheet(150), withBackSides(sheet(60)), randomMesh()}) {
        SimpleMesh soup;
        for (const std::uint32_t v : mesh.indices) soup.positions.push_back(mesh.positions[v]);
        MeshView view = soup.view();
        view.indices = {};
        const NormalOptions options{.crease_angle_deg = 20};
        expectSameBits(compute(mesh.view(), options), compute(view, options));
    }
}

/// If no edge is hard, and the faces around a point form one fan, the code path must not affect the result.
TEST(HardEdges, WithoutHardEdgesBitsEqualThoseOfSmoothNormals) {
    for (const SimpleMesh& mesh : {sheet(40), sheet(200)}) {
        NormalOptions options;
        const Outcome smooth = compute(mesh.view(), options);
        options.crease_angle_deg = 179;
        expectSameBits(smooth, compute(mesh.view(), options));
    }
}

TEST(Simd, AnyNumberOfTrianglesAndVerticesIsProcessed) {
    const SimpleMesh whole = randomMesh();
    for (std::size_t count = 1; count < 150; ++count) {
        SimpleMesh mesh = whole;
        mesh.indices.resize(3 * count);
        for (std::uint32_t& v : mesh.indices) v %= static_cast<std::uint32_t>(count + 2);
        mesh.positions.resize(count + 2);
        const Outcome plain = compute(mesh.view(), {}, {.simd = SimdTarget::scalar});
        for (const SimdTarget target : kTargets) expectSameBits(plain, compute(mesh.view(), {}, {.simd = target}));
    }
}

TEST(Simd, ReadsInterleavedPositionsUpToTheLastByteOnly) {
    const SimpleMesh mesh = sheet(20);
    const std::size_t count = mesh.positions.size();
    // Each record holds two other numbers and then the position, so the last position ends where the memory ends.
    std::vector<float> data(5 * count);
    for (std::size_t v = 0; v < count; ++v) std::memcpy(&data[5 * v + 2], &mesh.positions[v], sizeof(Vec3));
    const std::vector<float> exact(data);  // its capacity is its size, so a sanitizer detects any access beyond it
    MeshView view = mesh.view();
    view.positions = vec3Span(exact.data() + 2, count, 20);
    for (const SimdTarget target : kTargets) {
        expectSameBits(compute(mesh.view(), {}, {.simd = target}), compute(view, {}, {.simd = target}));
    }
}

TEST(Simd, WritesIntoInterleavedVerticesWithoutTouchingTheirNeighbors) {
    const SimpleMesh mesh = sheet(20);
    const std::size_t count = mesh.indices.size();
    std::vector<float> data(4 * count, 7.0f);
    const auto report = generateNormals(mesh.view(), {}, {reinterpret_cast<Vec3*>(data.data()), count, 16});
    ASSERT_TRUE(report.ok());
    const Outcome tight = compute(mesh.view(), {});
    for (std::size_t c = 0; c < count; ++c) {
        ASSERT_EQ(std::memcmp(&data[4 * c], &tight.normals[c], sizeof(Vec3)), 0);
        ASSERT_EQ(data[4 * c + 3], 7.0f);
    }
}

/// Returns the tolerance for `best`. It adds up the corners of each triangle in one code path, and the corners of each
/// point in the other. If edges differ by only 1e-5 from one direction, they are nearly parallel in single precision,
/// and `best` uses the `max` mean.
float allowedOfBest(const SimpleMesh& mesh) {
    float reach = 0;
    for (const Vec3& p : mesh.positions)
        reach = std::max(reach, std::fabs(p.y) / (1 + std::fabs(p.x) + std::fabs(p.z)));
    return reach > 1e3f && reach < 1e6f ? 0.03f : 2e-4f;
}

/// With a smoothing group that contains every face, only the code path differs.
TEST(TriangleFastPath, EqualsTheGeneralPathForTinyHugeAndThinTriangles) {
    for (const SimpleMesh& mesh : soundMeshes()) {
        const std::vector<std::uint32_t> one_group(mesh.indices.size() / 3, 1);
        for (NormalOptions options : kKinds) {
            const NormalWeighting weighting = options.weighting;
            const Outcome got = compute(mesh.view(), options);
            options.smoothing_groups = one_group;
            const Outcome want = compute(mesh.view(), options);
            EXPECT_EQ(got.report.degenerate_face_count, want.report.degenerate_face_count);
            EXPECT_EQ(got.report.fallback_corner_count, want.report.fallback_corner_count);
            // Angles are accurate to 2e-7, but the errors of a mean are relatively larger if its terms cancel.
            const float allowed = weighting == NormalWeighting::area   ? 2e-7f
                                  : weighting == NormalWeighting::best ? allowedOfBest(mesh)
                                                                       : 1e-5f;
            for (std::size_t c = 0; c < got.normals.size(); ++c) {
                const Vec3 &a = got.normals[c], &b = want.normals[c];
                ASSERT_LE(std::fabs(a.x - b.x), allowed) << c;
                ASSERT_LE(std::fabs(a.y - b.y), allowed) << c;
                ASSERT_LE(std::fabs(a.z - b.z), allowed) << c;
            }
        }
    }
}

TEST(Indices, BeyondTheVerticesAreFoundInMeshesOfAnySizeAndOrder) {
    for (const SimpleMesh& mesh : {sheet(200), sheet(20), randomMesh()}) {
        const auto beyond = static_cast<std::uint32_t>(mesh.positions.size());
        for (const std::size_t corner : {std::size_t{0}, mesh.indices.size() / 2, mesh.indices.size() - 1}) {
            for (const std::uint32_t index : {beyond, ~std::uint32_t{0}}) {
                SimpleMesh broken = mesh;
                broken.indices[corner] = index;
                std::vector<Vec3> out(broken.indices.size(), Vec3{7, 7, 7});
                for (const unsigned threads : {1u, 3u}) {
                    for (const bool weld : {false, true}) {
                        const auto result = generateNormals(broken.view(), {.weld_positions = weld}, out,
                                                            {.executor = test::threadTeam(threads)});
                        ASSERT_FALSE(result.ok());
                        EXPECT_EQ(result.error().code, ErrorCode::indexOutOfRange);
                        EXPECT_EQ(out[0], (Vec3{7, 7, 7}));
                    }
                }
            }
        }
    }
}

TEST(Welding, OfAnIndexedMeshIsThatOfTheSameVerticesWithoutIndices) {
    // In the first mesh few vertices share a position; in the second one most do.
    for (const SimpleMesh& mesh : {sheet(150), randomMesh()}) {
        SimpleMesh soup;
        for (const std::uint32_t v : mesh.indices) soup.positions.push_back(mesh.positions[v]);
        MeshView view = soup.view();
        view.indices = {};
        for (const unsigned threads : {1u, 3u}) {
            const Execution execution{.executor = test::threadTeam(threads)};
            expectSameBits(compute(mesh.view(), {}, execution), compute(view, {}, execution));
        }
    }
}

}  // namespace
}  // namespace tspace
