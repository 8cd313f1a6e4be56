// SPDX-License-Identifier: MIT
// checkFile on packed frames: correct ones are accepted, faults are detected, and the suggested remedies work.
#include <gtest/gtest.h>

#include <functional>

#include "model/generate_run.h"
#include "model/gltf/packed_layout.h"
#include "model/io/file_io.h"
#include "support/shared_data.h"
#include "tspace/check.h"

namespace tspace {
namespace {

using gltf::Json;
using namespace test;

constexpr FrameFormat kAllFormats[] = {FrameFormat::frame32,     FrameFormat::frame48,    FrameFormat::frame64,
                                       FrameFormat::oct32,       FrameFormat::qtangent64, FrameFormat::snorm8Pair,
                                       FrameFormat::snorm16Pair, FrameFormat::gltfSnorm8, FrameFormat::gltfSnorm16};

void pack(const std::string& input, const std::string& output, FrameFormat format, PackDrop drop = PackDrop::nothing) {
    GenerateOptions options;
    options.storage.pack = format;
    options.storage.pack_drop = drop;
    const auto report = generateFile(input, output, options);
    ASSERT_TRUE(report) << report.error().message;
}

CheckReport check(const std::string& file, unsigned threads = 1) {
    CheckOptions options;
    options.images = false;
    options.execution.thread_count = threads;
    auto report = checkFile(file, options);
    EXPECT_TRUE(report) << report.error().message << " at " << report.error().place;
    return report ? *std::move(report) : CheckReport{};
}

const Finding* find(const CheckReport& report, FindingCode code) {
    for (const Finding& finding : report.findings) {
        if (finding.code == code) return &finding;
    }
    return nullptr;
}

/// A model of a grid with TANGENT and _FRAME32 attributes, which `edit` changes after packing.
class PackedGrid {
  public:
    explicit PackedGrid(const std::function<void(GltfBuilder&)>& edit) {
        GltfBuilder model = gridModel(Grid(4, false));
        const std::vector<Vec3> normals(25, {0, 0, 1});
        const std::vector<Vec4> tangents(25, {1, 0, 0, 1});
        std::vector<std::uint8_t> words(100);
        EXPECT_TRUE(packFrames(std::span(normals), std::span(tangents), FrameFormat::frame32,
                               std::as_writable_bytes(std::span(words))));
        std::vector<float> numbers;
        for (const Vec4& t : tangents) numbers.insert(numbers.end(), {t.x, t.y, t.z, t.w});
        Json& attributes = firstPrimitive(model)["attributes"];
        attributes["TANGENT"] = model.addFloats(numbers, 4);
        attributes["_FRAME32"] = model.addAccessor(words, kU8, "VEC4", 25);
        edit(model);
        file_ = folder_.write("in.glb", model.glb());
    }
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] std::string output() const { return folder_.path("out.glb").string(); }

  private:
    TempFolder folder_;
    std::string file_;
};

Json& packedAccessor(GltfBuilder& model) {
    return model.json()["accessors"][firstPrimitive(model)["attributes"]["_FRAME32"].get<std::size_t>()];
}

TEST(CheckPacked, ReportsTheErrorInEveryFormat) {
    for (const FrameFormat format : kAllFormats) {
        SCOPED_TRACE(frameFormatName(format));
        const PackedGrid grid([](GltfBuilder&) {});
        pack(grid.file(), grid.output(), format);
        const CheckReport report = check(grid.output());
        const std::string last = gltf::packedLayout(format).parts[0].attribute;
        const auto info = std::find_if(report.packed_frames.begin(), report.packed_frames.end(),
                                       [&](const PackedFramesInfo& entry) { return entry.format == format; });
        ASSERT_NE(info, report.packed_frames.end());
        EXPECT_EQ(info->attribute, last);
        EXPECT_EQ(info->place, "/meshes/0/primitives/0/attributes/" + last);
        EXPECT_EQ(info->vertex_count, 25u);
        EXPECT_TRUE(info->is_readable && info->is_compared);
        EXPECT_LE(info->worst_normal_deg, frameErrorBound(format).normal_deg);
        EXPECT_LE(info->worst_tangent_deg, frameErrorBound(format).tangent_deg);
        EXPECT_EQ(info->differing_sign_count, 0u);
        EXPECT_EQ(find(report, FindingCode::packedFramesDiffer), nullptr);
        EXPECT_EQ(find(report, FindingCode::packedFramesUnreadable), nullptr);
    }
}

TEST(CheckPacked, FindsNothingInOutputsOfGenerate) {
    double worst = 0;
    for (const char* name : {"khronos/NormalTangentTest.glb", "derived/NormalTangentTest_quantized.glb",
                             "blender/01_morphed_cube/01_morphed_cube.gltf", "khronos/CesiumMan.glb"}) {
        const auto model = shared("models") / name;
        if (!std::filesystem::exists(model)) GTEST_SKIP() << "test data " << model << " is missing";
        const TempFolder folder;
        const std::string output = folder.path("out.glb").string();
        GenerateOptions options;
        options.selection.all = true;
        options.storage.pack = FrameFormat::frame32;
        ASSERT_TRUE(generateFile(model.string(), output, options));
        const CheckReport report = check(output);
        EXPECT_EQ(find(report, FindingCode::packedFramesDiffer), nullptr) << name;
        ASSERT_FALSE(report.packed_frames.empty()) << name;
        for (const PackedFramesInfo& info : report.packed_frames) {
            EXPECT_TRUE(info.is_compared);
            EXPECT_EQ(info.differing_sign_count, 0u);
            worst = std::max({worst, info.worst_normal_deg, info.worst_tangent_deg});
        }
    }
    EXPECT_LE(worst, 0.135 + 0.00015);
    EXPECT_GT(worst, 0.1) << "it was measured";
}

TEST(CheckPacked, ComparesWithRepairedTangents) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", withTangents(Grid(4)).glb()),
                      output = folder.path("out.glb").string();
    pack(input, output, FrameFormat::oct32);
    EXPECT_EQ(find(check(output), FindingCode::packedFramesDiffer), nullptr) << "packing again would change nothing";
}

TEST(CheckPacked, FindsWrongFramesAndSigns) {
    const PackedGrid turned([](GltfBuilder& model) {
        const std::vector<Vec3> normals(1, {0, 0, 1});
        const std::vector<Vec4> tangents(1, {0, 1, 0, -1});
        std::uint8_t* words = model.bytes().data() + model.bytes().size() - 100;
        ASSERT_TRUE(packFrames(std::span(normals), std::span(tangents), FrameFormat::frame32,
                               std::as_writable_bytes(std::span(words + 4 * 7, 4))));
        words[4 * 9] ^= 1;  // the lowest bit is the sign
    });
    const CheckReport report = check(turned.file());
    const Finding* finding = find(report, FindingCode::packedFramesDiffer);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity, Severity::warning);
    EXPECT_EQ(finding->place, "/meshes/0/primitives/0/attributes/_FRAME32");
    EXPECT_EQ(finding->count, 2u);
    EXPECT_EQ(finding->total, 25u);
    EXPECT_EQ(finding->vertices, (std::vector<std::uint32_t>{7, 9}));
    EXPECT_NEAR(finding->worst_deg, 90, 0.14);
    EXPECT_NE(finding->message.find("the sign differs at 2"), std::string::npos) << finding->message;
    EXPECT_EQ(finding->remedy, "Pack them again: tspace generate --pack frame32.");
    ASSERT_EQ(report.packed_frames.size(), 1u);
    EXPECT_EQ(report.packed_frames[0].differing_sign_count, 2u);
    EXPECT_EQ(report.packed_frames[0].worst_normal_deg, 0);
}

TEST(CheckPacked, SmallDifferencesAreANote) {
    const PackedGrid leaning([](GltfBuilder& model) {
        const std::vector<Vec3> normals(1, {0, 0.00873f, 0.99996f});  // tilted by half a degree
        const std::vector<Vec4> tangents(1, {1, 0, 0, 1});
        std::uint8_t* words = model.bytes().data() + model.bytes().size() - 100;
        ASSERT_TRUE(packFrames(std::span(normals), std::span(tangents), FrameFormat::frame32,
                               std::as_writable_bytes(std::span(words, 4))));
    });
    const CheckReport report = check(leaning.file());
    const Finding* finding = find(report, FindingCode::packedFramesDiffer);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity, Severity::note);
}

TEST(CheckPacked, FindsAccessorsThatAreNotPackedFramesAndTheirRemedyWorks) {
    struct Case {
        std::string fault;
        std::function<void(GltfBuilder&)> edit;
    };
    const Case cases[] = {
        {"is uint32, but must be uint8x4",
         [](GltfBuilder& model) {
             packedAccessor(model)["componentType"] = kU32;
             packedAccessor(model)["type"] = "SCALAR";
         }},
        {"is unorm8x4, but must be uint8x4", [](GltfBuilder& model) { packedAccessor(model)["normalized"] = true; }},
        {"is uint8x3, but must be uint8x4", [](GltfBuilder& model) { packedAccessor(model)["type"] = "VEC3"; }},
        {"is uint8 with an unknown accessor type, but must be uint8x4",
         [](GltfBuilder& model) { packedAccessor(model)["type"] = "VEC5"; }},
        {"has 3 elements, but the primitive has 25 vertices",
         [](GltfBuilder& model) { packedAccessor(model)["count"] = 3; }},
        {"has 1048577 elements, but the primitive has 25 vertices",
         [](GltfBuilder& model) {
             packedAccessor(model)["count"] = 1048577;
             packedAccessor(model).erase("bufferView");
         }},
    };
    for (const Case& broken : cases) {
        SCOPED_TRACE(broken.fault);
        const PackedGrid grid(broken.edit);
        const CheckReport report = check(grid.file());
        const Finding* finding = find(report, FindingCode::packedFramesUnreadable);
        ASSERT_NE(finding, nullptr);
        EXPECT_EQ(finding->severity, Severity::warning);
        EXPECT_EQ(finding->place, "/meshes/0/primitives/0/attributes/_FRAME32");
        EXPECT_EQ(finding->message, "_FRAME32 " + broken.fault);
        EXPECT_EQ(finding->remedy, "Pack them again: tspace generate --pack frame32.");
        ASSERT_EQ(report.packed_frames.size(), 1u);
        EXPECT_FALSE(report.packed_frames[0].is_readable);
        pack(grid.file(), grid.output(), FrameFormat::frame32);
        const CheckReport mended = check(grid.output());
        EXPECT_EQ(find(mended, FindingCode::packedFramesUnreadable), nullptr);
        ASSERT_EQ(mended.packed_frames.size(), 1u);
        EXPECT_TRUE(mended.packed_frames[0].is_compared);
        EXPECT_EQ(mended.packed_frames[0].worst_tangent_deg, 0) << "frames along axes are exact";
    }
}

TEST(CheckPacked, FindsHalfOfAPair) {
    const PackedGrid grid([](GltfBuilder& model) {
        Json& attributes = firstPrimitive(model)["attributes"];
        attributes["_GLTF_SNORM8_NORMAL"] = model.addAccessor(std::vector<std::uint8_t>(75), 5120, "VEC3", 25);
        model.json()["accessors"].back()["normalized"] = true;
    });
    const Finding* finding = nullptr;
    const CheckReport report = check(grid.file());
    finding = find(report, FindingCode::packedFramesUnreadable);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->message, "_GLTF_SNORM8_NORMAL needs the attribute _GLTF_SNORM8_TANGENT, which is missing");
}

TEST(CheckPacked, RejectsAWrongLengthIfNothingRecomputesIt) {
    const PackedGrid grid([](GltfBuilder& model) { packedAccessor(model)["count"] = 3; });
    GenerateOptions other;
    other.storage.pack = FrameFormat::oct32;
    for (const GenerateOptions& options : {GenerateOptions{}, other}) {
        const auto report = generateFile(grid.file(), grid.output(), options);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().code, ErrorCode::invalidFile);
        EXPECT_EQ(report.error().place, "/meshes/0/primitives/0/attributes/_FRAME32");
    }
}

TEST(CheckPacked, AccessorsThatLeaveTheirBufferAreAnError) {
    const PackedGrid grid([](GltfBuilder& model) { packedAccessor(model)["byteOffset"] = 4; });
    const auto report = checkFile(grid.file());
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalidFile);
}

TEST(CheckPacked, GivesNoCommandIfNothingCanBePacked) {
    const PackedGrid grid([](GltfBuilder& model) {
        packedAccessor(model)["normalized"] = true;
        firstPrimitive(model)["attributes"].erase("TANGENT");
        firstPrimitive(model)["material"] = 1;
    });
    const CheckReport report = check(grid.file());
    const Finding* finding = find(report, FindingCode::packedFramesUnreadable);
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->remedy.find("tspace"), std::string::npos) << finding->remedy;
}

TEST(CheckPacked, OnlyPackedTangentsAreMissingForOtherReaders) {
    for (const PackDrop drop : {PackDrop::tangents, PackDrop::all}) {
        const PackedGrid grid([](GltfBuilder&) {});
        pack(grid.file(), grid.output(), FrameFormat::frame32, drop);
        const CheckReport report = check(grid.output());
        ASSERT_EQ(report.packed_frames.size(), 1u);
        EXPECT_TRUE(report.packed_frames[0].is_readable);
        EXPECT_FALSE(report.packed_frames[0].is_compared);
        const Finding* finding = find(report, FindingCode::tangentsMissing);
        ASSERT_NE(finding, nullptr);
        EXPECT_EQ(finding->severity, Severity::note);
        const bool names_command = finding->remedy.find("tspace generate --overwrite") != std::string::npos;
        EXPECT_EQ(names_command, drop == PackDrop::tangents) << finding->remedy;
        GenerateOptions options;
        options.selection.existing = ExistingTangents::replace;
        ASSERT_TRUE(generateFile(grid.output(), grid.output(), options));
        EXPECT_EQ(find(check(grid.output()), FindingCode::tangentsMissing) == nullptr, names_command);
    }
}

TEST(CheckPacked, IsTheSameForAnyNumberOfThreads) {
    const PackedGrid grid([](GltfBuilder& model) {
        model.bytes()[model.bytes().size() - 30] ^= 0x55;
        Json& primitives = model.json()["meshes"][0]["primitives"];
        primitives.push_back(Json(primitives[0]));
        primitives.push_back(Json(primitives[0]));
        primitives[2]["attributes"].erase("TANGENT");
    });
    const CheckReport one = check(grid.file(), 1), two = check(grid.file(), 2);
    ASSERT_EQ(one.packed_frames.size(), 3u);
    ASSERT_EQ(two.packed_frames.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(one.packed_frames[i].worst_normal_deg, two.packed_frames[i].worst_normal_deg);
        EXPECT_EQ(one.packed_frames[i].place, two.packed_frames[i].place);
        EXPECT_EQ(one.packed_frames[i].is_compared, i < 2);
    }
    EXPECT_EQ(one.packed_frames[0].worst_tangent_deg, one.packed_frames[1].worst_tangent_deg)
        << "the arrays are shared";
}

}  // namespace
}  // namespace tspace
