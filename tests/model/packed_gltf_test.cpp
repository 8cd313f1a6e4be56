// SPDX-License-Identifier: MIT
// generateFile with packed frames: values of the attributes, effects on other attributes, and a second run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/vec_math.h"
#include "generate_run.h"
#include "model/gltf/packed_frames.h"
#include "model/gltf/packed_layout.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

using gltf::Json;
using gltf::Primitive;
using namespace test;

constexpr FrameFormat kFormats[] = {FrameFormat::frame32,     FrameFormat::frame48,    FrameFormat::frame64,
                                    FrameFormat::oct32,       FrameFormat::qtangent64, FrameFormat::snorm8Pair,
                                    FrameFormat::snorm16Pair, FrameFormat::gltfSnorm8, FrameFormat::gltfSnorm16};

GenerateOptions packing(FrameFormat format, PackDrop drop = PackDrop::nothing) {
    GenerateOptions options;
    options.storage.pack = format;
    options.storage.pack_drop = drop;
    return options;
}

struct Frames {
    std::vector<Vec3> normals;
    std::vector<Vec4> tangents;
};

Frames unpacked(const gltf::Document& document, const Primitive& primitive, FrameFormat format) {
    const Bytes words = readPackedWords(document, primitive, gltf::packedLayout(format));
    Frames frames{std::vector<Vec3>(primitive.vertex_count), std::vector<Vec4>(primitive.vertex_count)};
    EXPECT_TRUE(
        unpackFrames(std::as_bytes(std::span(words)), format, std::span(frames.normals), std::span(frames.tangents)));
    return frames;
}

/// Checks that packed frames match the stored NORMAL and TANGENT within the error bound of the format.
void expectPacked(const gltf::Document& document, const Primitive& primitive, FrameFormat format) {
    ASSERT_TRUE(primitive.find("NORMAL") && primitive.find("TANGENT"));
    const Frames frames = unpacked(document, primitive, format);
    const FrameErrorBound bound = frameErrorBound(format);
    const std::vector<Vec3> normals = readVec3(document, primitive, "NORMAL");
    const std::vector<Vec4> tangents = readTangents(document, primitive);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        // The stored frames are orthonormal only to float precision.
        constexpr double kDegrees = 180 / kPi, kFloats = 3e-5;
        EXPECT_LE(angleBetween(toDouble(frames.normals[i]), toDouble(normals[i])) * kDegrees,
                  bound.normal_deg + kFloats);
        EXPECT_LE(angleBetween(toDouble(xyz(frames.tangents[i])), toDouble(xyz(tangents[i]))) * kDegrees,
                  bound.tangent_deg + kFloats);
        EXPECT_EQ(frames.tangents[i].w, tangents[i].w);
    }
}

/// Returns a bent grid, whose frames are not axis-aligned.
Grid bentGrid(std::size_t size = 6) {
    Grid grid(size);
    for (std::size_t i = 0; i < grid.vertexCount(); ++i) {
        const float x = grid.positions[3 * i] / static_cast<float>(size);
        grid.positions[3 * i + 2] = x * x;
        const float length = std::sqrt(1 + 4 * x * x);
        grid.normals[3 * i] = -2 * x / length;
        grid.normals[3 * i + 2] = 1 / length;
    }
    return grid;
}

const Json& accessorOf(const gltf::Document& document, const Primitive& primitive, const char* name) {
    return document.json["accessors"][*primitive.find(name)];
}

TEST(PackedGltf, StoresTheFramesOfTheFileInEveryFormat) {
    for (const FrameFormat format : kFormats) {
        SCOPED_TRACE(frameFormatName(format));
        const GenerateRun outcome = run(gridModel(bentGrid()), packing(format));
        ASSERT_EQ(outcome.primitives.size(), 1u);
        EXPECT_TRUE(outcome.report.primitives[0].frames_packed);
        EXPECT_EQ(outcome.report.primitives[0].packing.mendedCount(), 0u);
        EXPECT_GT(outcome.report.primitives[0].vertices_after, outcome.report.primitives[0].vertices_before);
        expectPacked(outcome.after, outcome.primitives[0], format);
    }
}

TEST(PackedGltf, UsesValidAccessors) {
    for (const FrameFormat format : kFormats) {
        SCOPED_TRACE(frameFormatName(format));
        const gltf::PackedLayout& layout = gltf::packedLayout(format);
        EXPECT_EQ(layout.format, format);
        const GenerateRun outcome = run(gridModel(Grid(4)), packing(format));
        std::size_t bytes = 0;
        for (const gltf::PackedPart& part : layout.parts) {
            EXPECT_EQ(part.begin, bytes) << "together the parts are the word";
            bytes += part.byte_count;
            EXPECT_EQ(part.attribute[0], '_') << "only names that begin so are free";
            const gltf::Accessor accessor = readAccessor(outcome.after, *outcome.primitives.at(0).find(part.attribute));
            EXPECT_NE(accessor.component, gltf::ComponentType::u32) << "not allowed for attributes";
            EXPECT_LE(accessor.component_count, 4u);
            EXPECT_EQ(accessor.element_bytes, part.byte_count);
            EXPECT_EQ(accessor.stride % 4, 0u);
            EXPECT_EQ(accessor.byte_offset % 4, 0u);
        }
        EXPECT_EQ(bytes, frameBytes(format));
        EXPECT_FALSE(outcome.after.json.contains("extensionsRequired"));
    }
}

TEST(PackedGltf, IsFourBytesForFrame32) {
    const GenerateRun outcome = run(gridModel(Grid(4)), packing(FrameFormat::frame32));
    const Json& accessor = accessorOf(outcome.after, outcome.primitives.at(0), "_FRAME32");
    EXPECT_EQ(accessor["type"], "VEC4");
    EXPECT_EQ(accessor["componentType"], kU8);
    EXPECT_EQ(accessor["count"], outcome.report.primitives[0].vertices_after);
    EXPECT_FALSE(accessor.contains("normalized"));
}

TEST(PackedGltf, PacksAndRepairsKeptTangents) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", withTangents(Grid(4)).glb()),
                      output = folder.path("out.glb").string();
    const auto report = generateFile(input, output, packing(FrameFormat::oct32));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->primitives[0].action, PrimitiveAction::kept);
    EXPECT_TRUE(report->primitives[0].frames_packed);
    EXPECT_EQ(report->primitives[0].packing.not_orthogonal_count + report->primitives[0].packing.not_unit_count +
                  report->primitives[0].packing.bad_sign_count,
              25u);
    const gltf::Document before = gltf::loadDocument(input, {}), after = gltf::loadDocument(output, {});
    const Primitive a = readPrimitives(before).at(0), b = readPrimitives(after).at(0);
    EXPECT_EQ(readTangents(before, a), readTangents(after, b)) << "those in the file stay as they are";
    for (const Vec4& t : unpacked(after, b, FrameFormat::oct32).tangents) EXPECT_EQ(t.w, 1);
}

TEST(PackedGltf, IsOmittedWithAReasonIfAFrameIsMissing) {
    GltfBuilder model = gridModel(Grid(4));
    firstPrimitive(model)["material"] = 1;
    const GenerateRun outcome = run(model, packing(FrameFormat::frame32));
    const PrimitiveReport& report = outcome.report.primitives.at(0);
    EXPECT_FALSE(outcome.report.changed);
    EXPECT_FALSE(report.frames_packed);
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_EQ(report.notes[0], "its frames were not packed: it has no TANGENT; use --all to add it");
    GenerateOptions all = packing(FrameFormat::frame32);
    all.selection.all = true;
    EXPECT_TRUE(run(model, all).report.primitives.at(0).frames_packed) << "the advice holds";
}

TEST(PackedGltf, UsesTheStoredNumbers) {
    for (const VectorFormat numbers : {VectorFormat::snorm16, VectorFormat::snorm8}) {
        GenerateOptions options = packing(FrameFormat::frame64);
        options.storage.format = numbers;
        const TempFolder folder;
        const std::string input = folder.write("in.glb", gridModel(bentGrid()).glb()),
                          output = folder.path("out.glb").string();
        ASSERT_TRUE(generateFile(input, output, options));
        const gltf::Document document = gltf::loadDocument(output, {});
        const Primitive primitive = readPrimitives(document).at(0);
        const Frames frames = unpacked(document, primitive, FrameFormat::frame64);
        const std::vector<Vec3> normals = readVec3(document, primitive, "NORMAL");
        for (std::size_t i = 0; i < normals.size(); ++i)
            EXPECT_LE(angleBetween(toDouble(frames.normals[i]), toDouble(normals[i])), 1e-5);
        options.selection.existing = ExistingTangents::keep;
        const auto second = generateFile(output, output, options);
        EXPECT_TRUE(second && !second->changed);
    }
}

TEST(PackedGltf, MayReplaceItsSource) {
    for (const PackDrop drop : {PackDrop::tangents, PackDrop::all}) {
        const TempFolder folder;
        const std::string input = folder.write("in.glb", gridModel(bentGrid()).glb()),
                          whole = folder.path("whole.glb").string(), output = folder.path("out.glb").string();
        ASSERT_TRUE(generateFile(input, whole, packing(FrameFormat::frame32)));
        const GenerateOptions options = packing(FrameFormat::frame32, drop);
        const auto report = generateFile(input, output, options);
        ASSERT_TRUE(report);
        EXPECT_TRUE(report->primitives[0].tangents_dropped);
        EXPECT_EQ(report->primitives[0].normals_dropped, drop == PackDrop::all);
        EXPECT_LT(report->output_bytes, readFile(whole).size());
        const gltf::Document document = gltf::loadDocument(output, {}), full = gltf::loadDocument(whole, {});
        const Primitive primitive = readPrimitives(document).at(0);
        EXPECT_FALSE(primitive.find("TANGENT"));
        EXPECT_EQ(primitive.find("NORMAL").has_value(), drop == PackDrop::tangents);
        const gltf::PackedLayout& layout = gltf::packedLayout(FrameFormat::frame32);
        EXPECT_EQ(readPackedWords(document, primitive, layout),
                  readPackedWords(full, readPrimitives(full).at(0), layout));

        // Neither a run with the same options nor one without options may replace the frames by less accurate ones.
        const Bytes bytes = readFile(output);
        for (const GenerateOptions& again : {options, GenerateOptions{}}) {
            const auto second = generateFile(output, output, again);
            ASSERT_TRUE(second);
            EXPECT_FALSE(second->changed);
            EXPECT_EQ(second->primitives[0].action, PrimitiveAction::kept);
            EXPECT_EQ(second->primitives[0].reason, "its frames are packed in _FRAME32");
            EXPECT_EQ(second->primitives[0].frames_packed, again.storage.pack.has_value());
            EXPECT_TRUE(second->primitives[0].notes.empty());
            EXPECT_EQ(readFile(output), bytes);
        }
        const auto other = generateFile(output, output, packing(FrameFormat::oct32));
        ASSERT_TRUE(other && other->primitives[0].notes.size() == 1);
        EXPECT_EQ(other->primitives[0].notes[0],
                  "its frames were not packed: it has only other packed frames in _FRAME32, not the normals and "
                  "tangents that they were packed from");
    }
}

TEST(PackedGltf, RemovesNothingThatIsUsedElsewhere) {
    GltfBuilder model = gridModel(Grid(4, false));
    model.json()["meshes"][0]["primitives"].push_back(Json(firstPrimitive(model)));
    Json& other = model.json()["meshes"][0]["primitives"][1];
    other["material"] = 1;
    const TempFolder folder;
    const std::string input = folder.write("in.glb", model.glb()), output = folder.path("out.glb").string();
    ASSERT_TRUE(generateFile(input, output, packing(FrameFormat::snorm8Pair, PackDrop::all)));
    const gltf::Document before = gltf::loadDocument(input, {}), after = gltf::loadDocument(output, {});
    const std::vector<Primitive> a = readPrimitives(before), b = readPrimitives(after);
    EXPECT_FALSE(b.at(0).find("NORMAL"));
    ASSERT_TRUE(b.at(1).find("NORMAL"));
    EXPECT_EQ(readVec3(before, a.at(1), "NORMAL"), readVec3(after, b.at(1), "NORMAL"));
}

TEST(PackedGltf, IsSharedByPrimitivesThatShareFrames) {
    GltfBuilder model = gridModel(Grid(4));
    model.json()["meshes"][0]["primitives"].push_back(Json(firstPrimitive(model)));
    const GenerateRun outcome = run(model, packing(FrameFormat::frame32));
    ASSERT_EQ(outcome.primitives.size(), 2u);
    ASSERT_TRUE(outcome.primitives[0].find("_FRAME32"));
    EXPECT_EQ(outcome.primitives[0].find("_FRAME32"), outcome.primitives[1].find("_FRAME32"));
}

TEST(PackedGltf, KeepsTheBaseOfMorphTargets) {
    GltfBuilder model = gridModel(Grid(4));
    std::vector<float> offsets(75, 0);
    for (std::size_t i = 0; i < 25; ++i) offsets[3 * i + 2] = static_cast<float>(i % 3);
    const std::size_t moved = model.addFloats(offsets, 3);
    firstPrimitive(model)["targets"] = Json::array({Json{{"POSITION", moved}}});
    const GenerateRun outcome = run(model, packing(FrameFormat::frame32, PackDrop::all));
    const Primitive& primitive = outcome.primitives.at(0);
    expectPacked(outcome.after, primitive, FrameFormat::frame32);
    EXPECT_FALSE(gltf::findAttribute(primitive.targets.at(0), "_FRAME32"));
    EXPECT_FALSE(outcome.report.primitives[0].tangents_dropped || outcome.report.primitives[0].normals_dropped);
    ASSERT_EQ(outcome.report.primitives[0].notes.size(), 1u);
    EXPECT_EQ(outcome.report.primitives[0].notes[0],
              "its NORMAL and TANGENT were kept in addition to the packed frames, because its morph targets have "
              "deltas for them");
}

TEST(PackedGltf, UpdatesWithReplacedTangentsOnlyOnRequest) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", gridModel(bentGrid()).glb()),
                      packed = folder.path("packed.glb").string(), turned = folder.path("turned.glb").string();
    ASSERT_TRUE(generateFile(input, packed, packing(FrameFormat::frame32)));
    GenerateOptions options;
    options.selection.existing = ExistingTangents::replace;
    options.tangents.compute.convention = conventions::opengl;
    const auto report = generateFile(packed, turned, options);
    ASSERT_TRUE(report && report->primitives[0].notes.size() == 1);
    EXPECT_EQ(report->primitives[0].notes[0],
              "its packed frames in _FRAME32 are outdated (use --pack frame32 to replace them)");
    const auto words = [](const std::string& file) {
        const gltf::Document document = gltf::loadDocument(file, {});
        return readPackedWords(document, readPrimitives(document).at(0), gltf::packedLayout(FrameFormat::frame32));
    };
    EXPECT_EQ(words(turned), words(packed)) << "it is data like any other";
    ASSERT_TRUE(generateFile(turned, turned, packing(FrameFormat::frame32)));
    const gltf::Document document = gltf::loadDocument(turned, {});
    expectPacked(document, readPrimitives(document).at(0), FrameFormat::frame32);
    EXPECT_EQ(document.json["accessors"].size(), gltf::loadDocument(packed, {}).json["accessors"].size())
        << "the old words were overwritten";
}

TEST(PackedGltf, ReplacesInvalidPackedFrames) {
    GltfBuilder model = gridModel(Grid(4, false));
    const std::size_t number = model.addAccessor(std::vector<std::uint32_t>(25, 7), kU32, "SCALAR", 25);
    firstPrimitive(model)["attributes"]["_FRAME32"] = number;
    const TempFolder folder;
    const std::string input = folder.write("in.glb", model.glb()), output = folder.path("out.glb").string();
    ASSERT_TRUE(generateFile(input, output, packing(FrameFormat::frame32)));
    const gltf::Document document = gltf::loadDocument(output, {});
    expectPacked(document, readPrimitives(document).at(0), FrameFormat::frame32);
    EXPECT_EQ(*readPrimitives(document).at(0).find("_FRAME32"), number) << "the entry is used again";
}

TEST(PackedGltf, HasTheSameBytesForAnyNumberOfThreads) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", gridModel(bentGrid(60)).glb());
    Bytes first;
    for (const unsigned threads : {1u, 2u, 3u}) {
        GenerateOptions options = packing(FrameFormat::frame32);
        options.execution.thread_count = threads;
        const std::string output = folder.path("out.glb").string();
        ASSERT_TRUE(generateFile(input, output, options));
        if (first.empty()) first = readFile(output);
        EXPECT_EQ(readFile(output), first) << threads;
    }
}

TEST(PackedGltf, WritesNothingOnADryRun) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", gridModel(Grid(4)).glb());
    const Bytes before = readFile(input);
    GenerateOptions options = packing(FrameFormat::frame32);
    options.dry_run = true;
    const auto report = generateFile(input, input, options);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->changed && report->primitives[0].frames_packed);
    EXPECT_EQ(readFile(input), before);
    options.dry_run = false;
    const auto written = generateFile(input, input, options);
    ASSERT_TRUE(written);
    EXPECT_EQ(written->output_bytes, report->output_bytes);
    EXPECT_EQ(readFile(input).size(), report->output_bytes);
}

TEST(PackedGltf, RejectsInvalidOptions) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", gridModel(Grid(4)).glb());
    GenerateOptions no_pack;
    no_pack.storage.pack_drop = PackDrop::all;
    for (const GenerateOptions& options : {no_pack, packing(static_cast<FrameFormat>(99))}) {
        const auto report = generateFile(input, folder.path("out.glb").string(), options);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().code, ErrorCode::invalidOption);
    }
}

TEST(PackedGltf, NamesEveryFormat) {
    for (const FrameFormat format : kFormats) {
        std::string attribute = std::string("_") + frameFormatName(format);
        std::transform(attribute.begin(), attribute.end(), attribute.begin(),
                       [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
        for (const gltf::PackedPart& part : gltf::packedLayout(format).parts)
            EXPECT_EQ(std::string(part.attribute).rfind(attribute, 0), 0u) << part.attribute;
    }
    EXPECT_STREQ(frameFormatName(static_cast<FrameFormat>(9)), "");
}

}  // namespace
}  // namespace tspace
