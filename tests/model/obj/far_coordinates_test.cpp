// SPDX-License-Identifier: MIT
// OBJ files in meters of a map projection: the shape must match the decimals of the file, not their rounding to floats.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "model/gltf/primitive_reader.h"
#include "model/read/read_scene.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"
#include "tspace/normals.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

using gltf::Json;

constexpr int kSide = 12;
constexpr double kStep = 0.15;

/// Returns a number with 4 decimals, in every locale.
std::string decimals(double value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 4);
    return {text, end.ptr};
}

std::string vertexLine(const DVec3& p) {
    return "v " + decimals(p.x) + ' ' + decimals(p.y) + ' ' + decimals(p.z) + '\n';
}

/// Returns a bumpy square of kSide x kSide vertices with its corner at `place`. `before`: text before the faces.
/// Indices are relative, so that several squares can be concatenated.
std::string scan(const DVec3& place, const std::string& before = "s 1\n") {
    std::string text;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double height = 0.03 * std::sin(0.9 * x) * std::cos(0.7 * y);
            text += vertexLine(place + DVec3{kStep * x, kStep * y, height});
            text += "vt " + decimals(x / double{kSide - 1}) + ' ' + decimals(y / double{kSide - 1}) + '\n';
        }
    }
    text += before;
    const auto corner = [](int x, int y) {
        const std::string index = std::to_string(y * kSide + x - kSide * kSide);
        return ' ' + index + '/' + index;
    };
    for (int y = 0; y + 1 < kSide; ++y) {
        for (int x = 0; x + 1 < kSide; ++x) {
            text += "f" + corner(x, y) + corner(x + 1, y) + corner(x + 1, y + 1) + '\n';
            text += "f" + corner(x, y) + corner(x + 1, y + 1) + corner(x, y + 1) + '\n';
        }
    }
    return text;
}

constexpr DVec3 kFar{456123.2, 5261789.2, 412};
/// The center, rounded to a multiple that depends on the model's size. Heights are small enough to need no offset.
constexpr DVec3 kOffset{456124, 5261790, 0};

struct FarModel {
    GenerateReport report = {};
    gltf::Document document = {};
    std::vector<gltf::Primitive> primitives = {};
    std::string input = {}, output = {};

    [[nodiscard]] std::vector<Vec3> vec3(const char* name) const {
        return gltf::readVec3(document, primitives[0], name);
    }
    [[nodiscard]] Json translation(std::size_t node = 0) const {
        const Json& json = document.json["nodes"][node];
        return json.contains("translation") ? json["translation"] : Json();
    }
    [[nodiscard]] bool warns(const std::string& text) const {
        return std::any_of(report.warnings.begin(), report.warnings.end(),
                           [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
    }
};

FarModel makeFar(const TempFolder& folder, const std::string& name, const std::string& obj, bool keep = false) {
    GenerateOptions options;
    options.selection.all = true;
    options.file.keep_coordinates = keep;
    FarModel made{.input = folder.write(name + ".obj", obj), .output = (folder.path() / (name + ".glb")).string()};
    Result<GenerateReport> report = generateFile(made.input, made.output, options);
    EXPECT_TRUE(report) << (report ? "" : report.error().message);
    if (!report) return made;
    made.report = *report;
    made.document = gltf::loadDocument(made.output, {});
    made.primitives = gltf::readPrimitives(made.document);
    return made;
}

double degreesApart(const Vec3& a, const Vec3& b) {
    const DVec3 p = toDouble(a), q = toDouble(b);
    return std::atan2(length(cross(p, q)), dot(p, q)) * 180 / 3.14159265358979323846;
}

double worstAngle(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, degreesApart(a[i], b[i]));
    return worst;
}

TEST(FarCoordinates, AScanHasTheShapeThatItHasNearTheOrigin) {
    const TempFolder folder;
    const FarModel near = makeFar(folder, "near", scan({0, 0, 0})), far = makeFar(folder, "far", scan(kFar));
    EXPECT_EQ(far.translation().dump(), "[456124.0,5261790.0,0.0]");
    EXPECT_EQ(far.report.coordinate_offset[0], kOffset.x);
    EXPECT_EQ(far.report.coordinate_offset[1], kOffset.y);
    EXPECT_EQ(far.report.coordinate_offset[2], kOffset.z);
    EXPECT_TRUE(far.warns("(456124, 5261790, 0)"));
    const std::vector<Vec3> expected = near.vec3("POSITION"), positions = far.vec3("POSITION");
    ASSERT_EQ(positions.size(), expected.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        EXPECT_LT(length(toDouble(positions[i]) + kOffset - kFar - toDouble(expected[i])), 2e-5) << i;
    EXPECT_LT(worstAngle(far.vec3("NORMAL"), near.vec3("NORMAL")), 0.1);
    EXPECT_EQ(far.report.primitives[0].normals.degenerate_face_count, 0U);
}

TEST(FarCoordinates, NearTheOriginNoOffsetIsSubtracted) {
    const TempFolder folder;
    for (const DVec3& place : {DVec3{0, 0, 0}, DVec3{3, -2, 1}, DVec3{100, 0, 0}}) {
        const FarModel made = makeFar(folder, "near", scan(place));
        EXPECT_TRUE(made.translation().is_null());
        EXPECT_TRUE(made.report.warnings.empty());
        EXPECT_EQ(made.report.coordinate_offset[0], 0);
        EXPECT_EQ(made.vec3("POSITION")[0], toFloat(place));
    }
}

TEST(FarCoordinates, ExactFloatsAreUnchanged) {
    const TempFolder folder;
    const FarModel made = makeFar(
        folder, "whole", "v 5000000 0 0\nv 5000001 0 0\nv 5000000 1 0.5\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    EXPECT_TRUE(made.translation().is_null());
    EXPECT_EQ(made.vec3("POSITION")[1], (Vec3{5000001, 0, 0}));
}

TEST(FarCoordinates, KeptCoordinatesAreRoundedWithAWarning) {
    const TempFolder folder;
    const FarModel made = makeFar(folder, "far", scan(kFar), true);
    EXPECT_TRUE(made.translation().is_null());
    EXPECT_EQ(made.report.coordinate_offset[1], 0);
    EXPECT_EQ(made.vec3("POSITION")[0], toFloat(kFar));
    EXPECT_TRUE(made.warns("--keep-coordinates"));
    EXPECT_FALSE(made.warns("no effect"));
    EXPECT_TRUE(makeFar(folder, "near", scan({0, 0, 0}), true).warns("--keep-coordinates has no effect"));
}

TEST(FarCoordinates, AllObjectsOfAFileShareOneOffset) {
    const TempFolder folder;
    const FarModel made = makeFar(folder, "two", "o a\n" + scan(kFar) + "o b\n" + scan(kFar + DVec3{40, 25, 0}));
    ASSERT_EQ(made.document.json["nodes"].size(), 2U);
    ASSERT_FALSE(made.translation(0).is_null());
    EXPECT_EQ(made.translation(0), made.translation(1));
}

TEST(FarCoordinates, IgnoresAFaceLeftAtTheOrigin) {
    const TempFolder folder;
    const FarModel made = makeFar(folder, "stray", scan(kFar) + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
    EXPECT_EQ(made.translation().dump(), "[456124.0,5261790.0,0.0]");
}

TEST(FarCoordinates, IgnoresASmallDistantPart) {
    const TempFolder folder;
    const std::string far = scan(kFar);
    std::string strays;
    const auto faces = static_cast<std::size_t>(std::count(far.begin(), far.end(), 'f'));
    for (std::size_t i = 0; i < faces / 10; ++i) strays += "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
    const FarModel made = makeFar(folder, "part", far + strays);
    EXPECT_FALSE(made.translation().is_null());
}

TEST(FarCoordinates, DistantPartsAreRoundedWithAWarning) {
    const TempFolder folder;
    const FarModel made = makeFar(folder, "spread", "o a\n" + scan(kFar) + "o b\n" + scan(-1.0 * kFar));
    EXPECT_TRUE(made.translation().is_null());
    EXPECT_TRUE(made.warns("no common offset"));
}

TEST(FarCoordinates, IgnoresPositionsThatAreNotFinite) {
    const TempFolder folder;
    const FarModel made = makeFar(folder, "nan", scan(kFar) + "v 1e999 0 0\nf -1 -2 -3\n");
    EXPECT_FALSE(made.translation().is_null());
    EXPECT_TRUE(made.warns("not finite"));
}

TEST(FarCoordinates, EveryReaderSeesTheSamePlace) {
    const TempFolder folder;
    const FarModel made = makeFar(folder, "far", scan(kFar));
    const Result<Inspection> inspection = inspectFile(made.input);
    ASSERT_TRUE(inspection);
    EXPECT_EQ(inspection->coordinate_offset[1], kOffset.y);
    EXPECT_EQ(inspection->primitives[0].degenerate_triangle_count, 0U);
    const DrawnScene of_obj = readDrawnScene(made.input, {}, false), of_glb = readDrawnScene(made.output, {}, false);
    const auto corner = [](const DrawnScene& drawn) {
        return drawn.placements[0].to_world.point(toDouble(drawn.scene.primitives[0].positions[0]));
    };
    EXPECT_EQ(length(corner(of_obj) - corner(of_glb)), 0);
    EXPECT_LT(length(corner(of_obj) - kFar), 1e-6);
    const Result<FrameDiff> diff = diffFiles(made.input, made.output, {});
    ASSERT_TRUE(diff);
    EXPECT_EQ(diff->primitives[0].paired_by, "geometry");
    EXPECT_EQ(diff->unpaired_triangle_count, 0U);
}

TEST(FarCoordinates, TheSharedScanHasTheNormalsOfItsTwin) {
    TSPACE_NEEDS_SHARED("reports/utm_scan.obj");
    const TempFolder folder;
    GenerateOptions options;
    options.selection.all = true;
    options.normals.compute.weighting = NormalWeighting::angle;
    std::vector<std::vector<Vec3>> normals;
    for (const std::string name : {"utm_scan", "local_scan"}) {
        const std::string output = (folder.path() / (name + ".glb")).string();
        ASSERT_TRUE(generateFile(shared("reports/" + name + ".obj").string(), output, options));
        const gltf::Document document = gltf::loadDocument(output, {});
        normals.push_back(gltf::readVec3(document, gltf::readPrimitives(document)[0], "NORMAL"));
    }
    ASSERT_EQ(normals[0].size(), normals[1].size());
    EXPECT_LT(worstAngle(normals[0], normals[1]), 0.3);
}

}  // namespace
}  // namespace tspace::test
