// SPDX-License-Identifier: MIT
// checkFile: findings for a whole file, their locations and order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "commands/check/test_model.h"
#include "tspace/generate.h"

namespace tspace::test {
namespace {

using gltf::Json;

/// Frames are relative to the mesh's own coordinate system.
TEST(CheckFile, IgnoresNodeTransforms) {
    const TestModel still;
    TestModel moved;
    const std::size_t times = moved.builder.addAccessor(std::vector<float>{0, 1}, 5126, "SCALAR", 2);
    const std::size_t scales = moved.builder.addFloats({1, 1, 1, -2, 0, 3}, 3);
    moved.builder.json()["nodes"] = Json::parse(R"([{"mesh":0,"scale":[-1,2,0.5]}])");
    moved.builder.json()["animations"] = Json::array(
        {Json{{"samplers", Json::array({Json{{"input", times}, {"output", scales}}})},
              {"channels", Json::array({Json{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}})}}});
    const CheckReport a = still.check(), b = moved.check();
    ASSERT_EQ(a.findings.size(), b.findings.size());
    for (std::size_t i = 0; i < a.findings.size(); ++i) EXPECT_EQ(a.findings[i].message, b.findings[i].message);
    const TestModel inverted(false, true);
    EXPECT_GT(inverted.check().error_count, a.error_count);
}

TEST(CheckFile, FindsNothingInACorrectFile) {
    const CheckReport report = TestModel().check();
    EXPECT_EQ(codes(report), CodeCounts{});
    EXPECT_EQ(report.primitive_count, 1u);
    EXPECT_EQ(report.tangents_count, 1u);
    EXPECT_EQ(report.image_count, 1u);
    EXPECT_EQ(report.format, "gltf");
}

TEST(CheckFile, StatesTheLocationAndTheObject) {
    const CheckReport report = TestModel(false, true).check();
    ASSERT_EQ(codes(report), CodeCounts{"error signsInverted"});
    const Finding& finding = report.findings[0];
    EXPECT_EQ(finding.place, "/meshes/0/primitives/0");
    EXPECT_EQ(finding.mesh_name, "patch");
    EXPECT_EQ(finding.material_name, "skin");
    EXPECT_EQ(finding.count, 2 * kHalf);
    EXPECT_EQ(finding.vertices.size(), 8u);
    EXPECT_EQ(finding.remedy, findingRemedy(FindingCode::signsInverted));
    EXPECT_EQ(report.error_count, 1u);
}

/// Programs show the effect of a finding, its cause and its remedy; they need not parse the message.
TEST(CheckFile, StatesTheCauseWithoutTheSymptom) {
    const Finding inverted = TestModel(false, true).check().findings.at(0);
    EXPECT_EQ(inverted.message, "bumps look like dents along v: " + inverted.cause);
    EXPECT_EQ(inverted.cause.substr(0, 22), "every sign is inverted");
    // Clauses that are added when the whole file is known belong to the cause.
    const CheckReport both = TestModel(true, true).check();
    ASSERT_EQ(codes(both), (CodeCounts{"warning signsInverted", "note greenFlipped"}));
    for (const Finding& finding : both.findings) {
        EXPECT_TRUE(finding.message.ends_with(": " + finding.cause)) << finding.message;
        EXPECT_TRUE(finding.cause.ends_with("the two inversions cancel out")) << finding.cause;
    }
}

TEST(CheckFile, FindsANormalMapWhoseGreenPointsDown) {
    const CheckReport report = TestModel(true).check();
    ASSERT_EQ(codes(report), CodeCounts{"warning greenFlipped"});
    EXPECT_EQ(report.findings[0].place, "/materials/0/normalTexture");
    EXPECT_GT(report.findings[0].confidence, 0.9);
    EXPECT_NE(report.findings[0].message.find("'normal.png'"), std::string::npos);
    EXPECT_EQ(codes(TestModel(true).check({.images = false})), CodeCounts{});
}

TEST(CheckFile, DetectsThatInvertedSignsAndGreenDownCancelOut) {
    const CheckReport report = TestModel(true, true).check();
    EXPECT_EQ(codes(report), (CodeCounts{"warning signsInverted", "note greenFlipped"}));
    for (const Finding& finding : report.findings) {
        EXPECT_NE(finding.message.find("cancel out"), std::string::npos) << finding.message;
    }
    TestModel mixed(true, true);
    addPatch(mixed.builder, goodPatch());
    EXPECT_EQ(codes(mixed.check()), (CodeCounts{"warning signsInverted", "warning greenFlipped"}))
        << "not in the other patch";
}

/// Returns a map whose left half has green up and whose right half has green down.
RgbImage halfFlipped() {
    RgbImage map = normalMapOf(512, bumps);
    for (std::size_t y = 0; y < 512; ++y) {
        for (std::size_t x = 256; x < 512; ++x) map.rgb[3 * (512 * y + x) + 1] ^= 0xff;
    }
    return map;
}

/// Adds the left or right half of a square, with UVs of the same half of the image. `move`: added to the UVs, in whole
/// repeats of the image.
void addHalf(GltfBuilder& builder, bool is_right, float move = 0) {
    const float left = is_right ? 0.5f : 0, right = left + 0.5f;
    std::vector<float> normals, tangents;
    for (int i = 0; i < 4; ++i) {
        normals.insert(normals.end(), {0, 0, 1});
        tangents.insert(tangents.end(), {1, 0, 0, 1});
    }
    const std::size_t indices = builder.addAccessor(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, 5125, "SCALAR", 6);
    Json& primitive = builder.addPrimitive(
        {{"POSITION", builder.addFloats({left, 0, 0, right, 0, 0, right, 1, 0, left, 1, 0}, 3)},
         {"NORMAL", builder.addFloats(normals, 3)},
         {"TANGENT", builder.addFloats(tangents, 4)},
         {"TEXCOORD_0",
          builder.addFloats({left + move, 1 - move, right + move, 1 - move, right + move, -move, left + move, -move},
                            2)}});
    primitive["indices"] = indices;
    primitive["material"] = 0;
}

CheckReport checkHalves(const TempFolder& folder, bool with_left, bool with_right, const char* transform = nullptr) {
    folder.write("normal.png", pngFile(halfFlipped()));
    GltfBuilder builder;
    if (with_left) addHalf(builder, false, 3);
    if (with_right) addHalf(builder, true, -2);
    builder.json()["images"] = Json::parse(R"([{"uri":"normal.png"}])");
    builder.json()["textures"] = Json::parse(R"([{"source":0}])");
    builder.json()["materials"] = Json::parse(R"([{"normalTexture":{"index":0}}])");
    if (transform != nullptr) {
        builder.json()["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = Json::parse(transform);
    }
    const Result<CheckReport> report = checkFile(folder.write("model.gltf", builder.gltfText()));
    EXPECT_TRUE(report) << report.error().message;
    return report ? *report : CheckReport{};
}

TEST(CheckFile, ReadsOnlyTexelsCoveredByTriangles) {
    const TempFolder folder;
    EXPECT_EQ(codes(checkHalves(folder, true, false)), CodeCounts{}) << "the other half may hold anything";
    EXPECT_EQ(codes(checkHalves(folder, false, true)), CodeCounts{"warning greenFlipped"});
    EXPECT_EQ(codes(checkHalves(folder, false, true, R"({"offset":[0.5,0]})")), CodeCounts{})
        << "which moves to the left half";
    EXPECT_EQ(codes(checkHalves(folder, true, false, R"({"offset":[-0.5,7]})")), CodeCounts{"warning greenFlipped"});
}

TEST(CheckFile, NamesThePartOfAMixedMapThatPointsDown) {
    const TempFolder folder;
    const CheckReport report = checkHalves(folder, true, true);
    ASSERT_EQ(codes(report), CodeCounts{"warning greenMixed"});
    const Finding& finding = report.findings[0];
    EXPECT_EQ(finding.primitive, 1u) << "the right half";
    EXPECT_EQ(finding.place, "/materials/0/normalTexture");
    EXPECT_NE(finding.message.find("columns 256 to 511, rows 0 to 511"), std::string::npos) << finding.message;
    EXPECT_NE(finding.message.find("columns 0 to 255, rows 0 to 511"), std::string::npos) << finding.message;
    EXPECT_NEAR(static_cast<double>(finding.count) / static_cast<double>(finding.total), 0.5, 0.1);
    EXPECT_NE(finding.message.find(" %"), std::string::npos) << finding.message;
}

TEST(CheckFile, AdvisesBothOrNeitherWhereTwoFaultsCancelOut) {
    for (const Finding& finding : TestModel(true, true).check().findings) {
        EXPECT_NE(finding.remedy.find("both or neither"), std::string::npos) << finding.remedy;
        EXPECT_TRUE(finding.remedy.ends_with("tspace generate --overwrite --flip-green.")) << finding.remedy;
    }
}

TEST(CheckFile, StatesThatAnUnreadableMapMayCancelTheFault) {
    for (const char* content : {"", "RIFF0000WEBP", "\xABKTX 20", "no image"}) {
        TestModel model(false, true);
        model.folder.write("normal.png", content);
        const CheckReport report = model.check();
        EXPECT_EQ(codes(report), (CodeCounts{"warning signsInverted", "note normalMapUnreadable"})) << content;
        EXPECT_EQ(report.findings[0].remedy.find("tspace generate"), std::string::npos);
        std::filesystem::remove(model.folder.path("normal.png"));
        EXPECT_EQ(codes(model.check()), (CodeCounts{"warning signsInverted", "warning normalMapUnreadable"}));
    }
    EXPECT_EQ(codes(TestModel(false, true).check({.images = false})), CodeCounts{"warning signsInverted"});
}

/// An explicitly requested convention determines which signs are right.
TEST(CheckFile, GivesADefiniteVerdictForAnExplicitConvention) {
    TestModel model;
    model.folder.write("normal.png", "no image");
    EXPECT_EQ(codes(model.check({.convention = conventions::opengl})),
              (CodeCounts{"error signsInverted", "note normalMapUnreadable"}));
    EXPECT_EQ(codes(model.check()), CodeCounts{"note normalMapUnreadable"});
}

TEST(CheckFile, AcceptsGreenDownIfTheConventionRequiresIt) {
    const CheckReport report = TestModel(true, true).check({.convention = conventions::directx});
    ASSERT_EQ(codes(report), CodeCounts{"note greenFlipped"});
    EXPECT_EQ(report.findings[0].remedy.find("tspace"), std::string::npos);
}

TEST(CheckFile, FixesSignsAndMapTogetherIfHalfOfTheMeshesMatchTheMap) {
    TestModel model(true, true);
    addPatch(model.builder, goodPatch(Seam::turned));
    const CheckReport report = model.check();
    ASSERT_EQ(codes(report), (CodeCounts{"warning signsInverted", "warning greenFlipped"}));
    for (const Finding& finding : report.findings)
        EXPECT_TRUE(finding.remedy.ends_with("tspace generate --overwrite --flip-green.")) << finding.remedy;
    const std::string output = model.folder.path("corrected.gltf").string();
    ASSERT_TRUE(
        generateFile(model.folder.path("model.gltf").string(), output,
                     {.selection = {.existing = ExistingTangents::replace}, .maps = {.flip_green = FlipGreen::down}}));
    EXPECT_EQ(codes(*checkFile(output)), CodeCounts{});
}

TEST(CheckFile, ConsidersEveryNormalMapOfAPrimitive) {
    TestModel model(false, true);
    model.folder.write("down.png", pngFile(normalMapOf(256, bumps, true)));
    model.builder.json()["images"].push_back(Json{{"uri", "down.png"}});
    model.builder.json()["textures"].push_back(Json{{"source", 1}});
    model.builder.json()["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] =
        Json{{"index", 1}};
    EXPECT_EQ(codes(model.check()), (CodeCounts{"warning signsInverted", "note greenFlipped"}))
        << "one of two is cancelled";
}

TEST(CheckFile, ReportsUnneededTangentsOnce) {
    TestModel model(false, true);
    Json& primitives = model.builder.json()["meshes"][0]["primitives"];
    for (int i = 0; i < 3; ++i) primitives.push_back(primitives[0]);
    for (std::size_t i = 1; i < 4; ++i) primitives[i].erase("material");
    const CheckReport report = model.check();
    ASSERT_EQ(codes(report), (CodeCounts{"error signsInverted", "note tangentsUnused"}));
    EXPECT_EQ(report.findings[1].count, 3u);
    EXPECT_EQ(report.findings[1].total, 4u);
    EXPECT_EQ(report.findings[1].unit, "primitives");
    EXPECT_EQ(report.findings[1].place, "");
    EXPECT_NE(report.findings[1].remedy.find("tspace generate --strip"), std::string::npos);
}

/// A morph target without attributes is not valid, so the tangents of a target that has nothing else cannot be removed.
TEST(CheckFile, AdvisesNothingImpossible) {
    TestModel model;
    Json& primitive = model.builder.json()["meshes"][0]["primitives"][0];
    primitive["targets"] = Json::array({Json{{"TANGENT", primitive["attributes"]["NORMAL"]}}});
    primitive.erase("material");
    EXPECT_EQ(codes(model.check()), CodeCounts{}) << "--strip leaves them";
    TestModel no_uvs;
    no_uvs.builder.json()["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    no_uvs.builder.json()["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
    const CheckReport report = no_uvs.check();
    EXPECT_EQ(codes(report), (CodeCounts{"error uvsMissing", "warning tangentsMissing"}));
    for (const Finding& finding : report.findings) {
        EXPECT_EQ(finding.remedy.find("tspace generate"), std::string::npos) << finding.remedy;
    }
}

TEST(CheckFile, IgnoresMapsThatAnUnlitMaterialDoesNotUse) {
    TestModel model(false, true);
    model.builder.json()["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    EXPECT_EQ(codes(model.check()), CodeCounts{"note tangentsUnused"});
}

/// KHR_materials_unlit is the fallback for readers that do not support the other extension.
TEST(CheckFile, GivesOneVerdictWithAndWithoutAnUnlitFallback) {
    const auto verdict = [](const char* extension, const char* content, bool has_fallback) {
        TestModel model(false, true);
        Json& extensions = model.builder.json()["materials"][0]["extensions"];
        extensions[extension] = Json::parse(content);
        if (has_fallback) extensions["KHR_materials_unlit"] = Json::object();
        return codes(model.check());
    };
    for (const auto& [extension, content] : {std::pair{"VRMC_materials_mtoon", R"({"specVersion":"1.0"})"},
                                             {"EXT_toon", R"({"normalTexture":{"index":0}})"},
                                             {"EXT_toon", R"({"layers":[{"detailNormalMap":{"index":0}}]})"},
                                             {"EXT_toon", R"({"a":{"BUMP_map":{"index":0}}})"}}) {
        EXPECT_EQ(verdict(extension, content, false), CodeCounts{"error signsInverted"}) << content;
        EXPECT_EQ(verdict(extension, content, true), CodeCounts{"error signsInverted"}) << content;
    }
    // An unknown extension may read the tangents, so they are not reported as unused.
    for (const char* content : {R"({"normalScale":1})", R"({"baseTexture":{"index":0}})"})
        EXPECT_EQ(verdict("EXT_toon", content, true), CodeCounts{}) << content;
    EXPECT_EQ(verdict("KHR_materials_clearcoat", R"({"clearcoatNormalTexture":{"index":0}})", true),
              CodeCounts{"note tangentsUnused"});
}

/// VRM 0.x describes materials at the root of the file, and KHR_materials_unlit is the fallback of its MToon.
TEST(CheckFile, FindsTheNormalMapsOfVrm0) {
    const auto verdict = [](const char* shader, const char* textures, bool has_gltf_map) {
        TestModel model(false, true);
        Json& root = model.builder.json();
        root["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
        if (!has_gltf_map) root["materials"][0].erase("normalTexture");
        root["extensions"]["VRM"]["materialProperties"] =
            Json::array({Json{{"shader", shader}, {"textureProperties", Json::parse(textures)}}});
        return codes(model.check());
    };
    const char* const with_map = R"({"_MainTex":0,"_BumpMap":0})";
    for (const bool has_gltf_map : {false, true}) {
        EXPECT_EQ(verdict("VRM/MToon", with_map, has_gltf_map), CodeCounts{"error signsInverted"}) << has_gltf_map;
        EXPECT_EQ(verdict("VRM/MToon", R"({"_MainTex":0})", has_gltf_map), CodeCounts{"note tangentsUnused"});
        EXPECT_EQ(verdict("VRM_USE_GLTFSHADER", with_map, has_gltf_map), CodeCounts{"note tangentsUnused"});
    }
}

TEST(CheckFile, ReportsThatAnImageWasNotExamined) {
    TestModel model;
    model.folder.write("normal.png", "RIFF0000WEBP");
    CheckReport report = model.check();
    EXPECT_EQ(codes(report), CodeCounts{"note normalMapUnreadable"});
    EXPECT_EQ(report.image_count, 0u);
    std::filesystem::remove(model.folder.path("normal.png"));
    report = model.check();
    EXPECT_EQ(codes(report), CodeCounts{"warning normalMapUnreadable"});
    EXPECT_NE(report.findings[0].message.find("does not exist"), std::string::npos) << report.findings[0].message;
    EXPECT_EQ(report.findings[0].remedy.find("PNG"), std::string::npos) << report.findings[0].remedy;
    EXPECT_NE(report.findings[0].remedy.find("path"), std::string::npos) << report.findings[0].remedy;
    model.builder.json()["images"][0]["uri"] = "data:image/png;base64,iVBORw0KGgo=!!";
    report = model.check();
    EXPECT_EQ(codes(report), CodeCounts{"warning normalMapUnreadable"});
    EXPECT_EQ(report.findings[0].remedy.find("path"), std::string::npos) << "a data URI has none";
}

TEST(CheckFile, GivesEachPrimitiveItsOwnFindings) {
    TestModel model(false, true);
    Json& primitives = model.builder.json()["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);  // the same arrays as primitive 0: they are checked once
    addPatch(model.builder, goodPatch());
    primitives.push_back(primitives[0]);
    primitives[3].erase("material");
    const CheckReport report = model.check();
    EXPECT_EQ(codes(report), (CodeCounts{"error signsInverted", "error signsInverted", "note tangentsUnused"}));
    EXPECT_EQ(report.findings[0].place, "/meshes/0/primitives/0");
    EXPECT_EQ(report.findings[1].place, "/meshes/0/primitives/1");
    EXPECT_EQ(report.findings[1].primitive, 1u);
    EXPECT_EQ(report.findings[2].place, "/meshes/0/primitives/3");
    EXPECT_TRUE(std::is_sorted(report.findings.begin(), report.findings.end(),
                               [](const Finding& a, const Finding& b) { return a.severity > b.severity; }));
}

TEST(CheckFile, IsTheSameForAnyNumberOfThreads) {
    TestModel model(true, true);
    for (int i = 0; i < 5; ++i) addPatch(model.builder, goodPatch(Seam::mirrored));
    const auto texts = [&](unsigned threads) {
        std::vector<std::string> result;
        for (const Finding& finding : model.check({.execution = {.thread_count = threads}}).findings) {
            result.push_back(finding.place + finding.message);
        }
        return result;
    };
    EXPECT_EQ(texts(1), texts(4));
    EXPECT_FALSE(texts(1).empty());
}

TEST(CheckFile, DoesNotReportMissingTangentsOfAnObj) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl a\nnorm n.png\n");
    folder.write("n.png", pngFile(normalMapOf(256, bumps, true)));
    const std::string file = folder.write("a.obj",
                                          "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
                                          "usemtl a\nf 1/1/1 2/2/1 3/3/1\n");
    const Result<CheckReport> report = checkFile(file);
    ASSERT_TRUE(report);
    EXPECT_EQ(codes(*report), (CodeCounts{"note tangentsMissing", "warning greenFlipped"}));
    EXPECT_EQ(report->findings[0].place, "usemtl a");
}

TEST(CheckFile, PassesOnWarningsOfTheReader) {
    const TempFolder folder;
    const std::string file = folder.write("a.obj",
                                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvn 0 0 1\n"
                                          "f 1/1/1 2/2/1 3/9/1\n");
    const Result<CheckReport> report = checkFile(file);
    ASSERT_TRUE(report);
    ASSERT_EQ(codes(*report), CodeCounts{"note fileRemark"});
    EXPECT_NE(report->findings[0].message.find(
                  "1 index refers to texture coordinates that do not exist, the first in line 7"),
              std::string::npos)
        << report->findings[0].message;
    EXPECT_EQ(report->findings[0].place, "") << "it is about the whole file";
}

TEST(CheckFile, ReportsItsProgress) {
    TestModel model;
    addPatch(model.builder, goodPatch(Seam::none));
    addPatch(model.builder, goodPatch(Seam::none));
    for (const std::uint32_t threads : {1u, 4u}) {
        std::vector<std::pair<std::string, std::uint64_t>> told;
        CheckOptions options;
        options.execution.thread_count = threads;
        options.progress = [&](const std::string& what, std::uint64_t done, std::uint64_t total) {
            EXPECT_LE(done, total);
            told.emplace_back(what, done);
        };
        const CheckReport report = model.check(options);
        EXPECT_EQ(report.primitive_count, 3u);
        using Told = std::vector<std::pair<std::string, std::uint64_t>>;
        const Told all = {{"reading", 0},
                          {"reading", 1},
                          {"checking", 0},
                          {"checking", 1},
                          {"checking", 2},
                          {"checking", 3},
                          {"checking normal maps", 0},
                          {"comparing primitives", 0}};
        if (threads == 1) {
            EXPECT_EQ(told, all);
        }
        ASSERT_GE(told.size(), 4u);
        EXPECT_EQ(told[2], all[2]);
        EXPECT_EQ(told.back(), all.back());
    }
}

}  // namespace
}  // namespace tspace::test
