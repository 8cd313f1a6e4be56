// SPDX-License-Identifier: MIT
// Meshes on which naive code takes quadratic time. Results must have the same bits for every number of threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/base/weld.h"
#include "support/simple_mesh.h"
#include "support/thread_team.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

using test::SimpleMesh;

constexpr double kPi = 3.14159265358979323846;

std::vector<Vec3> normalsOf(const MeshView& mesh, const NormalOptions& options, NormalReport* report = nullptr,
                            const Execution& execution = {}) {
    std::vector<Vec3> out(mesh.cornerCount());
    const Result<NormalReport> result = generateNormals(mesh, options, out, execution);
    EXPECT_TRUE(result.ok());
    if (report != nullptr && result) *report = *result;
    return out;
}

Vec3 onCircle(std::size_t i, std::size_t count, float height) {
    const double a = 2 * kPi * static_cast<double>(i) / static_cast<double>(count);
    return {static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)), height};
}

TEST(Crowds, AFanOf200000TrianglesIsOneComponent) {
    constexpr std::uint32_t kCount = 200'000;
    SimpleMesh fan;
    fan.positions.push_back({0, 0, 1});
    for (std::uint32_t i = 0; i < kCount; ++i) fan.positions.push_back(onCircle(i, kCount, 0));
    for (std::uint32_t i = 0; i < kCount; ++i) fan.addFace({0, 1 + i, 1 + (i + 1) % kCount});
    for (const float crease : {180.0f, 60.0f}) {
        const std::vector<Vec3> normals = normalsOf(fan.view(), {.crease_angle_deg = crease});
        for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(normals[3 * i], normals[0]);
        EXPECT_NEAR(normals[0].z, 1, 1e-6);
    }
}

TEST(Crowds, ABookOf100000PagesIsOneComponentOrOnePerPage) {
    constexpr std::uint32_t kCount = 100'000;
    SimpleMesh book;
    book.positions = {{0, 0, 0}, {0, 0, 1}};
    std::vector<std::uint32_t> masks;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        // Points of half a circle, in scattered order. All faces point to the same side, so their mean is not zero.
        book.positions.push_back(onCircle(i * 7919ull % kCount, 2 * kCount, 0.5f));
        book.addFace({0, 1, 2 + i});
        masks.push_back(i % 2 == 0 ? 0x1 : 0x10);
    }
    const std::vector<Vec3> smooth = normalsOf(book.view(), {.crease_angle_deg = 1});
    for (std::uint32_t i = 1; i < kCount; ++i) ASSERT_EQ(smooth[3 * i], smooth[0]);

    const NormalOptions by_mask{.crease_angle_deg = 1, .smoothing_groups = masks, .smoothing_groups_are_masks = true};
    const std::vector<Vec3> halves = normalsOf(book.view(), by_mask);
    for (std::uint32_t i = 2; i < kCount; ++i) ASSERT_EQ(halves[3 * i], halves[3 * (i % 2)]);
    EXPECT_NE(halves[0], halves[3]);

    const std::vector<Vec3> hard = normalsOf(book.view(), {.crease_angle_deg = 0});
    const std::vector<Vec3> flat = normalsOf(book.view(), {.weighting = NormalWeighting::flat});
    EXPECT_EQ(hard, flat);
}

TEST(Crowds, OneHundredThousandLooseFacesAtOnePointStayApart) {
    constexpr std::uint32_t kCount = 100'000;
    SimpleMesh burr;
    burr.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < kCount; ++i) {
        burr.positions.push_back(onCircle(2ull * i, 2 * kCount, static_cast<float>(i % 5)));
        burr.positions.push_back(onCircle(2ull * i + 1, 2 * kCount, static_cast<float>(i % 7)));
        burr.addFace({0, 1 + 2 * i, 2 + 2 * i});
    }
    EXPECT_EQ(normalsOf(burr.view(), {.crease_angle_deg = 170}),
              normalsOf(burr.view(), {.weighting = NormalWeighting::flat}));
    const std::vector<Vec3> smooth = normalsOf(burr.view(), {});
    for (std::uint32_t i = 1; i < kCount; ++i) ASSERT_EQ(smooth[3 * i], smooth[0]);
}

TEST(Crowds, CollapsedFacesAtOnePointAllGetASubstitute) {
    constexpr std::uint32_t kCount = 100'000;
    SimpleMesh mesh;
    mesh.positions = {{1, 2, 3}, {1, 2, 4}, {1, 2, 6}};
    for (std::uint32_t i = 0; i < kCount; ++i) mesh.addFace({0, i % 3, i % 2});
    NormalReport report;
    for (const Vec3& n : normalsOf(mesh.view(), {.crease_angle_deg = 60}, &report)) ASSERT_EQ(n, (Vec3{0, 0, 1}));
    EXPECT_EQ(report.degenerate_face_count, kCount);
    EXPECT_EQ(report.fallback_corner_count, 3 * kCount);
}

TEST(Crowds, APolygonWithRepeatedCornersAtAPointCountsOnce) {
    constexpr std::uint32_t kCount = 200'000;
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices.assign(kCount, 0);
    mesh.indices[kCount / 2] = 1;
    mesh.indices[kCount / 2 + 1] = 2;
    mesh.face_sizes = {kCount};
    for (const Vec3& n : normalsOf(mesh.view(), {.crease_angle_deg = 60})) ASSERT_EQ(n, (Vec3{0, 0, 1}));
}

TEST(NormalThreads, DoNotChangeABit) {
    std::mt19937 random(7);
    SimpleMesh mesh;
    for (int v = 0; v < 30'000; ++v) {
        const auto coordinate = [&] { return static_cast<float>(random() % 24); };
        const float x = coordinate(), y = coordinate();
        mesh.positions.push_back({x, y, coordinate()});
    }
    std::vector<std::uint32_t> groups;
    for (int f = 0; f < 40'000; ++f) {
        const auto vertex = [&] { return static_cast<std::uint32_t>(random() % 30'000); };
        const std::uint32_t a = vertex(), b = vertex(), c = vertex();
        mesh.addFace({a, b, c, vertex()});
        groups.push_back(random() % 4);
    }
    const auto expectSameBits = [&](const NormalOptions& options) {
        const std::vector<Vec3> one = normalsOf(mesh.view(), options);
        for (const unsigned threads : {2u, 3u, 8u}) {
            const std::vector<Vec3> many =
                normalsOf(mesh.view(), options, nullptr, {.executor = test::threadTeam(threads)});
            ASSERT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(Vec3)), 0) << threads;
        }
    };
    for (const NormalWeighting weighting : {NormalWeighting::angle, NormalWeighting::best}) {
        for (const float crease : {180.0f, 120.0f}) {
            NormalOptions options{.weighting = weighting, .crease_angle_deg = crease};
            options.refine = 2;
            expectSameBits(options);
            options.smoothing_groups = groups;
            expectSameBits(options);
        }
    }
}

TEST(Threads, DoNotChangeABitOfTriangles) {
    // The mesh has many vertices per position, collapsed triangles, and double-sided triangles whose mean normals are
    // zero.
    std::mt19937 random(9);
    SimpleMesh mesh;
    for (int v = 0; v < 70'000; ++v) {
        const auto coordinate = [&] { return static_cast<float>(random() % 24); };
        const float x = coordinate(), y = coordinate();
        mesh.positions.push_back({x, y, coordinate()});
    }
    for (std::uint32_t f = 0; f < 40'000; ++f) {
        const auto vertex = [&] { return static_cast<std::uint32_t>(random() % 60'000); };
        const std::uint32_t a = vertex(), b = vertex(), c = vertex();
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
    for (std::uint32_t v = 60'000; v + 3 <= 70'000; v += 3) {
        mesh.indices.insert(mesh.indices.end(), {v, v + 1, v + 2, v, v + 2, v + 1});
    }
    for (const bool weld : {false, true}) {
        for (const NormalWeighting weighting : {NormalWeighting::angle, NormalWeighting::area, NormalWeighting::best}) {
            NormalOptions options{.weighting = weighting, .weld_positions = weld};
            options.refine = 2;
            NormalReport one_report, report;
            const std::vector<Vec3> one = normalsOf(mesh.view(), options, &one_report);
            if (!weld) {
                EXPECT_GT(one_report.fallback_corner_count, 10'000u);
            }
            for (const unsigned threads : {2u, 3u, 8u}) {
                const std::vector<Vec3> many =
                    normalsOf(mesh.view(), options, &report, {.executor = test::threadTeam(threads)});
                ASSERT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(Vec3)), 0) << threads;
                EXPECT_EQ(report.degenerate_face_count, one_report.degenerate_face_count);
                EXPECT_EQ(report.fallback_corner_count, one_report.fallback_corner_count);
            }
        }
    }
}

/// Positions with colliding hashes would cause quadratic time. Many vertices at few positions come closest to that
/// without knowledge of the hash function.
TEST(Welding, FindsTheLowestOfManyVerticesAtFewPositions) {
    constexpr std::uint32_t kCount = 200'001;
    SimpleMesh mesh;
    for (std::uint32_t v = 0; v < kCount; ++v) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        mesh.positions.push_back(v % 3 == 0 ? Vec3{0, 0, 0} : v % 3 == 1 ? Vec3{1, 0, -0.0f} : Vec3{nan, 1, 0});
    }
    Parallel one(Execution{.thread_count = 1}), four(Execution{.thread_count = 4});
    for (Parallel* parallel : {&one, &four}) {
        const Buffer<std::uint32_t> lowest = weldPositions(mesh.view(), nullptr, *parallel);
        for (std::uint32_t v = 0; v < kCount; ++v) ASSERT_EQ(lowest[v], v % 3 == 2 ? v : v % 3);
    }
}

}  // namespace
}  // namespace tspace
