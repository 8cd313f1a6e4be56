// SPDX-License-Identifier: MIT
// Every file in which the glTF validator finds no error loads, and every file that loads is processed.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "model/json/json.h"
#include "model_files.h"
#include "support/shared_data.h"
#include "support/temp_folder.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"

namespace tspace {
namespace {

using test::shared;

/// Files without errors that are rejected nevertheless.
const std::map<std::string, ErrorCode> kRefused = {
    // A web address is never loaded.
    {"buffer/non_relative_uri.gltf", ErrorCode::forbiddenPath},
    // Requires a version after 2.0.
    {"asset/min_version_valid.gltf", ErrorCode::unsupportedFile},
};

TEST(ValidFiles, Load) {
    const std::string folder = "bad/gltf-validator/base";
    TSPACE_NEEDS_SHARED("bad/gltf-validator/base");
    int count = 0;
    for (const std::string& name : test::modelFiles(folder)) {
        const auto path = shared(folder) / name;
        std::ifstream file(path.string() + ".report.json");
        if (!file) continue;
        const std::string text(std::istreambuf_iterator<char>(file), {});
        const Json report = Json::parse(text);
        if (report.at("issues").at("numErrors") != 0) continue;
        ++count;
        const auto inspection = inspectFile(path.string());
        const auto refused = kRefused.find(name);
        if (refused == kRefused.end()) {
            EXPECT_TRUE(inspection) << name << ": " << inspection.error().message << " at " << inspection.error().place;
        } else {
            EXPECT_TRUE(!inspection && inspection.error().code == refused->second) << name;
        }
    }
    EXPECT_GT(count, 50);
}

/// generate must not reject a file that check can read, with any options.
TEST(ReadableFiles, AreProcessed) {
    const std::string folder = "bad/gltf-validator";
    TSPACE_NEEDS_SHARED("bad/gltf-validator");
    GenerateOptions all, strip, repair;
    all.selection.all = all.normals.overwrite = true;
    strip.selection.strip = true;
    repair.selection.existing = ExistingTangents::repair;
    int count = 0;
    for (const std::string& name : test::modelFiles(folder)) {
        const std::string path = (shared(folder) / name).string();
        if (!checkFile(path)) continue;
        ++count;
        for (const GenerateOptions& options : {GenerateOptions{}, all, strip, repair}) {
            for (const char* written : {"out.gltf", "out.glb"}) {
                const test::TempFolder output;
                const auto report = generateFile(path, output.path(written).string(), options);
                EXPECT_TRUE(report) << name << ": " << report.error().message << " at " << report.error().place;
            }
        }
    }
    EXPECT_GT(count, 150);
}

}  // namespace
}  // namespace tspace
