// SPDX-License-Identifier: MIT
// Files in meters of a map projection. From STL, the shape is as precise as the file in double precision. COLLADA and
// FBX cause a warning that floats lost precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "far_files.h"
#include "model/gltf/primitive_reader.h"
#include "model/imported/with_importer.h"
#include "model/read/read_scene.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"
#include "tspace/normals.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

using gltf::Json;

constexpr DVec3 kFar{500000, 5200000, 412}, kNegative{-500000.3, -5200000.7, -30};
constexpr int kSide = 20;

struct Made {
    GenerateReport report = {};
    DrawnScene drawn = {};
    Json nodes = {};

    [[nodiscard]] std::span<const Vec3> normals(std::size_t i = 0) const {
        return drawn.scene.primitives[i].normals.span();
    }
    /// Returns the position of a vertex in world space.
    [[nodiscard]] DVec3 at(std::size_t placement, std::size_t vertex) const {
        const ScenePlacement& place = drawn.placements[placement];
        return place.to_world.point(toDouble(drawn.scene.primitives[place.primitive].positions[vertex]));
    }
    [[nodiscard]] bool warns(const std::string& text) const {
        return std::any_of(report.warnings.begin(), report.warnings.end(),
                           [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
    }
    [[nodiscard]] bool hasOffset() const {
        return std::any_of(std::begin(report.coordinate_offset), std::end(report.coordinate_offset),
                           [](double axis) { return axis != 0; });
    }
};

Made make(const std::string& extension, const std::string& bytes, bool keep = false,
          float weld_distance = NormalOptions::weld_auto) {
    const TempFolder folder;
    GenerateOptions options{.selection = {.all = true}};
    options.normals.overwrite = true;
    options.normals.compute.weighting = NormalWeighting::angle;
    options.normals.compute.weld_distance = weld_distance;
    options.file = kWithImporter;
    options.file.keep_coordinates = keep;
    const std::string output = folder.path("out.glb").string();
    Result<GenerateReport> report = generateFile(folder.write("in" + extension, bytes), output, options);
    EXPECT_TRUE(report) << (report ? "" : report.error().message);
    if (!report) return {};
    return {*report, readDrawnScene(output, {}, false), gltf::loadDocument(output, {}).json["nodes"]};
}
Made make(FarFormat format, const std::vector<Part>& parts, bool keep = false, const FileStyle& style = {}) {
    return make(extensionOf(format), fileOf(format, parts, style), keep);
}

double worstAngle(std::span<const Vec3> a, std::span<const Vec3> b) {
    if (a.size() != b.size() || a.empty()) return 180;
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const DVec3 p = toDouble(a[i]), q = toDouble(b[i]);
        worst = std::max(worst, std::atan2(length(cross(p, q)), dot(p, q)) * 180 / 3.14159265358979323846);
    }
    return worst;
}

constexpr double kLeastDegrees = 0.01;

class FarFormats : public testing::TestWithParam<FarFormat> {};

TEST_P(FarFormats, AScanHasTheNormalsThatItHasNearTheOrigin) {
    const Made near = make(GetParam(), {sheet(kSide, {0, 0, 0})});
    EXPECT_FALSE(near.hasOffset());
    EXPECT_TRUE(near.report.warnings.empty());
    for (const DVec3& place : {kFar, kNegative}) {
        const Made far = make(GetParam(), {sheet(kSide, place)});
        EXPECT_TRUE(far.hasOffset());
        EXPECT_TRUE(far.warns("was subtracted"));
        EXPECT_EQ(far.report.warnings.size(), 1U);
        EXPECT_LT(worstAngle(far.normals(), near.normals()), kLeastDegrees);
        EXPECT_LT(length(far.at(0, 0) - near.at(0, 0) - place), 1e-4);
    }
}

TEST_P(FarFormats, ReadsAScanThatFloatsCollapseToAPoint) {
    Part small = sheet(3, {0, 0, 0});
    for (DVec3& p : small.positions) p = 0.2 * p + DVec3{5200000.12, 5200000.12, 5200000.12};
    const Made made = make(GetParam(), {small});
    EXPECT_TRUE(made.hasOffset());
    EXPECT_LT(length(made.at(0, 0) - small.positions[0]), 1e-4);
    EXPECT_GT(length(made.at(0, 0) - made.at(0, 1)), 0.02);
}

TEST_P(FarFormats, GeometriesShareOneOffset) {
    const DVec3 between{300, -200, 5};
    const auto parts = [&](const DVec3& place) {
        return std::vector<Part>{sheet(kSide, place), sheet(kSide, place + between)};
    };
    const Made near = make(GetParam(), parts({0, 0, 0}));
    for (const DVec3& place : {kFar, kNegative}) {
        const Made far = make(GetParam(), parts(place));
        ASSERT_EQ(far.drawn.placements.size(), 2U);
        EXPECT_TRUE(far.hasOffset());
        EXPECT_EQ(length(far.drawn.placements[0].to_world.origin - far.drawn.placements[1].to_world.origin), 0);
        for (const std::size_t i : {0, 1}) {
            EXPECT_LT(worstAngle(far.normals(i), near.normals(i)), kLeastDegrees);
            EXPECT_LT(length(far.at(i, 0) - near.at(i, 0) - place), 1e-4);
        }
    }
}

TEST_P(FarFormats, AGeometryNearTheOriginIsUnchanged) {
    const std::vector<Part> parts = {sheet(kSide, kFar), sheet(kSide, {0, 0, 0})};
    const Made made = make(GetParam(), parts), near = make(GetParam(), {parts[1]});
    EXPECT_TRUE(made.hasOffset());
    const std::span<const Vec3> positions = made.drawn.scene.primitives[1].positions.span(),
                                expected = near.drawn.scene.primitives[0].positions.span();
    EXPECT_TRUE(std::equal(positions.begin(), positions.end(), expected.begin(), expected.end()));
    EXPECT_EQ(length(made.drawn.placements[1].to_world.origin), 0);
    EXPECT_LT(worstAngle(made.normals(0), near.normals(0)), kLeastDegrees);
}

TEST_P(FarFormats, KeptCoordinatesAreRoundedWithAWarning) {
    const Made made = make(GetParam(), {sheet(kSide, kFar)}, true);
    EXPECT_FALSE(made.hasOffset());
    EXPECT_EQ(length(made.at(0, 0) - kFar), 0);
    EXPECT_TRUE(made.warns("omit --keep-coordinates"));
    EXPECT_FALSE(made.warns("no effect"));
    EXPECT_TRUE(make(GetParam(), {sheet(kSide, {0, 0, 0})}, true).warns("--keep-coordinates has no effect"));
}

TEST_P(FarFormats, DistantPartsAreRoundedWithAWarning) {
    const Made made = make(GetParam(), {sheet(kSide, kFar), sheet(kSide, -1.0 * kFar)});
    EXPECT_FALSE(made.hasOffset());
    EXPECT_TRUE(made.warns("no common offset"));
}

TEST_P(FarFormats, DistantVerticesOfOneGeometryAreRoundedWithAWarning) {
    Part part = sheet(kSide, kFar);
    const Part other = sheet(kSide, -1.0 * kFar);
    const auto first = static_cast<int>(part.positions.size());
    part.positions.insert(part.positions.end(), other.positions.begin(), other.positions.end());
    for (const std::array<int, 3>& face : other.faces)
        part.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    const Made made = make(GetParam(), {part});
    EXPECT_FALSE(made.hasOffset());
    EXPECT_TRUE(made.warns("no common offset"));
}

TEST_P(FarFormats, CoordinatesWrittenFromFloatsCauseNoWarning) {
    Part part = sheet(kSide, kFar);
    for (DVec3& p : part.positions) p = toDouble(toFloat(p));
    for (const int decimals : {6, 9}) {
        const Made made = make(GetParam(), {part}, false, {.decimals = decimals});
        EXPECT_FALSE(made.hasOffset());
        EXPECT_TRUE(made.warns("does not store more digits"));
    }
}

INSTANTIATE_TEST_SUITE_P(Import, FarFormats, testing::Values(FarFormat::stlText));

class FarFloats : public testing::TestWithParam<FarFormat> {};

TEST_P(FarFloats, ReportsShapesThatFloatsCannotRepresent) {
    for (const bool keep : {false, true}) {
        const Made made = make(GetParam(), {sheet(kSide, kFar)}, keep);
        EXPECT_FALSE(made.hasOffset());
        EXPECT_TRUE(made.warns(" edges of triangles")) << testing::PrintToString(made.report.warnings);
        EXPECT_TRUE(made.warns("further digits are lost"));
        EXPECT_EQ(made.warns("--keep-coordinates"), keep) << "it has no effect";
    }
    EXPECT_TRUE(make(GetParam(), {sheet(kSide, {0, 0, 0})}).report.warnings.empty());
}

TEST_P(FarFloats, ReportsNodePositionsThatFloatsCannotRepresent) {
    std::vector<Part> parts = {sheet(3, {0, 0, 0}), sheet(3, {0, 0, 0})};
    for (const bool has_matrices : {false, true}) {
        const FileStyle style{.has_matrices = has_matrices};
        parts[0].translation = DVec3{500000.123, 5200000.456, 7.89};
        parts[1].translation = DVec3{1000, 2, 3};
        const Made made = make(GetParam(), parts, false, style);
        EXPECT_EQ(made.report.warnings.size(), 1U);
        EXPECT_TRUE(made.warns("may change the position by up to 0.25 m"))
            << testing::PrintToString(made.report.warnings);
        parts[0].translation = DVec3{16000, -16000, 0};
        EXPECT_TRUE(make(GetParam(), parts, false, style).report.warnings.empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Import, FarFloats, testing::Values(FarFormat::collada, FarFormat::fbxText));

TEST(FarCollada, TheUnitCountsForPlacesOfNodes) {
    std::vector<Part> parts = {sheet(3, {0, 0, 0})};
    parts[0].translation = DVec3{500000, 1000000, 0};
    EXPECT_TRUE(make(FarFormat::collada, parts).warns("up to 0.031 m"));
    EXPECT_TRUE(make(FarFormat::collada, parts, false, {.unit = "0.01"}).report.warnings.empty());
}

TEST(FarStl, FloatsOfBinaryFilesHaveTheSameNormalsNearTheOrigin) {
    constexpr DVec3 kWhole{456123, 5261789, 0};
    Part far = sheet(kSide, kWhole + DVec3{0.2, 0.2, 412}), near = far;
    for (DVec3& p : far.positions) p = 8.0 * p;  // larger, so that floats preserve a part of the shape
    for (std::size_t i = 0; i < far.positions.size(); ++i)
        near.positions[i] = toDouble(toFloat(far.positions[i])) - 8.0 * kWhole;
    // Far from the origin the spacing of floats is larger, and so is the automatic weld distance.
    const Made made = make(".stl", binaryStl(far), false, 0), moved = make(".stl", binaryStl(near), false, 0);
    EXPECT_FALSE(made.hasOffset());
    EXPECT_TRUE(made.warns("does not store more digits"));
    const std::span<const Vec3> a = made.normals(), b = moved.normals();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << "differences of neighbors are exact in floats";
}

TEST(FarFormatsElsewhere, AreReadAsFloatsWithAWarning) {
    std::string text = "OFF\n400 722 0\n";
    const Part part = sheet(kSide, kFar);
    for (const DVec3& p : part.positions)
        text += std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + '\n';
    for (const std::array<int, 3>& face : part.faces)
        text += "3 " + std::to_string(face[0]) + ' ' + std::to_string(face[1]) + ' ' + std::to_string(face[2]) + '\n';
    EXPECT_TRUE(make(".off", text).warns("this format is read as 32-bit floats"));
}

}  // namespace
}  // namespace tspace::test
