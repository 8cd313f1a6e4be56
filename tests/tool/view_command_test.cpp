// SPDX-License-Identifier: MIT
// tspace view: writes one file with the page and a model. The tool searches for the page near itself, so the tool is
// copied.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_tool.h"

namespace tspace::test {
namespace {

namespace fs = std::filesystem;

/// A folder with an installed tool. `page`: contents of the page; empty if it was not built.
class Installed {
  public:
    explicit Installed(const std::string& page) {
        fs::create_directories(folder_.path() / "bin");
        fs::copy_file(TSPACE_TOOL, folder_.path() / "bin" / "tspace");
        if (!page.empty()) folder_.write("share/tspace/view.html", page);
        writeFoldedObj(folder_, "a.obj");
        writeBumpMap(folder_);
    }
    /// Runs the copy of the tool.
    [[nodiscard]] ToolRun run(const std::string& arguments) const {
        return runTool(folder_, arguments, R"(sh -c 'exec ./bin/tspace "$@"')");
    }
    [[nodiscard]] const TempFolder& folder() const { return folder_; }

  private:
    TempFolder folder_ = {};
};

constexpr const char* kPage = "<body><!-- model --><script>1</script></body>";

TEST(ViewCommand, EmbedsTheModelAndItsFilesInThePage) {
    const Installed installed(kPage);
    const ToolRun run = installed.run("view a.obj -o a.html");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string page = installed.folder().read("a.html");
    EXPECT_EQ(page.rfind("<body><script type=\"application/octet-stream\" data-name=\"a.obj\">", 0), 0U) << page;
    EXPECT_NE(page.find("data-name=\"folded.mtl\">bmV3bXRsIHNraW4KbWFwX0J1bXAgYnVtcC5wbmcK</script>"),
              std::string::npos)
        << page;
    EXPECT_NE(page.find("data-name=\"bump.png\">iVBORw0KGgo"), std::string::npos) << page;
    EXPECT_TRUE(page.ends_with("<script>1</script></body>"));
}

TEST(ViewCommand, IsReadableWithoutScripts) {
    const Installed installed(kPage);
    const auto page = [&](const char* epoch) {
        const ToolRun run = runTool(installed.folder(), "view a.obj -o a.html",
                                    std::string("SOURCE_DATE_EPOCH=") + epoch + R"( sh -c 'exec ./bin/tspace "$@"')");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return installed.folder().read("a.html");
    };
    const std::string made = page("1767225600");
    const std::size_t begin = made.find("<noscript>"), end = made.find("</noscript>");
    ASSERT_LT(begin, end);
    ASSERT_NE(end, std::string::npos);
    const std::string still = made.substr(begin, end - begin);
    for (const char* part : {"2026-01-01 00:00 UTC: <code>tspace view a.obj -o a.html</code>", "<h2>a.obj</h2>",
                             "src=\"data:image/png;base64,", "normalsMissing"})
        EXPECT_NE(still.find(part), std::string::npos) << part << '\n' << still.substr(0, 2000);
    EXPECT_EQ(still.find("<script"), std::string::npos);
    EXPECT_NE(made.find(R"("command": "tspace view a.obj -o a.html")"), std::string::npos) << "for the page's scripts";
    EXPECT_EQ(page("1767225600"), made);
}

TEST(ViewCommand, EscapesNamesOfFilesInTheCommand) {
    const Installed installed(kPage);
    ASSERT_EQ(installed.run("generate a.obj -o '<b>.glb'").exit_code, 0);
    ASSERT_EQ(installed.run("view '<b>.glb' -o a.html").exit_code, 0);
    EXPECT_EQ(installed.folder().read("a.html").find("<b>"), std::string::npos);
}

TEST(ViewCommand, FollowsTheRulesForFilesThatAModelNames) {
    const Installed installed(kPage);
    const auto model = [](const std::string& image) {
        return R"({"asset":{"version":"2.0"},"images":[{"uri":")" + image + R"("}]})";
    };
    installed.folder().write("long.gltf", model(std::string(300, 'n') + ".png"));
    installed.folder().write("m/out.gltf", model("link.png"));
    fs::create_symlink("../bump.png", installed.folder().path() / "m" / "link.png");
    for (const char* name : {"long", "m/out"}) {
        const ToolRun run = installed.run("view " + std::string(name) + ".gltf -o x.html");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(installed.folder().read("x.html").find("data:image/png"), std::string::npos)
            << "an image from outside";
    }
    installed.folder().write("m/in.gltf", model("./sub/./bump.png"));
    installed.folder().write("m/sub/bump.png", installed.folder().read("bump.png"));
    ASSERT_EQ(installed.run("view m/in.gltf -o x.html").exit_code, 0);
    EXPECT_NE(installed.folder().read("x.html").find("data-name=\"sub/bump.png\""), std::string::npos);
}

TEST(ViewCommand, EscapesNames) {
    const Installed installed(kPage);
    ASSERT_EQ(installed.run("generate a.obj -o '\"><b\t&.glb'").exit_code, 0);
    ASSERT_EQ(installed.run("view '\"><b\t&.glb' -o a.html").exit_code, 0);
    EXPECT_NE(installed.folder().read("a.html").find("data-name=\"&quot;&gt;&lt;b&#9;&amp;.glb\""), std::string::npos);
}

TEST(ViewCommand, PrintsJson) {
    const Installed installed(kPage);
    const auto json = nlohmann::json::parse(installed.run("view --json a.obj -o a.html").out);
    EXPECT_EQ(json["schema"], "tspace.view/1");
    EXPECT_EQ(json["files"], nlohmann::json({"a.obj", "bump.png", "folded.mtl"}));
    EXPECT_EQ(json["outputBytes"], installed.folder().read("a.html").size());
}

TEST(ViewCommand, RejectsInputsWithOneLineAndWritesNothing) {
    const Installed installed(kPage);
    installed.folder().write("broken.glb", "glTF");
    installed.folder().write("a.fbx", "Kaydara");
    for (const auto& [arguments, exit_code] : {std::pair("view a.obj", 2),
                                               {"view a.obj -o a.obj", 2},
                                               {"view none.glb -o x.html", 4},
                                               {"view broken.glb -o x.html", 3},
                                               {"view a.fbx -o x.html", 3},
                                               {"view a.obj -o a.obj/x.html", 4}}) {
        const ToolRun run = installed.run(arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << ": " << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_FALSE(fs::exists(installed.folder().path() / "x.html"));
    }
    const ToolRun without = Installed("").run("view a.obj -o x.html");
    EXPECT_EQ(without.exit_code, 4);
    EXPECT_NE(without.err.find("run scripts/web to build it"), std::string::npos) << without.err;
}

}  // namespace
}  // namespace tspace::test
