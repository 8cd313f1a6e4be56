// SPDX-License-Identifier: MIT
// KHR_texture_transform: its effect on tangents, and data that it does not affect.
#include <gtest/gtest.h>

#include <cmath>

#include "generate_run.h"

namespace tspace {
namespace {

using namespace test;

constexpr double kQuarter = 1.5707963705062866;  // 90 degrees as a float, as stored in files

GltfBuilder transformed(const Json& transform, bool mirrored_grid = false) {
    GltfBuilder builder = gridModel(Grid(4, mirrored_grid));
    builder.json()["extensionsUsed"] = {"KHR_texture_transform"};
    builder.json()["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = transform;
    return builder;
}

std::vector<Vec4> tangentsOf(const GltfBuilder& builder, const GenerateOptions& options = {}) {
    const GenerateRun outcome = run(builder, options);
    return readTangents(outcome.after, outcome.primitives.at(0));
}

/// Checks all tangents. In the grid, u increases along x and v against y, so without a transform every tangent is (1,
/// 0, 0, 1).
void expectAll(const std::vector<Vec4>& tangents, const Vec4& expected) {
    for (const Vec4& tangent : tangents) {
        EXPECT_NEAR(tangent.x, expected.x, 1e-6);
        EXPECT_NEAR(tangent.y, expected.y, 1e-6);
        EXPECT_NEAR(tangent.z, expected.z, 1e-6);
        EXPECT_EQ(tangent.w, expected.w);
    }
}

TEST(TextureTransform, RotatesTangentsLikeTheImage) {
    // The UVs are rotated counter-clockwise, so the image is rotated clockwise, and its right direction points down.
    expectAll(tangentsOf(transformed({{"rotation", kQuarter}})), {0, -1, 0, 1});
    expectAll(tangentsOf(transformed({{"rotation", -kQuarter}})), {0, 1, 0, 1});
    expectAll(tangentsOf(transformed({{"rotation", 2 * kQuarter}})), {-1, 0, 0, 1});
    const auto c = static_cast<float>(std::cos(0.5)), s = static_cast<float>(std::sin(0.5));
    expectAll(tangentsOf(transformed({{"rotation", 0.5}})), {c, -s, 0, 1});
    expectAll(tangentsOf(transformed({{"rotation", 0.5}, {"scale", {7, 7}}})), {c, -s, 0, 1});
}

TEST(TextureTransform, FlipsTheSignWhereItMirrors) {
    expectAll(tangentsOf(transformed({{"scale", {-1, 1}}, {"offset", {1, 0}}})), {-1, 0, 0, -1});
    expectAll(tangentsOf(transformed({{"scale", {1, -1}}, {"offset", {0, 1}}})), {1, 0, 0, -1});
    expectAll(tangentsOf(transformed({{"scale", {-2, -3}}})), {-1, 0, 0, 1});
    expectAll(tangentsOf(transformed({{"rotation", kQuarter}, {"scale", {6, -2}}})), {0, 1, 0, -1});
}

/// Adds correct tangents for the UVs without the transform.
GltfBuilder withTangentsOfUvs(GltfBuilder builder) {
    std::vector<float> tangents;
    for (int v = 0; v < 25; ++v) tangents.insert(tangents.end(), {1, 0, 0, 1});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    return builder;
}

TEST(TextureTransform, ThatTangentsIgnoredDoesNotInvertSignsWhenNormalsAreRecomputed) {
    GenerateOptions options;
    options.normals.overwrite = true;
    const auto recomputed = [&](const Json& transform) {
        return tangentsOf(withTangentsOfUvs(transformed(transform)), options);
    };
    expectAll(recomputed({{"scale", {-1, 1}}}), {-1, 0, 0, -1});
    expectAll(recomputed({{"scale", {-2, 3}}}), {-1, 0, 0, -1});
    expectAll(recomputed({{"rotation", kQuarter}, {"scale", {6, -2}}}), {0, 1, 0, -1});
    expectAll(recomputed({{"rotation", kQuarter}}), {0, -1, 0, 1});
}

TEST(TextureTransform, ScalesBeforeItRotates) {
    // u' = c su u + s sv v and v' = -s su u + c sv v, with u = x and v = -y. Along T, v' is constant and u' increases.
    const double c = std::cos(0.4), s = std::sin(0.4), su = 3, sv = 0.5;
    const double x = c / su, y = -s / sv, length = std::sqrt(x * x + y * y);
    expectAll(tangentsOf(transformed({{"rotation", 0.4}, {"scale", {su, sv}}})),
              {static_cast<float>(x / length), static_cast<float>(y / length), 0, 1});
}

TEST(TextureTransform, ChangesNoBitWhereItOnlyShiftsOrStretches) {
    const std::vector<Vec4> expected = tangentsOf(gridModel(Grid(4)));
    for (const char* transform : {R"({})", R"({"offset":[0.3,0.7]})", R"({"scale":[3,0.1]})", R"({"rotation":0})",
                                  R"({"scale":[0.00001526,0.00001526],"offset":[0.25,0]})"}) {
        EXPECT_EQ(tangentsOf(transformed(Json::parse(transform), true)), expected) << transform;
    }
}

TEST(TextureTransform, GivesValidTangentsForExtremeTransforms) {
    for (const double number : {0.0, -0.0, 1e-320, 1e-30, -1e30, 1e308, -1.7e308, 12345.678}) {
        for (const Json& transform :
             {Json{{"rotation", number}}, Json{{"scale", {number, 1}}},
              Json{{"scale", {number, -number}}, {"rotation", 0.3}}, Json{{"scale", {1, number}}, {"rotation", number}},
              Json{{"offset", {number, 0}}}}) {
            for (const Vec4& t : tangentsOf(transformed(transform, true))) {
                EXPECT_NEAR(t.x * t.x + t.y * t.y + t.z * t.z, 1, 1e-5) << transform;
                EXPECT_EQ(std::fabs(t.w), 1) << transform;
            }
        }
    }
}

TEST(TextureTransform, IsIgnoredOnRequest) {
    const auto options = [](TextureTransform reading) {
        return GenerateOptions{.tangents = {.texture_transform = reading}};
    };
    const GltfBuilder builder = transformed({{"rotation", 1}, {"scale", {-1, 1}}}, true);
    EXPECT_EQ(tangentsOf(builder, options(TextureTransform::ignore)), tangentsOf(gridModel(Grid(4))));
    EXPECT_NE(tangentsOf(builder, options(TextureTransform::apply)), tangentsOf(gridModel(Grid(4))));
}

TEST(TextureTransform, IsReportedInANote) {
    const auto notes = [](const Json& transform, TextureTransform reading) {
        return run(transformed(transform), {.tangents = {.texture_transform = reading}}).report.primitives.at(0).notes;
    };
    const Json turn = {{"rotation", 1}}, mirror = {{"scale", {-1, 1}}}, stretch = {{"scale", {2, 3}}};
    EXPECT_EQ(notes(turn, TextureTransform::apply),
              std::vector<std::string>{"KHR_texture_transform rotates normalTexture of material 0: the tangents follow "
                                       "the transformed UVs"});
    EXPECT_EQ(notes(mirror, TextureTransform::ignore),
              std::vector<std::string>{"KHR_texture_transform mirrors normalTexture of material 0: as requested, the "
                                       "tangents follow the UVs before the transform"});
    EXPECT_TRUE(notes(stretch, TextureTransform::apply).empty());
}

TEST(TextureTransform, SeparatesSharedVerticesOnlyIfTangentsDiffer) {
    GltfBuilder builder = transformed({{"rotation", 1}});
    Json& materials = builder.json()["materials"];
    const auto add = [&](const Json& transform) {
        materials.push_back(materials[0]);
        materials.back()["normalTexture"]["extensions"]["KHR_texture_transform"] = transform;
        Json& primitives = builder.json()["meshes"][0]["primitives"];
        primitives.push_back(Json(primitives[0]));
        primitives.back()["material"] = materials.size() - 1;
    };
    add({{"rotation", 1}, {"scale", {5, 5}}, {"offset", {1, 2}}});
    add({{"rotation", 2}});
    const GenerateRun outcome = run(builder);
    const auto tangent = [&](std::size_t i) { return outcome.primitives.at(i).find("TANGENT"); };
    EXPECT_EQ(tangent(0), tangent(1)) << "a common scale turns nothing";
    EXPECT_NE(tangent(0), tangent(2));
    EXPECT_EQ(outcome.primitives[0].find("POSITION"), outcome.primitives[2].find("POSITION"));
}

TEST(TextureTransform, OfAnotherTextureIsNotedWhereOneTangentCannotServeBoth) {
    GltfBuilder builder = transformed({{"rotation", 1}});
    Json& material = builder.json()["materials"][0];
    const auto notes = [&](const char* coat) {
        material["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = Json::parse(coat);
        std::vector<std::string> all = run(builder).report.primitives.at(0).notes;
        all.erase(all.begin());  // the note about the rotated normalTexture
        return all;
    };
    EXPECT_TRUE(notes(R"({"index":0,"extensions":{"KHR_texture_transform":{"rotation":1,"offset":[2,2]}}})").empty());
    EXPECT_EQ(notes(R"({"index":0})"),
              std::vector<std::string>{"the tangents fit the KHR_texture_transform of normalTexture of material 0, but "
                                       "clearcoatNormalTexture of material 0 is rotated or mirrored differently"});
    EXPECT_EQ(notes(R"({"index":0,"texCoord":1})"),
              std::vector<std::string>{"the tangents follow TEXCOORD_0 for normalTexture of material 0, but "
                                       "clearcoatNormalTexture of material 0 uses TEXCOORD_1"});
}

TEST(TextureTransform, IsNotedIfAnimated) {
    GltfBuilder builder = transformed({{"offset", {0, 0}}});
    const auto notes = [&](const std::string& member) {
        const std::string pointer = "/materials/0/normalTexture/extensions/KHR_texture_transform/" + member;
        builder.json()["animations"] = Json::array({Json{
            {"samplers", Json::array()},
            {"channels",
             Json::array({Json{
                 {"sampler", 0},
                 {"target",
                  {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}}})}}});
        return run(builder).report.primitives.at(0).notes;
    };
    EXPECT_EQ(notes("rotation").size(), 1u);
    EXPECT_EQ(notes("scale").size(), 1u);
    EXPECT_TRUE(notes("offset").empty()) << "a shift turns no tangent";
}

}  // namespace
}  // namespace tspace
