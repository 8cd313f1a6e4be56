// SPDX-License-Identifier: MIT
// generateFile with bitangents: the values of the attribute _BITANGENT, and the effects on vertices, morph targets and
// formats.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/vec_math.h"
#include "generate_run.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

using gltf::Json;
using gltf::Primitive;
using namespace test;

GenerateOptions withBitangents(Method method) {
    GenerateOptions options;
    options.tangents.compute.method = method;
    options.tangents.bitangents = true;
    return options;
}

std::vector<Vec3> bitangentsOf(const GenerateRun& outcome) {
    return readVec3(outcome.after, outcome.primitives.at(0), "_BITANGENT");
}

/// Returns a grid whose UVs are sheared: u = x + shear * (y - middle), v = -(y - middle), where shear is `above` above
/// the middle row and `below` otherwise. So dP/du is (1, 0, 0) everywhere, and -dP/dv is (-shear, 1, 0).
GltfBuilder shearedModel(float below, float above) {
    Grid grid(4, false);
    for (std::size_t i = 0; i < grid.vertexCount(); ++i) {
        const float x = grid.positions[3 * i], y = grid.positions[3 * i + 1] - 2;
        grid.uvs[2 * i] = x + (y < 0 ? below : above) * y;
        grid.uvs[2 * i + 1] = -y;
    }
    return gridModel(grid);
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance) {
    EXPECT_LE(length(toDouble(a) - toDouble(b)), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(BitangentsGltf, FollowDpDvWhereUvsAreSheared) {
    const Vec3 leaning{-0.6f, 0.8f, 0};  // -dP/dv for a shear of 0.75, normalized
    for (const Method method : {Method::mikktspace, Method::angle, Method::fast, Method::best}) {
        const GenerateRun outcome = run(shearedModel(0.75f, 0.75f), withBitangents(method));
        const std::vector<Vec3> bitangents = bitangentsOf(outcome);
        EXPECT_TRUE(outcome.report.primitives[0].bitangents_generated);
        ASSERT_EQ(bitangents.size(), 25u);
        for (const Vec3& b : bitangents) expectNear(b, leaning, 1e-6);
        for (const Vec4& t : readTangents(outcome.after, outcome.primitives[0])) expectNear(xyz(t), {1, 0, 0}, 1e-6);
        const Json& accessor = outcome.after.json["accessors"][*outcome.primitives[0].find("_BITANGENT")];
        EXPECT_EQ(accessor["type"], "VEC3");
        EXPECT_EQ(accessor["componentType"], 5126);
    }
}

TEST(BitangentsGltf, SplitVerticesWhereOnlyTheyDiffer) {
    const GltfBuilder model = shearedModel(0, 0.75f);
    GenerateOptions options = withBitangents(Method::flat);
    options.tangents.bitangents = false;
    EXPECT_EQ(run(model, options).report.primitives[0].vertices_after, 25u);
    options.tangents.bitangents = true;
    const GenerateRun outcome = run(model, options);
    EXPECT_EQ(outcome.report.primitives[0].vertices_after, 30u) << "the middle row is doubled";
    for (const Vec3& b : bitangentsOf(outcome)) {
        const bool leans = b.x < -0.3f;
        expectNear(b, leans ? Vec3{-0.6f, 0.8f, 0} : Vec3{0, 1, 0}, 1e-6);
    }
}

TEST(BitangentsGltf, HaveTheNumberFormatOfTangents) {
    for (const VectorFormat format : {VectorFormat::snorm16, VectorFormat::snorm8}) {
        GenerateOptions options = withBitangents(Method::best);
        options.storage.format = format;
        const bool is_short = format == VectorFormat::snorm16;
        const TempFolder folder;
        const std::string input = folder.write("in.glb", shearedModel(0.75f, 0.75f).glb()),
                          output = folder.path("out.glb").string();
        ASSERT_TRUE(generateFile(input, output, options));
        const gltf::Document after = gltf::loadDocument(output, {});
        const std::vector<Primitive> primitives = readPrimitives(after);
        const auto accessor = readAccessor(after, *primitives.at(0).find("_BITANGENT"));
        EXPECT_EQ(accessor.element_bytes, is_short ? 6u : 3u);
        EXPECT_EQ(accessor.stride, is_short ? 8u : 4u) << "elements start at multiples of 4 bytes";
        EXPECT_TRUE(accessor.normalized);
        for (const Vec3& b : readVec3(after, primitives[0], "_BITANGENT"))
            expectNear(b, {-0.6f, 0.8f, 0}, is_short ? 1e-4 : 1e-2);
    }
}

TEST(BitangentsGltf, AreSharedByPrimitivesThatShareVertices) {
    GltfBuilder model = gridModel(Grid(4));
    model.json()["meshes"][0]["primitives"].push_back(Json(firstPrimitive(model)));
    const GenerateRun outcome = run(model, withBitangents(Method::best));
    ASSERT_EQ(outcome.primitives.size(), 2u);
    EXPECT_TRUE(outcome.primitives[0].find("_BITANGENT").has_value());
    EXPECT_EQ(outcome.primitives[0].find("_BITANGENT"), outcome.primitives[1].find("_BITANGENT"));
}

TEST(BitangentsGltf, StripsStayStripsWithoutASplit) {
    GltfBuilder model = shearedModel(0.75f, 0.75f);
    const std::size_t strip = model.addAccessor(std::vector<std::uint16_t>{0, 1, 5, 6, 10, 11}, kU16, "SCALAR", 6);
    firstPrimitive(model)["indices"] = strip;
    firstPrimitive(model)["mode"] = 5;
    const GenerateRun outcome = run(model, withBitangents(Method::best));
    EXPECT_EQ(outcome.primitives.at(0).mode, gltf::Mode::triangleStrip);
    // Unused vertices have unit bitangents too.
    for (const Vec3& b : bitangentsOf(outcome)) EXPECT_NEAR(length(toDouble(b)), 1, 1e-6);
}

TEST(BitangentsGltf, HaveNoMorphDeltas) {
    GltfBuilder model = shearedModel(0, 0.75f);
    std::vector<float> offsets(75, 0);
    for (std::size_t i = 0; i < 25; ++i) offsets[3 * i + 2] = static_cast<float>(i % 3);
    const std::size_t moved = model.addFloats(offsets, 3);
    firstPrimitive(model)["targets"] = Json::array({Json{{"POSITION", moved}}});
    const GenerateRun outcome = run(model, withBitangents(Method::best));
    const Json& target = outcome.after.json["meshes"][0]["primitives"][0]["targets"][0];
    EXPECT_TRUE(target.contains("TANGENT"));
    EXPECT_FALSE(target.contains("_BITANGENT"));
    EXPECT_EQ(bitangentsOf(outcome).size(), outcome.report.primitives[0].vertices_after);
}

TEST(BitangentsGltf, AreMissingWhereTangentsAreKeptAndANoteSaysSo) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", withTangents(Grid(4)).glb()),
                      output = folder.path("out.glb").string();
    const auto report = generateFile(input, output, withBitangents(Method::best));
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->changed);
    EXPECT_FALSE(report->primitives[0].bitangents_generated);
    ASSERT_EQ(report->primitives[0].notes.size(), 1u);
    EXPECT_NE(report->primitives[0].notes[0].find("no bitangents"), std::string::npos);
}

TEST(BitangentsGltf, ReplaceExistingOnesOnlyOnRequest) {
    GltfBuilder model = withTangents(Grid(4, false));
    const std::size_t old = model.addFloats(std::vector<float>(75, 0.25f), 3);
    firstPrimitive(model)["attributes"]["_BITANGENT"] = old;
    GenerateOptions options = withBitangents(Method::best);
    options.selection.existing = ExistingTangents::replace;
    for (const Vec3& b : bitangentsOf(run(model, options))) expectNear(b, {0, 1, 0}, 1e-6);
    options.tangents.bitangents = false;
    for (const Vec3& b : bitangentsOf(run(model, options))) EXPECT_EQ(b, (Vec3{0.25f, 0.25f, 0.25f}));
}

}  // namespace
}  // namespace tspace
