// SPDX-License-Identifier: MIT
// Properties of the grouping methods on small meshes, for invalid calls, and when memory runs out.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"

namespace tspace::test {
namespace {

constexpr std::array kGrouping{Method::mikktspace, Method::uniform, Method::angle, Method::area};

TangentReport generate(const SimpleMesh& shape, const TangentOptions& options, Outputs& outputs,
                       const Execution& execution = {}) {
    const Result<TangentReport> result = generateTangents(shape.view(), options, outputs.view(), execution);
    EXPECT_TRUE(result) << (result ? "" : result.error().message);
    outputs.report = result ? *result : TangentReport{};
    return outputs.report;
}

Outputs generate(const SimpleMesh& shape, const TangentOptions& options = {.convention = conventions::opengl},
                 const Execution& execution = {}) {
    Outputs outputs(shape.cornerCount());
    generate(shape, options, outputs, execution);
    return outputs;
}

/// Returns a unit square in the xy plane whose UVs are its positions.
SimpleMesh square() {
    SimpleMesh shape;
    for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) shape.addVertex({uv.x, uv.y, 0}, kUp, uv);
    shape.addFace({0, 1, 2, 3});
    return shape;
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

TEST(Grouped, ASquareWithItsPositionsAsUvsHasTheAxesAsFrame) {
    for (const Method method : kGrouping) {
        const Outputs got = generate(square(), {.method = method, .convention = conventions::opengl});
        for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_EQ(got.tangents[c], (Vec4{1, 0, 0, 1}));
            EXPECT_EQ(got.bitangents[c], (Vec3{0, 1, 0}));
            EXPECT_NEAR(got.magnitudes_s[c], 1, 1e-6);
            EXPECT_NEAR(got.magnitudes_t[c], 1, 1e-6);
        }
        EXPECT_EQ(got.report.triangle_count, 2u);
        EXPECT_EQ(got.report.group_count, 4u);
        EXPECT_EQ(got.report.default_corner_count, 0u);
    }
}

TEST(Grouped, TheConventionTurnsSignAndBitangent) {
    const Outputs got = generate(square(), {.convention = conventions::gltf});
    for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_EQ(got.tangents[c], (Vec4{1, 0, 0, -1}));
        EXPECT_EQ(got.bitangents[c].y, -1.0f);
    }
}

TEST(Grouped, MirroredUvsGiveTheOtherSign) {
    SimpleMesh shape = square();
    for (Vec2& uv : shape.uvs) uv.x = 1 - uv.x;
    const Outputs got = generate(shape);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(got.tangents[c], (Vec4{-1, 0, 0, -1}));
    EXPECT_EQ(got.report.mirrored_count, 2u);
}

TEST(Grouped, FacesThatAreNotUsedGiveZeros) {
    SimpleMesh shape = square();
    shape.addFace({0, 1});
    shape.addFace({});
    shape.addFace({3});
    const Outputs got = generate(shape);
    for (std::size_t c = 4; c < 7; ++c) {
        EXPECT_EQ(got.tangents[c], Vec4{});
        EXPECT_EQ(got.bitangents[c], Vec3{});
        EXPECT_EQ(got.magnitudes_s[c], 0.0f);
        EXPECT_EQ(got.magnitudes_t[c], 0.0f);
    }
    EXPECT_EQ(got.report.skipped_face_count, 3u);
}

TEST(Grouped, NgonsAreTriangulatedOrSkipped) {
    SimpleMesh shape;
    std::vector<std::uint32_t> corners;
    for (int i = 0; i < 6; ++i) {
        const double a = 1.0471975511965976 * i;
        const auto x = static_cast<float>(std::cos(a)), y = static_cast<float>(std::sin(a));
        corners.push_back(shape.addVertex({x, y, 0}, kUp, {x, y}));
    }
    shape.addFace(corners);
    for (const Method method : kGrouping) {
        const Outputs cut = generate(shape, {.method = method, .convention = conventions::opengl});
        const Outputs skipped =
            generate(shape, {.method = method, .convention = conventions::opengl, .ngons = Ngons::skip});
        EXPECT_EQ(cut.report.triangle_count, 4u);
        EXPECT_EQ(skipped.report.skipped_face_count, 1u);
        for (std::size_t c = 0; c < 6; ++c) {
            EXPECT_LT(distance(xyz(cut.tangents[c]), {1, 0, 0}), 1e-6);
            EXPECT_EQ(cut.tangents[c].w, 1.0f);
            EXPECT_EQ(skipped.tangents[c], Vec4{});
        }
    }
}

TEST(Grouped, ATriangleWithoutUvAreaUsesItsNeighborsFrame) {
    SimpleMesh shape = square();
    const std::uint32_t far = shape.addVertex({2, 2, 0}, kUp, {1, 1});
    shape.addFace({1, far, 2});
    shape.uvs[far] = shape.uvs[2];
    shape.positions[far] = {2, 0.5f, 0};
    const Outputs got = generate(shape);
    EXPECT_EQ(got.report.degenerate_uv_count, 1u);
    EXPECT_EQ(got.tangents[4], (Vec4{1, 0, 0, 1})) << "the corner that shares a vertex with the square";
    EXPECT_EQ(got.tangents[5], (Vec4{1, 0, 0, -1})) << "the corner on its own holds the default";
    EXPECT_EQ(got.report.default_corner_count, 1u);
}

TEST(Grouped, ACornerOfADegenerateTriangleCopiesItsNodesFrame) {
    SimpleMesh shape = square();
    shape.addFace({1, 1, 2});
    const Outputs got = generate(shape);
    EXPECT_EQ(got.report.degenerate_triangle_count, 1u);
    for (std::size_t c = 4; c < 7; ++c) EXPECT_EQ(got.tangents[c], (Vec4{1, 0, 0, 1}));
}

TEST(Grouped, NotFiniteTangentsAreCounted) {
    SimpleMesh shape = square();
    shape.normals.assign(4, Vec3{std::numeric_limits<float>::quiet_NaN(), 0, 1});
    EXPECT_EQ(generate(shape).report.not_finite_count, 4u);
}

TEST(Grouped, WeightingsAreTheirFormulas) {
    SimpleMesh shape = fan(7);
    for (std::size_t i = 1; i < shape.positions.size(); ++i) {
        shape.positions[i].x *= 1.0f + 0.2f * static_cast<float>(i);
        shape.positions[i].z = 0.1f * static_cast<float>(i * i % 5);
    }
    for (const Method method : {Method::uniform, Method::angle, Method::area}) {
        const Outputs got = generate(shape, {.method = method, .convention = conventions::opengl});
        Vec3 sum{};
        for (std::size_t t = 0; t < 7; ++t) {
            const auto at = [&](std::size_t k) { return shape.indices[3 * t + k]; };
            const auto d = [&](std::size_t k) {
                const Vec3 &a = shape.positions[at(0)], &b = shape.positions[at(k)];
                return Vec3{b.x - a.x, b.y - a.y, b.z - a.z};
            };
            const Vec2 &w0 = shape.uvs[at(0)], &w1 = shape.uvs[at(1)], &w2 = shape.uvs[at(2)];
            const Vec3 d1 = d(1), d2 = d(2);
            const float v1 = w1.y - w0.y, v2 = w2.y - w0.y;  // UV area is positive in this fan
            Vec3 s{v2 * d1.x - v1 * d2.x, v2 * d1.y - v1 * d2.y, 0};
            const Vec3 c{d1.y * d2.z - d1.z * d2.y, d1.z * d2.x - d1.x * d2.z, d1.x * d2.y - d1.y * d2.x};
            const float area = 0.5f * std::hypot(c.x, c.y, c.z);
            const float cosine =
                (d1.x * d2.x + d1.y * d2.y + d1.z * d2.z) / std::hypot(d1.x, d1.y, d1.z) / std::hypot(d2.x, d2.y, d2.z);
            const float weight = method == Method::uniform ? 1.0f : method == Method::area ? area : std::acos(cosine);
            const float scale = weight / std::hypot(s.x, s.y);
            sum = {sum.x + scale * s.x, sum.y + scale * s.y, 0};
        }
        const float length = std::hypot(sum.x, sum.y);
        for (std::size_t t = 0; t < 7; ++t) {
            EXPECT_LT(distance(xyz(got.tangents[3 * t]), {sum.x / length, sum.y / length, 0}), 1e-5);
        }
    }
}

TEST(Grouped, ASmallThresholdSplitsAGroup) {
    const SimpleMesh shape = fan(64);
    SimpleMesh bent = shape;
    for (std::size_t i = 33; i < bent.uvs.size(); ++i) bent.uvs[i].x = 0.5f + (bent.uvs[i].x - 0.5f) * 0.1f;
    const auto tangentsAtApex = [&](float threshold) {
        const Outputs got = generate(bent, {.convention = conventions::opengl, .angular_threshold_deg = threshold});
        std::vector<Vec4> all;
        for (std::size_t t = 0; t < 64; ++t) {
            const Vec4& tangent = got.tangents[3 * t];
            if (std::find(all.begin(), all.end(), tangent) == all.end()) all.push_back(tangent);
        }
        return all.size();
    };
    EXPECT_EQ(tangentsAtApex(180), 1u);
    EXPECT_GT(tangentsAtApex(5), 1u);
}

TEST(TangentPlan, GivesTheBitsOfTheOneCallOnItsOwnPose) {
    for (const Method method : kGrouping) {
        for (const SimpleMesh& shape :
             {someDegenerate(800), checkerboard(800), someWithoutUvArea(800), notFinite(800)}) {
            const TangentOptions options{
                .method = method, .convention = conventions::opengl, .angular_threshold_deg = 60};
            const Outputs direct = generate(shape, options);
            const Result<TangentPlan> plan = planTangents(shape.view(), options);
            ASSERT_TRUE(plan);
            EXPECT_GT(plan->memoryBytes(), 0u);
            Outputs planned(shape.cornerCount());
            const MeshView mesh = shape.view();
            ASSERT_TRUE(evaluateTangents(*plan, {mesh.positions, mesh.normals}, planned.view()));
            EXPECT_TRUE(sameBits(direct, planned));
        }
    }
}

/// A square of two triangles that do not share vertices: along the diagonal, each has equal vertices of its own.
TEST(TangentPlan, SupportsEqualVerticesThatSeparate) {
    SimpleMesh square;
    for (const Vec2& uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
        square.indices.push_back(static_cast<std::uint32_t>(square.positions.size()));
        square.positions.push_back({uv.x, uv.y, 0});
        square.normals.push_back({0, 0, 1});
        square.uvs.push_back(uv);
    }
    for (const Method method : {Method::mikktspace, Method::uniform, Method::angle, Method::area}) {
        const Result<TangentPlan> plan =
            planTangents(square.view(), {.method = method, .convention = conventions::opengl});
        ASSERT_TRUE(plan);
        SimpleMesh apart = square;
        for (std::size_t v = 3; v < 6; ++v) apart.positions[v].x += 5;
        Outputs got(6);
        ASSERT_TRUE(evaluateTangents(*plan, {apart.positions, apart.normals}, got.view()));
        for (std::size_t c = 0; c < 6; ++c) EXPECT_EQ(got.tangents[c], (Vec4{1, 0, 0, 1})) << c;
    }
}

TEST(TangentPlan, KeepsItsGroupsOnAnotherPose) {
    const SimpleMesh shape = checkerboard(800);
    const Result<TangentPlan> plan = planTangents(shape.view(), {.convention = conventions::opengl});
    ASSERT_TRUE(plan);
    const Outputs at_rest = generate(shape);
    SimpleMesh moved = shape;
    for (Vec3& p : moved.positions) p = {p.x + 0.3f * p.y, p.y, p.z + 0.05f * p.x * p.x};
    Outputs got(shape.cornerCount());
    ASSERT_TRUE(evaluateTangents(*plan, {moved.positions, moved.normals}, got.view()));
    std::vector<std::size_t> first(shape.positions.size(), ~std::size_t{0});
    for (std::size_t c = 0; c < shape.indices.size(); ++c) {
        std::size_t& other = first[shape.indices[c]];
        if (other == ~std::size_t{0}) {
            other = c;
        } else if (at_rest.tangents[other] == at_rest.tangents[c]) {
            EXPECT_EQ(got.tangents[other], got.tangents[c]);
        }
    }
    EXPECT_FALSE(sameBits(at_rest, got));
}

TEST(TangentPlan, RejectsAPoseOfAnotherMesh) {
    const SimpleMesh shape = grid(4);
    const Result<TangentPlan> plan = planTangents(shape.view(), {.convention = conventions::opengl});
    ASSERT_TRUE(plan);
    Outputs outputs(shape.cornerCount());
    const std::span<const Vec3> all(shape.positions);
    const auto code = [&](const Pose& pose, const TangentOutput& out) {
        const Result<TangentReport> result = evaluateTangents(*plan, pose, out);
        return result ? ErrorCode::ok : result.error().code;
    };
    EXPECT_EQ(code({shape.positions, shape.normals}, outputs.view()), ErrorCode::ok);
    EXPECT_EQ(code({all.first(3), shape.normals}, outputs.view()), ErrorCode::planMismatch);
    EXPECT_EQ(code({shape.positions, {}}, outputs.view()), ErrorCode::planMismatch);
    outputs.tangents.pop_back();
    EXPECT_EQ(code({shape.positions, shape.normals}, outputs.view()), ErrorCode::planMismatch);
}

TEST(TangentBorder, NamesTheInvalidArgument) {
    const SimpleMesh shape = grid(2);
    Outputs outputs(shape.cornerCount());
    const auto code = [&](const MeshView& mesh, const TangentOptions& options, const TangentOutput& out) {
        const Result<TangentReport> result = generateTangents(mesh, options, out);
        return result ? ErrorCode::ok : result.error().code;
    };
    MeshView mesh = shape.view();
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl}, outputs.view()), ErrorCode::ok);
    EXPECT_EQ(code(mesh, {.method = static_cast<Method>(77), .convention = conventions::opengl}, outputs.view()),
              ErrorCode::invalidOption);
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl, .pairing = static_cast<Pairing>(2)}, outputs.view()),
              ErrorCode::invalidOption);
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl, .ngons = static_cast<Ngons>(2)}, outputs.view()),
              ErrorCode::invalidOption);
    TangentOutput out = outputs.view();
    out.tangents.count -= 1;
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl}, out), ErrorCode::countMismatch);
    out = outputs.view();
    out.magnitudes_t.count -= 1;
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl}, out), ErrorCode::countMismatch);
    mesh.normals = {};
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl}, outputs.view()), ErrorCode::missingAttribute);
    mesh = shape.view();
    mesh.uvs = {};
    EXPECT_EQ(code(mesh, {.convention = conventions::opengl}, outputs.view()), ErrorCode::missingAttribute);
}

TEST(TangentBorder, AnEmptyMeshIsFine) {
    const Result<TangentReport> result =
        generateTangents(MeshView{}, {.convention = conventions::opengl}, TangentOutput{});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->triangle_count, 0u);
}

TEST(TangentBorder, UnwantedOutputsMayBeMissing) {
    const SimpleMesh shape = someDegenerate(200);
    const Outputs all = generate(shape);
    Outputs some(shape.cornerCount());
    ASSERT_TRUE(generateTangents(shape.view(), {.convention = conventions::opengl}, {.tangents = some.tangents}));
    EXPECT_EQ(all.tangents, some.tangents);
}

/// Counts allocations, and fails from the call `fails_at` on.
struct CountingAllocator {
    std::size_t calls = 0, fails_at = ~std::size_t{0}, live_bytes = 0, peak_bytes = 0;
    Allocator allocator{.allocate = [](void* user, std::size_t bytes, std::size_t alignment) -> void* {
                            auto& self = *static_cast<CountingAllocator*>(user);
                            if (self.calls++ >= self.fails_at) return nullptr;
                            self.live_bytes += bytes;
                            self.peak_bytes = std::max(self.peak_bytes, self.live_bytes);
                            return ::operator new(bytes, std::align_val_t(alignment));
                        },
                        .release =
                            [](void* user, void* memory, std::size_t bytes, std::size_t alignment) {
                                static_cast<CountingAllocator*>(user)->live_bytes -= bytes;
                                ::operator delete(memory, std::align_val_t(alignment));
                            },
                        .user = this};
};

/// Lets each allocation of a call fail in turn, and returns the number of allocations.
std::size_t letEachAllocationFail(const SimpleMesh& shape, float threshold, Method method = Method::mikktspace) {
    CountingAllocator counting;
    const Execution execution{.allocator = &counting.allocator};
    const TangentOptions options{
        .method = method, .convention = conventions::opengl, .angular_threshold_deg = threshold};
    const Outputs want = generate(shape, options, execution);
    EXPECT_EQ(counting.live_bytes, 0u);
    const std::size_t calls = counting.calls;
    for (std::size_t n = 0; n < calls; ++n) {
        counting.calls = 0;
        counting.fails_at = n;
        Outputs outputs(shape.cornerCount());
        const Result<TangentReport> result = generateTangents(shape.view(), options, outputs.view(), execution);
        EXPECT_FALSE(result) << "allocation " << n;
        if (!result) {
            EXPECT_EQ(result.error().code, ErrorCode::outOfMemory);
        }
        EXPECT_EQ(counting.live_bytes, 0u);
    }
    return calls;
}

TEST(TangentMemory, EachAllocationMayFail) {
    SimpleMesh shape = someDegenerate(2000);
    for (const auto& more : {std::array{0u, 1u, 2u}, std::array{0u, 1u, 3u}})
        shape.addTriangle(more[0], more[1], more[2]);
    shape.normals[0].x = -0.0f;
    shape.uvs[3] = shape.uvs[2];
    for (const float threshold : {20.0f, 180.0f}) EXPECT_GT(letEachAllocationFail(shape, threshold), 10u);
    for (const Method method : {Method::fast, Method::best}) EXPECT_GT(letEachAllocationFail(shape, 180, method), 10u);
}

TEST(TangentMemory, UnindexedCornersTakeAtMost32BytesPerTriangle) {
    SimpleMesh shape = grid(200);
    // Triangles whose UVs are a single point require a second pass.
    for (std::uint32_t corner = 0; corner < 300; ++corner) shape.uvs[shape.indices[corner]] = {};
    SimpleMesh corners;
    for (const std::uint32_t v : shape.indices) corners.addVertex(shape.positions[v], shape.normals[v], shape.uvs[v]);
    MeshView mesh = corners.view();
    mesh.indices = {};
    for (const unsigned threads : {1u, 2u}) {
        CountingAllocator counting;
        std::vector<Vec4> tangents(corners.positions.size());
        ASSERT_TRUE(generateTangents(mesh, {.convention = conventions::opengl}, {.tangents = tangents},
                                     {.thread_count = threads, .allocator = &counting.allocator}));
        EXPECT_LE(counting.peak_bytes, 32 * (tangents.size() / 3)) << threads << " threads";
    }
}

/// If first all first triangles of quads and then all second ones are listed, one pass still completes the nodes of a
/// grid. It needs no memory for the vertex path.
TEST(TangentMemory, SecondTrianglesOfQuadsMayFollowAllFirstOnes) {
    const SimpleMesh natural = gridOf(20000);
    SimpleMesh sweeps = natural;
    sweeps.indices.clear();
    for (const std::size_t first : {0u, 1u}) {
        for (std::size_t t = first; t < natural.indices.size() / 3; t += 2)
            sweeps.addTriangle(natural.indices[3 * t], natural.indices[3 * t + 1], natural.indices[3 * t + 2]);
    }
    CountingAllocator counting;
    std::vector<Vec4> tangents(sweeps.cornerCount());
    ASSERT_TRUE(generateTangents(sweeps.view(), {.convention = conventions::opengl}, {.tangents = tangents},
                                 {.thread_count = 1, .allocator = &counting.allocator}));
    EXPECT_LE(counting.peak_bytes, 32 * (tangents.size() / 3));
    const Result<TangentPlan> plan = planTangents(sweeps.view(), {.convention = conventions::opengl});
    std::vector<Vec4> planned(tangents.size());
    ASSERT_TRUE(evaluateTangents(*plan, {sweeps.positions, sweeps.normals}, {.tangents = planned}));
    EXPECT_EQ(std::memcmp(tangents.data(), planned.data(), tangents.size() * sizeof(Vec4)), 0);
}

TEST(TangentMemory, ASmallMeshTakesFewBlocks) {
    for (const float threshold : {20.0f, 180.0f}) {
        const std::size_t calls = letEachAllocationFail(someDegenerate(100), threshold);
        EXPECT_GE(calls, 1u);
        EXPECT_LE(calls, 4u);
    }
}

}  // namespace
}  // namespace tspace::test
