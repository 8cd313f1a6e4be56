// SPDX-License-Identifier: MIT
// Commands that read files with normals whose length is not 1; and computed normals at positions that are equal except
// for rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/generate_run.h"
#include "support/scene_file.h"
#include "support/shared_data.h"
#include "tspace/bake_file.h"
#include "tspace/check.h"
#include "tspace/inspect.h"

namespace tspace::test {
namespace {

using gltf::Primitive;

double lengthOf(const Vec3& v) { return std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z); }

double degreesBetween(const Vec3& a, const Vec3& b) {
    const double dots = double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
    return std::acos(std::clamp(dots / (lengthOf(a) * lengthOf(b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// Values of a file as stored, without scaling.
struct Stored {
    gltf::Document document;
    std::vector<Primitive> primitives;

    explicit Stored(const std::string& path) : document(gltf::loadDocument(path, {})) {
        primitives = readPrimitives(document);
        for (Primitive& primitive : primitives) primitive.normal_scales = {};
    }
    [[nodiscard]] std::vector<Vec3> normals(std::size_t i = 0) const {
        return readVec3(document, primitives[i], "NORMAL");
    }
    [[nodiscard]] std::vector<Vec4> tangents(std::size_t i = 0) const { return readTangents(document, primitives[i]); }
};

struct Files {
    TempFolder folder = {};

    [[nodiscard]] std::string input(const GltfBuilder& builder) const { return folder.write("in.glb", builder.glb()); }
    [[nodiscard]] std::string output() const { return folder.path("out.glb").string(); }
};

GenerateReport generated(const std::string& input, const std::string& output, const GenerateOptions& options = {}) {
    auto report = generateFile(input, output, options);
    EXPECT_TRUE(report) << report.error().message;
    return report ? *std::move(report) : GenerateReport{};
}

constexpr const char* kNormalLengths = "normals that do not have unit length";

template <class Report>
std::size_t warningsOnLengths(const Report& report) {
    return static_cast<std::size_t>(
        std::count_if(report.warnings.begin(), report.warnings.end(),
                      [](const std::string& warning) { return warning.rfind(kNormalLengths, 0) == 0; }));
}

/// Returns a bent sheet with a normal map whose normals all have this length.
GltfBuilder sheetOf(float length) {
    ModelData sheet = bentSheet(6);
    for (Vec3& n : sheet.normals) n = {n.x * length, n.y * length, n.z * length};
    GltfBuilder builder;
    builder.json()["materials"] = Json::parse(R"([{"normalTexture":{"index":0}}])");
    builder.json()["textures"] = Json::parse("[{}]");
    const Json attributes = {{"POSITION", builder.addFloats(floatsOf(sheet.positions), 3)},
                             {"NORMAL", builder.addFloats(floatsOf(sheet.normals), 3)},
                             {"TEXCOORD_0", builder.addFloats(floatsOf(sheet.uvs), 2)}};
    const std::size_t indices = builder.addAccessor(sheet.indices, kU32, "SCALAR", sheet.indices.size());
    Json& primitive = builder.addPrimitive(attributes);
    primitive["indices"] = indices;
    primitive["material"] = 0;
    return builder;
}

std::vector<Vec4> tangentsOf(const GltfBuilder& builder, const GenerateOptions& options = {}) {
    const Files files;
    generated(files.input(builder), files.output(), options);
    return Stored(files.output()).tangents();
}

double worstDegrees(const std::vector<Vec4>& a, const std::vector<Vec4>& b) {
    EXPECT_EQ(a.size(), b.size());
    double worst = 0;
    for (std::size_t v = 0; v < std::min(a.size(), b.size()); ++v) {
        EXPECT_EQ(a[v].w, b[v].w);
        worst = std::max(worst, degreesBetween({a[v].x, a[v].y, a[v].z}, {b[v].x, b[v].y, b[v].z}));
    }
    return worst;
}

TEST(NormalLengths, TangentsAreThoseOfUnitNormals) {
    for (const char* name : {"normals_x2", "normals_x100", "normal_vec3_i8_unnorm"}) {
        const std::string input = "reports/second/" + std::string(name) + ".glb";
        TSPACE_NEEDS_SHARED(input);
        const Files files;
        const GenerateReport report = generated(shared(input).string(), files.output());
        EXPECT_EQ(warningsOnLengths(report), 1u);
        const Stored before(shared(input).string()), after(files.output());
        const std::vector<Vec3> normals = after.normals();
        const std::vector<Vec4> tangents = after.tangents();
        EXPECT_EQ(normals, before.normals()) << name;
        // Integers represent directions of normals within half a degree.
        for (std::size_t v = 0; v < normals.size(); ++v)
            EXPECT_NEAR(degreesBetween(normals[v], {tangents[v].x, tangents[v].y, tangents[v].z}), 90, 0.01) << name;
    }
}

TEST(NormalLengths, AreReportedOnceAndOnlyIfWrong) {
    const std::vector<Vec4> wanted = tangentsOf(sheetOf(1));
    for (const float length : {0.5f, 0.99f, 2.0f, 100.0f, 1e-6f, 1e-10f, 1e-18f, 1e30f}) {
        const Files files;
        EXPECT_EQ(warningsOnLengths(generated(files.input(sheetOf(length)), files.output())), 1u) << length;
        EXPECT_LT(worstDegrees(Stored(files.output()).tangents(), wanted), 0.01) << length;
    }
    for (const float length : {1.0f, 0.994f, 1.006f}) {
        const Files files;
        EXPECT_EQ(warningsOnLengths(generated(files.input(sheetOf(length)), files.output())), 0u) << length;
    }
}

TEST(NormalLengths, AreReportedByCommandsThatOnlyRead) {
    for (const float length : {1.0f, 2.0f}) {
        const Files files;
        const std::string input = files.input(sheetOf(length)), other = files.folder.write("b.glb", sheetOf(1).glb());
        const auto inspection = inspectFile(input);
        const auto identification = identifyFile(input);
        const auto diff = diffFiles(input, other), swapped = diffFiles(other, input);
        ASSERT_TRUE(inspection && identification && diff && swapped);
        const std::size_t wanted = length == 1 ? 0 : 1;
        EXPECT_EQ(warningsOnLengths(*inspection), wanted);
        EXPECT_EQ(warningsOnLengths(*identification), wanted);
        for (const FrameDiff* both : {&*diff, &*swapped}) {
            ASSERT_EQ(both->warnings.size(), wanted);
            if (wanted != 0) {
                EXPECT_EQ(both->warnings[0].rfind(input + ": " + kNormalLengths, 0), 0u);
            }
        }
    }
}

TEST(NormalLengths, OfQuantizedNormalsAreHandledToo) {
    const std::vector<Vec3> normals = [] {
        const Files files;
        return Stored(files.input(sheetOf(1))).normals();
    }();
    for (const int bits : {8, 16}) {
        const float most = bits == 8 ? 63.0f : 16000.0f;  // a factor for normals of about half of unit length
        GltfBuilder builder = sheetOf(1);
        std::size_t accessor = 0;
        if (bits == 8) {
            std::vector<std::int8_t> numbers;
            for (const Vec3& n : normals) {
                for (const float x : {n.x, n.y, n.z, 0.0f})
                    numbers.push_back(static_cast<std::int8_t>(std::lround(x * most)));
            }
            accessor = builder.addAccessor(numbers, 5120, "VEC3", normals.size());
        } else {
            std::vector<std::int16_t> numbers;
            for (const Vec3& n : normals) {
                for (const float x : {n.x, n.y, n.z, 0.0f})
                    numbers.push_back(static_cast<std::int16_t>(std::lround(x * most)));
            }
            accessor = builder.addAccessor(numbers, 5122, "VEC3", normals.size());
        }
        Json& json = builder.json();
        json["accessors"][accessor]["normalized"] = true;
        json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()]["byteStride"] = bits / 2;
        json["extensionsUsed"] = json["extensionsRequired"] = {"KHR_mesh_quantization"};
        firstPrimitive(builder)["attributes"]["NORMAL"] = accessor;
        EXPECT_LT(worstDegrees(tangentsOf(builder), tangentsOf(sheetOf(1))), bits == 8 ? 0.8 : 0.01);
        const Files files;
        generated(files.input(builder), files.output(), {.selection = {.existing = ExistingTangents::repair}});
        const Stored repaired(files.output());
        EXPECT_EQ(readAccessor(repaired.document, *repaired.primitives[0].find("NORMAL")).component,
                  bits == 8 ? gltf::ComponentType::i8 : gltf::ComponentType::i16);
        for (const Vec3& n : repaired.normals()) EXPECT_NEAR(lengthOf(n), 1, 0.0068);
    }
}

TEST(NormalLengths, RepairWritesUnitNormals) {
    const Files files;
    const std::string input = files.input(sheetOf(2));
    const GenerateReport report =
        generated(input, files.output(), {.selection = {.existing = ExistingTangents::repair}});
    EXPECT_TRUE(report.changed);
    EXPECT_EQ(warningsOnLengths(report), 1u);
    for (const Vec3& n : Stored(files.output()).normals()) EXPECT_NEAR(lengthOf(n), 1, 1e-6);
    const std::string again = files.folder.path("again.glb").string();
    const GenerateReport second =
        generated(files.output(), again, {.selection = {.existing = ExistingTangents::repair}});
    EXPECT_FALSE(second.changed);
    EXPECT_EQ(warningsOnLengths(second), 0u);
}

TEST(NormalLengths, OverwritingNormalsWritesUnitOnes) {
    const Files files;
    generated(files.input(sheetOf(2)), files.output(), {.normals = {.overwrite = true}});
    for (const Vec3& n : Stored(files.output()).normals()) EXPECT_NEAR(lengthOf(n), 1, 1e-6);
}

const Finding* findingOf(const CheckReport& report, FindingCode code) {
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [&](const Finding& finding) { return finding.code == code; });
    return found == report.findings.end() ? nullptr : &*found;
}

/// The remedy is `tspace generate --repair`.
TEST(NormalLengths, AreAnErrorOfCheckThatItsRemedyRemoves) {
    for (const float length : {0.5f, 2.0f, 127.0f, 1e-6f, 1e-18f, 1e30f}) {
        const Files files;
        const std::string input = files.input(sheetOf(length));
        const auto before = checkFile(input);
        ASSERT_TRUE(before);
        const Finding* const finding = findingOf(*before, FindingCode::normalsNotUnit);
        ASSERT_NE(finding, nullptr);
        EXPECT_EQ(finding->severity, Severity::error);
        EXPECT_NE(finding->remedy.find("tspace generate --repair"), std::string::npos);
        EXPECT_EQ(finding->message.find("length 0"), std::string::npos) << finding->message;
        if (length == 1e30f) {
            EXPECT_NE(finding->message.find("(from 1e+30 to 1e+30)"), std::string::npos) << finding->message;
        }
        EXPECT_EQ(findingOf(*before, FindingCode::fileRemark), nullptr);
        generated(input, files.output(), {.selection = {.existing = ExistingTangents::repair}});
        const auto after = checkFile(files.output());
        ASSERT_TRUE(after);
        for (const Finding& left : after->findings) EXPECT_EQ(left.severity, Severity::note) << left.message;
    }
}

/// Returns the sheet with NORMAL as normalized unsigned bytes. `encoded`: stores (n + 1) / 2 for each component;
/// otherwise clamps negative components to 0.
GltfBuilder unsignedSheet(bool encoded) {
    GltfBuilder builder = sheetOf(1);
    const Files files;
    const std::vector<Vec3> normals = Stored(files.input(builder)).normals();
    std::vector<std::uint8_t> bytes;
    for (const Vec3& n : normals) {
        for (const float c : {n.x, n.y, n.z, 0.0f})
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::max(0.0f, encoded ? (c + 1) / 2 : c))));
    }
    const std::size_t accessor = builder.addAccessor(bytes, 5121, "VEC3", normals.size());
    Json& json = builder.json();
    json["accessors"][accessor]["normalized"] = true;
    json["bufferViews"][json["accessors"][accessor]["bufferView"].get<std::size_t>()]["byteStride"] = 4;
    firstPrimitive(builder)["attributes"]["NORMAL"] = accessor;
    return builder;
}

/// glTF does not allow unsigned normals. A repair cannot know their encoding, so it must keep the finding.
TEST(UnsignedNormals, AreAFindingThatOnlyNewNormalsRemove) {
    for (const bool encoded : {false, true}) {
        const Files files;
        const std::string input = files.input(unsignedSheet(encoded));
        const auto before = checkFile(input);
        ASSERT_TRUE(before);
        const Finding* const finding = findingOf(*before, FindingCode::attributeUnreadable);
        ASSERT_NE(finding, nullptr);
        EXPECT_EQ(finding->severity, Severity::error);
        EXPECT_NE(finding->remedy.find("tspace generate --overwrite-normals"), std::string::npos);
        for (const Finding& other : before->findings)
            EXPECT_EQ(other.remedy.find("generate --repair"), std::string::npos) << other.message;

        const std::vector<Vec3> stored = Stored(input).normals();
        const GenerateReport plain = generated(input, files.output());
        EXPECT_EQ(plain.primitives[0].action, PrimitiveAction::generated);
        EXPECT_EQ(Stored(files.output()).normals(), stored);
        EXPECT_EQ(warningsOnLengths(plain), 1u);
        for (const std::string& warning : plain.warnings)
            EXPECT_NE(warning.find("--overwrite-normals"), std::string::npos) << warning;
        generated(input, files.output(), {.selection = {.existing = ExistingTangents::repair}});
        EXPECT_EQ(Stored(files.output()).normals(), stored);
        const auto still = checkFile(files.output());
        ASSERT_TRUE(still);
        EXPECT_NE(findingOf(*still, FindingCode::attributeUnreadable), nullptr);

        generated(input, files.output(), {.normals = {.overwrite = true}});
        const auto after = checkFile(files.output());
        ASSERT_TRUE(after);
        for (const Finding& left : after->findings) EXPECT_EQ(left.severity, Severity::note) << left.message;
    }
}

/// Tangents that match the directions of the normals are right, and are kept.
TEST(NormalLengths, RepairKeepsTangentsThatAreRight) {
    const Files files;
    generated(files.input(sheetOf(1)), files.output());
    const std::vector<Vec4> right = Stored(files.output()).tangents();
    GltfBuilder builder = sheetOf(3);
    firstPrimitive(builder)["attributes"]["TANGENT"] = builder.addFloats(floatsOf(right), 4);
    const std::string input = files.input(builder), output = files.folder.path("repaired.glb").string();
    generated(input, output, {.selection = {.existing = ExistingTangents::repair}});
    EXPECT_EQ(Stored(output).tangents(), right);
}

/// The base normal and its offsets are scaled equally, so that the direction of the normal does not change for any
/// weight.
TEST(NormalLengths, OffsetsOfMorphTargetsAreScaledWithTheNormals) {
    const auto build = [](float length) {
        GltfBuilder builder = sheetOf(length);
        std::vector<float> moves, turns;
        for (std::size_t v = 0; v < 49; ++v) {
            moves.insert(moves.end(), {0, 0, v % 7 < 3 ? 0.1f : 0});
            turns.insert(turns.end(), {0.3f * length, v % 2 == 0 ? 0.2f * length : 0, 0});
        }
        const Json target = {{"POSITION", builder.addFloats(moves, 3)}, {"NORMAL", builder.addFloats(turns, 3)}};
        firstPrimitive(builder)["targets"] = Json::array({target});
        return builder;
    };
    std::vector<std::vector<Vec3>> offsets;
    for (const float length : {1.0f, 4.0f}) {
        const Files files;
        generated(files.input(build(length)), files.output());
        const Stored after(files.output());
        offsets.push_back(readOffsets(after.document, after.primitives[0], 0, "TANGENT"));
    }
    ASSERT_EQ(offsets[0].size(), offsets[1].size());
    for (std::size_t v = 0; v < offsets[0].size(); ++v) {
        const Vec3 &a = offsets[0][v], &b = offsets[1][v];
        EXPECT_LT(lengthOf({a.x - b.x, a.y - b.y, a.z - b.z}), 1e-4);
    }
    const Files files;
    generated(files.input(build(4)), files.output(), {.selection = {.existing = ExistingTangents::repair}});
    const Stored repaired(files.output());
    for (const Vec3& offset : readOffsets(repaired.document, repaired.primitives[0], 0, "NORMAL"))
        EXPECT_NEAR(offset.x, 0.3f, 1e-6);
}

// Computed normals at positions that are equal except for rounding.

double worstAcross(const std::string& path) {
    const Stored made(path);
    const std::vector<Vec3> positions = readVec3(made.document, made.primitives[0], "POSITION"),
                            normals = made.normals();
    double worst = 0;
    for (std::size_t a = 0; a < positions.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            const Vec3 apart{positions[a].x - positions[b].x, positions[a].y - positions[b].y,
                             positions[a].z - positions[b].z};
            if (lengthOf(apart) < 1e-6) worst = std::max(worst, degreesBetween(normals[a], normals[b]));
        }
    }
    return worst;
}

TEST(NearPositions, CauseNoSeamInComputedNormals) {
    for (const char* name : {"three_torus_bare", "three_cylinder_bare", "exact_torus_bare"}) {
        const std::string input = "reports/second/" + std::string(name) + ".glb";
        TSPACE_NEEDS_SHARED(input);
        const bool is_torus = std::string(name).find("torus") != std::string::npos;
        for (const NormalWeighting weighting : {NormalWeighting::angle, NormalWeighting::best}) {
            const Files files;
            GenerateOptions options{.selection = {.all = true}};
            options.normals.compute.weighting = weighting;
            options.normals.compute.crease_angle_deg = is_torus ? 180 : 40;
            generated(shared(input).string(), files.output(), options);
            if (is_torus) {
                EXPECT_LT(worstAcross(files.output()), 0.01) << name;
            }
            options.normals.compute.weld_distance = 0;
            generated(shared(input).string(), files.output(), options);
            if (name == std::string("three_torus_bare")) {
                EXPECT_GT(worstAcross(files.output()), 4);
            }
        }
        const Files files;
        ASSERT_TRUE(finishFile(shared(input).string(), files.output()));
        if (is_torus) {
            EXPECT_LT(worstAcross(files.output()), 0.01) << name;
        }
    }
}

}  // namespace
}  // namespace tspace::test
