// SPDX-License-Identifier: MIT
// tspace diff --html.
#include "commands/render/drawn.h"
#include "support/temp_folder.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

void writePlainSquare(const TempFolder& folder, const std::string& name, float sign) {
    SquareModel model;
    for (std::size_t i = 3; i < model.tangents.size(); i += 4) model.tangents[i] = sign;
    GltfBuilder builder = model.build();
    builder.json()["meshes"][0]["name"] = "<script>alert('&')</script>";
    folder.write(name, std::span<const std::uint8_t>(builder.glb()));
}

std::size_t pictureCount(const std::string& page) {
    std::size_t count = 0;
    const std::string part = "src=\"data:image/png;base64,";
    for (std::size_t at = page.find(part); at != std::string::npos; at = page.find(part, at + 1)) ++count;
    return count;
}

TEST(DiffPage, ShowsAnglesAndTheWorstPlaces) {
    const TempFolder folder;
    writePlainSquare(folder, "a.glb", 1);
    writePlainSquare(folder, "b.glb", -1);
    const ToolRun plain = runTool(folder, "diff a.glb b.glb");
    const ToolRun run = runTool(folder, "diff a.glb b.glb --html report.html");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.out, plain.out) << "the text is that of the run without a page";
    const std::string page = folder.read("report.html");
    const std::string summary = plain.out.substr(0, plain.out.find('\n'));
    EXPECT_NE(page.find(summary), std::string::npos);
    EXPECT_NE(page.find("<th>T median</th>"), std::string::npos);
    EXPECT_EQ(pictureCount(page), 2U + 3 * 4) << "the heat map from two sides, and three pictures of each vertex";
    EXPECT_LT(page.size(), 2000000U);
    EXPECT_EQ(page.find("<div class=\"scroll\">"), std::string::npos) << "wide tables scroll by keys too";
}

TEST(DiffPage, EscapesTextOfFilesAndLoadsNothing) {
    const TempFolder folder;
    writePlainSquare(folder, "a<b>&.glb", 1);
    runTool(folder, "diff -q 'a<b>&.glb' 'a<b>&.glb' --html report.html");
    const std::string page = folder.read("report.html");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;alert(&#39;&amp;&#39;)&lt;/script&gt;"), std::string::npos);
    EXPECT_NE(page.find("a&lt;b&gt;&amp;.glb"), std::string::npos);
    EXPECT_EQ(page.find("http"), page.rfind("http")) << "the only one is that of http-equiv";
}

TEST(DiffPage, EqualModelsHaveNoWorstPlaces) {
    const TempFolder folder;
    writePlainSquare(folder, "a.glb", 1);
    const ToolRun run = runTool(folder, "diff -q a.glb a.glb --html report.html");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(pictureCount(folder.read("report.html")), 2U);
}

TEST(DiffPage, IsNotWrittenForUnreadableFiles) {
    const TempFolder folder;
    writePlainSquare(folder, "a.glb", 1);
    folder.write("broken.glb", std::string("glTF"));
    for (const auto& [command, code] : {std::pair<const char*, int>{"diff a.glb none.glb --html report.html", 4},
                                        {"diff broken.glb a.glb --html report.html", 3},
                                        {"diff a.glb a.glb --html a.glb/report.html", 4},
                                        {"diff a.glb a.glb --html", 2}}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_EQ(run.exit_code, code) << command;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_EQ(folder.files(), (std::set<std::string>{"a.glb", "broken.glb"})) << command;
    }
}

}  // namespace
}  // namespace tspace::test
