// SPDX-License-Identifier: MIT
// --repair: correct tangents are kept, wrong ones are recomputed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/base/vec_math.h"
#include "generate_run.h"
#include "images/images.h"
#include "model/read/read_scene.h"
#include "tspace/check.h"

namespace tspace {
namespace {

using namespace test;

const GenerateOptions kRepair = {.selection = {.existing = ExistingTangents::repair}};

/// A model in a GLB with correct tangents, computed by `method`, which tests then change.
class Model {
  public:
    explicit Model(const GltfBuilder& builder, Method method = Method::mikktspace) {
        GenerateOptions options;
        options.tangents.compute.method = method;
        const std::string input = folder_.write("in.glb", builder.glb());
        EXPECT_TRUE(generateFile(input, good(), options));
    }

    [[nodiscard]] std::string good() const { return folder_.path("good.glb").string(); }

    /// Writes the model with tangents changed by `harm`, which is called with each vertex and its tangent, and repairs
    /// it. Returns the report and reads the output into `repaired`.
    GenerateReport repair(const std::function<void(std::size_t, Vec4&)>& harm, GenerateOptions options = kRepair) {
        Bytes file = readFile(good());
        const gltf::Document document = gltf::loadDocument(good(), {});
        const gltf::Primitive primitive = readPrimitives(document).at(0);
        std::vector<Vec4> tangents = readTangents(document, primitive);
        const Bytes before = bytesOfValues(tangents);
        for (std::size_t i = 0; i < tangents.size(); ++i) harm(i, tangents[i]);
        const Bytes after = bytesOfValues(tangents);
        const auto place = std::search(file.begin(), file.end(), before.begin(), before.end());
        EXPECT_NE(place, file.end());
        std::copy(after.begin(), after.end(), place);
        const std::string input = folder_.write("harmed.glb", file);
        const auto report = generateFile(input, repaired(), options);
        EXPECT_TRUE(report) << report.error().message;
        const auto second = generateFile(repaired(), repaired(), options);
        EXPECT_TRUE(second && !second->changed) << "what was repaired is good";
        return report ? *report : GenerateReport{};
    }

    [[nodiscard]] std::string repaired() const { return folder_.path("repaired.glb").string(); }

    /// Checks that the damage is detected, and that the repair restores the original bits.
    void expectRepaired(const std::string& words, const std::function<void(std::size_t, Vec4&)>& harm) {
        const PrimitiveReport report = repair(harm).primitives.at(0);
        EXPECT_EQ(report.action, PrimitiveAction::replaced);
        ASSERT_EQ(report.notes.size(), 1u);
        EXPECT_GT(report.mended_vertex_count, 0u);
        EXPECT_EQ(report.notes[0].rfind("its tangents were wrong: ", 0), 0u);
        EXPECT_NE(report.notes[0].find(words), std::string::npos) << report.notes[0];
        EXPECT_EQ(readFile(repaired()), readFile(good()));
    }

  private:
    TempFolder folder_;
};

TEST(Repair, KeepsCorrectTangentsOfAnyMethod) {
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::angle, Method::area, Method::flat}) {
        const bool splits = method != Method::lengyel;  // lengyel cannot represent a mirrored seam
        Model model(gridModel(Grid(6, splits)), method);
        const GenerateReport report = model.repair([](std::size_t, Vec4&) {});
        EXPECT_EQ(report.primitives.at(0).action, PrimitiveAction::kept);
        EXPECT_EQ(report.primitives.at(0).reason, "its tangents are correct");
        EXPECT_FALSE(report.changed);
        EXPECT_EQ(readFile(model.repaired()), readFile(model.good()));
    }
}

TEST(Repair, ReplacesWrongSignsAndDirections) {
    Model model(gridModel(Grid(6)));
    model.expectRepaired("every sign is inverted", [](std::size_t, Vec4& t) { t.w = -t.w; });
    model.expectRepaired("sign", [](std::size_t i, Vec4& t) {
        if (i < 9) t.w = -t.w;
    });
    model.expectRepaired("do not point along increasing u", [](std::size_t, Vec4& t) { t = {-t.y, t.x, 0, t.w}; });
    model.expectRepaired("not perpendicular", [](std::size_t, Vec4& t) { t = {0, 0, 1, t.w}; });
}

TEST(Repair, ReplacesInvalidValuesEvenAtOneVertex) {
    Model model(gridModel(Grid(40)));  // one of its vertices is less than 0.1 % of all
    const auto at_one = [](const Vec4& value) {
        return [value](std::size_t i, Vec4& t) {
            if (i == 700) t = value;
        };
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    model.expectRepaired("NaN", at_one({kNan, 0, 0, 1}));
    model.expectRepaired("unit length", at_one({0, 0, 0, 1}));
    model.expectRepaired("neither +1 nor -1", at_one({1, 0, 0, 0}));
}

TEST(Repair, ReplacesTangentsThatAreSharedAcrossAMirroredSeam) {
    GltfBuilder builder = gridModel(Grid(6));
    std::vector<float> tangents;
    for (std::size_t i = 0; i < 49; ++i)
        tangents.insert(tangents.end(), {i % 7 > 3 ? -1.0f : 1.0f, 0, 0, i % 7 > 3 ? -1.0f : 1.0f});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    const GenerateRun outcome = run(builder, kRepair);
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::replaced);
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 56u) << "the seam is split now";
    EXPECT_EQ(outcome.report.primitives.at(0).mended_vertex_count, 7u) << "no other vertex got another tangent";
}

/// At vertices where the UVs fold back, nearly any direction could be intended. If all neighbors are wrong, these
/// tangents are recomputed too, because recomputed tangents must not be combined with old ones.
TEST(Repair, RepairsIndeterminateTangentsNextToWrongOnes) {
    Grid grid(64, false);
    const std::size_t folded = 32 * 65 + 32;
    grid.uvs[2 * folded] = grid.uvs[2 * folded + 2] + 0.5f / 64;
    Model model(gridModel(grid), Method::lengyel);
    model.repair([](std::size_t, Vec4& t) { t = {-t.y, t.x, 0, t.w}; });
    const Result<CheckReport> report = checkFile(model.repaired());
    ASSERT_TRUE(report);
    for (const Finding& finding : report->findings) ADD_FAILURE() << finding.message;
}

TEST(Repair, KeepsPrimitivesWithCorrectTangentsNextToWrongOnes) {
    const Grid grid(4, false);
    GltfBuilder builder = gridModel(grid);
    std::vector<float> good, wrong;
    for (std::size_t i = 0; i < grid.vertexCount(); ++i) {
        good.insert(good.end(), {1, 0, 0, 1});
        wrong.insert(wrong.end(), {1, 0, 0, -1});
    }
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    for (int i = 0; i < 2; ++i) primitives.push_back(Json(primitives[0]));
    const std::size_t good_accessor = builder.addFloats(good, 4);
    primitives[0]["attributes"]["TANGENT"] = good_accessor;
    primitives[1]["attributes"]["TANGENT"] = builder.addFloats(wrong, 4);
    const GenerateRun outcome = run(builder, kRepair);
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::kept);
    EXPECT_EQ(outcome.report.primitives.at(1).action, PrimitiveAction::replaced);
    EXPECT_EQ(outcome.report.primitives.at(2).action, PrimitiveAction::generated);
    EXPECT_EQ(outcome.primitives[0].find("TANGENT"), good_accessor);
    EXPECT_EQ(readTangents(outcome.after, outcome.primitives[1])[0], (Vec4{1, 0, 0, 1}));
}

TEST(Repair, AddsDeltasOfMorphTargetsToGoodTangents) {
    const Grid grid(4, false);
    GltfBuilder builder = gridModel(grid);
    std::vector<float> good, lift;
    for (std::size_t i = 0; i < grid.vertexCount(); ++i) {
        good.insert(good.end(), {1, 0, 0, 1});
        lift.insert(lift.end(), {0, 0, grid.positions[i * 3]});
    }
    Json& primitive = firstPrimitive(builder);
    const std::size_t tangents = builder.addFloats(good, 4), target = builder.addFloats(lift, 3);
    primitive["attributes"]["TANGENT"] = tangents;
    primitive["targets"] = Json::array({Json{{"POSITION", target}}});
    const GenerateRun outcome = run(builder, kRepair);
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::kept);
    EXPECT_EQ(outcome.primitives[0].find("TANGENT"), tangents);
    EXPECT_EQ(outcome.primitives[0].targets.at(0).size(), 2u) << "POSITION and TANGENT";
}

/// Tangents that are kept were not computed with the texture transform.
TEST(Repair, DoesNotClaimThatKeptTangentsFollowTheTransform) {
    GltfBuilder builder = gridModel(Grid(4, false));
    std::vector<float> tangents;
    for (std::size_t i = 0; i < 25; ++i) tangents.insert(tangents.end(), {1, 0, 0, 1});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    builder.json()["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"rotation", 1.5}};
    const TempFolder folder;
    const auto result = generateFile(folder.write("in.glb", builder.glb()), folder.path("out.glb").string(), kRepair);
    ASSERT_TRUE(result) << result.error().message;
    const PrimitiveReport& report = result->primitives.at(0);
    EXPECT_EQ(report.action, PrimitiveAction::kept);
    EXPECT_TRUE(report.notes.empty()) << report.notes[0];
    EXPECT_NE(report.reason.find("follow TEXCOORD_0 without the rotation"), std::string::npos) << report.reason;
}

TEST(Repair, JudgesByTheUvsAfterTheTextureTransform) {
    GltfBuilder builder = gridModel(Grid(6));
    Json& texture = builder.json()["materials"][0]["normalTexture"];
    texture["extensions"]["KHR_texture_transform"] = {{"rotation", 1.5}};
    Model model(builder);
    EXPECT_EQ(model.repair([](std::size_t, Vec4&) {}).primitives.at(0).action, PrimitiveAction::kept);
    const GenerateOptions ignore = {.selection = {.existing = ExistingTangents::repair},
                                    .tangents = {.texture_transform = TextureTransform::ignore}};
    EXPECT_EQ(model.repair([](std::size_t, Vec4&) {}, ignore).primitives.at(0).action, PrimitiveAction::replaced);
}

/// Tangents of a model before and after a repair.
struct Tangents {
    std::vector<Vec4> before = {}, after = {};
};

/// Computes correct tangents by lengyel, whose bits differ from those of a repair. Damages some of them with `harm`,
/// and repairs the model.
Tangents repairHarmed(const std::function<void(std::size_t, Vec4&)>& harm) {
    GltfBuilder builder = gridModel(Grid(6, false));
    // The grid is bent, so that methods differ.
    auto* positions = reinterpret_cast<float*>(builder.bytes().data());
    for (std::size_t v = 0; v < 49; ++v) {
        const auto x = static_cast<float>(v % 7), y = static_cast<float>(v / 7);
        positions[3 * v + 2] = 0.1f * x * y - 0.05f * x * x;
    }
    builder.json()["accessors"][0]["min"] = {0, 0, -2};
    Model model(builder, Method::area);
    Tangents result;
    (void)model.repair([&](std::size_t i, Vec4& t) {
        harm(i, t);
        result.before.push_back(t);
    });
    const gltf::Document document = gltf::loadDocument(model.repaired(), {});
    result.after = readTangents(document, readPrimitives(document).at(0));
    return result;
}

bool sameBits(const Vec4& a, const Vec4& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Repair, RepairsOnlyWrongTangents) {
    const auto is_harmed = [](std::size_t i) { return i % 7 == 3; };
    for (const Vec4& wrong : {Vec4{0, 1, 0, 1}, Vec4{NAN, 0, 0, 1}, Vec4{0, 0, 0, 1}, Vec4{0, 0, 1, 1}}) {
        const Tangents tangents = repairHarmed([&](std::size_t i, Vec4& t) {
            if (is_harmed(i)) t = wrong;
        });
        ASSERT_EQ(tangents.after.size(), tangents.before.size()) << "no vertex needed two tangents";
        for (std::size_t i = 0; i < tangents.after.size(); ++i) {
            EXPECT_NE(sameBits(tangents.after[i], tangents.before[i]), is_harmed(i)) << i;
        }
    }
}

TEST(Repair, InvertsWrongSignsAndKeepsDirections) {
    for (const std::size_t every : {1, 2, 7}) {
        const Tangents tangents = repairHarmed([&](std::size_t i, Vec4& t) {
            if (i % every == 0) t.w = -t.w;
        });
        ASSERT_EQ(tangents.after.size(), tangents.before.size());
        for (std::size_t i = 0; i < tangents.after.size(); ++i) {
            Vec4 expected = tangents.before[i];
            if (i % every == 0) expected.w = -expected.w;
            EXPECT_TRUE(sameBits(tangents.after[i], expected)) << i;
        }
    }
}

TEST(Repair, MakesShortTangentsUnitInTheirDirection) {
    const Tangents tangents = repairHarmed([](std::size_t i, Vec4& t) {
        if (i > 20) t = {0.5f * t.x, 0.5f * t.y, 0.5f * t.z, t.w};
    });
    for (std::size_t i = 0; i < tangents.after.size(); ++i) {
        const DVec3 before = toDouble(xyz(tangents.before[i])), after = toDouble(xyz(tangents.after[i]));
        EXPECT_NEAR(length(after), 1, 1e-6);
        EXPECT_NEAR(length(after - (i > 20 ? 2.0 : 1.0) * before), 0, 1e-6);
    }
}

/// A grid with tangents, and with a normal map in a separate file.
struct MappedModel {
    TempFolder folder = {};
    GltfBuilder builder = gridModel(Grid(6, false));

    MappedModel(float sign, const std::string& image) {
        std::vector<float> tangents;
        for (std::size_t i = 0; i < 49; ++i) tangents.insert(tangents.end(), {1, 0, 0, sign});
        firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
        builder.json()["images"] = Json::parse(R"([{"uri":"normal.png"}])");
        builder.json()["textures"] = Json::parse(R"([{"source":0}])");
        if (!image.empty()) folder.write("normal.png", image);
    }

    /// Returns whether --repair keeps every byte of the model.
    [[nodiscard]] bool isLeftAlone() const {
        const std::string input = folder.write("in.glb", builder.glb());
        const std::string output = folder.path("out.glb").string();
        const auto report = generateFile(input, output, kRepair);
        EXPECT_TRUE(report) << report.error().message;
        return readFile(input) == readFile(output);
    }
};

TEST(Repair, KeepsInvertedSignsThatTheNormalMapCancels) {
    const std::string down = pngFile(normalMapOf(256, bumps, true)), up = pngFile(normalMapOf(256, bumps, false));
    EXPECT_TRUE(MappedModel(-1, down).isLeftAlone());
    EXPECT_TRUE(MappedModel(1, down).isLeftAlone());
    EXPECT_TRUE(MappedModel(1, up).isLeftAlone());
    EXPECT_FALSE(MappedModel(-1, up).isLeftAlone());
    MappedModel both(-1, up);
    both.folder.write("down.png", down);
    both.builder.json()["images"].push_back(Json{{"uri", "down.png"}});
    both.builder.json()["textures"].push_back(Json{{"source", 1}});
    both.builder.json()["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] =
        Json{{"index", 1}};
    EXPECT_TRUE(both.isLeftAlone()) << "one of its two maps renders right";
}

TEST(Repair, KeepsInvertedSignsIfTheNormalMapIsUnreadable) {
    for (const char* content : {"", "no image", "\xABKTX 20\xBB"}) {
        EXPECT_TRUE(MappedModel(-1, content).isLeftAlone()) << content;
    }
}

TEST(Repair, RepairsSignsThatNoMapCancelsNextToKeptOnes) {
    MappedModel model(-1, pngFile(normalMapOf(256, bumps, true)));
    auto* const tangents = reinterpret_cast<float*>(
        model.builder.bytes().data() + model.builder.json()["bufferViews"][4]["byteOffset"].get<std::size_t>());
    tangents[4 * 24] = NAN;
    EXPECT_FALSE(model.isLeftAlone());
    const gltf::Document document = gltf::loadDocument(model.folder.path("out.glb").string(), {});
    for (const Vec4& t : readTangents(document, readPrimitives(document).at(0))) EXPECT_EQ(t, (Vec4{1, 0, 0, -1}));
}

/// Two primitives share their vertices. One of them has a map with which the inverted signs are correct.
TEST(Repair, DecidesForEachPrimitiveOverSharedVertices) {
    MappedModel model(-1, pngFile(normalMapOf(256, bumps, true)));
    model.builder.json()["materials"].push_back(Json::parse(R"({"normalTexture":{"index":1}})"));
    model.builder.json()["textures"].push_back(Json::object());
    Json& primitives = model.builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    primitives[1]["material"] = model.builder.json()["materials"].size() - 1;
    EXPECT_FALSE(model.isLeftAlone());
    const gltf::Document document = gltf::loadDocument(model.folder.path("out.glb").string(), {});
    const std::vector<gltf::Primitive> after = readPrimitives(document);
    EXPECT_EQ(readTangents(document, after[0])[0].w, -1);
    EXPECT_EQ(readTangents(document, after[1])[0].w, 1);
}

/// --repair keeps tangents for which `check` reports no error.
TEST(Repair, KeepsTangentsWithoutErrors) {
    for (const float degrees : {20.0f, 40.0f}) {
        MappedModel model(1, pngFile(normalMapOf(256, bumps, false)));
        const float angle = degrees * 3.14159265f / 180;
        auto* const tangents = reinterpret_cast<float*>(
            model.builder.bytes().data() + model.builder.json()["bufferViews"][4]["byteOffset"].get<std::size_t>());
        for (std::size_t v = 0; v < 49; ++v) {
            tangents[4 * v] = std::cos(angle);
            tangents[4 * v + 1] = std::sin(angle);
        }
        EXPECT_TRUE(model.isLeftAlone());
    }
}

/// Deltas of tangents that are kept are kept too; deltas of new tangents are recomputed.
TEST(Repair, KeepsDeltasOfCorrectTangents) {
    const Grid grid(4, false);
    GltfBuilder builder = gridModel(grid);
    std::vector<float> tangents, lift, deltas;
    for (std::size_t i = 0; i < grid.vertexCount(); ++i) {
        const bool is_wrong = i == 12;
        tangents.insert(tangents.end(), {is_wrong ? 0.0f : 1.0f, is_wrong ? 1.0f : 0.0f, 0, 1});
        lift.insert(lift.end(), {0, 0, grid.positions[i * 3]});
        deltas.insert(deltas.end(), {-0.25f, 0, 0.75f});
    }
    Json& primitive = firstPrimitive(builder);
    primitive["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    const std::size_t position = builder.addFloats(lift, 3), tangent = builder.addFloats(deltas, 3);
    primitive["targets"] = Json::array({Json{{"POSITION", position}, {"TANGENT", tangent}}});
    const TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    ASSERT_TRUE(generateFile(folder.write("in.glb", builder.glb()), output, kRepair));
    const gltf::Document document = gltf::loadDocument(output, {});
    const gltf::Primitive after = readPrimitives(document).at(0);
    const std::vector<Vec3> written = readOffsets(document, after, 0, "TANGENT");
    ASSERT_EQ(written.size(), grid.vertexCount());
    for (std::size_t v = 0; v < written.size(); ++v) {
        EXPECT_EQ(written[v] == (Vec3{-0.25f, 0, 0.75f}), v != 12) << v;
    }
    EXPECT_EQ(readTangents(document, after)[12], (Vec4{1, 0, 0, 1}));
}

/// Runs generateFile and returns the tangents of the output's first primitive; empty if the run fails.
std::vector<Vec4> tangentsAfter(const GltfBuilder& builder, const GenerateOptions& options, GenerateReport& report) {
    const TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    const auto result = generateFile(folder.write("in.glb", builder.glb()), output, options);
    EXPECT_TRUE(result) << result.error().message;
    if (!result) return {};
    report = *result;
    const gltf::Document document = gltf::loadDocument(output, {});
    const gltf::Primitive primitive = readPrimitives(document).at(0);
    EXPECT_TRUE(primitive.unreadable_tangents.empty());
    return primitive.find("TANGENT") ? readTangents(document, primitive) : std::vector<Vec4>{};
}

TEST(Repair, ReplacesUnreadableTangents) {
    const Grid grid(4, false);
    GltfBuilder of_another_shape = gridModel(grid), of_another_mesh = gridModel(grid), of_bytes = gridModel(grid);
    firstPrimitive(of_another_shape)["attributes"]["TANGENT"] = 1;  // VEC3
    firstPrimitive(of_another_mesh)["attributes"]["TANGENT"] =
        of_another_mesh.addFloats(std::vector<float>(4 * (grid.vertexCount() + 1), 0.5f), 4);
    firstPrimitive(of_bytes)["attributes"]["TANGENT"] =
        of_bytes.addAccessor(std::vector<std::uint8_t>(4 * grid.vertexCount(), 1), kU8, "VEC4", grid.vertexCount());
    const std::vector<std::pair<GltfBuilder, std::string>> models{
        {of_another_shape, "they do not have 4 components"},
        {of_another_mesh, "there are 26 of them for 25 vertices"},
        {of_bytes, "they are uint8x4, but must be floats or normalized signed integers"}};
    for (const auto& [builder, why] : models) {
        for (const ExistingTangents existing :
             {ExistingTangents::keep, ExistingTangents::repair, ExistingTangents::replace}) {
            GenerateReport report;
            for (const Vec4& t : tangentsAfter(builder, {.selection = {.existing = existing}}, report))
                EXPECT_EQ(t, (Vec4{1, 0, 0, 1}));
            EXPECT_EQ(report.primitives.at(0).action, PrimitiveAction::replaced);
            EXPECT_EQ(report.primitives.at(0).notes.at(0), "its existing tangents were invalid: " + why);
        }
        GltfBuilder unneeded = builder;
        firstPrimitive(unneeded)["material"] = 1;
        GenerateReport report;
        EXPECT_TRUE(tangentsAfter(unneeded, {}, report).empty());
        EXPECT_EQ(report.primitives.at(0).action, PrimitiveAction::removed);
        const TempFolder folder;
        const Result<CheckReport> checked = checkFile(folder.write("in.glb", builder.glb()));
        ASSERT_TRUE(checked) << checked.error().message;
        EXPECT_EQ(checked->findings.at(0).code, FindingCode::tangentsUnreadable);
        EXPECT_NE(checked->findings.at(0).message.find(why), std::string::npos) << checked->findings[0].message;
    }
}

/// Returns a grid with one vertex that no triangle uses. `tangents`: one more than the grid has vertices.
GltfBuilder withUnusedVertex(const std::vector<Vec4>& tangents) {
    Grid grid(4, false);
    grid.positions.insert(grid.positions.end(), {9, 9, 0});
    grid.normals.insert(grid.normals.end(), {0, 0, 1});
    grid.uvs.insert(grid.uvs.end(), {0, 0});
    GltfBuilder builder = gridModel(grid);
    std::vector<float> floats;
    for (const Vec4& t : tangents) floats.insert(floats.end(), {t.x, t.y, t.z, t.w});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(floats, 4);
    return builder;
}

TEST(Repair, MakesEverySignAndEveryLengthOne) {
    const std::vector<Vec4> good(26, Vec4{1, 0, 0, 1});
    for (const bool is_needed : {true, false}) {
        for (const Vec4& value :
             {Vec4{1, 0, 0, 0.998f}, Vec4{0.7f, 0, 0, 0.7f}, Vec4{NAN, 0, 0, 1}, Vec4{0, 0, 0, 0}}) {
            for (const std::size_t broken : {std::size_t{7}, std::size_t{25}}) {
                std::vector<Vec4> tangents = good;
                tangents[broken] = value;
                GltfBuilder builder = withUnusedVertex(tangents);
                if (!is_needed) firstPrimitive(builder)["material"] = 1;
                GenerateReport report;
                EXPECT_EQ(tangentsAfter(builder, kRepair, report), good) << broken;
                EXPECT_GE(report.primitives.at(0).mended_vertex_count, 1u);
                for (const Vec4& t :
                     tangentsAfter(builder, {.selection = {.existing = ExistingTangents::replace}}, report)) {
                    EXPECT_EQ(std::fabs(t.w), 1);
                    EXPECT_FLOAT_EQ(length(xyz(t)), 1);
                }
            }
        }
    }
    std::vector<Vec4> all(26, Vec4{1, 0, 0, 0.998f});
    GenerateReport report;
    EXPECT_EQ(tangentsAfter(withUnusedVertex(all), kRepair, report), good);
    EXPECT_EQ(tangentsAfter(withUnusedVertex(all), {}, report), all) << "nothing was asked for";
}

TEST(Repair, RepairsValuesInTheirFormat) {
    const std::size_t count = Grid(4, false).vertexCount();
    std::vector<std::int16_t> numbers;
    for (std::size_t v = 0; v < count; ++v)
        numbers.insert(numbers.end(), {0, 32767, 0, std::int16_t(v == 3 ? 0 : -32767)});
    GltfBuilder builder = gridModel(Grid(4, false));
    const std::size_t accessor = builder.addAccessor(numbers, 5122, "VEC4", count);
    builder.json()["accessors"][accessor]["normalized"] = true;
    // Two primitives share their tangents. The material of one of them does not need tangents.
    firstPrimitive(builder)["material"] = 1;
    firstPrimitive(builder)["attributes"]["TANGENT"] = accessor;
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    const TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    ASSERT_TRUE(generateFile(folder.write("in.glb", builder.glb()), output, kRepair));
    const gltf::Document document = gltf::loadDocument(output, {});
    const std::vector<gltf::Primitive> after = readPrimitives(document);
    EXPECT_EQ(after[0].find("TANGENT"), after[1].find("TANGENT")) << "still shared";
    EXPECT_EQ(gltf::readAccessor(document, *after[0].find("TANGENT")).component, gltf::ComponentType::i16);
    for (std::size_t v = 0; v < count; ++v) {
        EXPECT_EQ(readTangents(document, after[0])[v], (Vec4{0, 1, 0, v == 3 ? 1.0f : -1.0f})) << v;
    }
}

/// On brushed metal, tangents are along the strokes and do not depend on UVs.
TEST(Repair, KeepsTangentsThatNoTextureUses) {
    for (const bool has_uvs : {true, false}) {
        GltfBuilder builder = gridModel(Grid(4, false));
        std::vector<float> tangents;
        for (std::size_t v = 0; v < 25; ++v) tangents.insert(tangents.end(), {0.6f, 0.8f, 0, 1});
        tangents[4 * 7] = NAN;
        tangents[4 * 9 + 2] = 1;
        tangents[4 * 9] = tangents[4 * 9 + 1] = 0;  // makes tangent 9 parallel to N
        firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
        if (!has_uvs) firstPrimitive(builder)["attributes"].erase("TEXCOORD_0");
        builder.json()["materials"][0] =
            Json::parse(R"({"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":1}}})");
        GenerateReport report;
        for (const Vec4& t : tangentsAfter(builder, kRepair, report)) EXPECT_EQ(t, (Vec4{0.6f, 0.8f, 0, 1}));
        EXPECT_EQ(report.primitives.at(0).mended_vertex_count, 2u);
        EXPECT_NE(report.primitives.at(0).reason.find("no texture uses them"), std::string::npos);
    }
}

TEST(Repair, ReportsWhatWasExaminedForKeptTangents) {
    Grid grid(4, false);
    std::vector<float> tangents;
    for (std::size_t v = 0; v < 25; ++v) tangents.insert(tangents.end(), {1, 0, 0, 1});
    const auto reasonOf = [&] {
        GltfBuilder builder = gridModel(grid);
        firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
        GenerateReport report;
        (void)tangentsAfter(builder, kRepair, report);
        return report.primitives.at(0).reason;
    };
    EXPECT_EQ(reasonOf(), "its tangents are correct");
    for (std::size_t v = 0; v < 10; ++v) grid.uvs[v] = grid.uvs[v + 10];  // the first row has the UVs of the second one
    EXPECT_NE(reasonOf().find("on 25.0 % of the surface"), std::string::npos) << reasonOf();
    for (float& value : grid.uvs) value = 0;
    EXPECT_NE(reasonOf().find("only their values"), std::string::npos) << reasonOf();
}

TEST(Repair, KeepsCorrectTangentsWhenGeometryIsRecompressed) {
    const Model model(gridModel(Grid(4)));
    const TempFolder folder;
    GenerateOptions options = kRepair;
    options.storage.compression = Compression::meshopt;
    const std::string output = folder.path("packed.glb").string();
    const Result<GenerateReport> report = generateFile(model.good(), output, options);
    if (!report && report.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << "built without meshopt";
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->primitives.at(0).action, PrimitiveAction::kept);
}

}  // namespace
}  // namespace tspace
