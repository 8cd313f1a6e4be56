// SPDX-License-Identifier: MIT
// Accuracy of frames relative to exact ones, on a few small meshes. scripts/accuracy makes the full measurement.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "damage.h"
#include "measure.h"
#include "study.h"

namespace tspace::accuracy {
namespace {

std::vector<const Surface*> allSurfaces() {
    std::vector<const Surface*> all;
    for (const Surface& surface : surfaces()) all.push_back(&surface);
    for (const Surface& surface : heldOutSurfaces()) all.push_back(&surface);
    return all;
}

/// Returns the geometric mean of `errorOf` over irregular meshes of the twelve surfaces.
double meanOver(int cells, const std::function<double(const TestMesh&)>& errorOf) {
    std::vector<double> errors;
    for (const Surface& surface : surfaces()) {
        const auto number = static_cast<std::uint64_t>(errors.size());
        errors.push_back(errorOf(tessellate(surface, Tessellation::irregular, cells, Random{7, number})));
    }
    return geometricMean(errors);
}

double vertexError(Method method, const TestMesh& mesh) {
    return tangentErrors(mesh, framesBy(method, mesh), Corners::inside).mean;
}
double normalError(NormalWeighting weighting, const TestMesh& mesh, Corners corners = Corners::all,
                   std::uint32_t refine = NormalOptions{}.refine) {
    return normalErrors(mesh, normalsBy(weighting, mesh, refine), corners).mean;
}

TEST(Surfaces, HaveTheDerivativesOfDifferences) {
    constexpr double kStep = 1e-5;
    Random random{1};
    for (const Surface* surface : allSurfaces()) {
        for (int i = 0; i < 20; ++i) {
            const double s = 0.05 + 0.9 * random.unit(), t = 0.05 + 0.9 * random.unit();
            const int side = s < surface->fold ? -1 : 1;
            const ExactFrame frame = exactFrame(*surface, s, t, side);
            for (const auto& [ds, dt] : {std::pair{kStep, 0.0}, std::pair{0.0, kStep}}) {
                const ExactFrame after = exactFrame(*surface, s + ds, t + dt, side);
                const ExactFrame before = exactFrame(*surface, s - ds, t - dt, side);
                const DVec3 step = after.position - before.position;
                const DVec3 predicted = (after.u - before.u) * frame.tangent + (after.v - before.v) * frame.bitangent;
                EXPECT_LT(length(step - predicted), 1e-6 * length(step)) << surface->name;
                EXPECT_NEAR(dot(unit(step), frame.normal), 0, 1e-6) << surface->name;
            }
        }
    }
}

TEST(Surfaces, AreRecoveredFromTheirUvs) {
    Random random{2};
    for (const Surface* surface : allSurfaces()) {
        for (int i = 0; i < 20; ++i) {
            const double s = 0.1 + 0.8 * random.unit(), t = 0.1 + 0.8 * random.unit();
            const int side = s < surface->fold ? -1 : 1;
            const ExactFrame frame = exactFrame(*surface, s, t, side);
            double found_s = s + random.around(0.02), found_t = t + random.around(0.02);
            findUv(*surface, frame.u, frame.v, side, found_s, found_t);
            EXPECT_NEAR(found_s, s, 1e-9) << surface->name;
            EXPECT_NEAR(found_t, t, 1e-9) << surface->name;
        }
    }
}

TEST(Tessellations, DependOnlyOnTheSeed) {
    const Surface& surface = surfaces()[0];
    const TestMesh a = tessellate(surface, Tessellation::irregular, 16, Random{1, 2});
    const TestMesh b = tessellate(surface, Tessellation::irregular, 16, Random{1, 2});
    const TestMesh c = tessellate(surface, Tessellation::irregular, 16, Random{2, 2});
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_NE(a.positions, c.positions);
}

TEST(Tessellations, FlipNoTriangleAndSeparateTheSidesOfAFold) {
    using enum Tessellation;
    for (const Surface* surface : allSurfaces()) {
        for (const Tessellation kind : {regular, alternating, irregular, random, anisotropic, loops}) {
            const TestMesh mesh = tessellate(*surface, kind, 32, Random{3});
            for (std::size_t i = 0; i < mesh.triangleCount(); ++i) {
                const std::uint32_t a = mesh.indices[3 * i], b = mesh.indices[3 * i + 1], c = mesh.indices[3 * i + 2];
                const double turn = (mesh.s[b] - mesh.s[a]) * (mesh.t[c] - mesh.t[a]) -
                                    (mesh.t[b] - mesh.t[a]) * (mesh.s[c] - mesh.s[a]);
                ASSERT_GT(turn, 0) << surface->name << " " << nameOf(kind);
                ASSERT_EQ(mesh.sides[a], mesh.sides[b]);
                ASSERT_EQ(mesh.sides[a], mesh.sides[c]);
            }
        }
    }
}

/// Returns a point of a plane whose texture is uniformly rotated, stretched and sheared.
SurfacePoint affine(const Dual& s, const Dual& t, int) {
    return {{s, 2 * t, 0.5 * s - t}, {0.3 * s + 1.1 * t + 0.2, 0.4 * t - 0.9 * s}};
}

TEST(EveryMethod, IsExactOnAnAffineMap) {
    const Surface plane{.name = "affine", .at = affine};
    const TestMesh mesh = tessellate(plane, Tessellation::irregular, 16, Random{4});
    const Shading shading(mesh, 500, Random{5});
    for (const NamedMethod& method : methods()) {
        const Frames frames = framesBy(method.method, mesh);
        EXPECT_LT(tangentErrors(mesh, frames, Corners::all).max, 1e-3) << method.name;
        EXPECT_LT(shading.meanError(frames), 1e-4) << method.name;
    }
}

TEST(Mikktspace, ConvergesWithTheFirstOrderOnIrregularMeshes) {
    const auto errorOf = [](const TestMesh& mesh) { return vertexError(Method::mikktspace, mesh); };
    const double coarse = meanOver(16, errorOf), fine = meanOver(64, errorOf);
    EXPECT_GT(std::log2(coarse / fine) / 2, 1.0);
    EXPECT_LT(std::log2(coarse / fine) / 2, 1.3);
}

TEST(Mikktspace, HasTheKnownErrors) {
    EXPECT_NEAR(meanOver(32, [](const TestMesh& mesh) { return vertexError(Method::mikktspace, mesh); }), 0.18, 0.02);
    EXPECT_NEAR(meanOver(32, [](const TestMesh& mesh) { return vertexError(Method::area, mesh); }), 0.38, 0.04);
}

TEST(ExactVertexFrames, HaveAnErrorWhereTheyAreInterpolated) {
    const double floor = meanOver(32, [](const TestMesh& mesh) {
        EXPECT_LT(tangentErrors(mesh, exactFrames(mesh), Corners::all).max, 1e-4);
        return Shading(mesh, 1000, Random{6}).meanError(exactFrames(mesh));
    });
    EXPECT_NEAR(floor, 0.04, 0.005);
}

TEST(BestTangents, AreSeveralTimesCloserThanMikktspaceOnSmoothSurfaces) {
    const auto errorOf = [](Method method) {
        return meanOver(32, [=](const TestMesh& mesh) { return vertexError(method, mesh); });
    };
    const double mikktspace = errorOf(Method::mikktspace);
    EXPECT_LT(3.5 * errorOf(Method::best), mikktspace);
    EXPECT_LT(1.3 * errorOf(Method::fast), mikktspace);
}

// If a vertex has only four neighbors, they do not determine a quadratic map. Such vertices must not reduce the order
// of convergence.
TEST(BestTangents, ConvergeNearlyWithTheSecondOrderOnIrregularMeshes) {
    for (const bool held_out : {false, true}) {
        std::vector<double> coarse, fine;
        for (const Surface& surface : held_out ? heldOutSurfaces() : surfaces()) {
            for (const Tessellation kind : {Tessellation::irregular, Tessellation::random}) {
                const Random random{7, coarse.size()};
                coarse.push_back(vertexError(Method::best, tessellate(surface, kind, 32, random)));
                fine.push_back(vertexError(Method::best, tessellate(surface, kind, 128, random)));
            }
        }
        EXPECT_GT(std::log2(geometricMean(coarse) / geometricMean(fine)) / 2, held_out ? 1.85 : 1.72);
    }
}

TEST(BestTangents, AreCloserThanMikktspaceOnBevels) {
    double best = 0, fast = 0, mikktspace = 0;
    for (const Bevel& bevel : bevels()) {
        const TestMesh mesh = bevelMesh(bevel, Random{12});
        const auto errorOf = [&](Method method) {
            return tangentErrors(mesh, framesBy(method, mesh), Corners::measured).mean;
        };
        best += errorOf(Method::best);
        fast += errorOf(Method::fast);
        mikktspace += errorOf(Method::mikktspace);
    }
    EXPECT_LT(10 * best, mikktspace);
    EXPECT_LT(5 * fast, mikktspace);
}

TEST(BestNormals, AreSeveralTimesCloserThanAnyMeanOnSmoothSurfaces) {
    const auto errorOf = [](NormalWeighting weighting) {
        std::vector<double> errors;
        for (const Surface* surface : allSurfaces()) {
            if (surface->is_flat) continue;
            const TestMesh mesh = tessellate(*surface, Tessellation::irregular, 32, Random{8});
            errors.push_back(normalError(weighting, mesh));
        }
        return geometricMean(errors);
    };
    const double best = errorOf(NormalWeighting::best);
    EXPECT_LT(4 * best, errorOf(NormalWeighting::angleArea));
    EXPECT_LT(3 * best, errorOf(NormalWeighting::angle));
    EXPECT_LT(1.3 * best, errorOf(NormalWeighting::max));
}

TEST(BestTangents, LoseAFifthOfTheShadingErrorInTheFirstStepAndMoreInTheSecond) {
    for (const int cells : {8, 32}) {
        double errors[3];
        for (std::uint32_t refine = 0; refine < 3; ++refine) {
            errors[refine] = meanOver(cells, [&](const TestMesh& mesh) {
                return Shading(mesh, 2000, Random{3}).meanError(framesBy(Method::best, mesh, refine));
            });
        }
        EXPECT_LT(errors[1], (cells == 8 ? 0.92 : 0.85) * errors[0]);
        EXPECT_LT(errors[2], errors[1]);
    }
}

TEST(BestTangents, RefinementHardlyIncreasesTheErrorOnNoisyMeshes) {
    for (const Damage kind : {Damage::position_noise, Damage::uv_noise}) {
        const auto errorBy = [&](std::uint32_t refine) {
            return meanOver(32, [&](TestMesh mesh) {
                damage(mesh, kind, 0.1, Random{10});
                return tangentErrors(mesh, framesBy(Method::best, mesh, refine), Corners::inside).mean;
            });
        };
        EXPECT_LT(errorBy(1), 1.02 * errorBy(0));
    }
}

/// Returns the errors of `best` normals with 0, 1 and 2 refinement steps: geometric means over all curved surfaces.
std::array<double, 3> errorsBySteps(Tessellation tessellation, int cells, double noise) {
    std::array<double, 3> means{};
    for (std::uint32_t refine = 0; refine < 3; ++refine) {
        std::vector<double> errors;
        for (const Surface* surface : allSurfaces()) {
            if (surface->is_flat) continue;
            TestMesh mesh = tessellate(*surface, tessellation, cells, Random{8});
            if (noise > 0) damage(mesh, Damage::position_noise, noise, Random{10});
            errors.push_back(normalError(NormalWeighting::best, mesh, Corners::all, refine));
        }
        means[refine] = geometricMean(errors);
    }
    return means;
}

TEST(BestNormals, LoseAThirdOfTheErrorInTheFirstStepAndMoreInTheSecond) {
    for (const Tessellation tessellation : {Tessellation::irregular, Tessellation::loops}) {
        const auto [fit, one, two] = errorsBySteps(tessellation, 32, 0);
        EXPECT_LT(one, 0.67 * fit);
        EXPECT_LT(two, 0.95 * one);
    }
    const auto [fit, one, two] = errorsBySteps(Tessellation::irregular, 8, 0);
    EXPECT_LT(one, 0.8 * fit);
    EXPECT_LT(two, one);
}

TEST(BestNormals, RefinementHardlyIncreasesTheErrorOnNoisyMeshes) {
    for (const double noise : {0.02, 0.1, 0.2}) {
        const auto [fit, one, two] = errorsBySteps(Tessellation::irregular, 32, noise);
        EXPECT_LT(one, 1.01 * fit) << noise;
        EXPECT_LT(two, 1.02 * fit) << noise;
    }
}

TEST(BestNormals, AreNoWorseThanAngleTimesAreaUnderNoise) {
    for (const double share : {0.02, 0.05, 0.1, 0.2}) {
        std::vector<double> best, angle_area;
        for (const Surface* surface : allSurfaces()) {
            TestMesh mesh = tessellate(*surface, Tessellation::irregular, 32, Random{9});
            damage(mesh, Damage::position_noise, share, Random{10});
            best.push_back(normalError(NormalWeighting::best, mesh));
            angle_area.push_back(normalError(NormalWeighting::angleArea, mesh));
        }
        EXPECT_LT(geometricMean(best), 1.03 * geometricMean(angle_area)) << share;
    }
}

TEST(BestNormals, AreNoWorseThanAngleTimesAreaOnBevels) {
    double best = 0, fit = 0, angle_area = 0, max = 0;
    for (const Bevel& bevel : bevels()) {
        const TestMesh mesh = bevelMesh(bevel, Random{11});
        best += normalError(NormalWeighting::best, mesh, Corners::measured);
        fit += normalError(NormalWeighting::best, mesh, Corners::measured, 0);
        angle_area += normalError(NormalWeighting::angleArea, mesh, Corners::measured);
        max += normalError(NormalWeighting::max, mesh, Corners::measured);
    }
    EXPECT_LT(best, 1.03 * angle_area);
    EXPECT_LT(best, 1.01 * fit);
    EXPECT_GT(max, 10 * angle_area);  // shows that these meshes cause large errors
}

}  // namespace
}  // namespace tspace::accuracy
