// SPDX-License-Identifier: MIT
// Runs generateFile on every model of the shared data: all other data is preserved, and a second run on the output
// changes no byte.
#include <gtest/gtest.h>
#include <algorithm>

#include "gltf_builder.h"
#include "model/read/read_scene.h"
#include "model_compare.h"
#include "model_files.h"
#include "support/temp_folder.h"
#include "tspace/check.h"

namespace tspace {
namespace {

using test::shared;
using test::TempFolder;

class Models : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        if (GetParam().empty()) GTEST_SKIP() << "test data " << shared("models") << " is missing";
        input_ = shared("models") / GetParam();
    }

    static GenerateOptions everything(Method method) {
        GenerateOptions options;
        options.selection.all = true;
        options.selection.existing = ExistingTangents::replace;
        options.tangents.compute.method = method;
        // Lengyel's sums depend on vertex indices, so they change if vertices are split, which repaired signs may
        // cause.
        options.tangents.sanitize = method != Method::lengyel;
        return options;
    }

    /// Generates into another folder and compares the models; then runs again on the output.
    void check(const std::string& output_name, Method method) {
        SCOPED_TRACE(output_name);
        const TempFolder folder;
        const std::string output = folder.path(output_name).string();
        const auto report = generateFile(input_.string(), output, everything(method));
        if (!report && report.error().message.find("was built without the library") != std::string::npos) {
            EXPECT_EQ(folder.entryCount(), 0u);
            GTEST_SKIP() << report.error().message;
        }
        ASSERT_TRUE(report) << report.error().message << " at " << report.error().place;
        if (!report->changed) {
            EXPECT_EQ(readFile(input_), readFile(output));
        }
        const auto before = gltf::loadDocument(input_, {}), after = gltf::loadDocument(output, {});
        for (const std::string& difference : test::differences(before, after, *report)) ADD_FAILURE() << difference;

        const std::string again = folder.path("again/" + output_name).string();
        const auto second = generateFile(output, again, everything(method));
        ASSERT_TRUE(second) << second.error().message;
        EXPECT_FALSE(second->changed);
        EXPECT_EQ(readFile(output), readFile(again));
        const auto in_place = generateFile(output, output, everything(method));
        ASSERT_TRUE(in_place) << in_place.error().message;
        EXPECT_TRUE(in_place->output_files.empty()) << "nothing is to be written";
    }

    std::filesystem::path input_;
};

bool hasFinding(const std::string& input, FindingCode code) {
    const auto report = checkFile(input, {.images = false});
    return report && std::any_of(report->findings.begin(), report->findings.end(),
                                 [&](const Finding& finding) { return finding.code == code; });
}

TEST_P(Models, SurviveGenerate) { check(input_.filename().string(), Method::mikktspace); }

TEST_P(Models, SurviveGenerateWithoutSplit) { check(input_.filename().string(), Method::lengyel); }

TEST_P(Models, SurviveConversion) {
    check(lowerExtension(input_) == ".glb" ? "converted.gltf" : "converted.glb", Method::mikktspace);
}

TEST_P(Models, SurviveRepairAndStrip) {
    const TempFolder folder;
    const std::string output = folder.path(input_.filename().string()).string();
    const GenerateOptions options = {.selection = {.strip = true, .existing = ExistingTangents::repair}};
    const auto report = generateFile(input_.string(), output, options);
    if (!report) GTEST_SKIP() << report.error().message;
    const auto before = gltf::loadDocument(input_, {}), after = gltf::loadDocument(output, {});
    // --repair normalizes normals, so their bytes may differ.
    const bool scales_normals = hasFinding(input_.string(), FindingCode::normalsNotUnit);
    for (const std::string& difference : test::differences(before, after, *report)) {
        if (!scales_normals || !difference.ends_with(" has other bytes")) ADD_FAILURE() << difference;
    }
    const Bytes first = readFile(output);
    const auto second = generateFile(output, output, options);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_FALSE(second->changed) << "what was repaired or stripped needs no more";
    EXPECT_EQ(readFile(output), first);

    const auto checked = checkFile(output, {.images = false});
    if (!checked && checked.error().code == ErrorCode::unsupportedFile) return;  // unchanged compressed primitives
    ASSERT_TRUE(checked) << checked.error().message;
    for (const Finding& finding : checked->findings) {
        if (finding.severity != Severity::error) break;  // findings are sorted by severity
        ADD_FAILURE() << finding.place << ": " << finding.message;
    }
}

TEST_P(Models, AreUnchangedWithoutOverwriteIfNothingIsMissing) {
    const TempFolder folder;
    const std::string output = folder.path(input_.filename().string()).string();
    const auto report = generateFile(input_.string(), output, {});
    if (!report) GTEST_SKIP() << report.error().message;
    const auto before = gltf::loadDocument(input_, {}), after = gltf::loadDocument(output, {});
    for (const std::string& difference : test::differences(before, after, *report)) ADD_FAILURE() << difference;
    for (const PrimitiveReport& primitive : report->primitives) {
        EXPECT_NE(primitive.action, PrimitiveAction::replaced);
        EXPECT_FALSE(primitive.reason.empty());
    }
    if (!report->changed) {
        EXPECT_EQ(readFile(input_), readFile(output));
    }
}

/// Returns small models, with which tests are fast.
std::vector<std::filesystem::path> smallModels() {
    constexpr std::uintmax_t kSmall = 1u << 20;
    std::vector<std::filesystem::path> models;
    for (const std::string folder : {"models/features", "models/khronos", "models/derived", "models/blender"}) {
        for (const std::string& name : test::modelFiles(folder)) {
            if (!name.empty() && std::filesystem::file_size(shared(folder) / name) <= kSmall)
                models.push_back(shared(folder) / name);
        }
    }
    return models;
}

/// Checks that a run on the output changes no byte.
void expectNoChangeAgain(const std::string& output, const GenerateOptions& options) {
    const Bytes first = readFile(output);
    const auto second = generateFile(output, output, options);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_FALSE(second->changed);
    EXPECT_EQ(readFile(output), first);
}

struct Packing {
    Compression compression = Compression::keep;
    VectorFormat format = VectorFormat::float32;
    const char* output = "out.glb";
};

class EveryPacking : public testing::TestWithParam<Packing> {};

TEST_P(EveryPacking, ChangesOnlyReportedDataAndNothingTheSecondTime) {
    TSPACE_NEEDS_SHARED("models");
    int count = 0;
    for (const std::filesystem::path& input : smallModels()) {
        SCOPED_TRACE(input);
        const TempFolder temp;
        const std::string output = temp.path(GetParam().output).string();
        GenerateOptions options;
        options.selection.all = true;
        options.selection.existing = ExistingTangents::replace;
        options.storage.compression = GetParam().compression;
        options.storage.format = GetParam().format;
        const auto report = generateFile(input.string(), output, options);
        if (!report && report.error().message.find("was built without the library") != std::string::npos) continue;
        ASSERT_TRUE(report) << report.error().message << " at " << report.error().place;
        ++count;
        if (options.storage.compression != Compression::draco) {
            const auto before = gltf::loadDocument(input, {}), after = gltf::loadDocument(output, {});
            for (const std::string& difference : test::differences(before, after, *report, true))
                ADD_FAILURE() << difference;
        }
        ASSERT_NO_FATAL_FAILURE(expectNoChangeAgain(output, options));
    }
    EXPECT_GT(count, 0);
}

INSTANTIATE_TEST_SUITE_P(Small, EveryPacking,
                         testing::Values(Packing{Compression::none}, Packing{Compression::meshopt},
                                         Packing{Compression::draco},
                                         Packing{Compression::none, VectorFormat::float32, "out.gltf"},
                                         Packing{Compression::meshopt, VectorFormat::float32, "out.gltf"},
                                         Packing{Compression::draco, VectorFormat::float32, "out.gltf"},
                                         Packing{Compression::keep, VectorFormat::snorm8},
                                         Packing{Compression::keep, VectorFormat::snorm16},
                                         Packing{Compression::meshopt, VectorFormat::snorm8},
                                         Packing{Compression::draco, VectorFormat::snorm16}));

/// A second run of a method on its own output changes nothing. Only small models are used, to keep the tests fast.
class EveryMethod : public testing::TestWithParam<Method> {};

TEST_P(EveryMethod, ChangesNothingTheSecondTime) {
    TSPACE_NEEDS_SHARED("models");
    int count = 0;
    for (const std::filesystem::path& input : smallModels()) {
        SCOPED_TRACE(input);
        const TempFolder temp;
        const std::string output = temp.path("out.glb").string();
        GenerateOptions options;
        options.selection.all = true;
        options.selection.existing = ExistingTangents::replace;
        options.tangents.compute.method = GetParam();
        if (!generateFile(input.string(), output, options)) continue;
        ++count;
        ASSERT_NO_FATAL_FAILURE(expectNoChangeAgain(output, options));
    }
    EXPECT_GT(count, 0);
    RecordProperty("models", count);
}

INSTANTIATE_TEST_SUITE_P(Small, EveryMethod,
                         testing::Values(Method::uniform, Method::angle, Method::area, Method::fast, Method::best));

INSTANTIATE_TEST_SUITE_P(Shared, Models, testing::ValuesIn(test::modelFiles("models")),
                         [](const auto& file) { return test::testName(file.param); });

class BadFiles : public testing::TestWithParam<std::string> {};

TEST_P(BadFiles, GiveAnErrorOrAValidFile) {
    if (GetParam().empty()) GTEST_SKIP() << "test data " << shared("bad") << " is missing";
    const std::string input = (shared("bad") / GetParam()).string();
    for (const char* name : {"out.glb", "out.gltf"}) {
        const TempFolder folder;
        const std::string output = folder.path(name).string();
        GenerateOptions options;
        options.selection.all = true;
        options.selection.existing = ExistingTangents::replace;
        const auto report = generateFile(input, output, options);
        if (report) {
            const auto second = generateFile(output, output, options);
            ASSERT_TRUE(second) << second.error().message;
            EXPECT_FALSE(second->changed);
            continue;
        }
        const Error& error = report.error();
        EXPECT_NE(error.code, ErrorCode::internal) << error.message;
        EXPECT_FALSE(error.message.empty());
        EXPECT_EQ((error.message + error.place).find_first_of("\n\r"), std::string::npos) << error.message;
        EXPECT_EQ(folder.entryCount(), 0u) << "an error leaves nothing behind";
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, BadFiles, testing::ValuesIn(test::modelFiles("bad")), [](const auto& file) {
    return std::to_string(file.index) + "_" + test::testName(file.param);
});

}  // namespace
}  // namespace tspace
