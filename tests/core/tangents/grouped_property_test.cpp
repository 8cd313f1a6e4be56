// SPDX-License-Identifier: MIT
// Properties that must not affect results: index width, strides, threads, order of vertices, and representation of the
// mesh.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

/// Returns triangles and quads over few vertices, so that edges are shared by many faces, with UV seams, mirrored and
/// collapsed UVs and duplicated vertices.
SimpleMesh randomShape() {
    SimpleMesh shape;
    const int vertices = *rc::gen::inRange(3, 40);
    const bool mixed_zeros = *rc::gen::inRange(0, 4) == 0;
    for (int v = 0; v < vertices; ++v) {
        const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)) * 0.25f; };
        if (v > 3 && *rc::gen::inRange(0, 6) == 0) {
            const auto other = *rc::gen::inRange<std::size_t>(0, shape.positions.size());
            shape.addVertex(shape.positions[other], shape.normals[other], shape.uvs[other]);
        } else {
            shape.addVertex({number(-8, 8), number(-8, 8), number(-8, 8)}, {number(-2, 3), number(-2, 3), 1},
                            {number(0, 9), number(0, 9)});
        }
        if (mixed_zeros && shape.positions.back().x == 0) shape.positions.back().x = v % 2 == 0 ? 0.0f : -0.0f;
    }
    const int faces = *rc::gen::inRange(1, 120);
    for (int f = 0; f < faces; ++f) {
        std::vector<std::uint32_t> face(static_cast<std::size_t>(*rc::gen::element(3, 3, 3, 4, 4, 2)));
        for (auto& corner : face) corner = static_cast<std::uint32_t>(*rc::gen::inRange(0, vertices));
        shape.addFace(face);
    }
    return shape;
}

TangentOptions randomOptions() {
    TangentOptions options{.convention = conventions::opengl};
    options.method = *rc::gen::element(Method::mikktspace, Method::mikktspace, Method::uniform, Method::angle,
                                       Method::area, Method::fast, Method::best);
    options.angular_threshold_deg = *rc::gen::element(180.0f, 180.0f, 60.0f, 20.0f, 0.0f, 300.0f);
    options.pairing = *rc::gen::element(Pairing::reference, Pairing::corrected);
    options.refine = *rc::gen::element(0u, 1u, 2u);
    return options;
}

Outputs generate(const MeshView& mesh, const TangentOptions& options, const Execution& execution = {}) {
    Outputs outputs(mesh.cornerCount());
    const Result<TangentReport> result = generateTangents(mesh, options, outputs.view(), execution);
    RC_ASSERT(result.ok());
    outputs.report = *result;
    return outputs;
}

RC_GTEST_PROP(GroupedProperty, IndexWidthDoesNotMatter, ()) {
    const SimpleMesh shape = randomShape();
    const TangentOptions options = randomOptions();
    const Outputs want = generate(shape.view(), options);
    const std::vector<std::uint8_t> narrow(shape.indices.begin(), shape.indices.end());
    const std::vector<std::uint16_t> middle(shape.indices.begin(), shape.indices.end());
    MeshView mesh = shape.view();
    mesh.indices = IndexView(std::span<const std::uint8_t>(narrow));
    RC_ASSERT(sameBits(want, generate(mesh, options)));
    mesh.indices = IndexView(std::span<const std::uint16_t>(middle));
    RC_ASSERT(sameBits(want, generate(mesh, options)));
}

RC_GTEST_PROP(GroupedProperty, AVertexPerCornerGivesTheSame, ()) {
    const SimpleMesh shape = randomShape();
    const TangentOptions options = randomOptions();
    SimpleMesh loose;
    for (const std::uint32_t v : shape.indices) loose.addVertex(shape.positions[v], shape.normals[v], shape.uvs[v]);
    MeshView mesh = loose.view();
    mesh.indices = {};
    mesh.face_sizes = shape.face_sizes;
    RC_ASSERT(sameBits(generate(shape.view(), options), generate(mesh, options)));
}

RC_GTEST_PROP(GroupedProperty, OrderOfVerticesDoesNotMatter, ()) {
    const SimpleMesh shape = randomShape();
    const TangentOptions options = randomOptions();
    std::vector<std::uint32_t> place(shape.positions.size());
    std::iota(place.begin(), place.end(), 0u);
    for (std::size_t i = place.size(); i-- > 1;) std::swap(place[i], place[*rc::gen::inRange<std::size_t>(0, i + 1)]);
    SimpleMesh moved = shape;
    for (std::size_t v = 0; v < place.size(); ++v) {
        moved.positions[place[v]] = shape.positions[v];
        moved.normals[place[v]] = shape.normals[v];
        moved.uvs[place[v]] = shape.uvs[v];
    }
    for (std::uint32_t& v : moved.indices) v = place[v];
    RC_ASSERT(sameBits(generate(shape.view(), options), generate(moved.view(), options)));
}

RC_GTEST_PROP(GroupedProperty, StridesDoNotMatter, ()) {
    const SimpleMesh shape = randomShape();
    const TangentOptions options = randomOptions();
    struct Interleaved {
        Vec2 uv;
        Vec3 position;
        float gap;
        Vec3 normal;
    };
    std::vector<Interleaved> data(shape.positions.size());
    for (std::size_t v = 0; v < data.size(); ++v) data[v] = {shape.uvs[v], shape.positions[v], 7, shape.normals[v]};
    MeshView mesh = shape.view();
    mesh.positions = {&data[0].position, data.size(), sizeof(Interleaved)};
    mesh.normals = {&data[0].normal, data.size(), sizeof(Interleaved)};
    mesh.uvs = {&data[0].uv, data.size(), sizeof(Interleaved)};
    struct Result {
        float mag_t;
        Vec4 tangent;
        Vec3 bitangent;
        float mag_s;
    };
    std::vector<Result> results(shape.cornerCount());
    const TangentOutput out{{&results[0].tangent, results.size(), sizeof(Result)},
                            {&results[0].bitangent, results.size(), sizeof(Result)},
                            {&results[0].mag_s, results.size(), sizeof(Result)},
                            {&results[0].mag_t, results.size(), sizeof(Result)}};
    RC_ASSERT(generateTangents(mesh, options, out).ok());
    Outputs got(results.size());
    for (std::size_t c = 0; c < results.size(); ++c) {
        got.tangents[c] = results[c].tangent;
        got.bitangents[c] = results[c].bitangent;
        got.magnitudes_s[c] = results[c].mag_s;
        got.magnitudes_t[c] = results[c].mag_t;
    }
    RC_ASSERT(sameBits(generate(shape.view(), options), got));
}

RC_GTEST_PROP(GroupedProperty, PlanAndEvaluateEqualTheOneCall, ()) {
    const SimpleMesh shape = randomShape();
    const TangentOptions options = randomOptions();
    const MeshView mesh = shape.view();
    const auto plan = planTangents(mesh, options);
    RC_ASSERT(plan.ok());
    Outputs got(shape.cornerCount());
    const auto report = evaluateTangents(*plan, {mesh.positions, mesh.normals}, got.view());
    RC_ASSERT(report.ok());
    const Outputs want = generate(mesh, options);
    RC_ASSERT(sameBits(want, got));
    RC_ASSERT(report->group_count == want.report.group_count);
    RC_ASSERT(report->not_finite_count == want.report.not_finite_count);
}

RC_GTEST_PROP(GroupedProperty, TheConventionChangesOnlySignAndBitangent, ()) {
    const SimpleMesh shape = randomShape();
    TangentOptions options = randomOptions();
    options.convention = conventions::gltf;
    Outputs flipped = generate(shape.view(), options);
    options.convention = conventions::opengl;
    const Outputs plain = generate(shape.view(), options);
    for (Vec4& t : flipped.tangents) t.w = -t.w;
    for (Vec3& b : flipped.bitangents) b = {-b.x, -b.y, -b.z};
    for (std::size_t c = 0; c < plain.tangents.size(); ++c) {
        RC_ASSERT(plain.tangents[c] == flipped.tangents[c]);
        RC_ASSERT(plain.bitangents[c] == flipped.bitangents[c]);
    }
}

/// The meshes are so large that every phase is divided into several tasks.
TEST(GroupedThreads, GiveTheSameBits) {
    std::vector<SimpleMesh> shapes{gridOf(40000),       fan(20000),       someDegenerate(40000),
                                   checkerboard(40000), notFinite(40000), someWithoutUvArea(40000),
                                   book(20000, true)};
    shapes.push_back(gridOf(40000));
    shuffleTriangles(shapes.back(), 7);
    shapes.push_back(gridOf(40000));
    for (std::size_t v = 0; v < shapes.back().normals.size(); v += 3) shapes.back().normals[v].x = -0.0f;
    const Convention convention = conventions::opengl;
    const TangentOptions ways[] = {{.convention = convention},
                                   {.convention = convention, .angular_threshold_deg = 10.0f},
                                   {.method = Method::fast, .convention = convention},
                                   {.method = Method::best, .convention = convention},
                                   {.method = Method::best, .convention = convention, .refine = 2}};
    for (const SimpleMesh& shape : shapes) {
        for (const TangentOptions& options : ways) {
            const Outputs want = generate(shape.view(), options);
            for (const unsigned threads : {2u, 3u, 8u}) {
                const Outputs got = generate(shape.view(), options, {.executor = test::threadTeam(threads)});
                EXPECT_TRUE(sameBits(want, got)) << threads << " threads";
                EXPECT_EQ(want.report.group_count, got.report.group_count);
                EXPECT_EQ(want.report.not_finite_count, got.report.not_finite_count);
            }
        }
    }
}

}  // namespace
}  // namespace tspace::test
