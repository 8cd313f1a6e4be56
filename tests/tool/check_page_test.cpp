// SPDX-License-Identifier: MIT
// tspace check --html.
#include "support/scene_file.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// A sheet whose signs are inverted; its mesh has a name that means harm.
void writeInverted(const TempFolder& folder, const std::string& name) {
    ModelData data = withTangents(bentSheet(8), Method::mikktspace, 1);
    data.name = "<script>alert('&')</script>";
    writeModel(folder, name, {data});
}

TEST(CheckPage, ShowsEachFindingBeforeAndAfter) {
    const TempFolder folder;
    writeInverted(folder, "sheet.glb");
    const ToolRun run = runTool(folder, "check sheet.glb --html report.html");
    EXPECT_EQ(run.exit_code, 1);
    const std::string page = folder.read("report.html");
    EXPECT_NE(page.find("signsInverted"), std::string::npos);
    EXPECT_NE(page.find("Mend: "), std::string::npos);
    EXPECT_GE(countOf(page, "src=\"data:image/png;base64,"), 2U);
    EXPECT_EQ(countOf(page, "<figcaption>mended</figcaption>"), 1U);
    EXPECT_LT(page.size(), 2000000U);
}

TEST(CheckPage, TextOfFilesIsText) {
    const TempFolder folder;
    writeInverted(folder, "a<b>&.glb");
    runTool(folder, "check -q 'a<b>&.glb' --html report.html");
    const std::string page = folder.read("report.html");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;alert(&#39;&amp;&#39;)&lt;/script&gt;"), std::string::npos);
    EXPECT_NE(page.find("a&lt;b&gt;&amp;.glb"), std::string::npos);
    EXPECT_EQ(countOf(page, "http"), 1U) << "nothing is loaded: the only one is that of http-equiv";
}

TEST(CheckPage, SeveralFilesHaveAnOverview) {
    const TempFolder folder;
    writeInverted(folder, "models/wrong.glb");
    writeModel(folder, "models/right.glb", {withTangents(bentSheet(4), Method::mikktspace)});
    folder.write("models/broken.glb", std::string("glTF"));
    runTool(folder, "check -q models --html report.html");
    const std::string page = folder.read("report.html");
    EXPECT_EQ(countOf(page, "<a href=\"#file-"), 3U);
    for (const char* id : {"id=\"file-1\"", "id=\"file-2\"", "id=\"file-3\"", "not read", "nothing found"})
        EXPECT_NE(page.find(id), std::string::npos) << id;
}

TEST(CheckPage, WhatCannotBeWrittenIsSaid) {
    const TempFolder folder;
    writeInverted(folder, "sheet.glb");
    const ToolRun run = runTool(folder, "check -q sheet.glb --html none/report.html");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(folder.files(), (std::set<std::string>{"sheet.glb"}));
}

}  // namespace
}  // namespace tspace::test
