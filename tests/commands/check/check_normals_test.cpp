// SPDX-License-Identifier: MIT
// Normals that deviate strongly from their triangles, seams between primitives, and normals that morph targets do not
// update.
#include <gtest/gtest.h>

#include <limits>

#include "commands/check/patch.h"
#include "commands/check/scene_checks.h"
#include "support/shared_data.h"
#include "tspace/check.h"

namespace tspace::test {
namespace {

bool has(const std::vector<Finding>& findings, FindingCode code) {
    return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.code == code; });
}

/// Returns a box with 8 vertices whose normals point away from its center, or with 24 vertices that have the normals of
/// its faces.
ScenePrimitive box(bool is_smooth) {
    std::vector<Vec3> positions, normals;
    std::vector<std::uint32_t> corners;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(positions.size());
            for (const auto& [u, v] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
                std::array<float, 3> p = {}, n = {};
                p[std::size_t(axis)] = n[std::size_t(axis)] = side;
                p[std::size_t(axis + 1) % 3] = u * side;
                p[std::size_t(axis + 2) % 3] = v;
                positions.push_back({p[0], p[1], p[2]});
                const float k = 0.57735027f;
                normals.push_back(is_smooth ? Vec3{k * p[0], k * p[1], k * p[2]} : Vec3{n[0], n[1], n[2]});
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) corners.push_back(first + i);
        }
    }
    ScenePrimitive primitive;
    primitive.place = "/meshes/0/primitives/0";
    primitive.positions = positions;
    primitive.normals = normals;
    primitive.corners = corners;
    return primitive;
}

TEST(CheckNormals, FindsNormalsThatAreFarFromAllTheirTriangles) {
    const auto smooth = findingsOf(box(true));
    ASSERT_EQ(smooth.size(), 1u);
    EXPECT_EQ(smooth.front().code, FindingCode::normalsFarFromFaces);
    EXPECT_EQ(smooth.front().severity, Severity::note);
    EXPECT_NEAR(smooth.front().worst_deg, 54.7, 0.1);
    EXPECT_EQ(findingsOf(box(false)).size(), 0u);
    EXPECT_FALSE(has(findingsOf(goodPatch()), FindingCode::normalsFarFromFaces));
}

/// Returns a strip of a cylinder that starts at the angle `first` and has `count` steps of `step` degrees. `is_own`:
/// selects the normals of the strip's triangles instead of those of the cylinder.
ScenePrimitive strip(std::uint32_t number, double first, int count, double step, bool is_own) {
    std::vector<Vec3> positions, normals;
    std::vector<std::uint32_t> corners;
    const auto direction = [](double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        return Vec3{static_cast<float>(std::cos(a)), 0, static_cast<float>(-std::sin(a))};
    };
    for (int i = 0; i <= count; ++i) {
        for (int y = 0; y < 4; ++y) {
            const Vec3 at = direction(first + i * step);
            positions.push_back({at.x, static_cast<float>(y), at.z});
            const double lean = !is_own ? 0 : i == 0 ? step / 2 : i == count ? -step / 2 : 0;
            normals.push_back(direction(first + i * step + lean));
        }
    }
    for (std::uint32_t i = 0; i < std::uint32_t(count); ++i) {
        for (std::uint32_t y = 0; y < 3; ++y) {
            const std::uint32_t a = 4 * i + y;
            for (const std::uint32_t v : {a, a + 4, a + 5, a, a + 5, a + 1}) corners.push_back(v);
        }
    }
    ScenePrimitive primitive;
    primitive.place = "/meshes/0/primitives/" + std::to_string(number);
    primitive.primitive = number;
    primitive.positions = positions;
    primitive.normals = normals;
    primitive.corners = corners;
    return primitive;
}

std::vector<Finding> seamsOf(std::vector<ScenePrimitive> primitives) {
    Scene scene;
    scene.primitives = std::move(primitives);
    return checkSeams(scene, {});
}

TEST(CheckSeams, FindsOneSurfaceWhosePrimitivesHaveTheirOwnNormals) {
    const auto found = seamsOf({strip(0, 0, 6, 8, true), strip(1, 48, 6, 8, true)});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].code, FindingCode::normalSeam);
    EXPECT_EQ(found[0].severity, Severity::note);
    EXPECT_EQ(found[0].count, 4u);
    EXPECT_NEAR(found[0].worst_deg, 8, 0.1);
    EXPECT_EQ(found[0].place, "/meshes/0/primitives/0");
}

TEST(CheckSeams, ReportsNothingAtPossibleHardEdgesAndSmoothBorders) {
    EXPECT_TRUE(seamsOf({strip(0, 0, 6, 8, false), strip(1, 48, 6, 8, false)}).empty()) << "smooth";
    EXPECT_TRUE(seamsOf({strip(0, 0, 1, 48, true), strip(1, 48, 6, 8, true)}).empty())
        << "a flat side, and one that bends";
    auto other = strip(1, 48, 6, 8, true);
    other.mesh = 1;
    EXPECT_TRUE(seamsOf({strip(0, 0, 6, 8, true), other}).empty()) << "meshes move apart";
    // The angle at the border is larger than the angles of smooth edges elsewhere.
    ScenePrimitive sharp = strip(1, 48, 6, 8, true);
    std::vector<Vec3> positions(sharp.positions.begin(), sharp.positions.end()),
        normals(sharp.normals.begin(), sharp.normals.end());
    const Vec3 pivot = positions[0];
    const double turn = 30 * std::numbers::pi / 180;
    const auto turned = [&](const Vec3& v) {
        return Vec3{static_cast<float>(std::cos(turn) * v.x - std::sin(turn) * -v.z), v.y,
                    static_cast<float>(-(std::sin(turn) * v.x + std::cos(turn) * -v.z))};
    };
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const Vec3 moved = turned({positions[v].x - pivot.x, positions[v].y, positions[v].z - pivot.z});
        if (v >= 4) positions[v] = {moved.x + pivot.x, moved.y, moved.z + pivot.z};
        normals[v] = turned(normals[v]);
    }
    sharp.positions = positions;
    sharp.normals = normals;
    EXPECT_TRUE(seamsOf({strip(0, 0, 6, 8, true), sharp}).empty()) << "a hard edge";
}

/// Returns a flat patch with a target that rolls it up. `how`: factor of the deltas of normals; 1 rotates them with the
/// surface.
ScenePrimitive rolled(double how, bool has_normals = true) {
    constexpr std::uint32_t side = 17;
    std::vector<Vec3> positions, normals, offsets, turns;
    std::vector<std::uint32_t> corners;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const double s = x / 16.0;
            positions.push_back({float(s), float(y / 16.0), 0});
            normals.push_back({0, 0, 1});
            offsets.push_back({float(std::sin(s) - s), 0, float(1 - std::cos(s))});
            turns.push_back({float(how * -std::sin(s)), 0, float(how * (std::cos(s) - 1))});
            const std::uint32_t a = y * side + x;
            if (x + 1 == side || y + 1 == side) continue;
            for (const std::uint32_t v : {a, a + 1, a + side + 1, a, a + side + 1, a + side}) corners.push_back(v);
        }
    }
    ScenePrimitive primitive;
    primitive.place = "/meshes/0/primitives/0";
    primitive.positions = positions;
    primitive.normals = normals;
    primitive.corners = corners;
    primitive.morph_targets = {{.positions = offsets}};
    if (has_normals) primitive.morph_targets[0].normals = turns;
    return primitive;
}

TEST(CheckMorphNormals, FindsMissingAndWrongDeltas) {
    EXPECT_TRUE(findingsOf(rolled(1)).empty());
    EXPECT_TRUE(findingsOf(rolled(0.9)).empty()) << "other weights";
    for (const auto& [primitive, code] : {std::pair(rolled(0), FindingCode::morphNormalsMissing),
                                          std::pair(rolled(0, false), FindingCode::morphNormalsMissing),
                                          std::pair(rolled(-1), FindingCode::morphNormalsWrong)}) {
        const auto findings = findingsOf(primitive);
        ASSERT_EQ(findings.size(), 1u);
        EXPECT_EQ(findings.front().code, code);
        EXPECT_EQ(findings.front().place, "/meshes/0/primitives/0/targets/0");
    }
    EXPECT_EQ(findingsOf(rolled(0)).front().severity, Severity::warning);
    EXPECT_EQ(findingsOf(rolled(-1)).front().severity, Severity::error) << "114 degrees off";
    ScenePrimitive unlit = rolled(-1);
    unlit.is_unlit = true;
    EXPECT_TRUE(findingsOf(unlit).empty());
}

/// A target that mirrors a part flips its triangles, and exporters write the normals of the mirrored part. Halfway
/// between base and target all triangles collapse, so both directions of the normals are acceptable.
TEST(CheckMorphNormals, DoesNotJudgeWhereTrianglesAreFlipped) {
    for (const float turn : {-2.0f, 0.0f, -1.9f}) {
        ScenePrimitive mirrored = rolled(1);
        std::vector<Vec3> offsets;
        for (const Vec3& position : mirrored.positions) offsets.push_back({-2 * position.x, 0, 0.3f * position.x});
        mirrored.morph_targets[0].positions = offsets;
        mirrored.morph_targets[0].normals = std::vector<Vec3>(offsets.size(), Vec3{0.2f, 0, turn});
        EXPECT_TRUE(findingsOf(mirrored).empty()) << turn;
    }
    // Normals next to a flipped triangle are still checked.
    ScenePrimitive folded = rolled(-1);
    edit(folded.morph_targets[0].positions, [&](auto& offsets) { offsets[40] = {0.5f, 0, 0}; });
    EXPECT_EQ(findingsOf(folded).front().code, FindingCode::morphNormalsWrong);
}

TEST(CheckMorphNormals, JudgesTheChangeAndNotTheNormals) {
    ScenePrimitive tilted = rolled(1);
    const Vec3 lean{0, 0.6f, 0.8f};
    std::vector<Vec3> offsets;
    for (const Vec3& turn : tilted.morph_targets[0].normals) offsets.push_back({0.8f * turn.x, 0, 0.8f * turn.z});
    tilted.normals = std::vector<Vec3>(tilted.positions.size(), lean);
    tilted.morph_targets[0].normals = offsets;
    EXPECT_TRUE(findingsOf(tilted).empty());
}

// Some exporters, such as Blender, recompute the normals of a morph target from its displaced triangles.

/// Returns a square of two triangles from x = `left` to `left` + 1 that faces +z.
ScenePrimitive squareFrom(float left) {
    ScenePrimitive square;
    square.place = "/meshes/0/primitives/0";
    square.positions = std::vector<Vec3>{{left, 0, 0}, {left + 1, 0, 0}, {left + 1, 1, 0}, {left, 1, 0}};
    square.normals = std::vector<Vec3>(4, Vec3{0, 0, 1});
    square.corners = std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3};
    return square;
}

/// Returns a target that moves vertices and assigns these normals.
SceneMorphTarget targetOf(std::vector<Vec3> offsets, const std::vector<Vec3>& normals) {
    std::vector<Vec3> turns;
    for (const Vec3& normal : normals) turns.push_back(normal - Vec3{0, 0, 1});
    return {.positions = std::move(offsets), .normals = std::move(turns)};
}

std::size_t wrongNormals(const ScenePrimitive& primitive, std::span<const ScenePrimitive> all) {
    const PrimitiveVerdict verdict = judgePrimitive(primitive, {}, true, all);
    return static_cast<std::size_t>(
        std::count_if(verdict.findings.begin(), verdict.findings.end(),
                      [](const Finding& finding) { return finding.code == FindingCode::morphNormalsWrong; }));
}

TEST(CheckMorphNormals, OfBentPolygonsMayBeThoseOfTheWholePolygon) {
    ScenePrimitive square = squareFrom(0);
    const Vec3 of_polygon{-0.348F, -0.348F, 0.87F};
    square.morph_targets = {targetOf({{}, {}, {0, 0, 0.8F}, {}}, std::vector<Vec3>(4, of_polygon))};
    EXPECT_EQ(wrongNormals(square, {}), 0u);
    square.morph_targets = {targetOf({{}, {}, {0, 0, 0.8F}, {}}, std::vector<Vec3>(4, Vec3{0.6F, 0.6F, 0.53F}))};
    EXPECT_EQ(wrongNormals(square, {}), 1u);
}

TEST(CheckMorphNormals, AtBordersAreThoseOfTheWholeMesh) {
    std::vector<ScenePrimitive> roof = {squareFrom(-1), squareFrom(0)};
    const Vec3 left{-0.7071F, 0, 0.7071F}, right{0.7071F, 0, 0.7071F}, ridge{0, 0, 1};
    const auto raise = [&](const Vec3& at_ridge) {
        roof[0].morph_targets = {targetOf({{}, {0, 0, 1}, {0, 0, 1}, {}}, {left, at_ridge, at_ridge, left})};
        roof[1].morph_targets = {targetOf({{0, 0, 1}, {}, {}, {0, 0, 1}}, {at_ridge, right, right, at_ridge})};
    };
    raise(ridge);
    for (const ScenePrimitive& side : roof) {
        EXPECT_EQ(wrongNormals(side, roof), 0u);
        EXPECT_EQ(wrongNormals(side, {}), 1u) << "alone it does not fit";
    }
    raise({0, 0.95F, 0.3F});
    for (const ScenePrimitive& side : roof) EXPECT_EQ(wrongNormals(side, roof), 1u);
    // A surface does not continue in a different mesh at the same position.
    raise(ridge);
    roof[1].mesh = 1;
    EXPECT_EQ(wrongNormals(roof[0], roof), 1u);
}

TEST(CheckMorphNormals, TiltedNormalsMayTiltOppositelyIfAFaceRotates) {
    ScenePrimitive square = squareFrom(0);
    square.normals = std::vector<Vec3>(4, Vec3{0.6F, 0, 0.8F});
    const std::vector<Vec3> spin = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
    square.morph_targets = {{.positions = spin, .normals = std::vector<Vec3>(4, Vec3{-1.2F, 0, 0})}};
    EXPECT_EQ(wrongNormals(square, {}), 0u);
    square.morph_targets = {{.positions = spin, .normals = std::vector<Vec3>(4, Vec3{-1.55F, 0, -0.5F})}};
    EXPECT_EQ(wrongNormals(square, {}), 1u);
}

TEST(CheckMorphNormals, FindsOneOffsetThatIsNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        for (const bool in_normals : {false, true}) {
            ScenePrimitive primitive = rolled(1);
            primitive.morph_targets.push_back(primitive.morph_targets[0]);
            SharedArray<Vec3>& array =
                in_normals ? primitive.morph_targets[1].normals : primitive.morph_targets[1].positions;
            edit(array, [&](auto& offsets) { offsets[40].y = bad; });
            const FindingCode code = in_normals ? FindingCode::normalsNotFinite : FindingCode::positionsNotFinite;
            const auto findings = findingsOf(primitive);
            const auto found = std::find_if(findings.begin(), findings.end(),
                                            [&](const Finding& finding) { return finding.code == code; });
            ASSERT_NE(found, findings.end());
            EXPECT_EQ(found->severity, Severity::error);
            EXPECT_EQ(found->count, 1u);
            EXPECT_EQ(found->vertices, std::vector<std::uint32_t>{40});
            EXPECT_EQ(found->place, "/meshes/0/primitives/0/targets/1");
            EXPECT_NE(found->message.find("target 1"), std::string::npos);
            EXPECT_EQ(found->remedy.find("--morph-normals all") != std::string::npos, in_normals);
            primitive.corners = std::vector<std::uint32_t>{0, 1, 18};
            EXPECT_FALSE(has(findingsOf(primitive), code)) << "no triangle uses it";
        }
    }
}

TEST(CheckMorphNormals, FindsOneNormalThatATargetCancels) {
    ScenePrimitive primitive = rolled(1);
    edit(primitive.morph_targets[0].normals, [](auto& offsets) { offsets[40] = {0, 0, -1}; });
    const auto findings = findingsOf(primitive);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings.front().code, FindingCode::morphNormalsWrong);
    EXPECT_EQ(findings.front().severity, Severity::error);
    EXPECT_EQ(findings.front().vertices, std::vector<std::uint32_t>{40});
    primitive.morph_targets[0].positions = {};
    EXPECT_EQ(findingsOf(primitive).front().remedy, "Export the normals of the targets again.");
}

TEST(CheckMorphNormals, ReportsTheFaultsOfFiles) {
    TSPACE_NEEDS_SHARED("reports/morph_right.glb");
    const auto find = [](const char* name) {
        const auto report = checkFile(shared(std::string("reports/") + name).string());
        EXPECT_TRUE(report);
        return report->findings;
    };
    EXPECT_TRUE(has(find("morph_normal_is_position.glb"), FindingCode::morphNormalsWrong));
    EXPECT_TRUE(has(find("morph_pos_only.glb"), FindingCode::morphNormalsMissing));
    EXPECT_FALSE(has(find("morph_right.glb"), FindingCode::morphNormalsWrong));
    EXPECT_FALSE(has(find("morph_right.glb"), FindingCode::morphNormalsMissing));
    EXPECT_TRUE(has(find("pillar_smoothed.glb"), FindingCode::normalsFarFromFaces));
}

}  // namespace
}  // namespace tspace::test
