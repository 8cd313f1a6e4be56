// SPDX-License-Identifier: MIT
// --repair: good tangents stay, wrong ones are made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "generate_run.h"

namespace tspace {
namespace {

using namespace test;

const GenerateOptions kRepair = {.existing = ExistingTangents::repair};

/// A model with good tangents in its GLB, made by `method`, and then changed: `harm` gets each vertex and its tangent.
class Model {
  public:
    explicit Model(const GltfBuilder& builder, Method method = Method::mikktspace) {
        GenerateOptions options;
        options.tangents.method = method;
        const std::string input = folder_.write("in.glb", builder.glb());
        EXPECT_TRUE(generateFile(input, good(), options));
    }

    [[nodiscard]] std::string good() const { return folder_.path("good.glb").string(); }

    /// Writes the model with harmed tangents and repairs it. Returns the report; `repaired` is read back below.
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

    /// The harm is detected, and undone to the bit.
    void expectRepaired(const std::string& words, const std::function<void(std::size_t, Vec4&)>& harm) {
        const PrimitiveReport report = repair(harm).primitives.at(0);
        EXPECT_EQ(report.action, PrimitiveAction::replaced);
        ASSERT_EQ(report.notes.size(), 1u);
        EXPECT_EQ(report.notes[0].rfind("its tangents were wrong: ", 0), 0u);
        EXPECT_NE(report.notes[0].find(words), std::string::npos) << report.notes[0];
        EXPECT_EQ(readFile(repaired()), readFile(good()));
    }

  private:
    TempFolder folder_;
};

TEST(Repair, KeepsGoodTangentsWhateverMethodMadeThem) {
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::angle, Method::area, Method::flat}) {
        const bool splits = method != Method::lengyel;  // which cannot serve a mirrored seam
        Model model(gridModel(Grid(6, splits)), method);
        const GenerateReport report = model.repair([](std::size_t, Vec4&) {});
        EXPECT_EQ(report.primitives.at(0).action, PrimitiveAction::kept);
        EXPECT_EQ(report.primitives.at(0).reason, "its tangents are good");
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
    model.expectRepaired("do not point where u grows", [](std::size_t, Vec4& t) { t = {-t.y, t.x, 0, t.w}; });
    model.expectRepaired("not perpendicular", [](std::size_t, Vec4& t) { t = {0, 0, 1, t.w}; });
}

TEST(Repair, ReplacesWhatNoFileMayHaveEvenAtOneVertex) {
    Model model(gridModel(Grid(40)));  // one vertex is less than a thousandth of it
    const auto at_one = [](const Vec4& value) {
        return [value](std::size_t i, Vec4& t) {
            if (i == 700) t = value;
        };
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    model.expectRepaired("NaN", at_one({kNan, 0, 0, 1}));
    model.expectRepaired("not unit", at_one({0, 0, 0, 1}));
    model.expectRepaired("neither +1 nor -1", at_one({1, 0, 0, 0}));
}

TEST(Repair, ReplacesTangentsThatAreSharedAcrossAMirroredSeam) {
    GltfBuilder builder = gridModel(Grid(6));
    std::vector<float> tangents;
    for (std::size_t i = 0; i < 49; ++i)
        tangents.insert(tangents.end(), {i % 7 > 3 ? -1.0f : 1.0f, 0, 0, i % 7 > 3 ? -1.0f : 1.0f});
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(tangents, 4);
    const Outcome outcome = run(builder, kRepair);
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::replaced);
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 56u) << "the seam is split now";
}

TEST(Repair, LeavesPrimitivesWithGoodTangentsAloneBesideWrongOnes) {
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
    const Outcome outcome = run(builder, kRepair);
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
    const Outcome outcome = run(builder, kRepair);
    EXPECT_EQ(outcome.report.primitives.at(0).action, PrimitiveAction::kept);
    EXPECT_EQ(outcome.primitives[0].find("TANGENT"), tangents);
    EXPECT_EQ(outcome.primitives[0].targets.at(0).size(), 2u) << "POSITION and TANGENT";
}

TEST(Repair, JudgesByTheUvsAfterTheTextureTransform) {
    GltfBuilder builder = gridModel(Grid(6));
    Json& texture = builder.json()["materials"][0]["normalTexture"];
    texture["extensions"]["KHR_texture_transform"] = {{"rotation", 1.5}};
    Model model(builder);
    EXPECT_EQ(model.repair([](std::size_t, Vec4&) {}).primitives.at(0).action, PrimitiveAction::kept);
    const GenerateOptions ignore = {.existing = ExistingTangents::repair,
                                    .texture_transform = TextureTransform::ignore};
    EXPECT_EQ(model.repair([](std::size_t, Vec4&) {}, ignore).primitives.at(0).action, PrimitiveAction::replaced);
}

TEST(Repair, ReplacesTangentsOfAnotherShape) {
    GltfBuilder builder = gridModel(Grid(4, false));
    firstPrimitive(builder)["attributes"]["TANGENT"] = 1;  // VEC3
    const TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    const auto report = generateFile(folder.write("in.glb", builder.glb()), output, kRepair);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->primitives.at(0).action, PrimitiveAction::replaced);
    EXPECT_EQ(report->primitives.at(0).notes.at(0), "its tangents were wrong: they do not have 4 components");
}

TEST(Repair, KeepsGoodTangentsAlsoWhereGeometryIsPackedAnew) {
    const Model model(gridModel(Grid(4)));
    const TempFolder folder;
    GenerateOptions options = kRepair;
    options.compression = Compression::meshopt;
    const std::string output = folder.path("packed.glb").string();
    const Result<GenerateReport> report = generateFile(model.good(), output, options);
    if (!report && report.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << "built without meshopt";
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->primitives.at(0).action, PrimitiveAction::kept);
}

}  // namespace
}  // namespace tspace
