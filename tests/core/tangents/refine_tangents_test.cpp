// SPDX-License-Identifier: MIT
// TangentOptions::refine: a refinement step compared with the same step in double precision, and the limits of steps.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/vec_math.h"
#include "core/tangents/golden_mesh.h"
#include "core/tangents/shapes.h"
#include "core/tangents/smooth_patch.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

using test::Outputs;
using test::sameBits;
using test::SimpleMesh;
using test::SmoothPatch;

Outputs generate(const SimpleMesh& shape, std::uint32_t refine, Method method = Method::best) {
    Outputs outputs(shape.cornerCount());
    const auto report = generateTangents(
        shape.view(), {.method = method, .convention = conventions::opengl, .refine = refine}, outputs.view());
    EXPECT_TRUE(report.ok());
    if (report) outputs.report = *report;
    return outputs;
}

DVec3 unit(const DVec3& v) { return (1 / length(v)) * v; }
DVec3 flat(const DVec3& n, const DVec3& v) { return v - dot(n, v) * n; }
double angleDeg(const DVec3& a, const DVec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b)) * 57.29577951308232;
}

SmoothPatch patchOf(std::uint32_t seed, double wave = 0.2) {
    const auto surface = [wave](double u, double v) {
        return test::PatchPoint{u + wave * v * v * u, v - wave * u * v, wave * std::sin(3 * u) * std::cos(2 * v)};
    };
    return test::smoothPatch(surface, 10, seed);
}

/// The refinement step of the group at vertex v, in double precision, from the previous frames of all vertices.
class Step {
  public:
    Step(const SimpleMesh& shape, const Outputs& before) : shape_(shape), u_(shape.positions.size()), v_(u_.size()) {
        for (std::size_t c = 0; c < shape.cornerCount(); ++c) {
            const std::uint32_t v = shape.indices[c];
            u_[v] = double{before.magnitudes_s[c]} * unit(toDouble(xyz(before.tangents[c])));
            v_[v] = double{before.magnitudes_t[c]} * unit(toDouble(before.bitangents[c]));
        }
    }

    [[nodiscard]] DVec3 tangentAt(std::uint32_t at) const {
        double uu = 0, uv = 0, vv = 0, energy = 0;
        DVec3 ru{}, rv{};
        for (std::size_t t = 0; t < shape_.indices.size(); t += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (shape_.indices[t + k] != at) continue;
                const std::uint32_t a = shape_.indices[t + (k + 1) % 3], b = shape_.indices[t + (k + 2) % 3];
                const double area = length(cross(position(a) - position(at), position(b) - position(at))) / 2;
                for (const std::uint32_t to : {a, b}) {
                    const DVec3 e = position(to) - position(at);
                    const double w = std::sqrt(area) / dot(e, e);
                    const double du = double{shape_.uvs[to].x} - shape_.uvs[at].x;
                    const double dv = double{shape_.uvs[to].y} - shape_.uvs[at].y;
                    const DVec3 r = residual(at, to, e, du, dv);
                    uu += w * du * du, uv += w * du * dv, vv += w * dv * dv, energy += w * dot(r, r);
                    ru = ru + w * du * r;
                    rv = rv + w * dv * r;
                }
            }
        }
        const double det = uu * vv - uv * uv;
        const DVec3 du = (1 / det) * (vv * ru - uv * rv), dv = (1 / det) * (uu * rv - uv * ru);
        const double explained = dot(du, ru) + dot(dv, rv), doubt = 2 * std::max(energy - explained, 0.0) / explained;
        const double turn = dot(du, du) / dot(u_[at], u_[at]) + dot(dv, dv) / dot(v_[at], v_[at]);
        return unit(u_[at] + (0.5 / ((1 + doubt * doubt) * (1 + turn))) * du);
    }

  private:
    [[nodiscard]] DVec3 position(std::uint32_t v) const { return toDouble(shape_.positions[v]); }
    [[nodiscard]] DVec3 normal(std::uint32_t v) const { return unit(toDouble(shape_.normals[v])); }
    [[nodiscard]] DVec3 residual(std::uint32_t at, std::uint32_t to, const DVec3& e, double du, double dv) const {
        const DVec3 p = flat(normal(at), e), there = du * u_[to] + dv * v_[to];
        const double c = dot(normal(to) - normal(at), e) / length(e);
        const DVec3 arc = (length(e) / length(p) * (1 + c * c / 24)) * p;
        const DVec3 laid = length(there) * unit(flat(normal(at), there));
        return 2.0 * arc - laid - flat(normal(at), du * u_[at] + dv * v_[at]);
    }

    const SimpleMesh& shape_;
    std::vector<DVec3> u_, v_;
};

TEST(RefinedTangents, AreTheStepInDoublePrecision) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const SmoothPatch patch = patchOf(seed);
        const Outputs fit = generate(patch.shape, 0), one = generate(patch.shape, 1);
        const Step step(patch.shape, fit);
        double largest = 0;
        for (std::size_t c = 0; c < patch.shape.cornerCount(); ++c) {
            const std::uint32_t v = patch.shape.indices[c];
            const DVec3 before = toDouble(xyz(fit.tangents[c])), after = toDouble(xyz(one.tangents[c]));
            const double turn = angleDeg(before, step.tangentAt(v));
            largest = std::max(largest, turn);
            // The weight of the robust mean, which limits the step, is not known here, so the comparison has a
            // tolerance.
            EXPECT_LT(angleDeg(after, step.tangentAt(v)), 0.1 * turn + 1e-3) << "vertex " << v;
        }
        EXPECT_GT(largest, 0.1);  // otherwise the comparison would prove nothing
    }
}

TEST(RefinedTangents, AreCloserToTheSurfaceThanTheFitAndTheSecondStepIsCloserStill) {
    double error[3] = {};
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
        const SmoothPatch patch = patchOf(seed);
        for (std::uint32_t refine = 0; refine < 3; ++refine) {
            const Outputs got = generate(patch.shape, refine);
            for (std::size_t c = 0; c < patch.shape.cornerCount(); ++c)
                error[refine] +=
                    angleDeg(toDouble(xyz(got.tangents[c])), toDouble(patch.tangents[patch.shape.indices[c]]));
        }
    }
    EXPECT_LT(error[1], 0.75 * error[0]);
    EXPECT_LT(error[2], error[1]);
}

/// If UVs are linear, the fit is exact, and nothing remains to be refined.
TEST(RefinedTangents, AreUnchangedIfEdgesFit) {
    const SmoothPatch patch = patchOf(5, 0);
    const Outputs fit = generate(patch.shape, 0), two = generate(patch.shape, 2);
    for (std::size_t c = 0; c < patch.shape.cornerCount(); ++c)
        EXPECT_LT(angleDeg(toDouble(xyz(fit.tangents[c])), toDouble(xyz(two.tangents[c]))), 1e-3);
}

RC_GTEST_PROP(RefinedTangents, TurnByFourteenDegreesAtMost, ()) {
    SmoothPatch patch = patchOf(*rc::gen::arbitrary<std::uint32_t>());
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const int noise = *rc::gen::inRange(0, 200);
    for (Vec2& uv : patch.shape.uvs)
        uv.x += 0.001f * static_cast<float>(noise) * (static_cast<float>(random() % 201) / 100 - 1);
    Outputs before = generate(patch.shape, 0);
    for (const std::uint32_t refine : {1u, 2u}) {
        const Outputs after = generate(patch.shape, refine);
        for (std::size_t c = 0; c < patch.shape.cornerCount(); ++c) {
            const DVec3 a = toDouble(xyz(before.tangents[c])), b = toDouble(xyz(after.tangents[c]));
            RC_ASSERT(angleDeg(a, b) < 14.05);
            RC_ASSERT(std::fabs(length(b) - 1) < 1e-6);
        }
        before = after;
    }
}

/// The evaluation of a plan gives the same result as generateTangents, for the plan's pose and for another one, with
/// any number of refinement steps.
TEST(RefinedTangents, OfAPlanFollowThePose) {
    const SmoothPatch patch = patchOf(6);
    SimpleMesh moved = patch.shape;
    for (Vec3& p : moved.positions) p = {2 * p.x, 2 * p.y, 2 * p.z};
    for (const std::uint32_t refine : {0u, 1u, 2u}) {
        const auto plan = planTangents(patch.shape.view(),
                                       {.method = Method::best, .convention = conventions::opengl, .refine = refine});
        ASSERT_TRUE(plan.ok());
        for (const SimpleMesh& shape : {patch.shape, moved}) {
            Outputs evaluated(shape.cornerCount());
            ASSERT_TRUE(evaluateTangents(*plan, {shape.positions, shape.normals}, evaluated.view()).ok());
            const Outputs generated = generate(shape, refine);
            EXPECT_TRUE(sameBits(generated, evaluated)) << refine;
        }
    }
}

/// A closed tube with a UV seam along a line. Vertices on the two sides of the seam have no common neighbors.
TEST(RefinedTangents, HaveHalfTheDifferenceAcrossASeam) {
    constexpr std::uint32_t kSide = 32;
    const auto tube = [](double u, double v) {
        const double a = 6.283185307179586 * u, r = 1 + 0.3 * std::sin(3 * v);
        return test::PatchPoint{r * std::cos(a), r * std::sin(a), 5 * v};
    };
    const auto gapWith = [&](Method method, std::uint32_t refine) {
        double sum = 0;
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            const SmoothPatch patch = test::smoothPatch(tube, kSide, seed);
            const Outputs outputs = generate(patch.shape, refine, method);
            std::vector<DVec3> tangents(patch.shape.positions.size());
            for (std::size_t c = 0; c < outputs.tangents.size(); ++c) {
                tangents[patch.shape.indices[c]] = toDouble(xyz(outputs.tangents[c]));
            }
            for (std::uint32_t y = 1; y < kSide; ++y) {
                const std::size_t first = y * (kSide + 1);
                sum += angleDeg(tangents[first], tangents[first + kSide]) / (4 * (kSide - 1));
            }
        }
        return sum;
    };
    const double fit = gapWith(Method::best, 0), once = gapWith(Method::best, 1), twice = gapWith(Method::best, 2);
    EXPECT_LT(fit, gapWith(Method::mikktspace, 0));
    EXPECT_LT(once, 0.5 * fit);
    EXPECT_LT(twice, 0.7 * once);
}

TEST(RefinedTangents, OfOtherMethodsAreUnchanged) {
    const SmoothPatch patch = patchOf(7);
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                                Method::flat, Method::fast, Method::basis})
        EXPECT_TRUE(sameBits(generate(patch.shape, 0, method), generate(patch.shape, 2, method)));
    EXPECT_FALSE(sameBits(generate(patch.shape, 0), generate(patch.shape, 1)));
    EXPECT_FALSE(sameBits(generate(patch.shape, 1), generate(patch.shape, 2)));
}

TEST(RefinedTangents, AreOfTwoStepsAtMost) {
    const SmoothPatch patch = patchOf(8);
    Outputs outputs(patch.shape.cornerCount());
    const TangentOptions options{.method = Method::best, .convention = conventions::opengl, .refine = 3};
    const auto result = generateTangents(patch.shape.view(), options, outputs.view());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::invalidOption);
    EXPECT_FALSE(planTangents(patch.shape.view(), options).ok());
}

}  // namespace
}  // namespace tspace
