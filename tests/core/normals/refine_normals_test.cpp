// SPDX-License-Identifier: MIT
// NormalOptions::refine: a refinement step compared with the same step in double precision, and the limits of steps.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <utility>

#include "core/base/vec_math.h"
#include "support/random_values.h"
#include "support/simple_mesh.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

using test::randomFloat;
using test::SimpleMesh;

std::vector<Vec3> normalsOf(const MeshView& mesh, NormalOptions options, std::uint32_t refine) {
    options.refine = refine;
    std::vector<Vec3> out(mesh.cornerCount());
    EXPECT_TRUE(generateNormals(mesh, options, out).ok());
    return out;
}
const NormalOptions kBest{.weighting = NormalWeighting::best};

DVec3 unit(const DVec3& v) { return (1 / length(v)) * v; }
double angleDeg(const Vec3& a, const Vec3& b) {
    return 180 / 3.141592653589793 * std::atan2(length(cross(toDouble(a), toDouble(b))), dot(toDouble(a), toDouble(b)));
}

/// The least-squares system of the step of one normal, in the plane perpendicular to this normal.
struct Step {
    DVec3 n, x, y;
    double xx = 0, xy = 0, yy = 0, xm = 0, ym = 0, mm = 0, turn = 0;

    explicit Step(const DVec3& normal) : n(normal) {
        x = unit(cross(n, std::fabs(n.x) < 0.5 ? DVec3{1, 0, 0} : DVec3{0, 1, 0}));
        y = cross(n, x);
    }
    void add(const DVec3& edge, const DVec3& there, double double_area) {
        const double size = length(edge), w = std::sqrt(double_area) / (size * size);
        const double a = dot(x, edge), b = dot(y, edge), misfit = dot(edge, n + there);
        xx += w * a * a, xy += w * a * b, yy += w * b * b;
        xm += w * a * misfit, ym += w * b * misfit, mm += w * misfit * misfit;
        turn += w * dot(edge, there - n) * dot(edge, there - n);
    }
    [[nodiscard]] DVec3 result() const {
        const double det = xx * yy - xy * xy;
        const double a = -(yy * xm - xy * ym) / det, b = -(xx * ym - xy * xm) / det;
        const double explained = -(a * xm + b * ym), left = std::max(mm - explained, 0.0);
        const double unsure = 2 * left / explained, noisy = 30 * left / turn;
        const double share = 0.5 / ((1 + unsure * unsure) * (1 + noisy * noisy) * (1 + a * a + b * b));
        return unit(n + share * (a * x + b * y));
    }
};

/// Returns the normals after one step from the given normals of corners, for triangles. Corners with equal vertex and
/// normal have one system.
std::vector<Vec3> oneStep(const SimpleMesh& mesh, const std::vector<Vec3>& from) {
    using Key = std::pair<std::uint32_t, std::array<float, 3>>;
    const auto keyOf = [&](std::size_t c) { return Key{mesh.indices[c], {from[c].x, from[c].y, from[c].z}}; };
    std::map<Key, Step> steps;
    for (std::size_t c = 0; c < from.size(); ++c) {
        Step& step = steps.try_emplace(keyOf(c), unit(toDouble(from[c]))).first->second;
        const auto cornerAt = [&](std::size_t k) { return c / 3 * 3 + (c + k) % 3; };
        const auto edgeTo = [&](std::size_t other) {
            return toDouble(mesh.positions[mesh.indices[other]]) - toDouble(mesh.positions[mesh.indices[c]]);
        };
        const double double_area = length(cross(edgeTo(cornerAt(1)), edgeTo(cornerAt(2))));
        for (const std::size_t k : {1u, 2u}) step.add(edgeTo(cornerAt(k)), toDouble(from[cornerAt(k)]), double_area);
    }
    std::vector<Vec3> out;
    for (std::size_t c = 0; c < from.size(); ++c) out.push_back(toFloat(steps.at(keyOf(c)).result()));
    return out;
}

/// Returns a bent sheet of side x side cells with uneven grid lines. Its second half is folded up at a hard edge.
SimpleMesh foldedSheet(std::uint32_t side, float fold) {
    SimpleMesh mesh;
    std::vector<float> lines{0};
    for (std::uint32_t i = 0; i < side; ++i) lines.push_back(lines.back() + randomFloat(0.5f, 1.5f));
    const float bend = randomFloat(-0.02f, 0.02f), twist = randomFloat(-0.02f, 0.02f);
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            const float x = lines[i] - lines[side / 2], y = lines[j];
            mesh.positions.push_back({x, y, bend * (x * x - y * y) + twist * x * y + std::max(0.0f, fold * x)});
        }
    }
    for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    }
    return mesh;
}

bool areClose(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    for (std::size_t c = 0; c < a.size(); ++c) {
        if (angleDeg(a[c], b[c]) > 2e-3) return false;
    }
    return true;
}

RC_GTEST_PROP(RefinedNormals, AreTheStepInDoublePrecision, ()) {
    const SimpleMesh mesh = foldedSheet(6, 0);
    const std::vector<Vec3> fit = normalsOf(mesh.view(), kBest, 0), one = normalsOf(mesh.view(), kBest, 1);
    RC_ASSERT(areClose(one, oneStep(mesh, fit)));
    RC_ASSERT(areClose(normalsOf(mesh.view(), kBest, 2), oneStep(mesh, one)));
}

/// Each side of the hard edge is refined separately, with the same step.
RC_GTEST_PROP(RefinedNormals, WithHardEdgesAreTheStepOfEachSide, ()) {
    const SimpleMesh mesh = foldedSheet(6, 2);
    NormalOptions creased = kBest;
    creased.crease_angle_deg = 30;
    const std::vector<Vec3> fit = normalsOf(mesh.view(), creased, 0), one = normalsOf(mesh.view(), creased, 1);
    RC_ASSERT(areClose(one, oneStep(mesh, fit)));

    // The lower side by itself, without the faces beyond the hard edge.
    SimpleMesh alone = mesh;
    alone.indices.clear();
    std::vector<Vec3> wanted;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        bool is_low = true;
        for (std::size_t k = 0; k < 3; ++k) is_low &= mesh.positions[mesh.indices[t + k]].x <= 0;
        for (std::size_t k = 0; is_low && k < 3; ++k) {
            alone.indices.push_back(mesh.indices[t + k]);
            wanted.push_back(one[t + k]);
        }
    }
    RC_ASSERT(areClose(normalsOf(alone.view(), creased, 1), wanted));

    std::vector<std::uint32_t> groups;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        float x = 0;
        for (std::size_t k = 0; k < 3; ++k) x += mesh.positions[mesh.indices[t + k]].x;
        groups.push_back(x < 0 ? 1 : 2);
    }
    NormalOptions grouped = kBest;
    grouped.smoothing_groups = groups;
    RC_ASSERT(areClose(normalsOf(mesh.view(), grouped, 1), one));
}

/// Triangles of arbitrary values, or of points of a small grid: some are collapsed, double-sided or not finite, or
/// share an edge with many others.
RC_GTEST_PROP(RefinedNormals, OfGarbageRotateByAtMostFourteenDegreesAndStayUnit, ()) {
    SimpleMesh mesh;
    const bool is_grid = test::randomInt(0, 2) == 0;
    const auto coordinate = [] { return static_cast<float>(test::randomInt(0, 3)); };
    for (int v = 0; v < 12; ++v) {
        const float x = coordinate(), y = coordinate();
        mesh.positions.push_back(is_grid ? Vec3{x, y, coordinate()} : test::randomGarbageVec3());
    }
    for (int c = 0; c < 60; ++c) mesh.indices.push_back(static_cast<std::uint32_t>(test::randomInt(0, 12)));
    NormalOptions options = kBest;
    options.crease_angle_deg = test::randomInt(0, 2) == 0 ? 180.0f : 75.0f;
    std::vector<Vec3> before = normalsOf(mesh.view(), options, 0);
    for (const std::uint32_t refine : {1u, 2u}) {
        const std::vector<Vec3> after = normalsOf(mesh.view(), options, refine);
        for (std::size_t c = 0; c < after.size(); ++c) {
            RC_ASSERT(test::isUnit(after[c], 2e-7));
            RC_ASSERT(angleDeg(before[c], after[c]) < 14.05);
        }
        before = after;
    }
}

TEST(RefinedNormals, OfOtherWeightingsAreUnchanged) {
    const SimpleMesh cube = test::triangleCube(21);
    for (const auto weighting : {NormalWeighting::flat, NormalWeighting::uniform, NormalWeighting::area,
                                 NormalWeighting::angle, NormalWeighting::angleArea, NormalWeighting::max}) {
        const NormalOptions options{.weighting = weighting};
        EXPECT_EQ(normalsOf(cube.view(), options, 0), normalsOf(cube.view(), options, 2));
    }
}

TEST(RefinedNormals, AreOfTwoStepsAtMost) {
    const SimpleMesh cube = test::triangleCube(0);
    std::vector<Vec3> out(cube.indices.size());
    const auto result = generateNormals(cube.view(), {.refine = 3}, out);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::invalidOption);
}

/// The center of a fan of 200,000 triangles costs one sum per step.
TEST(RefinedNormals, OfAFanTakeOnePassPerStep) {
    SimpleMesh fan;
    fan.positions.push_back({0, 0, 0.2f});
    constexpr std::uint32_t kCount = 200'000;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const float a = 6.2831853f * static_cast<float>(i) / kCount;
        fan.positions.push_back({std::cos(a), std::sin(a), 0});
        fan.indices.insert(fan.indices.end(), {0, i + 1, (i + 1) % kCount + 1});
    }
    NormalOptions options = kBest;
    for (const float crease : {180.0f, 60.0f}) {
        options.crease_angle_deg = crease;
        EXPECT_LT(angleDeg(normalsOf(fan.view(), options, 2)[0], {0, 0, 1}), 1);
    }
}

}  // namespace
}  // namespace tspace
