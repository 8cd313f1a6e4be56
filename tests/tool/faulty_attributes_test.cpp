// SPDX-License-Identifier: MIT
// Attributes that cannot be read: each command reports or ignores them, and processes the other parts of the model.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tool/faulty_models.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

class FaultyAttributes : public testing::TestWithParam<FaultyModel> {
  public:
    void SetUp() override { writeFaulty(folder_, GetParam()); }

    static Json attributesOf(const Json& gltf, int mesh) { return gltf["meshes"][mesh]["primitives"][0]["attributes"]; }

  protected:
    TempFolder folder_;
};

TEST_P(FaultyAttributes, EndNoCommand) {
    for (const char* command :
         {"inspect faulty.gltf", "identify faulty.gltf", "diff faulty.gltf faulty.gltf",
          "render faulty.gltf -o a.png --size 32", "finish faulty.gltf -o finished.glb",
          "bake faulty.gltf --high faulty.gltf -o baked.png --size 16",
          "generate faulty.gltf -o b.glb --overwrite-normals", "generate faulty.gltf -o c.glb --repair",
          "generate faulty.gltf -o d.glb --fix-winding --morph-normals all --pack frame32"}) {
        const ToolRun run = runTool(folder_, command);
        EXPECT_NE(run.exit_code, 3) << command << ": " << run.err;
        EXPECT_LE(run.exit_code, 1) << command << ": " << run.err;
    }
}

TEST_P(FaultyAttributes, AreFindings) {
    const Json report = Json::parse(runTool(folder_, "check --json faulty.gltf").out);
    const bool has_two = GetParam().also[0] != '\0';
    std::size_t count = 0;
    for (const Json& finding : report["files"][0]["findings"]) {
        if (finding["code"] != "attributeUnreadable") continue;
        ++count;
        EXPECT_EQ(finding["severity"], "error");
        EXPECT_EQ(finding["mesh"], 1);
        EXPECT_EQ(finding["commands"].empty(), !GetParam().is_repairable) << finding["remedy"];
    }
    EXPECT_EQ(count, has_two ? 2U : 1U) << report;
}

TEST_P(FaultyAttributes, LeaveTheRestOfTheModelToGenerate) {
    const Json before = Json::parse(folder_.read("faulty.gltf"));
    const ToolRun run = runTool(folder_, "generate --json faulty.gltf -o out/faulty.gltf");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json report = Json::parse(run.out)["files"][0];
    EXPECT_EQ(report["primitives"][0]["action"], "generated");
    EXPECT_EQ(report["primitives"][1]["action"], "impossible");
    const Json after = Json::parse(folder_.read("out/faulty.gltf"));
    EXPECT_TRUE(attributesOf(after, 0).contains("TANGENT"));
    EXPECT_EQ(attributesOf(after, 1), attributesOf(before, 1));
    EXPECT_EQ(after["meshes"][1]["primitives"][0]["targets"], before["meshes"][1]["primitives"][0]["targets"]);
    const ToolRun repair = runTool(folder_, "generate --json faulty.gltf -o repaired/faulty.gltf --repair");
    ASSERT_EQ(repair.exit_code, 0) << repair.err;
    const Json repaired = Json::parse(folder_.read("repaired/faulty.gltf"));
    if (GetParam().is_repairable) {
        EXPECT_TRUE(attributesOf(repaired, 1).contains("TANGENT")) << repair.out;
        EXPECT_TRUE(attributesOf(repaired, 1).contains("JOINTS_0"));
    } else {
        EXPECT_EQ(attributesOf(repaired, 1), attributesOf(before, 1));
    }
}

INSTANTIATE_TEST_SUITE_P(Models, FaultyAttributes, testing::ValuesIn(faultyModels()),
                         [](const auto& model) { return std::string(model.param.name); });

}  // namespace
}  // namespace tspace::test
