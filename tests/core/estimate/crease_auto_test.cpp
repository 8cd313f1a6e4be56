// SPDX-License-Identifier: MIT
// NormalOptions::crease_auto: the edges that become hard, and the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "core/base/vec_math.h"
#include "core/estimate/pose_normals.h"
#include "core/normals/normals_outcome.h"
#include "scans.h"
#include "support/simple_mesh.h"
#include "support/thread_team.h"
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

constexpr float kAuto = NormalOptions::crease_auto;

Outcome bestOf(const MeshView& mesh, float crease_deg, float denoise = 0, const Execution& execution = {}) {
    return normalsOf(mesh, {.weighting = NormalWeighting::best, .crease_angle_deg = crease_deg, .denoise = denoise},
                     execution);
}
/// Returns a tube with a flat end cap. Dihedral angles: 90 degrees at the rim, 360 / `sides` between side faces.
SimpleMesh tube(std::uint32_t sides) {
    SimpleMesh mesh;
    for (std::uint32_t row = 0; row <= 8; ++row) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double angle = 6.283185307179586 * side / sides;
            mesh.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                                      0.25f * static_cast<float>(row)});
        }
    }
    for (std::uint32_t row = 0; row < 8; ++row) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t a = row * sides + side, b = row * sides + (side + 1) % sides;
            mesh.addTriangle(a, b, b + sides);
            mesh.addTriangle(a, b + sides, a + sides);
        }
    }
    for (std::uint32_t side = 1; side + 1 < sides; ++side)
        mesh.addTriangle(8 * sides, 8 * sides + side, 8 * sides + side + 1);
    return mesh;
}

TEST(AutomaticCreases, AreTheRimOfATubeAndNotItsSides) {
    for (const std::uint32_t sides : {24u, 48u, 96u}) {
        const SimpleMesh mesh = tube(sides);
        const Outcome found = bestOf(mesh.view(), kAuto), wanted = bestOf(mesh.view(), 60);
        EXPECT_TRUE(sameBits(found.normals, wanted.normals)) << sides;
        EXPECT_GT(found.report.crease_angle_deg, 360.0f / static_cast<float>(sides)) << sides;
        EXPECT_LT(found.report.crease_angle_deg, 90) << sides;
        EXPECT_EQ(wanted.report.crease_angle_deg, 60);
    }
}

TEST(AutomaticCreases, OfACubeAreItsEdges) {
    for (const SimpleMesh& cube : {test::quadCube(), test::triangleCube(0b101101)})
        EXPECT_TRUE(sameBits(bestOf(cube.view(), kAuto).normals, bestOf(cube.view(), 60).normals));
}

TEST(AutomaticCreases, AreNoneOnSmoothShapes) {
    for (const char* name : {"blob", "torus", "rounded box"}) {
        for (const double noise : {0.0, 0.03, 0.1}) {
            const Scan scan = accuracy::scan(shape(name), 48, noise, Random{1});
            const double by_mesh = shadedError(scan, bestOf(scan.view(), kAuto).normals, 2000, Random{5});
            const double without = shadedError(scan, bestOf(scan.view(), 180).normals, 2000, Random{5});
            EXPECT_LT(by_mesh, 1.03 * without) << name << ' ' << noise;
        }
    }
}

/// The edges of these shapes have angles of 40 degrees and more, but the distribution of angles is continuous, without
/// the gap that hard edges cause.
TEST(AutomaticCreases, AreNoneOnSmoothShapesDecimatedToSomeHundredTriangles) {
    for (const std::span<const Shape> all : {accuracy::shapes(), accuracy::heldOutShapes()}) {
        for (const Shape& shape : all) {
            if (shape.is_sharp) continue;
            const Scan net = accuracy::surfaceNets(shape, 64, 0, Random{1});
            for (const double share : {0.03, 0.01}) {
                const Scan scan = decimated(net, share);
                if (scan.indices.empty()) GTEST_SKIP() << "without meshoptimizer";
                const double by_mesh = shadedError(scan, bestOf(scan.view(), kAuto).normals, 2000, Random{5});
                const double without = shadedError(scan, bestOf(scan.view(), 180).normals, 2000, Random{5});
                EXPECT_LT(by_mesh, 1.15 * without) << shape.name << ' ' << share;
            }
        }
    }
}

/// These parts have flat regions, so their edges are detected.
TEST(AutomaticCreases, AreDetectedOnPartsDecimatedToSomeHundredTriangles) {
    for (const std::span<const Shape> all : {accuracy::shapes(), accuracy::heldOutShapes()}) {
        for (const Shape& shape : all) {
            if (!shape.is_sharp) continue;
            const Scan scan = decimated(accuracy::surfaceNets(shape, 64, 0, Random{1}), 0.01);
            if (scan.indices.empty()) GTEST_SKIP() << "without meshoptimizer";
            const Outcome found = bestOf(scan.view(), kAuto);
            EXPECT_LE(found.report.crease_angle_deg, 30) << shape.name;
        }
    }
}

/// Returns the shading error of `normals`, relative to the smallest error of four weightings with three crease angles
/// each.
double partOfExisting(const Scan& scan, const std::vector<Vec3>& normals) {
    using enum NormalWeighting;
    double least = 180;
    for (const NormalWeighting weighting : {area, angle, angleArea, best}) {
        for (const float crease : {30.0f, 45.0f, 180.0f}) {
            const Outcome other = normalsOf(scan.view(), {.weighting = weighting, .crease_angle_deg = crease});
            least = std::min(least, shadedError(scan, other.normals, 3000, Random{5}));
        }
    }
    return shadedError(scan, normals, 3000, Random{5}) / least;
}

TEST(AutomaticCreases, LeaveNoNoiseOnAPartWithEdges) {
    const Scan scan = accuracy::scan(shape("part"), 72, 0.1, Random{1});
    const Outcome found = bestOf(scan.view(), kAuto, NormalOptions::denoise_auto);
    EXPECT_NEAR(found.report.noise, 0.1, 0.02);
    EXPECT_LT(partOfExisting(scan, found.normals), 0.85);
}

TEST(AutomaticCreases, HaveTheSameBitsForAnyNumberOfThreads) {
    const Scan scan = accuracy::scan(shape("part"), 40, 0.1, Random{2});
    const Outcome one = bestOf(scan.view(), kAuto, NormalOptions::denoise_auto);
    for (const unsigned threads : {2u, 4u, 7u}) {
        const Outcome many =
            bestOf(scan.view(), kAuto, NormalOptions::denoise_auto, {.executor = test::threadTeam(threads)});
        EXPECT_TRUE(sameBits(one.normals, many.normals)) << threads;
        EXPECT_EQ(one.report.crease_angle_deg, many.report.crease_angle_deg);
    }
}

TEST(AutomaticCreases, HaveTheSameBitsNextToAPolygon) {
    // Next to a polygon, noise is smoothed face by face instead of four triangles at a time.
    for (const double noise : {0.025, 0.05, 0.1}) {
        Scan scan = accuracy::scan(shape("part"), 24, noise, Random{7});
        for (int left = 0; left < 4; ++left) {  // fewer triangles each time: 0 to 3 remain after groups of four
            std::vector<std::uint32_t> sizes(scan.indices.size() / 3, 3), indices = scan.indices;
            MeshView triangles = scan.view();
            triangles.face_sizes = sizes;
            const Outcome fours = bestOf(triangles, kAuto);
            sizes.push_back(1);
            indices.push_back(0);
            MeshView mixed{.positions = scan.positions, .indices = {indices}};
            mixed.face_sizes = sizes;
            Outcome singles = bestOf(mixed, kAuto);
            singles.normals.pop_back();
            EXPECT_LT(fours.report.crease_angle_deg, 180);
            EXPECT_EQ(fours.report.crease_angle_deg, singles.report.crease_angle_deg);
            EXPECT_TRUE(sameBits(fours.normals, singles.normals)) << noise << ", " << left;
            scan.indices.resize(scan.indices.size() - 3);
        }
    }
}

TEST(AutomaticCreases, WorkWithEveryWeightingAndWithGroups) {
    const SimpleMesh mesh = tube(48);
    for (const NormalWeighting weighting :
         {NormalWeighting::uniform, NormalWeighting::area, NormalWeighting::angle, NormalWeighting::max}) {
        EXPECT_TRUE(sameBits(normalsOf(mesh.view(), {.weighting = weighting, .crease_angle_deg = kAuto}).normals,
                             normalsOf(mesh.view(), {.weighting = weighting, .crease_angle_deg = 60}).normals));
    }
    std::vector<std::uint32_t> groups(mesh.indices.size() / 3);
    for (std::size_t f = 0; f < groups.size(); ++f) groups[f] = 1 + static_cast<std::uint32_t>(f / 200 % 2);
    EXPECT_TRUE(sameBits(normalsOf(mesh.view(), {.crease_angle_deg = kAuto, .smoothing_groups = groups}).normals,
                         normalsOf(mesh.view(), {.crease_angle_deg = 60, .smoothing_groups = groups}).normals));
}

TEST(AutomaticCreases, AreThoseOfTheMeshInEveryPose) {
    const SimpleMesh mesh = tube(24);
    std::vector<Vec3> flat = mesh.positions;
    for (Vec3& p : flat) p.z *= 0.01f;
    std::vector<Vec3> by_mesh(mesh.indices.size()), by_angle(mesh.indices.size());
    const auto pose = [&](float crease, std::vector<Vec3>& out) {
        const NormalOptions options{.crease_angle_deg = crease};
        EXPECT_TRUE(generatePoseNormals(mesh.view(), StridedSpan<const Vec3>(flat), options, out).ok());
    };
    pose(kAuto, by_mesh);
    pose(60, by_angle);
    EXPECT_TRUE(sameBits(by_mesh, by_angle));
}

TEST(AutomaticCreases, OfBrokenMeshesGiveUnitNormals) {
    SimpleMesh mesh = tube(24);
    const auto check = [&](const char* name) {
        const Outcome found = bestOf(mesh.view(), kAuto, 1);
        EXPECT_TRUE(std::all_of(found.normals.begin(), found.normals.end(), [](const Vec3& n) {
            return std::fabs(length(n) - 1) < 1e-5f;
        })) << name;
    };
    const SimpleMesh sound = mesh;
    for (const Vec3& bad : {Vec3{std::numeric_limits<float>::quiet_NaN(), 0, 0},
                            Vec3{std::numeric_limits<float>::infinity(), 0, 0}, Vec3{3e38f, -3e38f, 0}, Vec3{}}) {
        for (std::size_t v = 0; v < mesh.positions.size(); v += 13) mesh.positions[v] = bad;
        check("some vertices");
    }
    mesh.positions.assign(mesh.positions.size(), Vec3{1, 2, 3});
    check("one point");
    mesh = sound;
    for (std::size_t c = 0; c < mesh.indices.size(); ++c)
        mesh.indices[c] = static_cast<std::uint32_t>(c * 7919 % mesh.positions.size());
    check("triangles at random");
    for (std::size_t c = 0; c < mesh.indices.size(); c += 3) mesh.indices[c] = 0, mesh.indices[c + 1] = 1;
    check("a book");
    mesh.indices.clear();
    check("nothing");
}

}  // namespace
}  // namespace tspace
