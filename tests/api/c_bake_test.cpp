// SPDX-License-Identifier: MIT
// Compares baking and finishing by the C API with the tool: files, JSON and errors must be equal.
#include "api/made_bytes.h"
#include "tool/baked_sheets.h"

namespace tspace::test {
namespace {

/// Tests of bake whose working directory is the folder of the models.
class CFilesBake : public BakeCommand {
  protected:
    void SetUp() override {
        BakeCommand::SetUp();
        std::filesystem::current_path(folder.path());
    }
    /// Returns the names of all files in the folder of the models.
    [[nodiscard]] std::set<std::string> names() const {
        std::set<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            found.insert(entry.path().filename().string());
        return found;
    }
    /// Returns the contents of the files that a run of the tool wrote, and removes the files.
    [[nodiscard]] std::map<std::string, std::string> taken(const std::vector<std::string>& outputs) const {
        std::map<std::string, std::string> bytes;
        for (const std::string& output : outputs) {
            bytes[output] = folder.read(output);
            EXPECT_FALSE(bytes[output].empty()) << output;
            std::filesystem::remove(folder.path() / output);
        }
        return bytes;
    }
    void expectWritten(const std::map<std::string, std::string>& bytes) const {
        for (const auto& [output, content] : bytes) EXPECT_TRUE(folder.read(output) == content) << output;
    }
};

TEST_F(CFilesBake, FilesAndReportAreThoseOfTheTool) {
    const ToolRun run = runTool(folder,
                                "bake low.obj --high high.obj -o out.png --size 32x16 --bits 8 --convention unreal "
                                "--maps normal,ao --samples 16 --misses misses.png --json");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto bytes = taken({"out.png", "out_ao.png", "misses.png"});
    const char* options = R"({"size": "32x16", "bits": 8, "convention": "unreal", "maps": ["normal", "ao"],
                              "samples": 16, "misses": "misses.png", "threads": 2})";
    Made report;
    tspace_Error error;
    ASSERT_EQ(tspace_bakeFile("low.obj", "high.obj", "out.png", options, &report.bytes, &error), TSPACE_OK)
        << error.message;
    expectWritten(bytes);
    EXPECT_EQ(withoutSeconds(report.text()), withoutSeconds(run.out));
    EXPECT_EQ(tspace_bakeFile("low.obj", "high.obj", "out.png", options, nullptr, nullptr), TSPACE_OK);
}

TEST_F(CFilesBake, WithoutOptionsTheyAreThoseOfTheTool) {
    folder.write("plain.obj", sheet(1, 0, true));
    ASSERT_EQ(runTool(folder, "finish plain.obj -o out.glb").exit_code, 0);
    const auto bytes = taken({"out.glb"});
    for (const char* options : {static_cast<const char*>(nullptr), "", "{}"}) {
        ASSERT_EQ(tspace_finishFile("plain.obj", "out.glb", options, nullptr, nullptr), TSPACE_OK);
        expectWritten(bytes);
    }
}

TEST_F(CFilesBake, AFinishedModelWithItsMapsIsThatOfTheTool) {
    const ToolRun run = runTool(folder,
                                "finish high.obj --low low.obj -o out.glb --size 32 --maps normal,ao --samples 16 "
                                "--json");
    const auto bytes = taken({"out.glb", "out_normal.png", "out_ao.png"});
    Made report;
    tspace_Error error;
    ASSERT_EQ(
        tspace_finishFile("high.obj", "out.glb",
                          R"({"low": "low.obj", "size": 32, "maps": "normal,ao", "samples": 16, "html": "a.html"})",
                          &report.bytes, &error),
        TSPACE_OK)
        << error.message;
    expectWritten(bytes);
    // The API call also wrote a page, which the tool run did not.
    const auto ofTool = nlohmann::json::parse(run.out), made = nlohmann::json::parse(report.text());
    for (const char* member :
         {"schema", "exitCode", "input", "low", "output", "models", "check", "outputBytes", "remarks"})
        EXPECT_EQ(made.at(member), ofTool.at(member)) << member;
    EXPECT_EQ(made.at("bake").at("files"), ofTool.at("bake").at("files"));
    EXPECT_EQ(made.at("outputFiles").size(), ofTool.at("outputFiles").size() + 1);
    EXPECT_NE(folder.read("a.html").find("<title>"), std::string::npos);
}

TEST_F(CFilesBake, ABakeWithoutHitsSucceedsAndItsReportHasTheExitCodeOfTheTool) {
    folder.write("far.obj", sheet(4, 0, true, "sheet", 1000));
    const ToolRun run = runTool(folder, "bake low.obj --high far.obj -o out.png --size 32 --reach 0.1 --json");
    ASSERT_EQ(run.exit_code, 1) << run.err;
    const std::set<std::string> before = names();
    Made report;
    ASSERT_EQ(tspace_bakeFile("low.obj", "far.obj", "out.png", R"({"size": 32, "reach": 0.1})", &report.bytes, nullptr),
              TSPACE_OK);
    EXPECT_EQ(withoutSeconds(report.text()), withoutSeconds(run.out));
    EXPECT_EQ(names(), before);
}

TEST_F(CFilesBake, AnErrorOfABakeSaysWhichFileItIsAboutAndNothingIsWritten) {
    folder.write("bad.glb", "glTF....");
    const std::set<std::string> before = names();
    struct Wrong {
        const char *low, *high, *output, *options;
        tspace_ErrorCode code;
        std::uint64_t element;
    };
    for (const Wrong& wrong :
         {Wrong{"none.obj", "high.obj", "a.png", nullptr, TSPACE_ERROR_CANNOT_READ, 0},
          Wrong{"low.obj", "none.obj", "a.png", nullptr, TSPACE_ERROR_CANNOT_READ, 1},
          Wrong{"bad.glb", "high.obj", "a.png", nullptr, TSPACE_ERROR_INVALID_FILE, 0},
          Wrong{"low.obj", "bad.glb", "a.png", nullptr, TSPACE_ERROR_INVALID_FILE, 1},
          Wrong{"low.obj", "high.obj", "a.png", R"({"cage": "none.obj"})", TSPACE_ERROR_CANNOT_READ, 2},
          Wrong{"low.obj", "high.obj", "a.png", R"({"skew": "none.png"})", TSPACE_ERROR_CANNOT_READ, 4},
          Wrong{"high.obj", "high.obj", "a.png", nullptr, TSPACE_ERROR_MISSING_ATTRIBUTE, 0},
          Wrong{"low.obj", "high.obj", "a.jpg", nullptr, TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{"low.obj", "high.obj", "a.png", R"({"sise": 32})", TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{"low.obj", "high.obj", "a.png", R"({"pairs": "a"})", TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{"low.obj", "high.obj", "a.png", R"({"high": "a"})", TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{"low.obj", "high.obj", "a.png", R"({"size": 0})", TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{nullptr, "high.obj", "a.png", nullptr, TSPACE_ERROR_NULL_DATA, TSPACE_NO_ELEMENT},
          Wrong{"low.obj", nullptr, "a.png", nullptr, TSPACE_ERROR_NULL_DATA, TSPACE_NO_ELEMENT},
          Wrong{"low.obj", "high.obj", nullptr, nullptr, TSPACE_ERROR_NULL_DATA, TSPACE_NO_ELEMENT}}) {
        Made report;
        tspace_Error error;
        EXPECT_EQ(tspace_bakeFile(wrong.low, wrong.high, wrong.output, wrong.options, &report.bytes, &error),
                  wrong.code)
            << error.message;
        EXPECT_EQ(error.element, wrong.element) << error.message;
        EXPECT_TRUE(report.isEmpty());
    }
    EXPECT_EQ(names(), before);
    tspace_Error error;
    EXPECT_EQ(tspace_bakeFile("low.obj", "high.obj", "a.png", R"({"sise": 32})", nullptr, &error),
              TSPACE_ERROR_INVALID_OPTION);
    EXPECT_STREQ(error.message, "unknown option '--sise'; did you mean '--size'?");
}

TEST_F(CFilesBake, AnErrorOfFinishSaysWhichModelItIsAboutAndNothingIsWritten) {
    const std::set<std::string> before = names();
    struct Wrong {
        const char *input, *output, *options;
        tspace_ErrorCode code;
        std::uint64_t element;
    };
    for (const Wrong& wrong :
         {Wrong{"none.obj", "a.glb", nullptr, TSPACE_ERROR_CANNOT_READ, 1},
          Wrong{"high.obj", "a.glb", R"({"low": "none.obj"})", TSPACE_ERROR_CANNOT_READ, 0},
          Wrong{"high.obj", "a.gltf", nullptr, TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{"high.obj", "a.glb", R"({"crese": 60})", TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{"high.obj", "a.glb", R"({"size": 32})", TSPACE_ERROR_INVALID_OPTION, TSPACE_NO_ELEMENT},
          Wrong{nullptr, "a.glb", nullptr, TSPACE_ERROR_NULL_DATA, TSPACE_NO_ELEMENT},
          Wrong{"high.obj", nullptr, nullptr, TSPACE_ERROR_NULL_DATA, TSPACE_NO_ELEMENT}}) {
        Made report;
        tspace_Error error;
        EXPECT_EQ(tspace_finishFile(wrong.input, wrong.output, wrong.options, &report.bytes, &error), wrong.code)
            << error.message;
        EXPECT_EQ(error.element, wrong.element) << error.message;
        EXPECT_TRUE(report.isEmpty());
    }
    EXPECT_EQ(names(), before);
}

TEST_F(CFilesBake, RejectsOutputsThatAreInputsOrEqual) {
    ASSERT_EQ(runTool(folder, "generate low.obj -o low.glb --all -q").exit_code, 0);
    const std::string before = folder.read("low.glb");
    const std::set<std::string> names_before = names();
    EXPECT_NE(tspace_finishFile("low.glb", "low.glb", nullptr, nullptr, nullptr), TSPACE_OK);
    EXPECT_NE(tspace_finishFile("low.glb", "b.glb", R"({"html": "low.glb"})", nullptr, nullptr), TSPACE_OK);
    EXPECT_NE(tspace_finishFile("low.glb", "b.glb", R"({"html": "b.glb"})", nullptr, nullptr), TSPACE_OK);
    EXPECT_NE(tspace_finishFile("high.obj", "low.glb", R"({"low": "low.glb", "size": 32})", nullptr, nullptr),
              TSPACE_OK);
    EXPECT_NE(
        tspace_bakeFile("low.glb", "high.obj", "a.png", R"({"size": 32, "out-mesh": "low.glb"})", nullptr, nullptr),
        TSPACE_OK);
    EXPECT_NE(tspace_bakeFile("low.glb", "high.obj", "a.png", R"({"size": 32, "misses": "a.png"})", nullptr, nullptr),
              TSPACE_OK);
    EXPECT_TRUE(folder.read("low.glb") == before);
    EXPECT_EQ(names(), names_before);
}

}  // namespace
}  // namespace tspace::test
