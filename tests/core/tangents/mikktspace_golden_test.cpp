// SPDX-License-Identifier: MIT
// Compares every output word of `mikktspace` with results of the reference implementation. This file is built several
// times with different compiler flags, which must not change the bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "core/tangents/golden_mesh.h"
#include "support/shared_data.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

struct GoldenCase {
    std::filesystem::path path;
    GoldenMesh golden;
};

/// Returns the cases whose bits are promised, by name.
std::vector<GoldenCase> goldenCases() {
    std::vector<GoldenCase> cases;
    for (const auto& entry : std::filesystem::directory_iterator(shared("golden/mikktspace"))) {
        if (entry.path().extension() != ".tsg") continue;
        GoldenCase one{entry.path(), {}};
        EXPECT_TRUE(readGolden(one.path, one.golden)) << one.path;
        if (hasPromisedBits(one.golden.shape)) cases.push_back(std::move(one));
    }
    std::sort(cases.begin(), cases.end(), [](const GoldenCase& a, const GoldenCase& b) { return a.path < b.path; });
    return cases;
}

TangentOptions goldenOptions(const GoldenMesh& golden) {
    TangentOptions options{.convention = conventions::opengl};
    options.angular_threshold_deg = golden.angular_threshold_deg;
    options.ngons = Ngons::skip;
    return options;
}

bool matches(const GoldenResult& want, const Outputs& got, std::size_t c) {
    const Vec4& tangent = got.tangents[c];
    const bool orientation = want.sign == 0 || (want.orientation != 0) == (tangent.w > 0);
    return sameBits(want.tangent, xyz(tangent)) && sameBits(want.sign, tangent.w) && orientation &&
           sameBits(want.bitangent, got.bitangents[c]) && sameBits(want.magnitude_s, got.magnitudes_s[c]) &&
           sameBits(want.magnitude_t, got.magnitudes_t[c]);
}

/// Returns the number of corners that differ from the golden results.
std::size_t wrongCorners(const GoldenMesh& golden, const Outputs& outputs) {
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < golden.results.size(); ++c) wrong += !matches(golden.results[c], outputs, c);
    return wrong;
}

TEST(MikktspaceGolden, EveryWordEqualsTheReference) {
    TSPACE_NEEDS_SHARED("golden/mikktspace");
    const auto cases = goldenCases();
    ASSERT_GT(cases.size(), 300u);
    std::size_t passed = 0;
    for (const auto& [path, golden] : cases) {
        Outputs outputs(golden.shape.cornerCount());
        ASSERT_TRUE(generateTangents(golden.shape.view(), goldenOptions(golden), outputs.view())) << path;
        const std::size_t wrong = wrongCorners(golden, outputs);
        EXPECT_EQ(wrong, 0u) << path;
        passed += wrong == 0;
    }
    std::cout << "golden: " << passed << " of " << cases.size() << " passed\n";
}

TEST(MikktspaceGolden, PlanAndEvaluateGiveTheSameWords) {
    TSPACE_NEEDS_SHARED("golden/mikktspace");
    for (const auto& [path, golden] : goldenCases()) {
        const MeshView mesh = golden.shape.view();
        const Result<TangentPlan> plan = planTangents(mesh, goldenOptions(golden));
        ASSERT_TRUE(plan) << path;
        Outputs outputs(golden.shape.cornerCount());
        ASSERT_TRUE(evaluateTangents(*plan, {mesh.positions, mesh.normals}, outputs.view())) << path;
        EXPECT_EQ(wrongCorners(golden, outputs), 0u) << path;
    }
}

}  // namespace
}  // namespace tspace::test
