// SPDX-License-Identifier: MIT
#include "tspace/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/simple_mesh.h"

namespace tspace {
namespace {

using test::SimpleMesh;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<Vec3> normalsOf(const MeshView& mesh, const NormalOptions& options = {}, NormalReport* report = nullptr) {
    std::vector<Vec3> out(mesh.cornerCount(), Vec3{9, 9, 9});
    const Result<NormalReport> result = generateNormals(mesh, options, out);
    EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().message);
    if (report != nullptr && result) *report = *result;
    return out;
}

ErrorCode errorOf(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out,
                  const Execution& execution = {}) {
    const Result<NormalReport> result = generateNormals(mesh, options, out, execution);
    return result ? ErrorCode::ok : result.error().code;
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-6) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

void expectCubeIsSmooth(const SimpleMesh& cube, const std::vector<Vec3>& normals) {
    const float k = 1 / std::sqrt(3.0f);
    for (std::size_t c = 0; c < normals.size(); ++c) {
        const Vec3& p = cube.positions[cube.indices[c]];
        expectNear(normals[c], {k * p.x, k * p.y, k * p.z});
    }
}

void expectCubeIsHard(const std::vector<Vec3>& normals) {
    for (std::size_t c = 0; c < normals.size(); ++c) EXPECT_EQ(normals[c], test::kCubeNormals[c * 6 / normals.size()]);
}

TEST(AngleWeights, GiveTheBoxDiagonalForAnyTriangulation) {
    for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
        const SimpleMesh cube = test::triangleCube(diagonals);
        expectCubeIsSmooth(cube, normalsOf(cube.view()));
    }
    expectCubeIsSmooth(test::quadCube(), normalsOf(test::quadCube().view()));
}

TEST(AngleWeights, CountAReflexCornerByItsInteriorAngle) {
    // An L-shaped polygon whose reflex corner is vertex 0, and a wall at the notch. The L is given as one polygon, and
    // as triangles that all use vertex 0.
    SimpleMesh whole;
    whole.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    SimpleMesh cut = whole;
    whole.addFace({0, 1, 2, 3, 4, 5});
    whole.addFace({0, 5, 6});
    for (std::uint32_t i = 1; i < 5; ++i) cut.addFace({0, i, i + 1});
    cut.addFace({0, 5, 6});
    expectNear(normalsOf(whole.view())[0], normalsOf(cut.view())[0]);
}

TEST(Weights, EqualTheirFormulas) {
    // Two triangles at the origin: one in the plane z = 0 with edges of length 1 and 1, the other in the plane x = 0
    // with edges of length 2 and 4.
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0, 4}};
    mesh.positions[2] = {0.70710678f, 0.70710678f, 0};
    mesh.addFace({0, 1, 2});
    mesh.addFace({0, 3, 4});
    const double angle1 = 45, angle2 = 90, area1 = std::sqrt(0.5), area2 = 8;
    const auto expectRatio = [&](NormalWeighting weighting, double z, double x) {
        const double l = std::hypot(x, z);
        expectNear(normalsOf(mesh.view(), {.weighting = weighting})[0],
                   {static_cast<float>(x / l), 0, static_cast<float>(z / l)});
    };
    expectRatio(NormalWeighting::uniform, 1, 1);
    expectRatio(NormalWeighting::area, area1, area2);
    expectRatio(NormalWeighting::angle, angle1, angle2);
    expectRatio(NormalWeighting::angleArea, angle1 * area1, angle2 * area2);
    expectRatio(NormalWeighting::max, std::sqrt(0.5), 1 / 8.0);
    EXPECT_EQ(normalsOf(mesh.view(), {.weighting = NormalWeighting::flat})[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(normalsOf(mesh.view(), {.weighting = NormalWeighting::flat})[3], (Vec3{1, 0, 0}));
}

TEST(Weights, CountAFaceOnceAtACollapsedEdge) {
    SimpleMesh triangle, quad;
    triangle.positions = quad.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {0, 0, 0}};
    triangle.addFace({0, 1, 2});
    triangle.addFace({0, 2, 3});
    quad.addFace({0, 4, 1, 2});
    quad.addFace({2, 3, 4, 0});
    for (const auto weighting : {NormalWeighting::uniform, NormalWeighting::area, NormalWeighting::angle,
                                 NormalWeighting::angleArea, NormalWeighting::max}) {
        for (const float crease : {180.0f, 100.0f}) {
            const NormalOptions options{.weighting = weighting, .crease_angle_deg = crease};
            const Vec3 wanted = normalsOf(triangle.view(), options)[0];
            const std::vector<Vec3> normals = normalsOf(quad.view(), options);
            for (const std::size_t corner : {0u, 1u, 6u, 7u}) expectNear(normals[corner], wanted);
        }
    }
}

TEST(Newell, GivesTheNormalOfABentAndOfAConcavePolygon) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
    mesh.addFace({3, 4, 0, 1, 2});  // the polygon starts at its reflex corner
    for (const Vec3& n : normalsOf(mesh.view())) EXPECT_EQ(n, (Vec3{0, 0, 1}));
}

TEST(Newell, KeepsItsDigitsFarFromTheOrigin) {
    SimpleMesh mesh;
    mesh.positions = {{1e6f, 1e6f, 1e6f}, {1e6f + 1, 1e6f, 1e6f}, {1e6f, 1e6f + 1, 1e6f + 1}};
    mesh.addFace({0, 1, 2});
    expectNear(normalsOf(mesh.view())[0], {0, -std::sqrt(0.5f), std::sqrt(0.5f)});
}

TEST(CreaseAngle, SplitsACubeBelowNinetyDegreesOnly) {
    for (const SimpleMesh& cube : {test::quadCube(), test::triangleCube(0x2a)}) {
        for (const float hard : {0.0f, 30.0f, 89.999f}) {
            expectCubeIsHard(normalsOf(cube.view(), {.crease_angle_deg = hard}));
        }
        for (const float smooth : {90.0f, 120.0f, 180.0f}) {
            expectCubeIsSmooth(cube, normalsOf(cube.view(), {.crease_angle_deg = smooth}));
        }
    }
}

TEST(CreaseAngle, AppliesToEdgesSoThatSmallAnglesAddUp) {
    // A quarter of a cone: nine faces at its apex, in steps of 10 degrees around its axis. The first and the last face
    // are eight steps apart.
    SimpleMesh mesh;
    mesh.positions.push_back({0, 0, 0});
    for (int i = 0; i <= 9; ++i) {
        const double a = i * 10 * 3.14159265358979 / 180;
        mesh.positions.push_back({1, static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a))});
    }
    for (std::uint32_t i = 1; i <= 9; ++i) mesh.addFace({0, i, i + 1});
    const std::vector<Vec3> smooth = normalsOf(mesh.view(), {.crease_angle_deg = 11});
    for (std::size_t f = 0; f < 9; ++f) EXPECT_EQ(smooth[3 * f], smooth[0]);
    const std::vector<Vec3> hard = normalsOf(mesh.view(), {.crease_angle_deg = 5});
    for (std::size_t f = 1; f < 9; ++f) EXPECT_NE(hard[3 * f], hard[0]);
}

TEST(CreaseAngle, KeepsFacesApartThatMeetInAPointOnlyUnlessItIs180) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0.5f}, {-1, 0, 0}};
    mesh.addFace({0, 1, 2});
    mesh.addFace({0, 4, 3});
    EXPECT_NE(normalsOf(mesh.view(), {.crease_angle_deg = 179})[0],
              normalsOf(mesh.view(), {.crease_angle_deg = 179})[3]);
    EXPECT_EQ(normalsOf(mesh.view())[0], normalsOf(mesh.view())[3]);
}

TEST(SmoothingGroups, SmoothEqualNumbersAndNeverZero) {
    const SimpleMesh cube = test::quadCube();
    NormalOptions options;
    for (const float crease : {180.0f, 100.0f}) {
        options.crease_angle_deg = crease;
        const std::vector<std::uint32_t> same(6, 7), none(6, 0), different{1, 2, 3, 4, 5, 6};
        options.smoothing_groups = same;
        expectCubeIsSmooth(cube, normalsOf(cube.view(), options));
        options.smoothing_groups = none;
        expectCubeIsHard(normalsOf(cube.view(), options));
        options.smoothing_groups = different;
        expectCubeIsHard(normalsOf(cube.view(), options));
        const std::vector<std::uint32_t> x_and_y{1, 1, 1, 1, 2, 0};
        options.smoothing_groups = x_and_y;
        const std::vector<Vec3> normals = normalsOf(cube.view(), options);
        const float k = std::sqrt(0.5f);
        expectNear(normals[0], {-k, -k, 0});
        EXPECT_EQ(normals[16], (Vec3{0, 0, -1}));
        EXPECT_EQ(normals[20], (Vec3{0, 0, 1}));
    }
}

TEST(SmoothingGroups, AsMasksSmoothFacesWithABitInCommon) {
    const SimpleMesh cube = test::quadCube();
    const std::vector<std::uint32_t> masks{0x1, 0x80000001, 0x2, 0x2, 0x80000000, 0x0};
    for (const float crease : {180.0f, 100.0f}) {
        const NormalOptions options{
            .crease_angle_deg = crease, .smoothing_groups = masks, .smoothing_groups_are_masks = true};
        const std::vector<Vec3> normals = normalsOf(cube.view(), options);
        const float k = std::sqrt(0.5f);
        EXPECT_EQ(normals[0], (Vec3{-1, 0, 0}));  // corner at vertex 0: no neighbor there shares a bit
        expectNear(normals[4], {k, 0, -k});       // corner at vertex 1: +x and -z share the highest bit
        EXPECT_EQ(normals[8], (Vec3{0, -1, 0}));  // corner at vertex 0
        EXPECT_EQ(normals[20], (Vec3{0, 0, 1}));  // a face without bits
    }
}

TEST(Welding, MakesUvSeamsSmoothAndCanBeTurnedOff) {
    SimpleMesh cube = test::quadCube();
    SimpleMesh soup;
    for (const std::uint32_t v : cube.indices) soup.positions.push_back(cube.positions[v]);
    for (std::uint32_t c = 0; c < 24; ++c) soup.indices.push_back(c);
    soup.face_sizes = cube.face_sizes;
    EXPECT_EQ(normalsOf(soup.view()), normalsOf(cube.view()));
    expectCubeIsHard(normalsOf(soup.view(), {.weld_positions = false}));
    expectCubeIsSmooth(cube, normalsOf(cube.view(), {.weld_positions = false}));
}

TEST(Welding, TreatsMinusZeroAsZeroAndWeldsNoNan) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}, {0, 0, 1}, {kNan, 0, 0}, {kNan, 0, 0}};
    mesh.addFace({0, 1, 2});
    mesh.addFace({3, 2, 4});
    mesh.addFace({5, 2, 4});
    mesh.addFace({6, 1, 2});
    const std::vector<Vec3> normals = normalsOf(mesh.view());
    EXPECT_EQ(normals[0], normals[3]);
    EXPECT_EQ(normals[6], (Vec3{0, 0, 1}));
    EXPECT_EQ(normals[9], (Vec3{0, 0, 1}));
}

TEST(Conventions, HandednessAndWindingTurnNormals) {
    const SimpleMesh cube = test::triangleCube(5);
    for (const auto weighting : {NormalWeighting::flat, NormalWeighting::angle, NormalWeighting::max}) {
        for (const float crease : {180.0f, 20.0f}) {
            NormalOptions options{.weighting = weighting, .crease_angle_deg = crease};
            const std::vector<Vec3> plain = normalsOf(cube.view(), options);
            const auto expectFactor = [&](const Convention& convention, float factor) {
                options.convention = convention;
                const std::vector<Vec3> turned = normalsOf(cube.view(), options);
                for (std::size_t c = 0; c < plain.size(); ++c) {
                    EXPECT_EQ(turned[c], (Vec3{factor * plain[c].x, factor * plain[c].y, factor * plain[c].z}));
                }
            };
            expectFactor({.handedness = Handedness::left}, -1);
            expectFactor({.winding = Winding::clockwise}, -1);
            expectFactor(conventions::unity, 1);
            expectFactor(conventions::gltf, 1);
        }
    }
}

TEST(Fallbacks, ReplaceWhatHasNoMean) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.addFace({0, 1, 2});
    mesh.addFace({0, 2, 1});  // the back side of the first face: the means cancel
    mesh.addFace({0, 0, 1});  // degenerate face at points whose mean normal is zero
    mesh.addFace({3, 3, 3});  // degenerate face at a separate point
    NormalReport report;
    const std::vector<Vec3> normals = normalsOf(mesh.view(), {}, &report);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(normals[c], (Vec3{0, 0, 1}));
    for (std::size_t c = 3; c < 6; ++c) EXPECT_EQ(normals[c], (Vec3{0, 0, -1}));
    for (std::size_t c = 6; c < 12; ++c) EXPECT_EQ(normals[c], (Vec3{0, 0, 1}));
    EXPECT_EQ(report.face_count, 4u);
    EXPECT_EQ(report.degenerate_face_count, 2u);
    EXPECT_EQ(report.fallback_corner_count, 12u);
}

TEST(Fallbacks, ReplaceAMeanWhoseAnglesAddUpToNothing) {
    // At vertex 0 one triangle faces up. Two triangles that together have the same angle face down.
    for (const Vec3 middle : {Vec3{1, 1, 0}, Vec3{2, 1, 0}, Vec3{1, 2, 0}, Vec3{3, 1, 0}, Vec3{5, 7, 0}}) {
        SimpleMesh mesh;
        mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, middle};
        mesh.indices = {0, 1, 2, 0, 3, 1, 0, 2, 3};
        for (const bool as_faces : {false, true}) {  // explicit face sizes use a different code path
            if (as_faces) mesh.face_sizes = {3, 3, 3};
            std::vector<Vec3> out(9);
            ASSERT_TRUE(generateNormals(mesh.view(), {}, out));
            EXPECT_EQ(out[0], (Vec3{0, 0, 1}));
            EXPECT_EQ(out[3], (Vec3{0, 0, -1}));
            EXPECT_EQ(out[6], (Vec3{0, 0, -1}));
        }
    }
}

TEST(Fallbacks, GiveADegenerateFaceTheMeanOfTheOthers) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    mesh.addFace({0, 1, 2});
    mesh.addFace({0, 1, 3});
    for (const auto weighting : {NormalWeighting::flat, NormalWeighting::angle}) {
        for (const float crease : {180.0f, 20.0f}) {
            NormalReport report;
            const std::vector<Vec3> normals =
                normalsOf(mesh.view(), {.weighting = weighting, .crease_angle_deg = crease}, &report);
            for (std::size_t c = 0; c < 5; ++c) EXPECT_EQ(normals[c], (Vec3{0, 0, 1}));
            EXPECT_EQ(report.degenerate_face_count, 1u);
        }
    }
}

TEST(Faces, OfFewerThanThreeCornersGetZero) {
    SimpleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.addFace({0});
    mesh.addFace({0, 1});
    mesh.addFace({});
    mesh.addFace({0, 1, 2});
    for (const auto weighting : {NormalWeighting::flat, NormalWeighting::angle}) {
        NormalReport report;
        const std::vector<Vec3> normals = normalsOf(mesh.view(), {.weighting = weighting}, &report);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(normals[c], Vec3{});
        for (std::size_t c = 3; c < 6; ++c) EXPECT_EQ(normals[c], (Vec3{0, 0, 1}));
        EXPECT_EQ(report.face_count, 1u);
    }
}

TEST(Border, RejectsWrongOptionsAndLengths) {
    const SimpleMesh cube = test::quadCube();
    std::vector<Vec3> out(24), short_out(23);
    const std::vector<std::uint32_t> groups(5, 1);
    EXPECT_EQ(errorOf(cube.view(), {.crease_angle_deg = -2}, out), ErrorCode::invalidOption);
    EXPECT_EQ(errorOf(cube.view(), {.crease_angle_deg = 181}, out), ErrorCode::invalidOption);
    EXPECT_EQ(errorOf(cube.view(), {.crease_angle_deg = kNan}, out), ErrorCode::invalidOption);
    EXPECT_EQ(errorOf(cube.view(), {.weighting = static_cast<NormalWeighting>(7)}, out), ErrorCode::invalidOption);
    EXPECT_EQ(errorOf(cube.view(), {.smoothing_groups = groups}, out), ErrorCode::countMismatch);
    EXPECT_EQ(errorOf(cube.view(), {}, short_out), ErrorCode::countMismatch);
    EXPECT_EQ(errorOf(cube.view(), {}, StridedSpan<Vec3>(nullptr, 24)), ErrorCode::nullData);
    EXPECT_EQ(errorOf(MeshView{}, {}, {}), ErrorCode::ok);
}

TEST(Border, RunningOutOfMemoryIsAnErrorAtEveryAllocation) {
    struct Budget {
        int left;
    };
    const SimpleMesh cube = test::quadCube();
    std::vector<Vec3> out(24);
    for (int budget = 0;; ++budget) {
        Budget state{budget};
        const Allocator allocator{[](void* user, std::size_t bytes, std::size_t alignment) -> void* {
                                      if (static_cast<Budget*>(user)->left-- <= 0) return nullptr;
                                      return ::operator new(bytes, std::align_val_t(alignment));
                                  },
                                  [](void*, void* memory, std::size_t, std::size_t alignment) {
                                      ::operator delete(memory, std::align_val_t(alignment));
                                  },
                                  &state};
        const NormalOptions options{.weighting = NormalWeighting::best, .crease_angle_deg = 30};
        const ErrorCode code = errorOf(cube.view(), options, out, {.allocator = &allocator});
        if (code == ErrorCode::ok) {
            EXPECT_GT(budget, 5);
            break;
        }
        ASSERT_EQ(code, ErrorCode::outOfMemory);
    }
}

}  // namespace
}  // namespace tspace
