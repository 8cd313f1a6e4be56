// SPDX-License-Identifier: MIT
// Morph targets of glTF files with generateFile: which targets get deltas, how deltas are stored, and which data is
// preserved.
#include <gtest/gtest.h>

#include <cmath>

#include "generate_run.h"
#include "model/gltf/accessor.h"
#include "model/gltf/load_document.h"
#include "model/io/file_io.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

using gltf::Document;
using gltf::Json;
using namespace test;

/// Returns offsets that move the vertices for which `lifts(x, y)` is true, upward and along y.
template <class Lifts>
std::vector<float> lifted(const Grid& grid, Lifts&& lifts) {
    std::vector<float> offsets(grid.positions.size(), 0);
    for (std::size_t i = 0; i < offsets.size(); i += 3) {
        if (lifts(grid.positions[i], grid.positions[i + 1])) {
            offsets[i + 1] = offsets[i + 2] = 0.25f * grid.positions[i + 1] + 0.5f;
        }
    }
    return offsets;
}

std::vector<float> allLifted(const Grid& grid) {
    return lifted(grid, [](float, float) { return true; });
}
std::vector<float> noneLifted(const Grid& grid) { return std::vector<float>(grid.positions.size(), 0); }

/// Returns gridModel with one morph target for each list of offsets of positions.
GltfBuilder morphModel(const Grid& grid, const std::vector<std::vector<float>>& targets) {
    GltfBuilder builder = gridModel(grid);
    for (const std::vector<float>& offsets : targets) {
        const std::size_t accessor = builder.addFloats(offsets, 3);
        builder.json()["accessors"].back()["min"] = {0, 0, 0};
        builder.json()["accessors"].back()["max"] = {0, 0, 9};
        firstPrimitive(builder)["targets"].push_back(Json{{"POSITION", accessor}});
    }
    return builder;
}

const Json& targetsOf(const Document& document) { return document.json["meshes"][0]["primitives"][0]["targets"]; }

const Json& accessorOf(const Document& document, std::size_t target, const char* name) {
    return document.json["accessors"][targetsOf(document)[target][name].get<std::size_t>()];
}

std::vector<Vec3> offsetsOf(const GenerateRun& outcome, std::size_t target, const char* name) {
    return readOffsets(outcome.after, outcome.primitives[0], target, name);
}

double lengthOf(const Vec3& v) { return std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z); }

TEST(MorphGltf, TangentsFollowGeneratedNormalsAsTheyAreWritten) {
    Grid grid(4);
    for (std::size_t i = 0; i < grid.positions.size(); i += 3)
        grid.positions[i + 2] = 0.3f * grid.positions[i] * grid.positions[i + 1];
    GltfBuilder builder = morphModel(grid, {lifted(grid, [](float x, float) { return x > 2; })});
    firstPrimitive(builder)["attributes"].erase("NORMAL");
    builder.json()["extensionsUsed"] = builder.json()["extensionsRequired"] = {"KHR_mesh_quantization"};
    run(builder,
        {.storage = {.format = VectorFormat::snorm16}});  // a second run reads the deltas, and must change nothing
    run(builder, {.storage = {.format = VectorFormat::snorm8}});
}

TEST(MorphGltf, GivesDeltasToTargetsThatMoveTheSurfaceOnly) {
    const Grid grid(4);
    GltfBuilder builder = morphModel(grid, {allLifted(grid), noneLifted(grid)});
    Json& targets = firstPrimitive(builder)["targets"];
    const std::size_t positions = targets[0]["POSITION"].get<std::size_t>();
    targets.push_back(Json{{"NORMAL", positions}});
    const std::size_t colors = builder.addFloats(noneLifted(grid), 3);
    firstPrimitive(builder)["attributes"]["COLOR_0"] = colors;
    targets.push_back(Json{{"COLOR_0", colors}});
    const GenerateRun outcome = run(builder);
    const Json& after = targetsOf(outcome.after);
    for (const std::size_t moving : {0, 1, 2}) EXPECT_TRUE(after[moving].contains("TANGENT")) << moving;
    EXPECT_FALSE(after[3].contains("TANGENT"));
    EXPECT_FALSE(after[0].contains("NORMAL")) << "the base has normals, and the target does not turn them";
    EXPECT_EQ(outcome.report.primitives[0].morph_target_count, 4u);
    EXPECT_EQ(outcome.report.primitives[0].morph_deltas_computed, 3u);
    EXPECT_EQ(outcome.report.primitives[0].vertices_after, 30u);
    // Points move by an amount that depends only on y. Points with equal v therefore stay in line, and T, which is
    // along this line, does not change.
    for (const Vec3& offset : offsetsOf(outcome, 0, "TANGENT")) EXPECT_LT(lengthOf(offset), 1e-6);
}

TEST(MorphGltf, StoresDeltasSparselyWhereMostAreZero) {
    const Grid grid(40);
    const auto one = lifted(grid, [](float x, float y) { return x == 1 && y == 1; });
    const auto slope = [&] {
        std::vector<float> offsets = noneLifted(grid);
        for (std::size_t i = 0; i < offsets.size(); i += 3) offsets[i + 1] = std::sin(grid.positions[i]);
        return offsets;
    }();
    const GenerateRun outcome = run(morphModel(grid, {one, noneLifted(grid), slope}));
    const Json& few = accessorOf(outcome.after, 0, "TANGENT");
    ASSERT_TRUE(few.contains("sparse"));
    EXPECT_FALSE(few.contains("bufferView"));
    EXPECT_EQ(few["sparse"]["count"], 7) << "the vertex and those it shares a triangle with";
    for (const char* part : {"indices", "values"}) {
        const Json& view = outcome.after.json["bufferViews"][few["sparse"][part]["bufferView"].get<std::size_t>()];
        EXPECT_FALSE(view.contains("target"));
        EXPECT_FALSE(view.contains("byteStride"));
    }
    const Json& none = accessorOf(outcome.after, 1, "TANGENT");
    // Assimp rejects accessors that have neither a view nor sparse values, so one zero is stored.
    ASSERT_TRUE(none.contains("sparse") && !none.contains("bufferView"));
    EXPECT_EQ(none["sparse"]["count"], 1);
    for (const Vec3& offset : offsetsOf(outcome, 1, "TANGENT")) EXPECT_EQ(lengthOf(offset), 0);
    const GenerateRun small = run(morphModel(Grid(2), {allLifted(Grid(2)), noneLifted(Grid(2))}));
    for (const Json& accessor : small.after.json["accessors"]) EXPECT_TRUE(accessor.contains("bufferView"));
    const Json& all = accessorOf(outcome.after, 2, "TANGENT");
    EXPECT_TRUE(all.contains("bufferView") && !all.contains("sparse"));
}

TEST(MorphGltf, GivesDeltasToGeneratedNormals) {
    const Grid grid(4);
    GltfBuilder builder = morphModel(grid, {allLifted(grid), lifted(grid, [](float x, float) { return x == 2; })});
    firstPrimitive(builder)["attributes"].erase("NORMAL");
    const GenerateRun outcome = run(builder);
    EXPECT_TRUE(outcome.report.primitives[0].normals_generated);
    const std::vector<Vec3> normals = readVec3(outcome.after, outcome.primitives[0], "NORMAL");
    for (const std::size_t target : {0, 1}) {
        const std::vector<Vec3> offsets = offsetsOf(outcome, target, "NORMAL");
        ASSERT_EQ(offsets.size(), normals.size());
        const auto moved = offsetsOf(outcome, target, "POSITION");
        const auto corners = readTriangleCorners(outcome.after, outcome.primitives[0]);
        const auto positions = readVec3(outcome.after, outcome.primitives[0], "POSITION");
        const auto at = [&](std::size_t c) {
            const Vec3 p = positions[corners[c]], o = moved[corners[c]];
            return Vec3{p.x + o.x, p.y + o.y, p.z + o.z};
        };
        for (std::size_t c = 0; c < corners.size(); ++c) {
            const Vec3 a = at(c - c % 3), b = at(c - c % 3 + 1), d = at(c - c % 3 + 2);
            const Vec3 e{b.x - a.x, b.y - a.y, b.z - a.z}, f{d.x - a.x, d.y - a.y, d.z - a.z};
            const Vec3 n{e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
            const double size = lengthOf(n);
            const Vec3 got = normals[corners[c]], o = offsets[corners[c]];
            EXPECT_NEAR(got.x + o.x, n.x / size, 2e-5);
            EXPECT_NEAR(got.y + o.y, n.y / size, 2e-5);
            EXPECT_NEAR(got.z + o.z, n.z / size, 2e-5);
        }
    }
    EXPECT_GT(outcome.report.primitives[0].vertices_after, 60u) << "the second target bends the plane at edges";
}

TEST(MorphGltf, SharesWhatPrimitivesShare) {
    const Grid grid(4);
    GltfBuilder builder = morphModel(grid, {allLifted(grid)});
    const Json first = firstPrimitive(builder);
    builder.json()["meshes"][0]["primitives"].push_back(first);
    const GenerateRun outcome = run(builder);
    ASSERT_EQ(outcome.primitives.size(), 2u);
    EXPECT_EQ(outcome.primitives[0].targets, outcome.primitives[1].targets);
    EXPECT_EQ(outcome.primitives[0].attributes, outcome.primitives[1].attributes);
}

TEST(MorphGltf, KeepsSparseTargetsSparseThroughASplit) {
    const Grid grid(20);
    GltfBuilder builder = gridModel(grid);
    const std::size_t indices = builder.addView(bytesOfValues<std::uint16_t>({7, 10, 12}));
    const std::size_t values = builder.addView(bytesOfValues<float>({1, 2, 3, 4, 5, 6, 7, 8, 9}));
    builder.json()["accessors"].push_back({{"componentType", 5126},
                                           {"count", grid.vertexCount()},
                                           {"type", "VEC3"},
                                           {"min", {0, 0, 0}},
                                           {"max", {7, 8, 9}},
                                           {"sparse",
                                            {{"count", 3},
                                             {"indices", {{"bufferView", indices}, {"componentType", kU16}}},
                                             {"values", {{"bufferView", values}}}}}});
    firstPrimitive(builder)["targets"] = Json::array({Json{{"POSITION", 4}}});
    const GenerateRun outcome = run(builder);
    EXPECT_GT(outcome.report.primitives[0].vertices_after, grid.vertexCount());
    const Json& accessor = accessorOf(outcome.after, 0, "POSITION");
    ASSERT_TRUE(accessor.contains("sparse"));
    EXPECT_EQ(accessor["sparse"]["count"], 4) << "vertex 10 lies on the mirrored seam and was doubled";
    EXPECT_EQ(outcome.after.json["accessors"].size(), outcome.before.json["accessors"].size() + 2);
    const std::size_t new_views = 1 + 2;  // one for tangents, and two for their deltas: indices and values
    EXPECT_EQ(outcome.after.json["bufferViews"].size(), outcome.before.json["bufferViews"].size() + new_views)
        << "entries are re-used";
}

/// Returns a generated model from which the deltas of its first target were removed.
Document withoutFirstDeltas(const TempFolder& folder, const std::string& name) {
    const Grid grid(12);
    std::vector<float> wave = noneLifted(grid);
    for (std::size_t i = 0; i < wave.size(); i += 3) wave[i + 1] = std::sin(grid.positions[i]);
    const std::string model = folder.write("made.glb", morphModel(grid, {wave, allLifted(grid)}).glb());
    const std::string made = folder.path("whole.gltf").string();
    EXPECT_TRUE(generateFile(model, made, {}));
    Document whole = gltf::loadDocument(made, {});
    Json json = whole.json;
    json["meshes"][0]["primitives"][0]["targets"][0].erase("TANGENT");
    folder.write(name, toBytes(json.dump()));
    return whole;
}

TEST(MorphGltf, AddsMissingDeltasToKeptTangentsThatAgree) {
    const TempFolder folder;
    const Document whole = withoutFirstDeltas(folder, "part.gltf");
    const std::string part = folder.path("part.gltf").string(), output = folder.path("out.gltf").string();
    const auto report = generateFile(part, output, {});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->primitives[0].action, PrimitiveAction::kept);
    EXPECT_EQ(report->primitives[0].morph_deltas_computed, 1u);
    EXPECT_TRUE(report->changed);
    const Document after = gltf::loadDocument(output, {});
    for (const std::string& difference : differences(gltf::loadDocument(part, {}), after, *report))
        ADD_FAILURE() << difference;
    const auto deltas = [](const Document& document) {
        return copyElements(document, readAccessor(document, targetsOf(document)[0]["TANGENT"].get<std::size_t>()));
    };
    EXPECT_EQ(deltas(after), deltas(whole));
    const auto again = generateFile(output, output, {});
    EXPECT_TRUE(again && !again->changed);
}

TEST(MorphGltf, AddsNoDeltasToKeptTangentsThatDiffer) {
    const TempFolder folder;
    withoutFirstDeltas(folder, "part.gltf");
    GenerateOptions options;
    options.tangents.compute.convention = conventions::opengl;  // this convention requires the opposite sign
    const auto report = generateFile(folder.path("part.gltf").string(), folder.path("out.gltf").string(), options);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_FALSE(report->changed);
    EXPECT_EQ(report->primitives[0].morph_deltas_computed, 0u);
    EXPECT_NE(report->primitives[0].reason.find("864 corners differ"), std::string::npos)
        << report->primitives[0].reason;
}

TEST(MorphGltf, DoesNotGrowWhenDeltasAreReplaced) {
    const TempFolder folder;
    const Grid grid(30);
    const auto few = lifted(grid, [](float x, float y) { return x < 4 && y < 4; });
    const std::string file = folder.write("model.glb", morphModel(grid, {few, allLifted(grid)}).glb());
    GenerateOptions options;
    options.selection.existing = ExistingTangents::replace;
    ASSERT_TRUE(generateFile(file, file, options));
    const Bytes first = readFile(file);
    for (const Method method : {Method::lengyel, Method::basis, Method::mikktspace}) {
        options.tangents.compute.method = method;
        const auto report = generateFile(file, file, options);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_TRUE(report->changed);
    }
    const Document after = gltf::loadDocument(file, {});
    EXPECT_LE(readFile(file).size(), first.size() + 512) << "but for some JSON";
    EXPECT_TRUE(accessorOf(after, 0, "TANGENT").contains("sparse"));
}

TEST(MorphGltf, ReadsQuantizedOffsets) {
    const Grid grid(4);
    GltfBuilder builder = gridModel(grid);
    std::vector<std::int8_t> offsets;
    for (std::size_t v = 0; v < grid.vertexCount(); ++v) {
        const auto x = static_cast<int>(grid.positions[3 * v]);
        for (const int value : {0, x % 2, 0, 0}) offsets.push_back(static_cast<std::int8_t>(value));
    }
    const std::size_t accessor = builder.addAccessor(offsets, 5120, "VEC3", grid.vertexCount());
    builder.json()["bufferViews"].back()["byteStride"] = 4;
    builder.json()["extensionsUsed"] = builder.json()["extensionsRequired"] = {"KHR_mesh_quantization"};
    firstPrimitive(builder)["targets"] = Json::array({Json{{"POSITION", accessor}}});
    const GenerateRun outcome = run(builder);
    // Columns are displaced along y by one step of x in alternation, so at the left border T is rotated by 45 degrees.
    const std::vector<Vec3> deltas = offsetsOf(outcome, 0, "TANGENT");
    const std::vector<Vec4> tangents = readTangents(outcome.after, outcome.primitives[0]);
    EXPECT_NEAR(tangents[0].x + deltas[0].x, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(tangents[0].y + deltas[0].y, std::sqrt(0.5), 1e-6);
}

TEST(MorphGltf, KeepsOffsetsThatAreNotVectors) {
    const TempFolder folder;
    const Grid grid(4);
    GltfBuilder builder = gridModel(grid);
    firstPrimitive(builder)["targets"] = Json::array({Json{{"POSITION", 2}}});
    const std::string input = folder.write("in.glb", builder.glb()), output = folder.path("out.glb").string();
    const auto report = generateFile(input, output, {});
    ASSERT_TRUE(report) << report.error().message;
    const gltf::Document written = gltf::parseDocument(readFile(output), output, {});
    EXPECT_EQ(written.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"], 2u);
}

}  // namespace
}  // namespace tspace
