// SPDX-License-Identifier: MIT
// Runs every command on all shared files (valid, unusual and corrupt): all output conforms to docs/schema.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "support/shared_data.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// Returns the report of a run. runTool validates it against its schema.
Json reportOf(const TempFolder& folder, const std::string& arguments) {
    const ToolRun run = runTool(folder, arguments + " --json");
    const Json document = Json::parse(run.out, nullptr, false);
    EXPECT_TRUE(document.is_object()) << arguments << run.err;
    return document;
}

std::vector<std::string> sharedFiles(const std::set<std::string>& endings) {
    std::vector<std::string> files;
    for (const char* name : {"models", "reports", "bad"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shared(name))) {
            if (entry.is_regular_file() && endings.contains(entry.path().extension().string())) {
                files.push_back("'" + entry.path().string() + "'");
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string allFolders() {
    std::string text;
    for (const char* name : {"models", "reports", "bad"}) text += " '" + shared(name).string() + "'";
    return text;
}

#define NEEDS_ALL                   \
    TSPACE_NEEDS_SHARED("models");  \
    TSPACE_NEEDS_SHARED("reports"); \
    TSPACE_NEEDS_SHARED("bad")

void expectFolders(const std::string& command) {
    const Json document = reportOf(TempFolder(), command + allFolders());
    std::set<bool> seen;
    for (const Json& file : document["files"]) seen.insert(file["ok"].get<bool>());
    EXPECT_EQ(seen.size(), 2U) << "files that can be read, and such that cannot";
}

TEST(AllReports, OfCheck) {
    NEEDS_ALL;
    expectFolders("check");
}

TEST(AllReports, OfInspect) {
    NEEDS_ALL;
    expectFolders("inspect");
}

TEST(AllReports, OfIdentify) {
    NEEDS_ALL;
    expectFolders("identify");
}

TEST(AllReports, OfGenerate) {
    NEEDS_ALL;
    for (const char* options : {" --all --bitangents --morph-normals all --pack frame32 --normals angle",
                                " --repair --flip-green --fix-maps"}) {
        const Json document = reportOf(TempFolder(), "generate" + allFolders() + " -o out --dry-run" + options);
        EXPECT_TRUE(document["dryRun"].get<bool>());
        EXPECT_GT(document["files"].size(), 400U);
    }
    // Only a part of the models: converting the maps of all models takes minutes.
    reportOf(TempFolder(),
             "generate '" + shared("reports").string() + "' -o out --dry-run --overwrite --method flat --convert-maps");
}

TEST(AllReports, OfDiff) {
    NEEDS_ALL;
    const TempFolder folder;
    const std::vector<std::string> files = sharedFiles({".glb", ".gltf", ".obj"});
    ASSERT_GT(files.size(), 400U);
    // Compare every eighth file with the next one, which usually has another shape, and with itself.
    for (std::size_t i = 0; i + 1 < files.size(); i += 8) {
        reportOf(folder, "diff " + files[i] + ' ' + files[i + 1]);
        reportOf(folder, "diff " + files[i] + ' ' + files[i]);
    }
}

TEST(AllReports, OfRenderAndView) {
    NEEDS_ALL;
    const TempFolder folder;
    const std::vector<std::string> files = sharedFiles({".glb", ".gltf", ".obj"});
    const std::vector<std::string> views = {"lit", "normals", "tangents", "sign", "error", "uv", "mapped"};
    for (std::size_t i = 0; i < files.size(); i += 9) {
        reportOf(folder, "render " + files[i] + " -o a.png --size 32x32 --show " + views[i / 9 % views.size()]);
        reportOf(folder, "view " + files[i] + " -o a.html");
    }
}

TEST(AllReports, OfFinish) {
    NEEDS_ALL;
    const TempFolder folder;
    const std::vector<std::string> files = sharedFiles({".glb", ".gltf", ".obj"});
    for (std::size_t i = 0; i < files.size(); i += 5) reportOf(folder, "finish " + files[i] + " -o out.glb");
}

TEST(AllReports, OfMaps) {
    NEEDS_ALL;
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    const std::vector<std::string> images = sharedFiles({".png", ".jpg", ".webp", ".exr"});
    const std::vector<std::string> commands = {"flip-green", "height-to-normal --mesh a.obj",
                                               "convert-map --mesh a.obj"};
    for (std::size_t i = 0; i < images.size(); ++i) {
        reportOf(folder, commands[i % commands.size()] + " --dry-run -o out.png " + images[i]);
        reportOf(folder, "compress-map --dry-run -o out.dds " + images[i]);
    }
}

TEST(AllReports, OfBakeAndMapError) {
    TSPACE_NEEDS_SHARED("models/obj/spot.obj");
    const TempFolder folder;
    const std::string models = "--high '" + shared("models/obj/spot.obj").string() + "'";
    const std::string low = "'" + shared("models/obj/spot.obj").string() + "' ";
    EXPECT_TRUE(reportOf(folder, "bake " + low + models + " -o n.png --size 64 --heat heat.png")["ok"].get<bool>());
    EXPECT_TRUE(reportOf(folder, "map-error n.png " + low + models + " --heat e.png")["ok"].get<bool>());
    EXPECT_FALSE(reportOf(folder, "bake none.obj " + models + " -o n.png")["ok"].get<bool>());
    EXPECT_FALSE(reportOf(folder, "map-error none.png " + low + models)["ok"].get<bool>());
}

}  // namespace
}  // namespace tspace::test
