// SPDX-License-Identifier: MIT
// tspace check --html.
#include "commands/render/drawn.h"
#include "support/temp_folder.h"
#include "tool/run_tool.h"
#include "tspace/version.h"

namespace tspace::test {
namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// Writes a square with a normal map, and a malicious name.
void writeSquare(const TempFolder& folder, const std::string& name, float sign) {
    SquareModel model;
    for (std::size_t i = 3; i < model.tangents.size(); i += 4) model.tangents[i] = sign;
    GltfBuilder builder = model.build();
    builder.json()["meshes"][0]["name"] = "<script>alert('&')</script>";
    builder.json()["materials"][0]["normalTexture"] = {{"index", addTexture(builder, plainImage(128, 200, 220))}};
    folder.write(name, std::span<const std::uint8_t>(builder.glb()));
}
void writeInvertedSquare(const TempFolder& folder, const std::string& name) { writeSquare(folder, name, -1); }

TEST(CheckPage, ShowsEachFindingBeforeAndAfter) {
    const TempFolder folder;
    writeInvertedSquare(folder, "sheet.glb");
    const ToolRun run = runTool(folder, "check sheet.glb --html report.html");
    EXPECT_EQ(run.exit_code, 1);
    const std::string page = folder.read("report.html");
    EXPECT_NE(page.find("signsInverted"), std::string::npos);
    EXPECT_NE(page.find("Fix: "), std::string::npos);
    EXPECT_GE(countOf(page, "src=\"data:image/png;base64,"), 2U);
    EXPECT_EQ(countOf(page, "<figcaption>after tspace generate --repair</figcaption>"), 1U);
    EXPECT_LT(page.size(), 2000000U);
}

TEST(CheckPage, HasThePicturesOfTheJsonReport) {
    const TempFolder folder;
    writeInvertedSquare(folder, "models/a.glb");
    writeSquare(folder, "models/right.glb", 1);
    writeInvertedSquare(folder, "models/z.glb");
    const ToolRun run = runTool(folder, "check models --json --pictures --html report.html");
    const Json document = Json::parse(run.out);
    const std::string page = folder.read("report.html");
    ASSERT_EQ(document["pictures"].size(), 6U) << run.out.substr(0, 2000);
    for (std::size_t i = 0; i < 6; ++i) {
        const Json& picture = document["pictures"][i];
        const std::size_t file = i < 3 ? 0 : 2;
        EXPECT_EQ(picture["file"], file);
        EXPECT_EQ(document["files"][file]["findings"][picture["finding"].get<std::size_t>()]["code"], "signsInverted");
        EXPECT_NE(page.find("data:image/png;base64," + picture["png"].get<std::string>()), std::string::npos) << i;
    }
    EXPECT_EQ(document["pictures"][1]["caption"], "after tspace generate --repair");
    EXPECT_FALSE(Json::parse(runTool(folder, "check models --json").out).contains("pictures"));
    EXPECT_EQ(runTool(folder, "check models --pictures").exit_code, 2);
}

TEST(CheckPage, EscapesTextOfFiles) {
    const TempFolder folder;
    writeInvertedSquare(folder, "a<b>&.glb");
    runTool(folder, "check -q 'a<b>&.glb' --html report.html");
    const std::string page = folder.read("report.html");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;alert(&#39;&amp;&#39;)&lt;/script&gt;"), std::string::npos);
    EXPECT_NE(page.find("a&lt;b&gt;&amp;.glb"), std::string::npos);
    EXPECT_EQ(countOf(page, "http"), 1U) << "nothing is loaded: the only one is that of http-equiv";
}

TEST(CheckPage, StatesItsDateAndCommand) {
    const TempFolder folder;
    writeInvertedSquare(folder, "it's a sheet.glb");
    const std::string arguments = "check -q \"it's a sheet.glb\" --html report.html";
    const auto pageAt = [&](const char* epoch) {
        EXPECT_EQ(runTool(folder, arguments, std::string("SOURCE_DATE_EPOCH=") + epoch).exit_code, 1);
        return folder.read("report.html");
    };
    const std::string page = pageAt("1767225599");
    EXPECT_NE(page.find("tspace " TSPACE_VERSION_STRING ", 2025-12-31 23:59 UTC: <code>tspace check -q "
                        "&#39;it&#39;\\&#39;&#39;s a sheet.glb&#39; --html report.html</code>"),
              std::string::npos)
        << page.substr(0, 4000);
    EXPECT_EQ(pageAt("1767225599"), page) << "the same run gives the same bytes";
    EXPECT_NE(pageAt("1767225600").find(", 2026-01-01 00:00 UTC: "), std::string::npos);
    const ToolRun wrong = runTool(folder, arguments, "SOURCE_DATE_EPOCH=today");
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("SOURCE_DATE_EPOCH"), std::string::npos);
    EXPECT_EQ(runTool(folder, "check -q \"it's a sheet.glb\"", "SOURCE_DATE_EPOCH=today").exit_code, 1)
        << "no page, no date";
}

TEST(CheckPage, SeveralFilesHaveAnOverview) {
    const TempFolder folder;
    writeInvertedSquare(folder, "models/wrong.glb");
    writeSquare(folder, "models/right.glb", 1);
    folder.write("models/broken.glb", std::string("glTF"));
    runTool(folder, "check -q models --html report.html");
    const std::string page = folder.read("report.html");
    EXPECT_EQ(countOf(page, "<a href=\"#file-"), 3U);
    for (const char* id : {"id=\"file-1\"", "id=\"file-2\"", "id=\"file-3\"", "not read", "nothing found"})
        EXPECT_NE(page.find(id), std::string::npos) << id;
    EXPECT_NE(page.find("<div class=\"scroll\" tabindex=\"0\">"), std::string::npos) << "it scrolls by keys too";
}

TEST(CheckPage, ReportsAnUnwritablePage) {
    const TempFolder folder;
    writeInvertedSquare(folder, "sheet.glb");
    const ToolRun run = runTool(folder, "check -q sheet.glb --html sheet.glb/report.html");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(folder.files(), (std::set<std::string>{"sheet.glb"}));
}

}  // namespace
}  // namespace tspace::test
