// SPDX-License-Identifier: MIT
// NormalWeighting::best where its result is known: planes, boxes, bevels, hard edges, noise. tests/core/accuracy tests
// its accuracy on curved surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "support/simple_mesh.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

using test::SimpleMesh;

std::vector<Vec3> normalsOf(const MeshView& mesh, const NormalOptions& options) {
    std::vector<Vec3> out(mesh.cornerCount());
    EXPECT_TRUE(generateNormals(mesh, options, out).ok());
    return out;
}
std::vector<Vec3> bestOf(const MeshView& mesh) { return normalsOf(mesh, {.weighting = NormalWeighting::best}); }

double angleDeg(const Vec3& a, const Vec3& b) {
    const double x = double{a.y} * b.z - double{a.z} * b.y, y = double{a.z} * b.x - double{a.x} * b.z;
    const double z = double{a.x} * b.y - double{a.y} * b.x;
    const double product = double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
    return 57.29577951 * std::atan2(std::sqrt(x * x + y * y + z * z), product);
}

/// Returns a grid over [0, 1]^2 with the given x and y of its lines, and with a height for every point.
template <class HeightAt>
SimpleMesh grid(const std::vector<float>& lines, HeightAt heightAt) {
    SimpleMesh mesh;
    const auto count = static_cast<std::uint32_t>(lines.size());
    for (const float y : lines) {
        for (const float x : lines) mesh.positions.push_back({x, y, heightAt(x, y)});
    }
    for (std::uint32_t row = 0; row + 1 < count; ++row) {
        for (std::uint32_t column = 0; column + 1 < count; ++column) {
            const std::uint32_t a = row * count + column, b = a + count;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
    return mesh;
}

TEST(BestNormals, OfAPlaneAreThePlanesAlsoAtItsBorder) {
    const SimpleMesh plane = grid({0, 0.1f, 0.15f, 0.9f, 1}, [](float x, float y) { return 0.5f * x - 0.25f * y; });
    const double size = std::sqrt(1 + 0.25 + 0.0625);
    const Vec3 normal{static_cast<float>(-0.5 / size), static_cast<float>(0.25 / size), static_cast<float>(1 / size)};
    for (const Vec3& n : bestOf(plane.view())) EXPECT_LT(angleDeg(n, normal), 1e-4);
}

TEST(BestNormals, OfAGradedParabolaAreCloserThanThoseOfSimpleMeans) {
    const std::vector<float> lines{0, 0.02f, 0.1f, 0.13f, 0.3f, 0.35f, 0.5f, 0.52f, 0.6f, 0.75f, 0.8f, 1};
    const SimpleMesh mesh = grid(lines, [](float x, float y) { return 0.4f * x * x - 0.3f * x * y + 0.2f * y * y; });
    const auto errorOf = [&](NormalWeighting weighting) {
        const std::vector<Vec3> normals = normalsOf(mesh.view(), {.weighting = weighting});
        double sum = 0;
        for (std::size_t c = 0; c < normals.size(); ++c) {
            const Vec3& p = mesh.positions[mesh.indices[c]];
            const bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1;
            if (inside) sum += angleDeg(normals[c], {-0.8f * p.x + 0.3f * p.y, 0.3f * p.x - 0.4f * p.y, 1});
        }
        return sum;
    };
    const double best = errorOf(NormalWeighting::best);
    for (const auto weighting :
         {NormalWeighting::uniform, NormalWeighting::area, NormalWeighting::angle, NormalWeighting::angleArea}) {
        EXPECT_GT(errorOf(weighting), 3 * best);
    }
}

TEST(BestNormals, KeepTheFaceBesideANarrowBevelFlat) {
    // The rounded border is 0.02 wide and slopes by 45 degrees.
    const SimpleMesh mesh = grid({0, 0.02f, 0.98f, 1}, [](float x, float y) {
        const float past = std::max({0.02f - x, x - 0.98f, 0.02f - y, y - 0.98f, 0.0f});
        return -past;
    });
    const std::vector<Vec3> best = bestOf(mesh.view());
    const std::vector<Vec3> max = normalsOf(mesh.view(), {.weighting = NormalWeighting::max});
    for (std::size_t c = 0; c < best.size(); ++c) {
        if (mesh.positions[mesh.indices[c]].z != 0) continue;
        EXPECT_LT(angleDeg(best[c], {0, 0, 1}), 2);
        EXPECT_GT(angleDeg(max[c], {0, 0, 1}), 15);
    }
}

/// Returns a closed cylinder of radius 1 and height 2 with rounded rims. Each cap is a fan from one vertex of its rim,
/// as CAD kernels write it; the triangles of the upper cap come first.
SimpleMesh roundedCylinder(std::uint32_t sides, std::uint32_t segments, double fillet) {
    constexpr double kQuarter = 1.5707963267948966;
    SimpleMesh mesh;
    const std::uint32_t rings = 2 * (segments + 1), last = sides * (rings - 1);
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        const bool is_upper = ring <= segments;
        const double turn = kQuarter * (is_upper ? ring : rings - 1 - ring) / segments;
        const double radius = 1 - fillet + fillet * std::sin(turn), height = 1 - fillet + fillet * std::cos(turn);
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double around = 4 * kQuarter * i / sides;
            mesh.positions.push_back({static_cast<float>(radius * std::cos(around)),
                                      static_cast<float>(radius * std::sin(around)),
                                      static_cast<float>(is_upper ? height : -height)});
        }
    }
    for (std::uint32_t i = 1; i + 1 < sides; ++i) mesh.indices.insert(mesh.indices.end(), {0, i, i + 1});
    for (std::uint32_t i = 1; i + 1 < sides; ++i)
        mesh.indices.insert(mesh.indices.end(), {last, last + i + 1, last + i});
    for (std::uint32_t a = 0; a < last; a += sides) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t next = (i + 1) % sides, below = a + sides;
            mesh.indices.insert(mesh.indices.end(), {a + i, below + i, below + next, a + i, below + next, a + next});
        }
    }
    return mesh;
}

/// Returns the mean angle, in degrees, between +z and the interpolated normals, over the area of the first `count`
/// triangles.
double shadedErrorOfFlatTriangles(const SimpleMesh& mesh, std::size_t count, const std::vector<Vec3>& normals) {
    constexpr int kCells = 6;
    double sum = 0, areas = 0;
    for (std::size_t t = 0; t < count; ++t) {
        const Vec3 a = mesh.positions[mesh.indices[3 * t]], b = mesh.positions[mesh.indices[3 * t + 1]],
                   c = mesh.positions[mesh.indices[3 * t + 2]];
        const double area =
            std::abs((double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x));
        for (int i = 0; i < kCells; ++i) {
            for (int j = 0; i + j < kCells; ++j) {
                const auto v = static_cast<float>((i + 1 / 3.0) / kCells),
                           w = static_cast<float>((j + 1 / 3.0) / kCells);
                const Vec3 &l = normals[3 * t], &m = normals[3 * t + 1], &n = normals[3 * t + 2];
                const float u = 1 - v - w;
                sum += area *
                       angleDeg({u * l.x + v * m.x + w * n.x, u * l.y + v * m.y + w * n.y, u * l.z + v * m.z + w * n.z},
                                {0, 0, 1});
                areas += area;
            }
        }
    }
    return sum / areas;
}

TEST(BestNormals, KeepAFlatCapThatIsAFanFromItsRimAsFlatAsAngleTimesAreaBesideAFillet) {
    for (const double fillet : {0.05, 0.1, 0.16}) {
        for (const std::uint32_t sides : {8u, 12u, 16u, 24u, 48u}) {
            for (std::uint32_t segments = 2; segments <= 5; ++segments) {
                const SimpleMesh mesh = roundedCylinder(sides, segments, fillet);
                const auto errorOf = [&](NormalWeighting weighting, std::uint32_t refine) {
                    return shadedErrorOfFlatTriangles(
                        mesh, sides - 2, normalsOf(mesh.view(), {.weighting = weighting, .refine = refine}));
                };
                for (std::uint32_t refine = 0; refine <= 2; ++refine) {
                    EXPECT_LT(errorOf(NormalWeighting::best, refine), 1.1 * errorOf(NormalWeighting::angleArea, 0))
                        << fillet << ' ' << sides << ' ' << segments << ' ' << refine;
                }
            }
        }
    }
}

TEST(BestNormals, OfACubeAreNearlyTheDiagonalsForAnyTriangulation) {
    for (unsigned diagonals = 0; diagonals < 64; ++diagonals) {
        const SimpleMesh cube = test::triangleCube(diagonals);
        const std::vector<Vec3> normals = bestOf(cube.view());
        for (std::size_t c = 0; c < normals.size(); ++c)
            EXPECT_LT(angleDeg(normals[c], cube.positions[cube.indices[c]]), 1);
    }
}

TEST(BestNormals, DoNotCrossHardEdges) {
    SimpleMesh cube = test::quadCube();
    const std::vector<Vec3> creased =
        normalsOf(cube.view(), {.weighting = NormalWeighting::best, .crease_angle_deg = 60});
    for (std::size_t c = 0; c < creased.size(); ++c) EXPECT_LT(angleDeg(creased[c], test::kCubeNormals[c / 4]), 1e-4);

    const std::vector<std::uint32_t> groups{1, 2, 4, 8, 16, 32};
    const std::vector<Vec3> grouped =
        normalsOf(cube.view(), {.weighting = NormalWeighting::best, .smoothing_groups = groups});
    for (std::size_t c = 0; c < grouped.size(); ++c) EXPECT_LT(angleDeg(grouped[c], test::kCubeNormals[c / 4]), 1e-4);
}

TEST(BestNormals, FlipWithTheWindingAndDoNotDependOnScale) {
    SimpleMesh mesh = grid({0, 0.2f, 0.3f, 0.7f, 1}, [](float x, float y) { return x * y; });
    const std::vector<Vec3> normals = bestOf(mesh.view());
    Convention clockwise;
    clockwise.winding = Winding::clockwise;
    const std::vector<Vec3> turned =
        normalsOf(mesh.view(), {.weighting = NormalWeighting::best, .convention = clockwise});
    for (Vec3& p : mesh.positions) p = {1024 * p.x, 1024 * p.y, 1024 * p.z};
    const std::vector<Vec3> grown = bestOf(mesh.view());
    for (std::size_t c = 0; c < normals.size(); ++c) {
        EXPECT_LT(angleDeg(turned[c], {-normals[c].x, -normals[c].y, -normals[c].z}), 1e-4);
        EXPECT_EQ(grown[c], normals[c]);
    }
}

TEST(BestNormals, DoNotDependOnUnusedVertices) {
    SimpleMesh mesh = grid({0, 0.1f, 0.15f, 0.9f, 1}, [](float x, float y) { return x * x - 0.5f * y * y; });
    for (Vec3& p : mesh.positions) p = {std::ldexp(p.x, -60), std::ldexp(p.y, -60), std::ldexp(p.z, -60)};
    const std::vector<Vec3> want = bestOf(mesh.view());
    mesh.positions.insert(mesh.positions.end(), 3 * mesh.positions.size(), Vec3{std::ldexp(1.0f, 60), 0, 1});
    const std::vector<Vec3> got = bestOf(mesh.view());
    ASSERT_EQ(want.size(), got.size());
    EXPECT_EQ(std::memcmp(want.data(), got.data(), want.size() * sizeof(Vec3)), 0);
}

TEST(BestNormals, FollowNoiseNoMoreThanAngleTimesAreaDoes) {
    std::vector<float> lines;
    for (int i = 0; i <= 40; ++i) lines.push_back(static_cast<float>(i) / 40);
    std::mt19937 random(3);
    const auto noise = [&] { return 0.004f * (static_cast<float>(random() % 2001) / 1000 - 1); };
    const SimpleMesh mesh = grid(lines, [&](float, float) { return noise(); });
    const auto meanOf = [&](NormalWeighting weighting) {
        double sum = 0;
        for (const Vec3& n : normalsOf(mesh.view(), {.weighting = weighting})) sum += angleDeg(n, {0, 0, 1});
        return sum;
    };
    EXPECT_LT(meanOf(NormalWeighting::best), 1.03 * meanOf(NormalWeighting::angleArea));
}

}  // namespace
}  // namespace tspace
