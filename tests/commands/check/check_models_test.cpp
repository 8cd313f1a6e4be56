// SPDX-License-Identifier: MIT
// Real models: known faults are found, correct models have no errors, and the output of tspace has none either.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/model_files.h"
#include "support/temp_folder.h"
#include "tspace/check.h"
#include "tspace/generate.h"

namespace tspace::test {
namespace {

const Finding* find(const CheckReport& report, FindingCode code) {
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [&](const Finding& finding) { return finding.code == code; });
    return found == report.findings.end() ? nullptr : &*found;
}

std::string errorsOf(const CheckReport& report) {
    std::string text;
    for (const Finding& finding : report.findings) {
        if (finding.severity == Severity::error) text += finding.place + ": " + finding.message + "\n";
    }
    return text;
}

CheckReport check(const std::string& model) {
    const Result<CheckReport> report = checkFile(shared("models/" + model).string());
    EXPECT_TRUE(report) << report.error().message;
    return report ? *report : CheckReport{};
}

TEST(CheckModels, FindsTheInvertedSignsOfTwoSidedPlane) {
    TSPACE_NEEDS_SHARED("models/khronos/TwoSidedPlane.glb");
    const CheckReport report = check("khronos/TwoSidedPlane.glb");
    ASSERT_NE(find(report, FindingCode::signsInverted), nullptr);
    EXPECT_EQ(report.error_count, 1u);
}

TEST(CheckModels, ReportsOnceThatTheTangentsOfAFileAreInvisible) {
    for (const char* model : {"khronos/Suzanne/Suzanne.gltf", "khronos/ClearCoatTest.glb", "assets/Ghost.glb"}) {
        TSPACE_NEEDS_SHARED("models/" + std::string(model));
        const CheckReport report = check(model);
        EXPECT_EQ(std::count_if(report.findings.begin(), report.findings.end(),
                                [](const Finding& finding) { return finding.code == FindingCode::tangentsUnused; }),
                  1)
            << model;
        EXPECT_EQ(report.error_count + report.warning_count, 0u) << model;
    }
}

TEST(CheckModels, FindsThatCatIsMadeForDirectX) {
    TSPACE_NEEDS_SHARED("models/assets/Cat.glb");
    const CheckReport report = check("assets/Cat.glb");
    ASSERT_NE(find(report, FindingCode::signsInverted), nullptr);
    ASSERT_NE(find(report, FindingCode::greenFlipped), nullptr);
    EXPECT_NE(find(report, FindingCode::signsInverted)->message.find("cancel out"), std::string::npos);
}

TEST(CheckModels, FindsTheInvertedSignsOfChessBoard) {
    TSPACE_NEEDS_SHARED("models/perf/ChessBoard_178k.glb");
    const CheckReport report = check("perf/ChessBoard_178k.glb");
    ASSERT_NE(find(report, FindingCode::signsInverted), nullptr);
    EXPECT_EQ(find(report, FindingCode::signsInverted)->severity, Severity::error);
}

TEST(CheckModels, HasNoErrorOnCorrectExports) {
    for (const char* model :
         {"khronos/Lantern.glb", "khronos/FlightHelmet/FlightHelmet.gltf", "khronos/ClearCoatTest.glb",
          "khronos/BoomBoxWithAxes.glb", "khronos/SheenCloth.glb", "khronos/MultiUVTest/MultiUVTest.gltf",
          "khronos/AnisotropyStrengthTest.glb", "blender/01_sphere/01_sphere.gltf",
          "blender/01_morphed_cube/01_morphed_cube.gltf", "derived/Lantern_quantized.glb"}) {
        TSPACE_NEEDS_SHARED("models/" + std::string(model));
        EXPECT_EQ(errorsOf(check(model)), "") << model;
    }
}

class Models : public testing::TestWithParam<std::string> {};

TEST_P(Models, HaveNoErrorAfterGenerate) {
    if (GetParam().empty()) GTEST_SKIP() << "test data " << shared("models") << " is missing";
    const std::string input = (shared("models") / GetParam()).string();
    const TempFolder folder;
    const std::string output = folder.path("out.glb").string();
    GenerateOptions options;
    options.selection.all = true;
    options.selection.existing = ExistingTangents::replace;
    const auto generated = generateFile(input, output, options);
    if (!generated && generated.error().code == ErrorCode::unsupportedFile) {
        GTEST_SKIP() << generated.error().message;
    }
    ASSERT_TRUE(generated) << generated.error().message;
    const Result<CheckReport> report = checkFile(output);
    if (!report && report.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << report.error().message;
    ASSERT_TRUE(report) << report.error().message;
    CheckReport rest = *report;
    // generate keeps the normals of a file. This file has normals of length 1.1 to 1.7, which the glTF validator
    // reports too.
    if (GetParam() == "features/meshopt-fallback/meshopt-fallback.gltf") {
        const auto is_own = [](const Finding& finding) { return finding.code == FindingCode::normalsNotUnit; };
        EXPECT_EQ(std::erase_if(rest.findings, is_own), 2u);
    }
    EXPECT_EQ(errorsOf(rest), "");
}

INSTANTIATE_TEST_SUITE_P(All, Models, testing::ValuesIn(modelFiles("models")),
                         [](const auto& model) { return testName(model.param); });

/// Every corrupt file gives a report or an error.
TEST(CheckBadFiles, GiveAReportOrAnError) {
    TSPACE_NEEDS_SHARED("bad");
    std::size_t files = 0, refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(shared("bad"))) {
        const std::string extension = lowerExtension(entry.path());
        if (!entry.is_regular_file() || (extension != ".glb" && extension != ".gltf" && extension != ".obj")) continue;
        const Result<CheckReport> report = checkFile(entry.path().string());
        ++files;
        refused += !report;
        if (report) continue;
        EXPECT_NE(report.error().code, ErrorCode::internal) << entry.path();
        EXPECT_EQ(report.error().message.find('\n'), std::string::npos) << entry.path();
    }
    EXPECT_GT(files, 100u);
    EXPECT_GT(refused, 50u);
    EXPECT_LT(refused, files);
}

}  // namespace
}  // namespace tspace::test
