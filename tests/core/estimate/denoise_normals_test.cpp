// SPDX-License-Identifier: MIT
// NormalOptions::denoise: how much it improves noisy meshes, when it must not change any bit, and invalid meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "core/base/vec_math.h"
#include "core/estimate/denoise.h"
#include "core/estimate/pose_normals.h"
#include "core/normals/normals_outcome.h"
#include "scans.h"
#include "support/simple_mesh.h"
#include "support/thread_team.h"
#include "test_mesh.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

using accuracy::Random;
using accuracy::Scan;
using accuracy::Shape;
using test::normalsOf;
using test::Outcome;
using test::sameBits;
using test::shape;
using test::SimpleMesh;

Outcome bestOf(const MeshView& mesh, float denoise, float crease_deg = 180, const Execution& execution = {}) {
    return normalsOf(mesh, {.weighting = NormalWeighting::best, .crease_angle_deg = crease_deg, .denoise = denoise},
                     execution);
}
constexpr float kAuto = NormalOptions::denoise_auto;

bool areUnit(const std::vector<Vec3>& normals) {
    return std::all_of(normals.begin(), normals.end(), [](const Vec3& n) { return std::fabs(length(n) - 1) < 1e-5f; });
}

/// Returns a cylinder whose caps are fans from one vertex of the rim.
SimpleMesh cappedCylinder(std::uint32_t sides, std::uint32_t rows) {
    SimpleMesh mesh;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double angle = 6.283185307179586 * side / sides;
            mesh.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                                      2 * static_cast<float>(row) / static_cast<float>(rows)});
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t a = row * sides + side, b = row * sides + (side + 1) % sides;
            mesh.addTriangle(a, b, b + sides);
            mesh.addTriangle(a, b + sides, a + sides);
        }
    }
    for (std::uint32_t side = 1; side + 1 < sides; ++side) {
        const std::uint32_t top = rows * sides;
        mesh.addTriangle(0, side + 1, side);
        mesh.addTriangle(top, top + side, top + side + 1);
    }
    return mesh;
}

/// Returns a cube of the sides in kCubeFaces, one after the other, with cells^2 squares each. `noise`: standard
/// deviation, in edge lengths.
SimpleMesh noisyCube(std::uint32_t cells, double noise, Random random) {
    SimpleMesh cube;
    const std::vector<Vec3> corners = test::cubePositions();
    std::map<std::array<float, 3>, Vec3> moved;              // vertices shared by two sides move together
    const double size = 2 * noise / cells * std::sqrt(3.0);  // random.around(1) deviates by 1 / sqrt(3)
    for (const auto& face : test::kCubeFaces) {
        const auto first = static_cast<std::uint32_t>(cube.positions.size());
        const Vec3 origin = corners[face[0]], right = corners[face[1]] - origin, up = corners[face[3]] - origin;
        for (std::uint32_t j = 0; j <= cells; ++j) {
            for (std::uint32_t i = 0; i <= cells; ++i) {
                const float x = static_cast<float>(i) / static_cast<float>(cells),
                            y = static_cast<float>(j) / static_cast<float>(cells);
                const Vec3 p = origin + x * right + y * up;
                const auto [place, is_new] = moved.try_emplace({p.x, p.y, p.z});
                if (is_new)
                    place->second =
                        toFloat(toDouble(p) + DVec3{random.around(size), random.around(size), random.around(size)});
                cube.positions.push_back(place->second);
            }
        }
        for (std::uint32_t j = 0; j < cells; ++j) {
            for (std::uint32_t i = 0; i < cells; ++i) {
                const std::uint32_t a = first + j * (cells + 1) + i, b = a + cells + 1;
                cube.addTriangle(a, a + 1, b + 1);
                cube.addTriangle(a, b + 1, b);
            }
        }
    }
    return cube;
}

/// Returns the shading error of `normals`, relative to the smallest error of area, angle, angleArea and best.
double partOfExisting(const Scan& scan, const std::vector<Vec3>& normals) {
    using enum NormalWeighting;
    constexpr int kPoints = 3000;
    double least = 180;
    for (const NormalWeighting weighting : {area, angle, angleArea, best}) {
        const Outcome other = normalsOf(scan.view(), {.weighting = weighting});
        least = std::min(least, shadedError(scan, other.normals, kPoints, Random{5}));
    }
    return shadedError(scan, normals, kPoints, Random{5}) / least;
}

TEST(DenoisedNormals, AreNearerToTheShapeOnNoisyScans) {
    struct Case {
        const char* shape;
        double noise, part;  // noise, and upper bound of the relative error (measured: 0.3 to 0.6)
    };
    for (const Case& c : {Case{"blob", 0.03, 0.85}, Case{"blob", 0.1, 0.55}, Case{"blob", 0.3, 0.38},
                          Case{"rounded box", 0.03, 0.80}, Case{"rounded box", 0.1, 0.55}, Case{"torus", 0.1, 0.35}}) {
        const Scan scan = accuracy::scan(shape(c.shape), 56, c.noise, Random{1});
        const Outcome denoised = bestOf(scan.view(), kAuto);
        EXPECT_LT(partOfExisting(scan, denoised.normals), c.part) << c.shape << ' ' << c.noise;
        EXPECT_NEAR(denoised.report.noise, c.noise, 0.15 * c.noise) << c.shape;
    }
}

TEST(DenoisedNormals, AreNearerToTheShapeOnNoisyMarchingCubes) {
    const std::map<std::string, double> parts = {{"hand", 0.9}, {"ripples", 0.72}, {"links", 0.8}};
    for (const Shape& shape : accuracy::heldOutShapes()) {
        if (shape.is_sharp) continue;
        const Scan cubes = accuracy::marchingCubes(shape, 64, 0.1, Random{1});
        EXPECT_LT(partOfExisting(cubes, bestOf(cubes.view(), kAuto).normals), parts.at(shape.name)) << shape.name;
    }
}

TEST(DenoisedNormals, HaveTheBitsOfBestWhereNothingIsNoise) {
    const auto expectSame = [](const MeshView& mesh, const char* name) {
        for (const float crease : {180.0f, 45.0f}) {
            const Outcome denoised = bestOf(mesh, kAuto, crease);
            EXPECT_TRUE(sameBits(denoised.normals, bestOf(mesh, 0, crease).normals)) << name;
            EXPECT_EQ(denoised.report.noise, 0) << name;
        }
    };
    for (const Shape& shape : accuracy::shapes())
        expectSame(accuracy::scan(shape, 48, 0, Random{1}).view(), shape.name);
    for (const std::span<const Shape> all : {accuracy::shapes(), accuracy::heldOutShapes()}) {
        for (const Shape& shape : all) {
            for (const double share : {0.1, 0.03})
                expectSame(decimated(accuracy::surfaceNets(shape, 64, 0, Random{1}), share).view(), shape.name);
            expectSame(decimated(accuracy::marchingCubes(shape, 64, 0, Random{1}), 0.1).view(), shape.name);
        }
    }
    for (const bool is_sharp : {false, true}) {
        for (const Scan& drawn : accuracy::drawnMeshes(is_sharp)) expectSame(drawn.view(), drawn.shape->name);
    }
    for (const std::uint32_t sides : {6u, 8u, 24u, 96u}) {
        for (const std::uint32_t rows : {1u, 8u, 50u}) expectSame(cappedCylinder(sides, rows).view(), "cylinder");
    }
    for (const accuracy::Bevel& bevel : accuracy::bevels()) expectSame(bevelMesh(bevel, Random{1}).view(), "bevel");
    expectSame(test::quadCube().view(), "cube");
}

TEST(DenoisedNormals, HaveTheSameBitsForAnyNumberOfThreads) {
    const Scan scan = accuracy::scan(shape("part"), 40, 0.1, Random{2});
    for (const float crease : {180.0f, 45.0f}) {
        const Outcome one = bestOf(scan.view(), kAuto, crease);
        EXPECT_GT(one.report.noise, 0);
        for (const unsigned threads : {2u, 4u, 7u}) {
            const Outcome many = bestOf(scan.view(), kAuto, crease, {.executor = test::threadTeam(threads)});
            EXPECT_TRUE(sameBits(one.normals, many.normals)) << threads;
            EXPECT_EQ(one.report.noise, many.report.noise);
        }
    }
}

TEST(DenoisedNormals, KeepHardEdges) {
    // On a noisy cube, the fit for each side uses only this side, so its normals deviate only by the noise.
    SimpleMesh cube = noisyCube(24, 0.1, Random{3});
    const Outcome hard = bestOf(cube.view(), kAuto, 50), before = bestOf(cube.view(), 0, 50);
    EXPECT_GT(hard.report.noise, 0.05);
    const auto meanError = [&](const std::vector<Vec3>& normals) {
        double sum = 0;
        for (std::size_t c = 0; c < normals.size(); ++c) {
            const Vec3 side = test::kCubeNormals[c / (normals.size() / 6)];
            sum += std::acos(std::clamp(double{dot(side, normals[c])}, -1.0, 1.0));
        }
        return sum / static_cast<double>(normals.size());
    };
    EXPECT_LT(meanError(hard.normals), 0.6 * meanError(before.normals));
}

TEST(DenoisedNormals, TakeAFactorOnTheNoiseThatIsMeasured) {
    const Scan scan = accuracy::scan(shape("torus"), 40, 0.1, Random{4});
    const Outcome automatic = bestOf(scan.view(), kAuto), once = bestOf(scan.view(), 1),
                  thrice = bestOf(scan.view(), 3);
    EXPECT_TRUE(sameBits(automatic.normals, once.normals));  // because the whole deviation is noise
    EXPECT_FLOAT_EQ(thrice.report.noise, 3 * once.report.noise);
    EXPECT_FALSE(sameBits(once.normals, thrice.normals));
    for (const float wrong : {-0.5f, -2.0f, 4.5f, std::numeric_limits<float>::quiet_NaN()}) {
        std::vector<Vec3> out(scan.indices.size());
        const Result<NormalReport> result =
            generateNormals(scan.view(), {.weighting = NormalWeighting::best, .denoise = wrong}, out);
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::invalidOption);
    }
}

TEST(DenoisedNormals, OptionIsIgnoredByOtherWeightings) {
    const Scan scan = accuracy::scan(shape("torus"), 24, 0.1, Random{4});
    const NormalOptions angle{.weighting = NormalWeighting::angle, .denoise = kAuto};
    EXPECT_TRUE(sameBits(normalsOf(scan.view(), angle).normals, normalsOf(scan.view(), {}).normals));
}

TEST(DenoisedNormals, OfAPoseKeepTheirBitsWhereNothingMoves) {
    const Scan scan = accuracy::scan(shape("torus"), 56, 0.1, Random{6});
    std::vector<Vec3> moved = scan.positions;
    for (Vec3& p : moved) {
        if (p.x > 0.3f) p.z += p.x - 0.3f;
    }
    const NormalOptions options{.weighting = NormalWeighting::best, .denoise = kAuto};
    std::vector<Vec3> posed(scan.indices.size());
    const Result<NormalReport> report =
        generatePoseNormals(scan.view(), StridedSpan<const Vec3>(moved), options, posed);
    ASSERT_TRUE(report.ok());
    const Outcome still = bestOf(scan.view(), kAuto);
    EXPECT_EQ(report->noise, still.report.noise);
    std::size_t far = 0;
    for (std::size_t c = 0; c < posed.size(); ++c) {
        if (scan.positions[scan.indices[c]].x > -0.4f) continue;  // others are 18 edges away from moved ones
        EXPECT_EQ(posed[c], still.normals[c]);
        ++far;
    }
    EXPECT_GT(far, 1000u);
    EXPECT_FALSE(sameBits(posed, still.normals));
}

TEST(DenoisedNormals, OfPolygonsAreBetterToo) {
    const Scan scan = accuracy::scan(shape("torus"), 48, 0.1, Random{7});
    SimpleMesh quads;
    quads.positions = scan.positions;
    for (std::size_t c = 0; c < scan.indices.size(); c += 6) {  // two triangles a, b, c and a, c, d form a quad
        const std::uint32_t* v = scan.indices.data() + c;
        quads.addFace({v[0], v[1], v[2], v[5]});
    }
    const auto onTriangles = [&](const std::vector<Vec3>& normals) {
        std::vector<Vec3> corners;
        for (std::size_t f = 0; f < normals.size(); f += 4)
            for (const std::size_t k : {0, 1, 2, 0, 2, 3}) corners.push_back(normals[f + k]);
        return shadedError(scan, corners, 3000, Random{5});
    };
    const double before = onTriangles(bestOf(quads.view(), 0).normals),
                 after = onTriangles(bestOf(quads.view(), kAuto).normals);
    EXPECT_LT(after, 0.45 * before);
}

/// Returns the run time in seconds, and checks that all normals are finite and of unit length.
double timeOf(const SimpleMesh& mesh, float denoise) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(areUnit(bestOf(mesh.view(), denoise).normals));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

SimpleMesh noisyFan(std::uint32_t count, Random random) {
    SimpleMesh fan;
    fan.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * i / count;
        fan.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                                 static_cast<float>(random.around(0.3))});
    }
    for (std::uint32_t i = 0; i < count; ++i) fan.addTriangle(0, 1 + i, 1 + (i + 1) % count);
    return fan;
}

TEST(DenoisedNormals, OfAFanTakeLinearTime) {
    const SimpleMesh small = noisyFan(25'000, Random{8}), large = noisyFan(400'000, Random{8});
    EXPECT_LT(timeOf(large, 1), 60 * timeOf(small, 1) + 1);  // allows for 16 times the triangles on a busy machine
}

TEST(DenoisedNormals, OfBrokenMeshesAreFiniteAndUnit) {
    Scan scan = accuracy::scan(shape("torus"), 24, 0.1, Random{9});
    SimpleMesh mesh;
    mesh.indices = scan.indices;
    const auto check = [&](const char* name) {
        for (const float denoise : {kAuto, 1.0f, 4.0f}) {
            for (const float crease : {180.0f, 30.0f}) {
                EXPECT_TRUE(areUnit(bestOf(mesh.view(), denoise, crease).normals)) << name;
            }
        }
        EXPECT_TRUE(measurePositionNoise(mesh.view()).ok()) << name;
    };
    mesh.positions.assign(scan.positions.size(), Vec3{1, 2, 3});
    check("all at one point");
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
    for (const Vec3& bad : {Vec3{kNan, 0, 0}, Vec3{kInfinite, 0, 0}, Vec3{3e38f, -3e38f, 0}, Vec3{0, 0, 0}}) {
        mesh.positions = scan.positions;
        for (std::size_t v = 0; v < mesh.positions.size(); v += 97) mesh.positions[v] = bad;
        check("some vertices far away");
    }
    for (const float size : {1e-30f, 1e-12f, 1e12f, 1e30f}) {
        mesh.positions = scan.positions;
        for (Vec3& p : mesh.positions) p = size * p;
        check("another size");
    }
    mesh.positions = scan.positions;
    for (Vec3& p : mesh.positions) p.z = 0;
    check("flat and folded");
    for (std::size_t c = 0; c < mesh.indices.size(); ++c)
        mesh.indices[c] = static_cast<std::uint32_t>(c * 7919 % scan.positions.size());
    mesh.positions = scan.positions;
    check("triangles at random");
    mesh.indices.clear();
    check("nothing");
}

TEST(PositionNoise, IsMeasuredOnSmoothShapes) {
    for (const char* name : {"blob", "torus", "rounded box"}) {
        for (const double noise : {0.03, 0.1, 0.3}) {
            const Result<PositionNoise> found =
                measurePositionNoise(accuracy::scan(shape(name), 56, noise, Random{1}).view());
            ASSERT_TRUE(found.ok());
            EXPECT_NEAR(found->sigma, noise, 0.15 * noise) << name;
            EXPECT_GT(found->noise, 0.9 * found->sigma) << name;
        }
        const Result<PositionNoise> clean = measurePositionNoise(accuracy::scan(shape(name), 56, 0, Random{1}).view());
        EXPECT_LT(clean->sigma, 0.01) << name;
        EXPECT_EQ(clean->noise, 0) << name;
    }
}

TEST(PositionNoise, AboveAMinimumEqualsTheFullMeasurement) {
    constexpr double kLeast = 0.03;
    for (const char* name : {"blob", "torus", "rounded box"}) {
        for (const double noise : {0.0, 0.02, 0.035, 0.06, 0.3}) {
            for (const int size : {24, 40, 56}) {
                const Scan scan = accuracy::scan(shape(name), size, noise, Random{3});
                const Result<PositionNoise> sure = measureSureNoise(scan.view(), kLeast, {});
                const Result<PositionNoise> found = measurePositionNoise(scan.view());
                ASSERT_TRUE(sure.ok() && found.ok());
                if (found->noise >= kLeast)
                    EXPECT_EQ(sure->noise, found->noise) << name << ' ' << noise << ' ' << size;
                else
                    EXPECT_LT(sure->noise, kLeast) << name << ' ' << noise << ' ' << size;
            }
        }
    }
}

TEST(PositionNoise, IsRelativeToTheEdgesWithoutNoise) {
    for (const Shape& shape : accuracy::heldOutShapes()) {
        if (shape.is_sharp) continue;
        const double edge = measurePositionNoise(accuracy::scan(shape, 80, 0, Random{1}).view())->mean_edge;
        for (const double noise : {0.03, 0.1, 0.2, 0.3}) {
            const Result<PositionNoise> found =
                measurePositionNoise(accuracy::scan(shape, 80, noise, Random{2}).view());
            ASSERT_TRUE(found.ok());
            EXPECT_NEAR(found->sigma, noise, 0.12 * noise) << shape.name;
            EXPECT_NEAR(found->mean_edge, edge, 0.02 * edge) << shape.name << ' ' << noise;
        }
    }
}

TEST(PositionNoise, DependsNeitherOnSizeNorOnPlaceNorOnOrder) {
    const Scan scan = accuracy::scan(shape("blob"), 40, 0.1, Random{1});
    const float noise = measurePositionNoise(scan.view())->noise;
    Scan other = scan;
    for (Vec3& p : other.positions) p = 1024.0f * p + Vec3{100, 0, -50};
    for (std::size_t i = 0, j = other.indices.size() - 3; i < j; i += 3, j -= 3)
        std::swap_ranges(other.indices.begin() + static_cast<std::ptrdiff_t>(i),
                         other.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                         other.indices.begin() + static_cast<std::ptrdiff_t>(j));
    EXPECT_NEAR(measurePositionNoise(other.view())->noise, noise, 0.05 * noise);
}

}  // namespace
}  // namespace tspace
