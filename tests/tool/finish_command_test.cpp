// SPDX-License-Identifier: MIT
// tspace finish: correct data is preserved, faults are repaired, and low polys get all maps.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tool/baked_sheets.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

class Finish : public testing::Test {
  protected:
    /// Returns the report of a run that must end with `exit_code`.
    [[nodiscard]] Json report(const std::string& arguments, int exit_code = 0) const {
        const ToolRun run = runTool(folder, "finish --json " + arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << run.err;
        return Json::parse(run.out, nullptr, false);
    }
    /// Returns the names of the findings in a file, with their numbers.
    [[nodiscard]] std::map<std::string, int> found(const std::string& name) const {
        const ToolRun run = runTool(folder, "check --json " + name);
        const Json json = Json::parse(run.out, nullptr, false);
        std::map<std::string, int> codes;
        for (const Json& finding : json["files"][0]["findings"]) ++codes[finding["code"].get<std::string>()];
        return codes;
    }
    [[nodiscard]] int turnable(const std::string& name) const {
        const ToolRun run = runTool(folder, "generate --json --fix-winding --dry-run -o dry.glb " + name);
        return Json::parse(run.out, nullptr, false)["files"][0]["windings"][0]["turned"].get<int>();
    }
    void make(const std::string& arguments) const { ASSERT_EQ(runTool(folder, arguments + " --quiet").exit_code, 0); }

    const TempFolder folder;
};

/// Returns an uneven sheet of unit cells with two triangles each. Every eleventh triangle is flipped. `fits`: the
/// normals of flipped triangles are flipped too.
std::string turnedSheet(int cells, bool with_normals, bool fits) {
    std::string text = "o sheet\n", faces;
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x)
            text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string((x * x + y) % 3) + "\n";
    }
    text += "vn 0 0 1\nvn 0 0 -1\n";
    int count = 0;
    const auto add = [&](int a, int b, int c) {
        const bool is_turned = ++count % 11 == 5;
        if (is_turned) std::swap(b, c);
        faces += "f";
        for (const int vertex : {a, b, c})
            faces += " " + std::to_string(vertex) + (with_normals ? is_turned && fits ? "//2" : "//1" : "");
        faces += "\n";
    };
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            const int a = y * (cells + 1) + x + 1;
            add(a, a + 1, a + cells + 2);
            add(a, a + cells + 2, a + cells + 1);
        }
    }
    return text + faces;
}

TEST_F(Finish, KeepsACorrectModelByteForByte) {
    writeBumpMap(folder);
    writeFoldedObj(folder, "a.obj");
    make("generate a.obj -o right.glb");
    const Json json = report("right.glb -o out.glb");
    EXPECT_TRUE(folder.read("out.glb") == folder.read("right.glb"));
    EXPECT_EQ(json["models"][0]["done"], Json::array({"no changes were needed"}));
    EXPECT_FALSE(json["models"][0]["made"]["changed"].get<bool>());
}

TEST_F(Finish, AddsNormalsAndMakesTheWindingConsistent) {
    folder.write("a.obj", turnedSheet(12, false, false));
    EXPECT_GT(turnable("a.obj"), 0);
    const Json json = report("a.obj -o out.glb");
    EXPECT_EQ(turnable("out.glb"), 0);
    EXPECT_EQ(found("out.glb").count("normalsMissing"), 0U);
    EXPECT_EQ(json["models"][0]["made"]["windings"][0]["conflictsAfter"], 0);
    EXPECT_EQ(json["check"]["counts"]["error"], 0);
}

TEST_F(Finish, FlipsNoTriangleThatFitsItsNormals) {
    folder.write("a.obj", turnedSheet(12, true, true));
    make("generate a.obj -o a.glb");
    EXPECT_GT(turnable("a.glb"), 0);
    const Json json = report("a.glb -o out.glb");
    EXPECT_TRUE(folder.read("out.glb") == folder.read("a.glb"));
    EXPECT_EQ(json["models"][0]["leftWinding"], turnable("a.glb"));
    EXPECT_NE(json["remarks"][0].get<std::string>().find("--normals all"), std::string::npos);
    (void)report("a.glb -o all.glb --normals all");
    EXPECT_EQ(turnable("all.glb"), 0);
}

TEST_F(Finish, FlipsTrianglesThatContradictKeptNormals) {
    folder.write("a.obj", turnedSheet(12, true, false));
    make("generate a.obj -o a.glb");
    const Json json = report("a.glb -o out.glb");
    EXPECT_EQ(turnable("out.glb"), 0);
    EXPECT_EQ(found("out.glb").count("normalsAgainstWinding"), 0U);
    EXPECT_FALSE(json["models"][0]["made"]["primitives"][0]["normalsGenerated"].get<bool>());
}

TEST_F(Finish, LeavesNoErrorThatCheckFindsInTangentsOrNormals) {
    writeBumpMap(folder);
    writeFoldedObj(folder, "a.obj");
    make("generate a.obj -o signs.glb --convention directx");
    EXPECT_EQ(found("signs.glb").count("signsInverted"), 1U);
    (void)report("signs.glb -o out.glb");
    EXPECT_EQ(found("out.glb").count("signsInverted"), 0U);
    // One of two primitives has normals of length 0 and gets new ones. The other one keeps its normals.
    std::string text = turnedSheet(12, true, false);
    text.replace(text.find("vn 0 0 1"), 18, "vn 0.28 0 0.96\nvn 0 0 1");
    const std::size_t half = text.find("\nf ", text.size() / 2) + 1;
    std::string second = text.substr(half);
    for (std::size_t at = second.find("//1"); at != std::string::npos; at = second.find("//1", at))
        second[at + 2] = '2';
    folder.write("b.obj", text.substr(0, half) + "usemtl other\n" + second);
    make("generate b.obj -o b.glb");
    std::string bytes = folder.read("b.glb");
    const float normal[3] = {0.28F, 0, 0.96F};
    const std::string wanted(reinterpret_cast<const char*>(normal), sizeof normal);
    for (std::size_t at = bytes.find(wanted); at != std::string::npos; at = bytes.find(wanted, at))
        bytes.replace(at, wanted.size(), wanted.size(), '\0');
    folder.write("b.glb", bytes);
    ASSERT_EQ(found("b.glb").count("normalsNotUnit"), 1U);
    const Json json = report("b.glb -o out.glb --keep-winding");
    EXPECT_EQ(found("out.glb").count("normalsNotUnit"), 0U);
    const Json& primitives = json["models"][0]["made"]["primitives"];
    ASSERT_EQ(primitives.size(), 2U);
    EXPECT_TRUE(primitives[0]["normalsReplaced"].get<bool>());
    EXPECT_FALSE(primitives[1]["normalsGenerated"].get<bool>());
}

TEST_F(Finish, NamesToolsForMissingUvsAndDoesTheOtherSteps) {
    folder.write("a.obj", turnedSheet(6, false, false));
    const Json json = report("a.obj -o out.glb");
    ASSERT_EQ(json["remarks"].size(), 1U);
    EXPECT_NE(json["remarks"][0].get<std::string>().find("unwrapping"), std::string::npos);
    EXPECT_EQ(turnable("out.glb"), 0);
    const ToolRun run = runTool(folder, "finish a.obj --low a.obj -o b.glb");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_NE(run.err.find("unwrapping"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.glb"));
}

TEST_F(Finish, MalformedFilesCauseOneLineAndNoFile) {
    folder.write("bad.glb", "glTF....");
    folder.write("a.obj", sheet(4, 0, true));
    for (const std::string arguments : {"bad.glb -o out.glb", "a.obj --low bad.glb -o out.glb", "none.obj -o out.glb",
                                        "a.obj -o out.gltf", "bad.glb --low a.obj -o out.glb --html p.html"}) {
        const ToolRun run = runTool(folder, "finish " + arguments);
        EXPECT_TRUE(arguments == "a.obj -o out.gltf" ? run.exit_code == 2 : run.exit_code >= 3) << arguments;
        EXPECT_EQ(run.errorLines(), 1) << arguments << run.err;
        EXPECT_EQ(run.err.find("bad.glb") != std::string::npos, arguments.find("bad.glb") != std::string::npos);
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.glb"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "p.html"));
}

TEST_F(Finish, NoOutputIsAnInputOrAnotherOutput) {
    folder.write("a.obj", sheet(4, 0, true));
    make("generate a.obj -o a.glb");
    const std::string before = folder.read("a.glb");
    for (const char* arguments : {"a.glb -o a.glb", "a.glb -o b.glb --html a.glb", "a.glb -o b.glb --report b.glb",
                                  "a.obj --low a.glb -o a.glb", "a.glb -o b.glb --html b.glb"}) {
        const ToolRun run = runTool(folder, std::string("finish ") + arguments);
        EXPECT_EQ(run.exit_code, 2) << arguments;
        EXPECT_EQ(run.errorLines(), 1) << arguments;
    }
    EXPECT_EQ(folder.read("a.glb"), before);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.glb"));
    EXPECT_EQ(runTool(folder, "finish a.glb -o b.glb --size 64").exit_code, 2) << "a map without a low poly";
}

TEST_F(Finish, ThePageShowsTheModelBeforeAndAfterAndLoadsNothing) {
    folder.write("a.obj", turnedSheet(6, false, false));
    (void)report("a.obj -o out.glb --html page.html");
    const std::string page = folder.read("page.html");
    std::size_t pictures = 0;
    for (std::size_t at = page.find("<img"); at != std::string::npos; at = page.find("<img", at + 1)) ++pictures;
    EXPECT_EQ(pictures, 6U);
    for (const char* when : {"before", "finished"}) {
        for (const char* what : {", lit<", ", lit, from behind", ", the shaded normals"})
            EXPECT_NE(page.find(std::string(when) + what), std::string::npos) << when << what;
    }
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    (void)report("flat.obj -o flat.glb --html flat.html");
    EXPECT_NE(folder.read("flat.html").find("finished, lit, from behind: nothing is visible from this side."),
              std::string::npos)
        << "a glTF material is single-sided";
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find("http"), page.find("http-equiv"));
}

class FinishLow : public BakeCommand {
  protected:
    ToolRun finish(const std::string& arguments) const {
        const ToolRun run = runTool(folder, "finish --size 32 --samples 8 " + arguments);
        EXPECT_LE(run.exit_code, 1) << run.err;
        return run;
    }
};

TEST_F(FinishLow, WritesAllMapsAndEmbedsThoseThatGltfSupports) {
    const Json json = Json::parse(finish("high.obj --low low.obj -o out/a.glb --json").out, nullptr, false);
    std::vector<std::string> wanted = {"out/a.glb"};
    for (const char* map :
         {"normal", "ao", "bent", "curvature", "height", "position", "thickness", "id", "color", "orm", "emission"})
        wanted.push_back("out/a_" + std::string(map) + ".png");
    std::vector<std::string> files = json["outputFiles"];
    std::sort(files.begin() + 1, files.end());
    std::sort(wanted.begin() + 1, wanted.end());
    EXPECT_EQ(files, wanted);
    EXPECT_EQ(json["check"]["counts"]["error"], 0);
    const std::string bytes = folder.read("out/a.glb");
    for (const char* member :
         {"normalTexture", "occlusionTexture", "baseColorTexture", "metallicRoughnessTexture", "emissiveTexture"})
        EXPECT_NE(bytes.find(member), std::string::npos) << member;
}

TEST_F(FinishLow, GivesTheMapThatBakingTheFinishedModelsGives) {
    finish("high.obj --low low.obj -o a.glb --maps normal,ao --crease 180");
    ASSERT_EQ(runTool(folder, "finish high.obj -o high.glb --crease 180").exit_code, 0);
    ASSERT_EQ(runTool(folder, "finish low.obj -o low.glb --crease 180").exit_code, 0);
    ASSERT_EQ(runTool(folder, "bake low.glb --high high.glb -o n.png --maps normal,ao --size 32 --samples 8").exit_code,
              0);
    EXPECT_TRUE(folder.read("a_normal.png") == folder.read("n.png"));
    EXPECT_TRUE(folder.read("a_ao.png") == folder.read("n_ao.png"));
}

TEST_F(FinishLow, GivesTheSameBytesForAnyThreads) {
    finish("high.obj --low low.obj -o one/a.glb --threads 1 --html one/a.html");
    finish("high.obj --low low.obj -o two/a.glb --threads 3");
    for (const std::string name : {"a.glb", "a_normal.png", "a_thickness.png"})
        EXPECT_TRUE(folder.read("one/" + name) == folder.read("two/" + name)) << name;
    EXPECT_NE(folder.read("one/a.html").find("one/a_normal.png"), std::string::npos);
}

TEST_F(FinishLow, WritesNothingIfNoRayHits) {
    std::string far = sheet(4, 0, false, "far", 900);
    folder.write("far.obj", far);
    const ToolRun run = runTool(folder, "finish far.obj --low low.obj -o a.glb --size 32 --reach 0.01 --maps normal");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("no map was written"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.glb"));
}

}  // namespace
}  // namespace tspace::test
