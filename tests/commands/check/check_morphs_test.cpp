// SPDX-License-Identifier: MIT
// Tangent deltas of morph targets: missing ones, wrong ones, and those of triangles that a target collapses.
#include <gtest/gtest.h>

#include "commands/check/patch.h"

namespace tspace::test {
namespace {

using Codes = std::set<std::string>;

/// Returns a morph target that bends the patch: it rotates every vertex about the x axis by an angle that grows with y.
SceneMorphTarget bend(const ScenePrimitive& patch, double most) {
    std::vector<Vec3> positions, normals, tangents;
    const auto delta = [](const Vec3& v, double angle) {
        const DVec3 d = toDouble(v);
        const DVec3 to{d.x, std::cos(angle) * d.y - std::sin(angle) * d.z,
                       std::sin(angle) * d.y + std::cos(angle) * d.z};
        return toFloat(to - d);
    };
    for (std::size_t v = 0; v < patch.positions.size(); ++v) {
        positions.push_back(delta(patch.positions[v], most));
        normals.push_back(delta(patch.normals[v], most));
        tangents.push_back(delta(xyz(patch.tangents[v]), most));
    }
    return {positions, normals, tangents};
}

TEST(CheckMorphs, FindsMorphTargetsWithoutTangents) {
    ScenePrimitive patch = goodPatch(Seam::turned);
    patch.morph_targets = {bend(patch, 1.0)};
    EXPECT_EQ(codesOf(patch), Codes{}) << "these fit";
    patch.morph_targets[0].tangents = {};
    EXPECT_EQ(codesOf(patch), Codes{"warning morphTangentsMissing"});
    patch.morph_targets.push_back(bend(patch, 0.02));
    patch.morph_targets[1].tangents = {};
    const std::vector<Finding> findings = findingsOf(patch);
    ASSERT_EQ(findings.size(), 1u);
    const Finding& finding = findings[0];
    EXPECT_EQ(finding.code, FindingCode::morphTangentsMissing);
    EXPECT_EQ(finding.count, 1u) << "one degree does not matter";
    EXPECT_EQ(finding.total, 2u);
    EXPECT_EQ(finding.unit, "targets");
    EXPECT_EQ(finding.place, "/meshes/0/primitives/0/targets/0");
}

TEST(CheckMorphs, FindsMorphTargetsWhoseTangentsDoNotFit) {
    ScenePrimitive patch = goodPatch(Seam::turned);
    patch.morph_targets = {bend(patch, 1.0)};
    edit(patch.morph_targets[0].tangents, [](auto& deltas) {
        for (Vec3& delta : deltas) delta = -1.0f * delta;
    });
    EXPECT_EQ(codesOf(patch), Codes{"error morphTangentsWrong"});
}

/// Makes the target move the first three rows of the first half to one point.
void collapse(const ScenePrimitive& patch, SceneMorphTarget& target) {
    edit(target.positions, [&](auto& deltas) {
        for (std::size_t v = 0; v < 3 * kSide; ++v) deltas[v] = Vec3{1, 2, 3} - patch.positions[v];
    });
}

TEST(CheckMorphs, IgnoresTangentsOfCollapsedTriangles) {
    ScenePrimitive patch = goodPatch();
    patch.morph_targets = {bend(patch, 1.0)};
    collapse(patch, patch.morph_targets[0]);
    edit(patch.morph_targets[0].tangents, [&](auto& deltas) {
        for (std::size_t v = 0; v < 3 * kSide; ++v) deltas[v] = Vec3{};
    });
    EXPECT_EQ(codesOf(patch), Codes{});
}

TEST(CheckMorphs, FindsWrongMorphTangentsNextToCollapsedTriangles) {
    ScenePrimitive patch = goodPatch();
    patch.morph_targets = {bend(patch, 1.0)};
    collapse(patch, patch.morph_targets[0]);
    edit(patch.morph_targets[0].tangents, [](auto& deltas) {
        for (std::size_t v = 5 * kSide; v < deltas.size(); ++v) deltas[v] = -1.0f * deltas[v];
    });
    EXPECT_EQ(codesOf(patch), Codes{"error morphTangentsWrong"});
}

/// Sets deltas that make tangents opposite to the correct direction, zero, or parallel to the normal.
TEST(CheckMorphs, FindsEveryWayInWhichMorphTangentsAreWrong) {
    for (const double share : {-2.0, -1.0, 0.0}) {
        ScenePrimitive patch = goodPatch();
        patch.morph_targets = {bend(patch, 1.0)};
        edit(patch.morph_targets[0].tangents, [&](auto& deltas) {
            for (std::size_t v = 0; v < deltas.size(); ++v) {
                const Vec3 base = xyz(patch.tangents[v]), fitting = base + deltas[v];
                const Vec3 normal = patch.normals[v] + patch.morph_targets[0].normals[v];
                const Vec3 wrong = share == 0.0 ? normal : static_cast<float>(1 + share) * fitting;
                deltas[v] = wrong - base;
            }
        });
        EXPECT_EQ(codesOf(patch), Codes{"error morphTangentsWrong"}) << share;
    }
}

}  // namespace
}  // namespace tspace::test
