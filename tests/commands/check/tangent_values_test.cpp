// SPDX-License-Identifier: MIT
// Requirements on tangents that do not depend on UVs, and deviations that are not faults of tangents: authored tangents
// and rounded positions.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "commands/check/patch.h"

namespace tspace::test {
namespace {

using Codes = std::set<std::string>;
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// Returns a patch whose second half has no UV area, but has tangents in its surface.
ScenePrimitive halfWithoutUvArea() {
    ScenePrimitive patch = goodPatch();
    edit(patch.uv_sets[0], [](auto& uvs) {
        for (std::size_t v = kHalf; v < uvs.size(); ++v) uvs[v] = uvs[kHalf];
    });
    return patch;
}

TEST(Check, FindsTangentsParallelToTheNormalWithoutUvArea) {
    const auto leaning = [](double degrees) {
        ScenePrimitive patch = halfWithoutUvArea();
        edit(patch.tangents, [&](auto& tangents) {
            const double angle = degrees * std::numbers::pi / 180;
            for (std::size_t v = kHalf; v < tangents.size(); ++v) {
                const DVec3 t =
                    std::sin(angle) * toDouble(xyz(tangents[v])) + std::cos(angle) * toDouble(patch.normals[v]);
                tangents[v] = {toFloat(t).x, toFloat(t).y, toFloat(t).z, tangents[v].w};
            }
        });
        return codesOf(patch);
    };
    const Codes sound{"warning uvsDegenerate"}, broken{"warning uvsDegenerate", "error tangentsNotOrthogonal"};
    EXPECT_EQ(codesOf(halfWithoutUvArea()), sound);
    for (const double degrees : {0.0, 2.0, 4.5, 176.0, 180.0}) EXPECT_EQ(leaning(degrees), broken) << degrees;
    EXPECT_EQ(leaning(30), sound) << "a lean that nobody sees";
}

TEST(Check, ReportsAFewTangentsParallelToTheNormalSeparately) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [&](auto& tangents) {
        for (std::size_t v = 0; v < tangents.size(); ++v) {
            DVec3 t = toDouble(xyz(tangents[v])) + 0.3 * toDouble(patch.normals[v]);
            if (v == 40) t = toDouble(patch.normals[v]);
            normalize(t);
            tangents[v] = {toFloat(t).x, toFloat(t).y, toFloat(t).z, tangents[v].w};
        }
    });
    EXPECT_EQ(codesOf(patch, {.error_share = 0.1}),
              (Codes{"error tangentsNotOrthogonal", "warning tangentsNotOrthogonal"}));
}

TEST(Check, FindsBrokenValuesAtVerticesThatNoTriangleUses) {
    ScenePrimitive patch = goodPatch();
    edit(patch.positions, [](auto& positions) { positions.push_back({}); });
    edit(patch.normals, [](auto& normals) { normals.push_back({0, 0, 1}); });
    edit(patch.uv_sets[0], [](auto& uvs) { uvs.push_back({}); });
    edit(patch.tangents, [](auto& tangents) { tangents.push_back({1, 0, 0, 1}); });
    EXPECT_EQ(codesOf(patch), Codes{});
    edit(patch.tangents, [](auto& tangents) { tangents.back() = {0, 0, 0, 0}; });
    EXPECT_EQ(codesOf(patch), (Codes{"warning tangentsNotUnit", "warning signsNotOne"}));
    edit(patch.tangents, [](auto& tangents) { tangents.back() = {kNotANumber, 0, 0, 1}; });
    EXPECT_EQ(codesOf(patch), Codes{"warning tangentsNotFinite"}) << "nobody sees it";
}

/// Brushed metal: a material with anisotropy but without a texture for it; tangents are along the strokes.
TEST(Check, ChecksOnlyValuesIfNoTextureUsesTheTangents) {
    ScenePrimitive patch = goodPatch();
    patch.uses = {{.needed_by = "anisotropy", .has_texture = false}};
    edit(patch.tangents, [&](auto& tangents) {
        for (std::size_t v = 0; v < tangents.size(); ++v) tangents[v] = turned(tangents[v], patch.normals[v], 60);
    });
    EXPECT_EQ(codesOf(patch), Codes{});
    ScenePrimitive bare = patch;
    bare.uv_sets = {};
    EXPECT_EQ(codesOf(bare), Codes{}) << "UVs are not needed";
    ScenePrimitive hair = patch;
    hair.uses = {};
    EXPECT_EQ(codesOf(hair), Codes{"note tangentsUnused"});
    hair.other_reader = "the material extension EXT_hair";
    EXPECT_EQ(codesOf(hair), Codes{});
    ScenePrimitive mapped = patch;
    mapped.uses.push_back({.needed_by = "normalTexture"});
    EXPECT_EQ(codesOf(mapped), Codes{"error directionsWrong"}) << "a normal map is read with them";
    edit(patch.tangents, [](auto& tangents) { tangents[40] = {0, 0, 0, 1}; });
    EXPECT_EQ(codesOf(patch), Codes{"error tangentsNotUnit"});
}

TEST(Check, NamesTheAxesOfUnconvertedTangents) {
    ScenePrimitive patch = goodPatch();
    edit(patch.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t = {t.x, -t.z, t.y, t.w};  // converted to Z up
    });
    const std::vector<Finding> findings = findingsOf(patch);
    const std::string& message = only(findings, FindingCode::directionsWrong).message;
    EXPECT_NE(message.find("they fit if the stored vectors are read as (x, z, -y)"), std::string::npos) << message;
    const PrimitiveVerdict verdict = judgePrimitive(patch, {}, true);
    for (const std::uint32_t bits : verdict.faults) EXPECT_NE(bits & faultBit(FindingCode::directionsWrong), 0u);
}

/// Like a tile of a globe in the globe's coordinates, stored as floats: positions far from the origin are rounded.
TEST(Check, AttributesErrorsToRoundedPositions) {
    ScenePrimitive patch = goodPatch();
    const auto moveBy = [&](float offset) {
        ScenePrimitive moved = patch;
        edit(moved.positions, [&](auto& positions) {
            for (Vec3& p : positions) p = {10 * p.x + offset, 10 * p.y - offset, 10 * p.z + offset};
        });
        return moved;
    };
    EXPECT_EQ(codesOf(moveBy(0)), Codes{});
    const std::vector<Finding> findings = findingsOf(moveBy(5e6f));
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].code, FindingCode::positionsRounded);
    EXPECT_NE(findings[0].message.find("steps of 0.5"), std::string::npos) << findings[0].message;
    edit(patch.tangents, [](auto& tangents) { tangents[40] = {0, 0, 0, 1}; });
    EXPECT_EQ(codesOf(moveBy(5e6f)), (Codes{"warning positionsRounded", "error tangentsNotUnit"}))
        << "values are no matter of rounding";
}

ScenePrimitive roundedPatch(double step) {
    ScenePrimitive patch = goodPatch();
    edit(patch.positions, [&](auto& positions) {
        for (Vec3& p : positions) {
            const auto rounded = [&](float value) {
                return static_cast<float>(std::round(double{value} / step) * step);
            };
            p = {rounded(p.x), rounded(p.y), rounded(p.z)};
        }
    });
    return patch;
}

/// Positions are rounded to decimals, to a binary fraction, and to fractions of a bounding box. Edges are half a step
/// to three steps long.
TEST(Check, DetectsPositionsRoundedNearTheOrigin) {
    for (const double step : {0.1, 0.125, 0.2, 0.25, 0.3, 7.0 / 65535 * 2000}) {
        EXPECT_EQ(codesOf(roundedPatch(step)), Codes{"warning positionsRounded"}) << step;
        ScenePrimitive wrong = roundedPatch(step);
        edit(wrong.tangents, [](auto& tangents) { tangents[40] = {0, 0, 0, 1}; });
        EXPECT_EQ(codesOf(wrong), (Codes{"error tangentsNotUnit", "warning positionsRounded"})) << step;
    }
    EXPECT_EQ(codesOf(roundedPatch(0.001)), Codes{}) << "fine enough";
    ScenePrimitive bare = roundedPatch(0.2);
    bare.tangents = {};
    bare.uses.clear();
    EXPECT_EQ(codesOf(bare).count("warning positionsRounded"), 0u) << "no tangents, and none are needed";
}

/// If positions were modeled on a grid, they are not rounded: triangles match the UVs, and wrong tangents are reported.
TEST(Check, TreatsModelsBuiltOnAGridAsExact) {
    for (const float step : {1.0F, 0.1F}) {
        ScenePrimitive grid = goodPatch();
        edit(grid.positions, [&](auto& positions) {
            for (std::size_t v = 0; v < positions.size(); ++v) {
                const std::size_t half = v / kHalf, row = v % kHalf / kSide, column = v % kSide + half * (kSide - 1);
                // A slope of 45 degrees along v.
                positions[v] = {step * static_cast<float>(column), step * static_cast<float>(row),
                                -step * static_cast<float>(row)};
            }
        });
        edit(grid.normals, [](auto& normals) {
            for (Vec3& n : normals) n = {0, 0.70710678F, 0.70710678F};
        });
        edit(grid.tangents, [](auto& tangents) {
            for (Vec4& t : tangents) t = {1, 0, 0, t.w};
        });
        EXPECT_EQ(codesOf(grid), Codes{}) << step;
        edit(grid.tangents, [](auto& tangents) {
            for (Vec4& t : tangents) t = {0, 0.70710678F, -0.70710678F, t.w};
        });
        EXPECT_EQ(codesOf(grid), Codes{"error directionsWrong"}) << step;
    }
}

/// Terrain in meters of a map projection, with a grid spacing of one meter.
TEST(Check, TreatsRastersFarFromTheOriginAsExact) {
    ScenePrimitive terrain = goodPatch();
    edit(terrain.positions, [&](auto& positions) {
        edit(terrain.normals, [&](auto& normals) {
            for (std::size_t v = 0; v < positions.size(); ++v) {
                const std::size_t half = v / kHalf, row = v % kHalf / kSide, column = v % kSide;
                const double x = static_cast<double>(column + half * (kSide - 1)), z = static_cast<double>(row);
                positions[v] =
                    toFloat(DVec3{500000 + x, 0.6 * std::sin(0.4 * x) + 0.5 * std::cos(0.3 * z), 4500000 - z});
                DVec3 n{-0.24 * std::cos(0.4 * x), 1, -0.15 * std::sin(0.3 * z)};
                normalize(n);
                normals[v] = toFloat(n);
            }
        });
    });
    terrain.tangents = tangentsOf(terrain);
    EXPECT_EQ(codesOf(terrain), Codes{});
    edit(terrain.tangents, [](auto& tangents) {
        for (Vec4& t : tangents) t = {-t.x, -t.y, -t.z, -t.w};
    });
    EXPECT_EQ(codesOf(terrain), Codes{"error directionsWrong"});
}

TEST(Check, TreatsUnreadableTangentsAsMissing) {
    ScenePrimitive patch = goodPatch();
    patch.tangents = {};
    patch.tangent_faults = {{.why = "they do not have 4 components"}};
    EXPECT_EQ(codesOf(patch), Codes{"error tangentsUnreadable"});
}

}  // namespace
}  // namespace tspace::test
