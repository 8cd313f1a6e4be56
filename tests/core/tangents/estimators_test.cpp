// SPDX-License-Identifier: MIT
// Properties of the methods `fast` and `best`: their formulas, cases where they are exact, convergence of the error,
// and finite results for any input.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/recovery_oracle.h"
#include "core/tangents/shapes.h"
#include "core/tangents/smooth_patch.h"
#include "support/shared_data.h"
#include "tspace/tangents.h"

namespace tspace::test {
namespace {

constexpr std::array kEstimated{Method::fast, Method::best};

Outputs generate(const SimpleMesh& shape, Method method, std::uint32_t refine = 1) {
    Outputs outputs(shape.cornerCount());
    const auto report = generateTangents(
        shape.view(), {.method = method, .convention = conventions::opengl, .refine = refine}, outputs.view());
    EXPECT_TRUE(report);
    if (report) outputs.report = *report;
    return outputs;
}

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Returns the angle in degrees between a unit vector and the exact direction.
double errorDeg(const Vec3& got, const Vec3& want) {
    return 2 * std::asin(std::min(1.0, distance(got, want) / 2)) * 180 / std::numbers::pi;
}

/// Returns the mean error of the tangents at corners whose vertex is not at the border.
double meanError(const SmoothPatch& patch, Method method, std::uint32_t refine = 1) {
    const Outputs got = generate(patch.shape, method, refine);
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < patch.shape.cornerCount(); ++c) {
        const std::uint32_t v = patch.shape.indices[c];
        if (!patch.inside[v]) continue;
        sum += errorDeg(xyz(got.tangents[c]), patch.tangents[v]);
        count += 1;
    }
    return sum / count;
}

TEST(Estimators, AreTheFormulasOfTheirPages) {
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        const SimpleMesh shape = bumpyRing(5 + seed % 3, seed);
        for (const Method method : kEstimated) {
            const Outputs got = generate(shape, method, 0);
            const ExpectedFrame want = method == Method::fast ? twoWeightsAtFirst(shape) : recoveryAtFirst(shape);
            EXPECT_LT(distance(xyz(got.tangents[0]), want.tangent), 2e-4) << "seed " << seed;
            EXPECT_LT(distance(got.bitangents[0], want.bitangent), 2e-4) << "seed " << seed;
            EXPECT_NEAR(got.magnitudes_s[0] / want.length_s, 1, 2e-3) << "seed " << seed;
            EXPECT_NEAR(got.magnitudes_t[0] / want.length_t, 1, 2e-3) << "seed " << seed;
        }
    }
}

TEST(Estimators, AreExactWhereUvsAreLinearOnAPlane) {
    SimpleMesh shape = grid(6);
    const float a = 0.7f, b = 0.3f, c = -0.2f, d = 0.5f;  // dP/du = (a, b), dP/dv = (c, d)
    for (std::size_t v = 0; v < shape.positions.size(); ++v) {
        const Vec2 uv{shape.uvs[v].x + 0.05f * static_cast<float>(v % 3), shape.uvs[v].y};
        shape.uvs[v] = uv;
        shape.positions[v] = {a * uv.x + c * uv.y, b * uv.x + d * uv.y, 2};
    }
    const double s = std::hypot(a, b), t = std::hypot(c, d);
    for (const Method method : kEstimated) {
        const Outputs got = generate(shape, method);
        for (std::size_t i = 0; i < got.tangents.size(); ++i) {
            EXPECT_LT(distance(xyz(got.tangents[i]), Vec3{float(a / s), float(b / s), 0}), 1e-5);
            EXPECT_LT(distance(got.bitangents[i], Vec3{float(c / t), float(d / t), 0}), 1e-5);
            EXPECT_NEAR(got.magnitudes_s[i], s, 1e-4);
            EXPECT_NEAR(got.magnitudes_t[i], t, 1e-4);
            EXPECT_EQ(got.tangents[i].w, 1.0f);
        }
    }
}

TEST(Estimators, OneTriangleHasItsOwnDerivatives) {
    SimpleMesh shape;
    shape.addVertex({0, 0, 0}, kUp, {0, 0});
    shape.addVertex({2, 1, 0}, kUp, {1, 0});
    shape.addVertex({-1, 3, 0}, kUp, {0, 1});
    shape.addTriangle(0, 1, 2);
    for (const Method method : kEstimated) {
        const Outputs got = generate(shape, method);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_LT(distance(xyz(got.tangents[c]), Vec3{0.894427f, 0.447214f, 0}), 1e-5);
            EXPECT_LT(distance(got.bitangents[c], Vec3{-0.316228f, 0.948683f, 0}), 1e-5);
            EXPECT_NEAR(got.magnitudes_s[c], 2.236068, 1e-4);
            EXPECT_NEAR(got.magnitudes_t[c], 3.162278, 1e-4);
        }
    }
}

TEST(Estimators, BestFollowsAQuadraticMapThatMeansDoNot) {
    const auto quadratic = [](double u, double v) {
        return PatchPoint{u + 0.1 * u * u - 0.06 * u * v, v + 0.08 * u * u + 0.05 * v * v, 0.1 * u * v};
    };
    const SmoothPatch patch = smoothPatch(quadratic, 16, 3);
    const double angle = meanError(patch, Method::angle);
    EXPECT_GT(angle, 0.02);
    EXPECT_LT(meanError(patch, Method::best, 0), angle / 20);
    // Interpolated frames are fitted to the edges, not to the directions at vertices, so the bound is weaker.
    EXPECT_LT(meanError(patch, Method::best), angle / 12);
    EXPECT_LT(meanError(patch, Method::fast), angle / 1.5);
}

TEST(Estimators, TheErrorOfBestFallsFasterThanTheEdges) {
    const auto shell = [](double u, double v) {
        const double a = 2.2 * u, r = 1 + 0.4 * std::cos(3 * v);
        return PatchPoint{r * std::cos(a), r * std::sin(a), 0.4 * std::sin(3 * v)};
    };
    const auto order = [&](Method method) {
        return std::log(meanError(smoothPatch(shell, 24, 5), method) / meanError(smoothPatch(shell, 96, 5), method)) /
               std::log(4.0);
    };
    EXPECT_GT(order(Method::best), 1.6);
    EXPECT_LT(order(Method::angle), 1.3);
}

TEST(Estimators, AThinShearedBevelDoesNotTurnTheFlatFace) {
    const SimpleMesh shape = shearedBevel(0.02f);
    const auto worst = [&](Method method) {
        const Outputs got = generate(shape, method);
        double error = 0;
        for (std::size_t c = 0; c < 6; ++c) error = std::max(error, errorDeg(xyz(got.tangents[c]), {1, 0, 0}));
        return error;
    };
    EXPECT_GT(worst(Method::angle), 20);
    for (const Method method : kEstimated) EXPECT_LT(worst(method), 3);
}

TEST(Estimators, ScalingByPowersOfFourChangesNoBit) {
    const SimpleMesh shape = bumpyRing(6, 9);
    for (const Method method : kEstimated) {
        const Outputs want = generate(shape, method);
        for (const int exponent : {-40, -12, 4, 40}) {
            SimpleMesh scaled = shape;
            for (Vec3& p : scaled.positions)
                p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
            const Outputs by_length = generate(scaled, method);
            for (std::size_t c = 0; c < want.tangents.size(); ++c)
                EXPECT_TRUE(sameBits(want.tangents[c], by_length.tangents[c])) << "2^" << exponent;
            EXPECT_EQ(by_length.magnitudes_s[0], std::ldexp(want.magnitudes_s[0], exponent));
            scaled = shape;
            for (Vec2& uv : scaled.uvs) uv = {std::ldexp(uv.x, exponent / 2), std::ldexp(uv.y, exponent / 2)};
            const Outputs by_uv = generate(scaled, method);
            for (std::size_t c = 0; c < want.tangents.size(); ++c)
                EXPECT_TRUE(sameBits(want.tangents[c], by_uv.tangents[c])) << "2^" << exponent / 2;
        }
    }
}

TEST(Estimators, UnusedVerticesChangeNoBit) {
    const SimpleMesh shape = bumpyRing(6, 9);
    SimpleMesh crowded = shape;
    for (std::size_t i = 0; i < 3 * shape.positions.size(); ++i)
        crowded.addVertex({std::ldexp(1.0f, 60), 0, 1}, kUp, {std::ldexp(1.0f, 60), 1});
    for (const Method method : kEstimated) {
        const Outputs want = generate(shape, method), got = generate(crowded, method);
        for (std::size_t c = 0; c < want.tangents.size(); ++c)
            EXPECT_TRUE(sameBits(want.tangents[c], got.tangents[c])) << "corner " << c;
    }
}

TEST(Estimators, AMirroredHalfMirrorsTheFrame) {
    SimpleMesh shape = grid(8);
    for (Vec2& uv : shape.uvs) uv.x = std::fabs(uv.x - 0.5f);
    for (const Method method : kEstimated) {
        const Outputs got = generate(shape, method);
        for (std::size_t c = 0; c < got.tangents.size(); ++c) {
            const bool left = shape.positions[shape.indices[c / 3 * 3]].x +
                                  shape.positions[shape.indices[c / 3 * 3 + 1]].x +
                                  shape.positions[shape.indices[c / 3 * 3 + 2]].x <
                              12;
            EXPECT_EQ(got.tangents[c].w, left ? -1.0f : 1.0f);
            EXPECT_EQ(got.tangents[c].x > 0, !left);
        }
    }
}

/// Returns shapes with values that are not finite, huge, tiny or degenerate.
std::vector<SimpleMesh> hostileShapes() {
    std::vector<SimpleMesh> list{fan(50),           unrolledFan(50), cone(50),
                                 collapsed(40),     book(40, true),  someDegenerate(800),
                                 checkerboard(800), notFinite(800),  someWithoutUvArea(800)};
    for (const float factor : {1e-38f, 1e-20f, 1e19f, 3e38f}) {
        SimpleMesh shape = grid(5);
        for (std::size_t v = 0; v < shape.positions.size(); ++v) {
            if (v % 2 == 0) shape.positions[v] = {factor * shape.positions[v].x, 1, factor};
            if (v % 3 == 0) shape.uvs[v].y = factor;
            if (v % 5 == 0) shape.normals[v] = {0, 0, factor};
            if (v % 7 == 0) shape.normals[v] = {0, 0, 0};
            if (v % 11 == 0) shape.normals[v].x = std::numeric_limits<float>::quiet_NaN();
        }
        list.push_back(shape);
    }
    return list;
}

void expectFinite(const Outputs& got) {
    for (std::size_t c = 0; c < got.tangents.size(); ++c) {
        const Vec4& t = got.tangents[c];
        ASSERT_TRUE(std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z)) << "corner " << c;
        ASSERT_NEAR(t.x * t.x + t.y * t.y + t.z * t.z, 1, 1e-5) << "corner " << c;
        ASSERT_TRUE(std::isfinite(got.bitangents[c].x)) << "corner " << c;
    }
    EXPECT_EQ(got.report.not_finite_count, 0u);
}

TEST(Estimators, GiveUnitTangentsWhateverTheInput) {
    for (const SimpleMesh& shape : hostileShapes()) {
        for (const Method method : kEstimated) expectFinite(generate(shape, method));
    }
}

TEST(Estimators, GiveFiniteTangentsOnTheGoldenMeshesAndSanitizeRepairsTheRest) {
    TSPACE_NEEDS_SHARED("golden/mikktspace");
    std::size_t meshes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(shared("golden/mikktspace"))) {
        GoldenMesh golden;
        if (!entry.is_regular_file() || !readGolden(entry.path(), golden)) continue;
        ++meshes;
        SCOPED_TRACE(entry.path().filename().string());
        for (const Method method : kEstimated) {
            Outputs got = generate(golden.shape, method);
            for (std::size_t c = 0; c < got.tangents.size(); ++c)
                ASSERT_TRUE(std::isfinite(got.tangents[c].x)) << "corner " << c;
            ASSERT_TRUE(sanitizeTangents(golden.shape.view(), {}, got.tangents));
            const auto again = sanitizeTangents(golden.shape.view(), {}, got.tangents);
            ASSERT_TRUE(again);
            EXPECT_EQ(again->mendedCount(), 0u);
        }
    }
    EXPECT_GT(meshes, 0u);
}

}  // namespace
}  // namespace tspace::test
