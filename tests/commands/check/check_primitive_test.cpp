// SPDX-License-Identifier: MIT
// A correct primitive has no findings; a primitive with one fault has the corresponding finding, and those that follow
// from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "commands/check/findings.h"
#include "commands/check/patch.h"
#include "tspace/tangents.h"

namespace tspace::test {
namespace {

using Codes = std::set<std::string>;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Check, FindsNothingInAGoodPrimitive) {
    for (const Seam seam : {Seam::none, Seam::mirrored, Seam::turned}) EXPECT_EQ(codesOf(goodPatch(seam)), Codes{});
}

TEST(Check, AcceptsEveryWayToAverage) {
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area}) {
        for (const Seam seam : {Seam::mirrored, Seam::turned}) {
            ScenePrimitive patch = goodPatch(seam);
            patch.tangents = tangentsOf(patch, method);
            EXPECT_EQ(codesOf(patch), Codes{}) << static_cast<int>(method);
        }
    }
}

TEST(Check, AcceptsTangentsStoredIn8Bits) {
    ScenePrimitive patch = goodPatch();
    const auto stored = [](float value) { return std::round(value * 127) / 127; };
    edit(patch.tangents, [&](auto& tangents) {
        for (Vec4& t : tangents) t = {stored(t.x), stored(t.y), stored(t.z), t.w};
    });
    edit(patch.normals, [&](auto& normals) {
        for (Vec3& n : normals) n = {stored(n.x), stored(n.y), stored(n.z)};
    });
    EXPECT_EQ(codesOf(patch), Codes{});
}

TEST(Check, AcceptsTheSignsOfAnotherConventionWhenAsked) {
    ScenePrimitive patch = goodPatch(Seam::mirrored);
    edit(patch.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t.w = -t.w;
    });
    EXPECT_EQ(codesOf(patch, {.convention = conventions::opengl}), Codes{});
    EXPECT_EQ(codesOf(patch), Codes{"error signsInverted"});
}

TEST(Check, FindsPositionsThatAreNotFinite) {
    ScenePrimitive patch = goodPatch();
    edit(patch.positions, [](auto& positions) { positions[40].y = kNan; });
    const std::vector<Finding> findings = findingsOf(patch);
    const Finding& finding = only(findings, FindingCode::positionsNotFinite);
    EXPECT_EQ(finding.severity, Severity::error);
    EXPECT_EQ(finding.count, 1u);
    EXPECT_EQ(finding.total, 2 * kHalf);
    EXPECT_EQ(finding.vertices, std::vector<std::uint32_t>{40});
}

TEST(Check, FindsMissingUvs) {
    ScenePrimitive patch = goodPatch();
    patch.uses[0].uv_set = 3;
    EXPECT_EQ(codesOf(patch), Codes{"error uvsMissing"});
}

TEST(Check, FindsUvsThatAreNotFinite) {
    ScenePrimitive patch = goodPatch();
    edit(patch.uv_sets[0], [](auto& uvs) { uvs[40].x = std::numeric_limits<float>::infinity(); });
    EXPECT_EQ(codesOf(patch).count("error uvsNotFinite"), 1u);
}

TEST(Check, FindsTrianglesWithoutUvArea) {
    ScenePrimitive patch = goodPatch();
    edit(patch.uv_sets[0], [](auto& uvs) {
        for (std::size_t row = 0; row < kSide; ++row) uvs[row * kSide] = uvs[row * kSide + 1];
    });
    EXPECT_EQ(codesOf(patch), Codes{"warning uvsDegenerate"});
    const std::vector<Finding> findings = findingsOf(patch);
    const Finding& finding = only(findings, FindingCode::uvsDegenerate);
    EXPECT_EQ(finding.count, 2 * (kSide - 1));
    EXPECT_EQ(finding.unit, "triangles");
    EXPECT_NEAR(finding.surface_share, 1.0 / 16, 0.02);
    patch.uses.clear();
    EXPECT_EQ(codesOf(patch), (Codes{"note tangentsUnused", "note uvsDegenerate"})) << "nothing follows them";
}

TEST(Check, FindsMissingNormals) {
    ScenePrimitive patch = goodPatch();
    patch.normals = {};
    EXPECT_EQ(codesOf(patch), (Codes{"note normalsMissing", "warning tangentsIgnored"}));
    patch.tangents = {};
    EXPECT_EQ(codesOf(patch), (Codes{"note normalsMissing", "warning tangentsMissing"}));
}

TEST(Check, FindsNormalsThatAreNotFinite) {
    ScenePrimitive patch = goodPatch();
    edit(patch.normals, [](auto& normals) { normals[7].z = kNan; });
    EXPECT_EQ(codesOf(patch), Codes{"error normalsNotFinite"});
}

TEST(Check, FindsNormalsThatAreNotUnit) {
    ScenePrimitive patch = goodPatch();
    edit(patch.normals, [](auto& normals) { normals[7] = 0.9f * normals[7]; });
    EXPECT_EQ(codesOf(patch), Codes{"warning normalsNotUnit"});
    edit(patch.normals, [](auto& normals) { normals[40] = {0, 0, 0}; });
    EXPECT_EQ(codesOf(patch), Codes{"error normalsNotUnit"}) << "none at all is worse";
    EXPECT_EQ(codesOf(patch, {.error_share = 0.9}), Codes{"error normalsNotUnit"}) << "at a single vertex";
}

TEST(Check, FindsNormalsAgainstTheWinding) {
    ScenePrimitive patch = goodPatch(Seam::turned);
    edit(patch.corners, [](auto& corners) {
        for (std::size_t c = 0; c < corners.size(); c += 3) std::swap(corners[c], corners[c + 1]);
    });
    EXPECT_EQ(codesOf(patch), Codes{"error normalsAgainstWinding"});
    ScenePrimitive one = goodPatch();
    edit(one.corners, [](auto& corners) { std::swap(corners[0], corners[1]); });
    EXPECT_EQ(codesOf(one).count("note normalsAgainstWinding"), 1u) << "a single triangle is a note";
}

TEST(Check, FindsMissingTangents) {
    ScenePrimitive patch = goodPatch();
    patch.tangents = {};
    EXPECT_EQ(codesOf(patch), Codes{"warning tangentsMissing"});
    patch.uses.clear();
    EXPECT_EQ(codesOf(patch), Codes{}) << "nobody needs them";
}

TEST(Check, FindsUnusedTangents) {
    ScenePrimitive patch = goodPatch();
    patch.uses.clear();
    EXPECT_EQ(codesOf(patch), Codes{"note tangentsUnused"});
    patch.corners = {};
    patch.mode = "points";
    EXPECT_EQ(codesOf(patch), Codes{"note tangentsUnused"});
}

TEST(Check, ReportsNothingElseAboutUnusedTangents) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t = {kNan, 0, 2, -t.w};
    });
    patch.uses.clear();
    EXPECT_EQ(codesOf(patch), Codes{"note tangentsUnused"});
}

/// In glTF, points with tangents are lit with the normal map of their material.
TEST(Check, AcceptsTangentsOfPointsWithANormalMap) {
    ScenePrimitive patch = goodPatch();
    patch.corners = {};
    patch.mode = "points";
    EXPECT_EQ(codesOf(patch), Codes{});
}

TEST(Check, NotesNormalsThatUnlitMaterialsDoNotUse) {
    ScenePrimitive patch = goodPatch();
    patch.uses.clear();
    patch.tangents = {};
    patch.is_unlit = true;
    edit(patch.normals, [](auto& normals) {
        for (Vec3& n : normals) n = -1.5f * n;
        normals[3].x = kNan;
    });
    EXPECT_EQ(codesOf(patch), (Codes{"note normalsNotFinite", "note normalsNotUnit", "note normalsAgainstWinding"}));
    patch.is_unlit = false;
    EXPECT_EQ(codesOf(patch).count("error normalsAgainstWinding"), 1u);
}

/// Leaves of trees often have the normals of the whole tree.
TEST(Check, WarnsOfNormalsAgainstTheWindingOfDoubleSidedMaterials) {
    ScenePrimitive patch = goodPatch();
    edit(patch.corners, [](auto& corners) {
        for (std::size_t c = 0; c < corners.size() * 7 / 10; c += 3) std::swap(corners[c], corners[c + 1]);
    });
    patch.uses.clear();
    patch.tangents = {};
    EXPECT_EQ(codesOf(patch), Codes{"error normalsAgainstWinding"});
    patch.is_double_sided = true;
    EXPECT_EQ(codesOf(patch), Codes{"warning normalsAgainstWinding"});
}

TEST(Check, FindsTangentsThatAreNotFinite) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) { tangents[40].y = kNan; });
    EXPECT_EQ(codesOf(patch), Codes{"error tangentsNotFinite"});
}

TEST(Check, FindsTangentsThatAreNotUnit) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t = {0.95f * t.x, 0.95f * t.y, 0.95f * t.z, t.w};
    });
    EXPECT_EQ(codesOf(patch), Codes{"warning tangentsNotUnit"});
    edit(patch.tangents, [](auto& tangents) { tangents[40] = {0, 0, 0, tangents[40].w}; });
    EXPECT_EQ(codesOf(patch), Codes{"error tangentsNotUnit"}) << "none at all is worse";
}

TEST(Check, FindsTangentsThatAreTiltedOutOfTheSurface) {
    const auto leaning = [](float by) {
        ScenePrimitive patch = goodPatch();
        edit(patch.tangents, [&](auto& tangents) {
            for (std::size_t v = 0; v < tangents.size(); ++v) {
                DVec3 t = toDouble(xyz(tangents[v])) + by * toDouble(patch.normals[v]);
                normalize(t);
                tangents[v] = {toFloat(t).x, toFloat(t).y, toFloat(t).z, tangents[v].w};
            }
        });
        return patch;
    };
    EXPECT_EQ(codesOf(leaning(0.04f)), Codes{}) << "2.3 degrees";
    EXPECT_EQ(codesOf(leaning(0.3f)), Codes{"warning tangentsNotOrthogonal"});
    EXPECT_NEAR(findingsOf(leaning(0.3f))[0].worst_deg, 16.7, 0.1);
    EXPECT_EQ(codesOf(leaning(20.0f)), Codes{"error tangentsNotOrthogonal"}) << "there is no frame left";
}

TEST(Check, FindsSignsThatAreNotOne) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) { tangents[40].w *= 0.9f; });
    EXPECT_EQ(codesOf(patch), Codes{"warning signsNotOne"});
    edit(patch.tangents, [](auto& tangents) { tangents[41].w *= 0.1f; });
    EXPECT_EQ(codesOf(patch), Codes{"error signsNotOne"});
}

TEST(Check, FindsThatEverySignIsInverted) {
    for (const Seam seam : {Seam::none, Seam::mirrored, Seam::turned}) {
        ScenePrimitive patch = goodPatch(seam);
        edit(patch.tangents, [](auto& tangents) {
            for (Vec4& t : tangents) t.w = -t.w;
        });
        EXPECT_EQ(codesOf(patch), Codes{"error signsInverted"});
    }
}

TEST(Check, FindsThatSomeSignsAreWrong) {
    ScenePrimitive patch = goodPatch(Seam::mirrored);
    edit(patch.tangents, [](auto& tangents) {
        for (std::size_t v = kHalf; v < tangents.size(); ++v) tangents[v].w = -tangents[v].w;
    });
    EXPECT_EQ(codesOf(patch), Codes{"error signsWrong"}) << "the sign was lost and taken for +1";
    EXPECT_EQ(findingsOf(patch)[0].count, kHalf);
}

TEST(Check, FindsMixedSigns) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) { tangents[40].w = -tangents[40].w; });
    EXPECT_EQ(codesOf(patch), (Codes{"error signsMixed", "error signsWrong"}));
    const std::vector<Finding> findings = findingsOf(patch);
    EXPECT_EQ(only(findings, FindingCode::signsMixed).count, 6u) << "the triangles around that vertex";
}

TEST(Check, FindsAMirroredSeamWhoseVerticesWereNotSplit) {
    ScenePrimitive patch = goodPatch(Seam::mirrored);
    edit(patch.corners, [](auto& corners) {
        for (std::uint32_t& corner : corners) {
            for (std::size_t row = 0; row < kSide; ++row) {
                if (corner == seamVertex(1, row)) corner = seamVertex(0, row);
            }
        }
    });
    EXPECT_EQ(codesOf(patch), (Codes{"error mirroredSeamAveraged", "error signsMixed"}));
    const std::vector<Finding> findings = findingsOf(patch);
    EXPECT_EQ(only(findings, FindingCode::mirroredSeamAveraged).count, kSide);
}

/// Gives the two vertices of each pair on the seam the same tangent: a mean of their tangents.
void averageSeam(ScenePrimitive& patch) {
    edit(patch.tangents, [&](auto& tangents) {
        for (std::size_t row = 0; row < kSide; ++row) {
            Vec4 &a = tangents[seamVertex(0, row)], &b = tangents[seamVertex(1, row)];
            // The exact mean of opposite tangents would be zero.
            DVec3 mean = toDouble(xyz(a)) + 0.8 * toDouble(xyz(b)) + DVec3{0, 0.1, 0};
            const DVec3 normal = toDouble(patch.normals[seamVertex(0, row)]);
            mean = mean - dot(mean, normal) * normal;
            normalize(mean);
            const Vec3 t = toFloat(mean);
            a = {t.x, t.y, t.z, a.w};
            b = {t.x, t.y, t.z, b.w};
        }
    });
}

TEST(Check, FindsAMirroredSeamWhoseTangentsWereAveraged) {
    ScenePrimitive patch = goodPatch(Seam::mirrored);
    averageSeam(patch);
    EXPECT_EQ(codesOf(patch).count("error mirroredSeamAveraged"), 1u);
}

TEST(Check, FindsAUvSeamWhoseTangentsWereAveraged) {
    ScenePrimitive patch = goodPatch(Seam::turned);
    averageSeam(patch);
    EXPECT_EQ(codesOf(patch), Codes{"error uvSeamAveraged"});
    const std::vector<Finding> findings = findingsOf(patch);
    EXPECT_EQ(only(findings, FindingCode::uvSeamAveraged).count, 2 * kSide);
}

TEST(Check, FindsDirectionsThatAreOff) {
    const auto off = [](double degrees) {
        ScenePrimitive patch = goodPatch(Seam::turned);
        edit(patch.tangents, [&](auto& tangents) {
            for (std::size_t v = 0; v < tangents.size(); ++v)
                tangents[v] = turned(tangents[v], patch.normals[v], degrees);
        });
        return patch;
    };
    EXPECT_EQ(codesOf(off(5)), Codes{}) << "within what methods differ by";
    EXPECT_EQ(codesOf(off(30)), Codes{"warning directionsWrong"});
    EXPECT_EQ(codesOf(off(60)), Codes{"error directionsWrong"});
    EXPECT_EQ(codesOf(off(180)), Codes{"error directionsWrong"});
    EXPECT_EQ(codesOf(off(5), {.direction_deg = 1}), Codes{"warning directionsWrong"}) << "the angle is an option";
    EXPECT_NEAR(findingsOf(off(60))[0].worst_deg, 60, 3);
}

/// Collapses the UVs of a patch to a point, except for one column of its first half: only the triangles of this column
/// determine the right direction.
TEST(Check, IgnoresTrianglesWithoutUvArea) {
    ScenePrimitive patch = goodPatch();
    edit(patch.uv_sets[0], [](auto& uvs) {
        for (std::size_t v = 0; v < uvs.size(); ++v) {
            if (v >= kHalf || v % kSide > 1) uvs[v] = {0.5f, 0.5f};
        }
    });
    patch.tangents = tangentsOf(patch);
    edit(patch.tangents, [](auto& tangents) {
        for (std::size_t v = 0; v < tangents.size(); ++v) {
            if (v >= kHalf || v % kSide > 2) tangents[v] = {0, 1, 0, v % 2 == 0 ? 1.0f : -1.0f};
        }
    });
    EXPECT_EQ(codesOf(patch), Codes{"warning uvsDegenerate"});
    edit(patch.tangents, [](auto& tangents) {
        for (std::size_t v = 0; v < kHalf; ++v) {
            if (v % kSide <= 2) tangents[v].w = -tangents[v].w;
        }
    });
    EXPECT_EQ(codesOf(patch), (Codes{"error signsInverted", "warning uvsDegenerate"}));
}

TEST(Check, AcceptsTangentsOfGenerate) {
    EXPECT_TRUE(rc::check([] {
        ScenePrimitive patch = goodPatch(Seam::none);
        // Choose from few UVs, so that many triangles have no area, are mirrored or overlap.
        edit(patch.uv_sets[0], [](auto& uvs) {
            for (Vec2& uv : uvs) uv = {static_cast<float>(anyInt(0, 3)) / 3, static_cast<float>(anyInt(0, 3)) / 3};
        });
        // Every corner is a separate vertex, so that no tangent is averaged by welding.
        std::vector<Vec3> positions, normals;
        std::vector<Vec2> uvs;
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t v : patch.corners) {
            positions.push_back(patch.positions[v]);
            normals.push_back(patch.normals[v]);
            uvs.push_back(patch.uv_sets[0][v]);
            corners.push_back(static_cast<std::uint32_t>(corners.size()));
        }
        patch.positions = std::move(positions);
        patch.normals = std::move(normals);
        patch.uv_sets[0] = std::move(uvs);
        patch.corners = std::move(corners);
        std::vector<Vec4> tangents = tangentsOf(patch);
        (void)sanitizeTangents(patch.view(patch.uv_sets[0].span()), {}, tangents);
        patch.tangents = std::move(tangents);
        for (const Finding& finding : findingsOf(patch)) {
            RC_ASSERT(finding.code == FindingCode::uvsDegenerate);
        }
    }));
}

/// A mesh of text with a second UV set that was never unwrapped.
TEST(Check, DoesNotBlameAUvSetWithoutArea) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t = {-t.x, -t.y, -t.z, t.w};
    });
    patch.uv_sets.push_back(std::vector<Vec2>(patch.positions.size()));
    EXPECT_EQ(codesOf(patch), Codes{"error directionsWrong"});
    // A second set is not an explanation either if it has UV area only in a corner of the surface, where the tangents
    // follow it by chance.
    edit(patch.uv_sets[1], [&](auto& uvs) {
        for (std::size_t v = 0; v < 2 * kSide; ++v) {
            uvs[v] = {-patch.uv_sets[0][v].x, -patch.uv_sets[0][v].y};
        }
    });
    EXPECT_EQ(codesOf(patch), Codes{"error directionsWrong"});
}

TEST(Check, WarnsOnlyWhereTheTangentsFitAnotherTexture) {
    ScenePrimitive patch = goodPatch();
    SharedArray<Vec2> other = patch.uv_sets[0];
    edit(other, [](auto& uvs) {
        for (Vec2& uv : uvs) uv = {uv.y, -uv.x};
    });
    patch.uv_sets.insert(patch.uv_sets.begin(), other);
    patch.uses.push_back({.needed_by = "clearcoatNormalTexture", .place = "/coat", .uv_set = 1});
    EXPECT_EQ(codesOf(patch), (Codes{"warning texturesDisagree", "warning uvSetWrong"}));
}

TEST(Check, FindsTangentsAlongAnotherUvSet) {
    ScenePrimitive patch = goodPatch();
    SharedArray<Vec2> other = patch.uv_sets[0];
    edit(other, [](auto& uvs) {
        for (Vec2& uv : uvs) uv = {uv.y, -uv.x};
    });
    patch.uv_sets.insert(patch.uv_sets.begin(), other);
    EXPECT_EQ(codesOf(patch), Codes{"error uvSetWrong"});
    EXPECT_NE(findingsOf(patch)[0].message.find("follow TEXCOORD_1, but the texture uses TEXCOORD_0"),
              std::string::npos);
    patch.uses[0].uv_set = 1;
    EXPECT_EQ(codesOf(patch), Codes{});
}

TEST(Check, FindsThatATextureTransformWasIgnored) {
    for (const auto& [rotation, scale_v] : {std::pair{1.5707963267948966, 1.0}, {0.0, -1.0}, {3.0, 2.0}}) {
        ScenePrimitive patch = goodPatch();
        patch.uses[0].transform = {.rotation = rotation, .scale = {1, scale_v}};
        EXPECT_EQ(codesOf(patch), Codes{"warning textureTransformIgnored"}) << rotation;
    }
    ScenePrimitive patch = goodPatch();
    patch.uses[0].transform = {.offset = {0.5, 0.5}, .scale = {4, 2}};
    EXPECT_EQ(codesOf(patch), Codes{}) << "this one turns nothing";
}

TEST(Check, FindsEqualVerticesWithDifferentTangents) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [&](auto& tangents) {
        for (std::size_t row = 0; row < kSide; ++row) {
            const std::uint32_t v = seamVertex(1, row);
            tangents[v] = turned(tangents[v], patch.normals[v], 6);
        }
    });
    EXPECT_EQ(codesOf(patch), Codes{"warning splitFramesDiffer"});
    EXPECT_EQ(findingsOf(patch)[0].count, kSide);
    EXPECT_EQ(codesOf(goodPatch(Seam::mirrored)), Codes{}) << "here equal vertices must differ";
}

TEST(Check, FindsTexturesThatNeedDifferentFrames) {
    ScenePrimitive patch = goodPatch();
    patch.uses.push_back({.needed_by = "clearcoatNormalTexture", .place = "/materials/0/extensions/coat"});
    EXPECT_EQ(codesOf(patch), Codes{});
    patch.uses[1].transform.rotation = 1;
    EXPECT_EQ(codesOf(patch), Codes{"warning texturesDisagree"});
    EXPECT_EQ(findingsOf(patch)[0].place, "/materials/0/extensions/coat");
    patch.uses[1].transform = {};
    patch.uses[1].uv_set = 1;
    patch.uv_sets.push_back(patch.uv_sets[0]);
    EXPECT_EQ(codesOf(patch), Codes{}) << "another set with the same directions";
    edit(patch.uv_sets[1], [](auto& uvs) {
        for (Vec2& uv : uvs) uv.x = -uv.x;
    });
    EXPECT_EQ(codesOf(patch), Codes{"warning texturesDisagree"});
}

TEST(Check, WarnsOnlyWhereTheFaultIsTiny) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) { tangents[40].w = -tangents[40].w; });
    EXPECT_EQ(codesOf(patch, {.error_share = 0.5}), (Codes{"warning signsMixed", "warning signsWrong"}));
}

TEST(Check, EveryCodeHasANameAndARemedy) {
    std::set<std::string> names;
    for (std::uint32_t code = 0; code < kFindingCodeCount; ++code) {
        names.insert(findingName(static_cast<FindingCode>(code)));
        EXPECT_GT(std::string(findingRemedy(static_cast<FindingCode>(code))).size(), 20u) << code;
        EXPECT_TRUE(std::string(findingSummary(static_cast<FindingCode>(code))).ends_with(".")) << code;
        EXPECT_TRUE(std::string(findingEffect(static_cast<FindingCode>(code))).ends_with(".")) << code;
    }
    EXPECT_EQ(names.size(), kFindingCodeCount);
    EXPECT_STREQ(findingName(static_cast<FindingCode>(kFindingCodeCount)), "");
}

TEST(ExamineTangents, ReportsWhyTangentsAreNotKept) {
    ScenePrimitive patch = goodPatch(Seam::mirrored);
    const auto why = [&] { return whyTangentsAreWrong(examineTangents(viewOf(patch), CheckOptions{}), {}); };
    EXPECT_EQ(why(), "");
    edit(patch.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t.w = -t.w;
    });
    EXPECT_NE(why().find("every sign is inverted"), std::string::npos);
}

TEST(ExamineTangents, SurvivesASeamWithATangentThatIsNotFinite) {
    ScenePrimitive patch = goodPatch(Seam::turned);
    edit(patch.tangents, [&](auto& tangents) {
        for (std::size_t row = 0; row < kSide; ++row) {
            const std::uint32_t v = seamVertex(0, row);
            tangents[v] = turned(tangents[v], patch.normals[v], -45);
            tangents[seamVertex(1, row)].x = kNan;
        }
    });
    EXPECT_EQ(codesOf(patch).count("error tangentsNotFinite"), 1u);
}

TEST(ExamineTangents, SurvivesGarbage) {
    EXPECT_TRUE(rc::check([] {
        ScenePrimitive patch = goodPatch(Seam::turned);
        const float largest = std::numeric_limits<float>::max();
        const float garbage[] = {0, kNan, largest, -largest, std::numeric_limits<float>::infinity(), 1e-40f, -1};
        const auto spoil = [&](auto& values) {
            for (int i = 0; i < 20; ++i) {
                auto& value = values[static_cast<std::size_t>(anyInt(0, static_cast<int>(values.size()) - 1))];
                float* numbers = reinterpret_cast<float*>(&value);
                numbers[anyInt(0, static_cast<int>(sizeof(value) / sizeof(float)) - 1)] = garbage[anyInt(0, 6)];
            }
        };
        edit(patch.positions, spoil);
        edit(patch.normals, spoil);
        edit(patch.tangents, spoil);
        edit(patch.uv_sets[0], spoil);
        for (const Finding& finding : findingsOf(patch)) {
            RC_ASSERT(finding.count <= finding.total);
            RC_ASSERT(finding.count > 0u);
            RC_ASSERT(finding.surface_share >= 0 && finding.surface_share <= 1);
            RC_ASSERT(std::isfinite(finding.worst_deg));
        }
    }));
}

TEST(CheckFile, RejectsInvalidOptions) {
    for (const CheckOptions& options : {CheckOptions{.direction_deg = -1}, CheckOptions{.error_share = NAN}}) {
        const Result<CheckReport> report = checkFile("unread.glb", options);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().code, ErrorCode::invalidOption);
    }
}

}  // namespace
}  // namespace tspace::test
