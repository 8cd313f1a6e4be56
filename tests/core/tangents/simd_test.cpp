// SPDX-License-Identifier: MIT
// Neither the SIMD target nor the code path (one pass, or plan and evaluation) may change any bit.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>
#include <optional>
#include <random>

#include "core/simd/dispatch.h"
#include "core/tangents/golden_mesh.h"
#include "core/tangents/mikktspace/corner_terms.h"
#include "core/tangents/mikktspace/vertex_path.h"
#include "core/tangents/shapes.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

constexpr SimdTarget kTargets[] = {SimdTarget::scalar, SimdTarget::sse2, SimdTarget::avx2, SimdTarget::avx512,
                                   SimdTarget::neon};
/// Linking fails without tspace_scalar_kernels. Otherwise SSE2 would be tested in place of scalar code.
[[maybe_unused]] const volatile auto kPlainCode = &mikk::scalar::cornerTerms;

constexpr Method kMethods[] = {Method::mikktspace, Method::uniform, Method::angle,  Method::area,
                               Method::fast,       Method::best,    Method::lengyel};

/// Returns a rolled-up sheet with duplicated vertices along its seam, mirrored UVs on one half, some triangles without
/// UV area, some without area, and normals whose length is not exactly 1.
SimpleMesh rolledSheet(std::uint32_t side) {
    SimpleMesh shape = grid(side);
    for (std::size_t v = 0; v < shape.positions.size(); ++v) {
        const float x = shape.positions[v].x,
                    turn = 6.2831853f * std::fmod(x, static_cast<float>(side)) / static_cast<float>(side);
        shape.positions[v] = {std::cos(turn), std::sin(turn), 0.1f * shape.positions[v].y};
        shape.normals[v] = {1.001f * std::cos(turn), 1.001f * std::sin(turn), 0.01f};
        if (shape.uvs[v].x > 0.5f) shape.uvs[v].x = 1 - shape.uvs[v].x;
        if (v % 97 == 0 && v > 0) shape.uvs[v] = shape.uvs[v - 1];
        if (v % 211 == 0 && v > 0) shape.positions[v] = shape.positions[v - 1];
    }
    return shape;
}

/// Returns the mesh with every third pair of triangles combined into a quad.
SimpleMesh withQuads(const SimpleMesh& from) {
    SimpleMesh shape = from;
    shape.indices.clear();
    for (std::size_t i = 0; i < from.indices.size(); i += 6) {
        const auto* v = from.indices.data() + i;
        if (i % 18 == 0) {
            shape.addFace({v[0], v[1], v[2], v[5]});
        } else {
            shape.addFace({v[0], v[1], v[2]});
            shape.addFace({v[3], v[4], v[5]});
        }
    }
    return shape;
}

SimpleMesh unindexed(const SimpleMesh& from) {
    SimpleMesh shape;
    for (const std::uint32_t v : from.indices)
        shape.indices.push_back(shape.addVertex(from.positions[v], from.normals[v], from.uvs[v]));
    return shape;
}

/// Returns a wavy sheet with everything that prevents a node from being a simple fan: UVs that are mirrored every few
/// columns, columns and patches without UV area, flipped and duplicated triangles, and triangles without area.
SimpleMesh foldedSheet(std::uint32_t side, std::uint32_t fold) {
    SimpleMesh shape = grid(side);
    const std::uint32_t columns = side + 1;
    for (std::uint32_t v = 0; v < shape.uvs.size(); ++v) {
        const std::uint32_t x = v % columns, y = v / columns, step = x % (2 * fold);
        shape.uvs[v].x = 0.1f * static_cast<float>(std::min(step, 2 * fold - step - (step > fold ? 1 : 0)));
        shape.positions[v].z = 0.3f * std::sin(0.7f * static_cast<float>(x + 2 * y));
        if (x > side / 2 && y > side / 2 && x < side - 2) shape.uvs[v] = {0.5f, 0.5f};
        if (v % 89 == 1) shape.positions[v] = shape.positions[v - 1];
    }
    for (std::size_t i = 0; i + 3 <= shape.indices.size(); i += 3) {
        if (i % 201 == 0) std::swap(shape.indices[i], shape.indices[i + 1]);
        if (i % 309 == 3) std::copy_n(shape.indices.begin() + i - 3, 3, shape.indices.begin() + i);
    }
    return shape;
}

/// Returns the mesh with each run of four triangles combined into a hexagon. Some hexagons use one vertex twice.
SimpleMesh withHexagons(const SimpleMesh& from) {
    SimpleMesh shape = from;
    shape.indices.clear();
    for (std::size_t i = 0; i + 12 <= from.indices.size(); i += 12) {
        const auto* v = from.indices.data() + i;
        shape.addFace({v[0], v[1], v[2], v[5], i % 84 == 0 ? v[1] : v[8], i % 60 == 0 ? v[5] : v[11]});
    }
    return shape;
}

SimpleMesh withBrokenValues(SimpleMesh shape) {
    for (std::size_t v = 0; v < shape.positions.size(); v += 301)
        shape.positions[v].x = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t v = 7; v < shape.uvs.size(); v += 401) shape.uvs[v].x = std::numeric_limits<float>::infinity();
    return shape;
}

std::vector<SimpleMesh> shapes() {
    std::vector<SimpleMesh> list{
        grid(9),    rolledSheet(60),    withQuads(rolledSheet(40)),       unindexed(rolledSheet(30)),
        cone(3000), checkerboard(3000), withBrokenValues(rolledSheet(40))};
    list.push_back(rolledSheet(150));
    shuffleTriangles(list.back(), 5);
    list.insert(list.end(), {foldedSheet(40, 3), withQuads(foldedSheet(37, 2)), withHexagons(foldedSheet(36, 4)),
                             foldedSheet(160, 5)});
    shuffleTriangles(list.back(), 6);
    return list;
}

Outputs generate(const SimpleMesh& shape, const TangentOptions& options, const Execution& execution = {}) {
    Outputs outputs(shape.cornerCount());
    const auto report = generateTangents(shape.view(), options, outputs.view(), execution);
    EXPECT_TRUE(report.ok());
    if (report) outputs.report = *report;
    return outputs;
}

TEST(Simd, EveryTargetGivesTheBitsOfPlainCode) {
    for (const SimpleMesh& shape : shapes()) {
        for (const Method method : kMethods) {
            TangentOptions options{.convention = conventions::opengl};
            options.method = method;
            options.refine = 2;
            const Outputs want = generate(shape, options, {.simd = SimdTarget::scalar});
            for (const SimdTarget target : kTargets) {
                ASSERT_TRUE(sameBits(want, generate(shape, options, {.simd = target})))
                    << "target " << static_cast<int>(target) << ", method " << static_cast<int>(method);
            }
        }
    }
}

TEST(Simd, RequestingAnUnsupportedTargetSelectsTheBestSupportedOne) {
    const SimdTarget best = simd::resolve(SimdTarget::best);
    EXPECT_NE(best, SimdTarget::best);
    EXPECT_LE(simd::resolve(SimdTarget::avx512), best);
    EXPECT_EQ(simd::resolve(SimdTarget::neon), best);
    EXPECT_EQ(simd::resolve(SimdTarget::scalar), SimdTarget::scalar);
}

TEST(Simd, RequestingAnotherArchitectureSelectsASupportedTarget) {
    const SimdTarget best = simd::resolve(SimdTarget::best);
    const bool is_x86 = best != SimdTarget::scalar && best != SimdTarget::neon;
    for (const SimdTarget requested : {SimdTarget::sse2, SimdTarget::avx2, SimdTarget::avx512})
        EXPECT_EQ(simd::resolve(requested) != SimdTarget::scalar, is_x86);
}

void planAndEvaluate(const SimpleMesh& shape, const TangentOptions& options, Outputs& outputs) {
    const auto plan = planTangents(shape.view(), options);
    ASSERT_TRUE(plan.ok());
    const auto report = evaluateTangents(*plan, {shape.positions, shape.normals}, outputs.view());
    ASSERT_TRUE(report.ok());
    outputs.report = *report;
}

TEST(OnePass, GivesTheBitsOfPlanAndEvaluationForAnyNumberOfThreads) {
    for (const SimpleMesh& shape : shapes()) {
        for (const Method method : kMethods) {
            TangentOptions options{.convention = conventions::opengl};
            options.method = method;
            Outputs want(shape.cornerCount());
            ASSERT_NO_FATAL_FAILURE(planAndEvaluate(shape, options, want));
            for (const unsigned threads : {1u, 2u, 3u, 8u}) {
                ASSERT_TRUE(sameBits(want, generate(shape, options, {.executor = test::threadTeam(threads)})))
                    << threads << " threads, method " << static_cast<int>(method);
            }
        }
    }
}

/// Returns random faces over few vertices, as in grouped_property_test.cpp, but more of them.
SimpleMesh soup(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto number = [&](std::uint32_t most) { return 0.25f * static_cast<float>(random() % most); };
    SimpleMesh shape;
    const std::uint32_t vertices = 3 + random() % 12;
    for (std::uint32_t v = 0; v < vertices; ++v)
        shape.addVertex({number(9), number(9), number(9)}, {number(5) - 0.5f, number(5) - 0.5f, 1},
                        {number(5), number(5)});
    const std::uint32_t sizes = 1 + random() % 3, faces = 1 + random() % 40;
    for (std::uint32_t f = 0; f < faces; ++f) {
        std::vector<std::uint32_t> face(3 + random() % sizes);
        for (std::uint32_t& corner : face) corner = random() % vertices;
        shape.addFace(face);
    }
    return shape;
}

/// Returns a flat ring of rows, the last of which is connected to the first, so that neighbors there have very
/// different indices.
SimpleMesh ring(std::uint32_t rows, std::uint32_t columns) {
    SimpleMesh shape;
    for (std::uint32_t v = 0; v < rows * columns; ++v) {
        const auto row = static_cast<float>(v / columns), column = static_cast<float>(v % columns);
        const float turn = 6.2831853f * row / static_cast<float>(rows), radius = static_cast<float>(columns) + column;
        const Vec2 at{radius * std::cos(turn), radius * std::sin(turn)};
        shape.addVertex({at.x, at.y, 0.3f * std::sin(column)}, kUp, at);
    }
    for (std::uint32_t a = 0; a < rows * columns; ++a) {
        if ((a + 1) % columns == 0) continue;
        const std::uint32_t d = (a + columns) % (rows * columns);
        shape.addTriangle(a, a + 1, d + 1);
        shape.addTriangle(a, d + 1, d);
    }
    return shape;
}

/// Returns the outputs of mikk::evaluateInOnePass. `range_shift`: log2 of the number of nodes per range; 0 means that
/// it is chosen for the mesh.
Outputs onePass(const SimpleMesh& shape, const Call<TangentOptions>& options, bool tangents_only,
                unsigned range_shift = 0) {
    const MeshView mesh = shape.view();
    Parallel parallel(options.execution);
    const mikk::TriangleList triangles = mikk::cutFaces(mesh, options.ngons, nullptr);
    mikk::Nodes nodes = mikk::weld(mesh, triangles, nullptr, parallel);
    mikk::listVertices(nodes, nullptr);
    Outputs outputs(shape.cornerCount());
    TangentOutput to = outputs.view();
    if (tangents_only) to = {.tangents = to.tangents};
    ScratchBlock transient(nullptr, std::as_writable_bytes(std::span(to.tangents.data, to.tangents.count)));
    outputs.report =
        mikk::evaluateInOnePass({{mesh, triangles, nodes}, options, {}}, to, transient, parallel, range_shift);
    return outputs;
}

TEST(OnePass, AndAPlanGiveTheSameBits) {
    std::vector<SimpleMesh> list = shapes();
    for (std::uint32_t seed = 0; seed < 3000; ++seed) list.push_back(soup(seed));
    std::size_t compared = 0;
    for (const SimpleMesh& shape : list) {
        for (const Method method : {Method::mikktspace, Method::angle}) {
            TangentOptions options{.convention = conventions::opengl};
            options.method = method;
            options.pairing = Pairing::corrected;
            Outputs want(shape.cornerCount());
            ASSERT_NO_FATAL_FAILURE(planAndEvaluate(shape, options, want));
            const Call<TangentOptions> call{options, {.executor = test::threadTeam(1 + compared % 3)}};
            const auto got = onePass(shape, call, false);
            ++compared;
            ASSERT_TRUE(sameBits(want, got));
            const auto tangents = onePass(shape, call, true);
            for (std::size_t c = 0; c < shape.cornerCount(); ++c) {
                ASSERT_EQ((std::bit_cast<std::array<std::uint32_t, 4>>(tangents.tangents[c])),
                          (std::bit_cast<std::array<std::uint32_t, 4>>(want.tangents[c])));
            }
        }
    }
    EXPECT_GT(compared, list.size());
}

TEST(OnePass, InRangesOfNodesGivesTheSameBits) {
    std::vector<SimpleMesh> list = shapes();
    list.push_back(foldedSheet(200, 7));
    list.push_back(ring(500, 70));  // its neighbors are farther apart than lists of fans can represent
    shuffleTriangles(list.back(), 8);
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        list.push_back(soup(seed + 3000));
        list.push_back(unrolledFan(seed + 3));
        shuffleTriangles(list.back(), seed);
    }
    std::size_t compared = 0;
    for (const SimpleMesh& shape : list) {
        for (const Method method : {Method::mikktspace, Method::angle, Method::fast}) {
            TangentOptions options{.convention = conventions::opengl};
            options.method = method;
            options.pairing = Pairing::corrected;
            Outputs want(shape.cornerCount());
            ASSERT_NO_FATAL_FAILURE(planAndEvaluate(shape, options, want));
            for (const unsigned shift : {6u, 9u, 13u}) {
                const Call<TangentOptions> call{options, {.executor = test::threadTeam(1 + compared % 3)}};
                const auto got = onePass(shape, call, compared % 2 != 0, shift);
                ++compared;
                for (std::size_t c = 0; c < shape.cornerCount(); ++c) {
                    ASSERT_EQ((std::bit_cast<std::array<std::uint32_t, 4>>(got.tangents[c])),
                              (std::bit_cast<std::array<std::uint32_t, 4>>(want.tangents[c])));
                }
                EXPECT_EQ(got.report.group_count, want.report.group_count);
                EXPECT_EQ(got.report.mirrored_count, want.report.mirrored_count);
                EXPECT_EQ(got.report.degenerate_uv_count, want.report.degenerate_uv_count);
                EXPECT_EQ(got.report.degenerate_triangle_count, want.report.degenerate_triangle_count);
                EXPECT_EQ(got.report.default_corner_count, want.report.default_corner_count);
            }
        }
    }
    EXPECT_GT(compared, 2 * list.size());
}

TEST(OnePass, GivesTheSameTangentsWithoutTheOtherOutputs) {
    for (const SimpleMesh& shape : shapes()) {
        const Outputs want = generate(shape, {.convention = conventions::opengl});
        std::vector<Vec4> tangents(shape.cornerCount());
        const auto report = generateTangents(shape.view(), {.convention = conventions::opengl}, {tangents});
        ASSERT_TRUE(report.ok());
        for (std::size_t c = 0; c < tangents.size(); ++c) {
            ASSERT_EQ((std::bit_cast<std::array<std::uint32_t, 4>>(tangents[c])),
                      (std::bit_cast<std::array<std::uint32_t, 4>>(want.tangents[c])));
        }
        EXPECT_EQ(report->group_count, want.report.group_count);
    }
}

TEST(OnePass, WritesLargeOutputsAsItWritesOthers) {
    const SimpleMesh shape = gridOf(720000);  // 34 MB of tangents, so that areStreamed() is true
    struct Padded {
        Vec4 tangent;
        float other = 7;
    };
    const std::size_t corners = shape.cornerCount();
    std::vector<Padded> padded(corners);
    const StridedSpan<Vec4> with_gaps(&padded[0].tangent, corners, sizeof(Padded));
    ASSERT_TRUE(generateTangents(shape.view(), {.convention = conventions::opengl}, {.tangents = with_gaps}).ok());
    for (const unsigned threads : {1u, 2u}) {
        std::vector<Vec4> tangents(corners);
        ASSERT_TRUE(generateTangents(shape.view(), {.convention = conventions::opengl}, {.tangents = tangents},
                                     {.executor = test::threadTeam(threads)})
                        .ok());
        std::size_t different = 0;
        for (std::size_t c = 0; c < corners; ++c) {
            different += std::memcmp(&tangents[c], &padded[c].tangent, sizeof(Vec4)) != 0 || padded[c].other != 7;
        }
        EXPECT_EQ(different, 0u);
    }
}

TEST(OnePass, ReadsInterleavedVerticesUpToTheLastByteOnly) {
    const SimpleMesh shape = rolledSheet(20);
    const std::size_t count = shape.positions.size();
    std::vector<float> data(8 * count);  // position, UV, normal: the last normal ends where the memory ends
    for (std::size_t v = 0; v < count; ++v) {
        const float values[8] = {shape.positions[v].x, shape.positions[v].y, shape.positions[v].z, shape.uvs[v].x,
                                 shape.uvs[v].y,       shape.normals[v].x,   shape.normals[v].y,   shape.normals[v].z};
        std::copy_n(values, 8, data.begin() + static_cast<std::ptrdiff_t>(8 * v));
    }
    const std::vector<float> exact(data);  // its capacity is its size, so a sanitizer detects any access beyond it
    MeshView mesh = shape.view();
    mesh.positions = vec3Span(exact.data(), count, 32);
    mesh.uvs = vec2Span(exact.data() + 3, count, 32);
    mesh.normals = vec3Span(exact.data() + 5, count, 32);
    for (const Method method : {Method::mikktspace, Method::lengyel}) {
        const TangentOptions options{.method = method, .convention = conventions::opengl};
        Outputs got(shape.cornerCount());
        const auto report = generateTangents(mesh, options, got.view());
        ASSERT_TRUE(report.ok());
        got.report = *report;
        EXPECT_TRUE(sameBits(generate(shape, options), got)) << "method " << static_cast<int>(method);
    }
}

}  // namespace
}  // namespace tspace::test
