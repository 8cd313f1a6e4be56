// SPDX-License-Identifier: MIT
// tspace bake --pairs: many bakes in one run.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tool/baked_sheets.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

class BakePairs : public BakeCommand {
  protected:
    void SetUp() override {
        BakeCommand::SetUp();
        folder.write("t/low.obj", folder.read("low.obj"));
        folder.write("t/high.obj", folder.read("high.obj"));
        folder.write("t/other.obj", sheet(40, 0.01, false));
        folder.write("t/table.txt", "# props\nlow.obj = high.obj\n\n  low.obj=other.obj = second.png \r\n");
    }
    [[nodiscard]] Json pairs(const std::string& arguments, int exit_code = 0) const {
        const ToolRun run = runTool(folder, "bake --size 32 --json " + arguments);
        EXPECT_EQ(run.exit_code, exit_code) << run.err;
        return Json::parse(run.out, nullptr, false);
    }
};

TEST_F(BakePairs, GiveTheMapsThatSingleBakesGiveForAnyJobs) {
    const Json json = pairs("--pairs t/table.txt -o two --jobs 2 --out-mesh models");
    ASSERT_EQ(json["pairs"].size(), 2U);
    EXPECT_EQ(json["pairs"][0]["output"], "two/low.png");
    EXPECT_EQ(json["pairs"][1]["output"], "two/second.png");
    ASSERT_EQ(runTool(folder, "bake t/low.obj --high t/other.obj -o one.png --size 32").exit_code, 0);
    EXPECT_TRUE(folder.read("two/low.png") == folder.read("first.png"));
    EXPECT_TRUE(folder.read("two/second.png") == folder.read("one.png"));
}

TEST_F(BakePairs, MayBeTgaWithTheTexelsOfThePngOfEightBits) {
    folder.write("t/table.txt", "low.obj = high.obj = a.tga\nlow.obj = high.obj = a.png\n");
    (void)pairs("--pairs t/table.txt -o two --bits 8 --maps normal,ao");
    const FloatImage png = imageOf(folder, "two/a.png");
    const std::string tga = folder.read("two/a.tga");
    ASSERT_EQ(tga.size(), 18 + 3 * png.texels.size() + 26);
    for (std::size_t i = 0; i < png.texels.size(); ++i)
        EXPECT_EQ(static_cast<std::uint8_t>(tga[18 + 3 * i + 2]), std::lround(255 * png.texels[i].x)) << i;
    EXPECT_EQ(folder.read("two/a_ao.tga").size(), tga.size());
    EXPECT_EQ(runTool(folder, "convert-map --flip-green two/a.png -o b.tga").exit_code, 0);
    EXPECT_EQ(folder.read("b.tga").size(), tga.size());
    EXPECT_EQ(runTool(folder, "bake low.obj --high high.obj -o c.tga --out-mesh c.glb").exit_code, 2);
}

TEST_F(BakePairs, ResumeSkipsCompletedUnchangedPairs) {
    const std::string arguments = "--pairs t/table.txt -o two --manifest m.jsonl --resume";
    (void)pairs(arguments);
    Json json = pairs(arguments);
    EXPECT_TRUE(json["pairs"][0]["skipped"].get<bool>() && json["pairs"][1]["skipped"].get<bool>());
    folder.write("t/other.obj", sheet(40, 0.015, false));
    json = pairs(arguments);
    EXPECT_TRUE(json["pairs"][0]["skipped"].get<bool>());
    EXPECT_FALSE(json["pairs"][1]["skipped"].get<bool>()) << "its high poly is another one";
    json = pairs(arguments + " --bits 8");
    EXPECT_FALSE(json["pairs"][0]["skipped"].get<bool>()) << "with other options";
}

TEST_F(BakePairs, AFailedPairIsReportedAndTheOthersAreBaked) {
    folder.write("t/table.txt", "none.obj = high.obj\nlow.obj = high.obj\n");
    const ToolRun run = runTool(folder, "bake --pairs t/table.txt -o two --size 32 --report r.json");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "two/low.png"));
    EXPECT_FALSE(Json::parse(folder.read("r.json"))["pairs"][0]["report"]["ok"].get<bool>());
}

TEST_F(BakePairs, NamesInATableStayInTheFolderOfTheOutput) {
    const std::string absolute = (folder.path() / "absolute.png").string();
    for (const std::string& name : {std::string("../up.png"), std::string("sub/../../up.png"), absolute}) {
        folder.write("t/table.txt", "low.obj = high.obj = first.png\nlow.obj = high.obj = " + name + "\n");
        const ToolRun run = runTool(folder, "bake --pairs t/table.txt -o in/two --size 32 --out-mesh in/models");
        EXPECT_EQ(run.exit_code, 3) << name << run.err;
        EXPECT_EQ(run.errorLines(), 1) << name << run.err;
        EXPECT_NE(run.err.find("line 2"), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "in")) << name << ": nothing was written";
        EXPECT_FALSE(std::filesystem::exists(absolute));
    }
    folder.write("t/table.txt", "../t/low.obj = ../high.obj = sub/deep.png\n");
    (void)pairs("--pairs t/table.txt -o in/two --out-mesh in/models");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "in/two/sub/deep.png")) << "models may lie anywhere";
}

TEST_F(BakePairs, ATableCannotPutControlCharactersIntoFileNames) {
    for (const char* name : {"a\tb.png", "a\x1b[2Jb.png", "a\x7f.png", "a\xc2\x9b.png"}) {
        folder.write("t/table.txt", std::string("low.obj = high.obj\nlow.obj = high.obj = ") + name + "\n");
        const ToolRun run = runTool(folder, "bake --pairs t/table.txt -o in/two --size 32");
        EXPECT_EQ(run.exit_code, 3) << run.err;
        EXPECT_NE(run.err.find("line 2: the output"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("has a control character in its name"), std::string::npos) << run.err;
        EXPECT_FALSE(folder.has("in")) << "nothing was written";
    }
    folder.write("t/lo\bw.obj", folder.read("low.obj"));
    folder.write("t/table.txt", "lo\bw.obj = high.obj\n");
    EXPECT_EQ(runTool(folder, "bake --pairs t/table.txt -o in/two --size 32").exit_code, 3);
    folder.write("t/table.txt", "lo\bw.obj = high.obj = named.png\n");
    (void)pairs("--pairs t/table.txt -o in/two");
    EXPECT_TRUE(folder.has("in/two/named.png"));
}

TEST_F(BakePairs, LowPolysWithEqualNamesGetDistinctOutputs) {
    folder.write("t/a/low.obj", folder.read("low.obj"));
    folder.write("t/table.txt", "# props\nlow.obj = high.obj\na/low.obj = high.obj\n");
    const ToolRun run = runTool(folder, "bake --pairs t/table.txt -o two --size 32");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.errorLines(), 1) << run.err;
    EXPECT_NE(run.err.find("lines 2 and 3"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "two")) << "nothing is baked";
    folder.write("t/table.txt", "low.obj = high.obj\na/low.obj = high.obj = a/low.png\n");
    EXPECT_EQ(pairs("--pairs t/table.txt -o two")["pairs"].size(), 2U);
}

TEST_F(BakePairs, RejectsTwoLinesWithOneOutput) {
    folder.write("t/two.obj", "mtllib two.mtl\nusemtl body\n" + sheet(4, 0, true, "a") + "usemtl belt\n" +
                                  sheet(4, 0, true, "b", 0.01, 25));
    folder.write("t/two.mtl", "newmtl body\nnewmtl belt\n");
    const auto run = [&](const char* first, const char* second, const char* options) {
        folder.write("t/table.txt", std::string(first) + "\n" + second + "\n");
        return runTool(folder, std::string("bake --pairs t/table.txt -o two --size 32 -q ") + options);
    };
    const struct {
        const char *first, *second, *options, *file;
    } cases[] = {
        {"low.obj = high.obj = x.png", "low.obj = other.obj = x_ao.png", "--maps normal,ao", "x_ao.png"},
        {"low.obj = high.obj = x_ao.png", "low.obj = other.obj = x.png", "--maps normal,ao", "x_ao.png"},
        {"low.obj = high.obj = x.tga", "low.obj = other.obj = x_id.tga", "--maps normal,id", "x_id.tga"},
        {"low.obj = high.obj = x.png", "low.obj = other.obj = ./x_ao.png", "--maps normal,ao", "x_ao.png"},
        {"low.obj = high.obj = x.png", "low.obj = other.obj = x.tga", "--out-mesh models", "models/x.glb"},
        {"two.obj = high.obj = x.png", "low.obj = other.obj = x.body.png", "", "x.body.png"},
        {"low.obj = other.obj = x_ao.belt.png", "two.obj = high.obj = x.png", "--maps normal,ao", "x_ao.belt.png"},
        {"two.obj = high.obj = x.png", "low.obj = other.obj = x.body.png", "--udim", "x.body.1001.png"},
    };
    for (const auto& [first, second, options, file] : cases) {
        const ToolRun refused = run(first, second, options);
        EXPECT_EQ(refused.exit_code, 2) << second << refused.err;
        EXPECT_EQ(refused.errorLines(), 1) << refused.err;
        EXPECT_NE(refused.err.find("lines 1 and 2"), std::string::npos) << refused.err;
        EXPECT_NE(refused.err.find(file), std::string::npos) << refused.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "two")) << second << ": nothing is baked";
    }
    EXPECT_EQ(run("low.obj = high.obj = x.png", "low.obj = other.obj = x.body.png", "").exit_code, 0)
        << "one material gives its file no word";
    EXPECT_EQ(run("low.obj = high.obj = x.png", "low.obj = other.obj = x_ao.png", "").exit_code, 0);
}

TEST_F(BakePairs, RejectsALineThatWritesAnInputOfAnother) {
    folder.write("t/part.glb", folder.read("low.obj"));
    for (const auto& [table, options] :
         {std::pair("low.obj = high.obj = part.png\npart.glb = high.obj = x.png\n", "-o two --out-mesh t"),
          std::pair("low.obj = high.obj = part.png\nlow.obj = part.glb = x.png\n", "-o two --out-mesh t")}) {
        folder.write("t/table.txt", table);
        const ToolRun run = runTool(folder, std::string("bake --pairs t/table.txt --size 32 ") + options);
        EXPECT_EQ(run.exit_code, 2) << table << run.err;
        EXPECT_NE(run.err.find("is an input"), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "two/part.png")) << "nothing is baked";
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "t/x.png")) << "nothing is baked";
    }
}

TEST_F(BakePairs, AnInvalidTableCausesOneLine) {
    for (const auto& [table, code] :
         {std::pair("low.obj\n", 3), std::pair("low.obj = high.obj = a.png = b\n", 3), std::pair("= high.obj\n", 3),
          std::pair("", 3), std::pair("low.obj = high.obj\nlow.obj = other.obj\n", 2),
          std::pair("low.obj = high.obj = ../t/high.obj\n", 3)}) {
        folder.write("t/table.txt", table);
        const ToolRun run = runTool(folder, "bake --pairs t/table.txt -o two --size 32");
        EXPECT_EQ(run.exit_code, code) << table << run.err;
        EXPECT_EQ(run.errorLines(), 1) << table << run.err;
    }
    for (const char* arguments :
         {"bake -o a.png", "bake low.obj --pairs t/table.txt -o two", "bake --pairs t/table.txt --high high.obj -o two",
          "bake --pairs t/table.txt -o low.obj", "bake low.obj --high high.obj -o a.png --jobs 2"})
        EXPECT_EQ(runTool(folder, arguments).exit_code, 2) << arguments;
}

}  // namespace
}  // namespace tspace::test
