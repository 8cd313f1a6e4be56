// SPDX-License-Identifier: MIT
// tspace flip-green, and generate --flip-green.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "images/image.h"
#include "images/images.h"
#include "run_tool.h"

namespace tspace::test {
namespace {

std::vector<std::uint8_t> pixelsOf(const std::string& file) {
    std::string why;
    const std::optional<RgbImage> image = decodeImage(bytesOf(file), 1 << 22, why);
    return image ? image->rgb : std::vector<std::uint8_t>{};
}

std::vector<std::uint8_t> invertedGreen(std::vector<std::uint8_t> pixels) {
    for (std::size_t i = 1; i < pixels.size(); i += 3) pixels[i] ^= 0xff;
    return pixels;
}

TEST(FlipGreenCommand, InvertsAnImage) {
    const TempFolder folder;
    const RgbImage map = normalMapOf(16, bumps);
    folder.write("n.png", pngFile(map));
    const ToolRun run = runTool(folder, "flip-green n.png -o out/gl.png");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("n.png -> out/gl.png"), std::string::npos);
    EXPECT_NE(run.out.find("PNG, 16 x 16, 8 bits"), std::string::npos) << run.out;
    EXPECT_EQ(pixelsOf(folder.read("out/gl.png")), invertedGreen(map.rgb));
    EXPECT_EQ(runTool(folder, "flip-green --quiet --in-place out/gl.png").out, "");
    EXPECT_EQ(pixelsOf(folder.read("out/gl.png")), map.rgb);
}

TEST(FlipGreenCommand, WarnsThatAJpegIsCompressedOnceMore) {
    const TempFolder folder;
    folder.write("n.jpg", jpegFile(normalMapOf(16, bumps), 90));
    EXPECT_NE(runTool(folder, "flip-green n.jpg -o b.jpg").out.find("warning"), std::string::npos);
    EXPECT_EQ(runTool(folder, "flip-green n.jpg -o b.png").out.find("warning"), std::string::npos);
}

TEST(FlipGreenCommand, PrintsJson) {
    const TempFolder folder;
    folder.write("n.png", pngFile(normalMapOf(16, bumps)));
    const auto json = nlohmann::json::parse(runTool(folder, "flip-green --json n.png -o b.png").out);
    EXPECT_EQ(json["schema"], "tspace.flip-green/1");
    EXPECT_EQ(json["exact"], true);
    EXPECT_EQ(json["bits"], 8);
    const auto failed = nlohmann::json::parse(runTool(folder, "flip-green --json none.png -o b.png").out);
    EXPECT_EQ(failed["error"]["code"], "cannotRead");
    EXPECT_EQ(failed["exitCode"], 4);
}

TEST(FlipGreenCommand, ReadsAndWritesPipes) {
    const TempFolder folder;
    folder.write("n.png", pngFile(normalMapOf(16, bumps)));
    folder.write("n.jpg", jpegFile(normalMapOf(16, bumps), 90));
    for (const std::string name : {"n.png", "n.jpg"}) {
        ASSERT_EQ(runTool(folder, "flip-green -q " + name + " -o out/" + name).exit_code, 0);
        const std::string expected = folder.read("out/" + name);
        const ToolRun run = runTool(folder, "flip-green - -o - < " + name);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.out, expected) << name;
        EXPECT_NE(run.err.find("- -> -"), std::string::npos) << "the report goes to stderr\n" << run.err;
        EXPECT_EQ(runTool(folder, "flip-green -q -o - " + name).out, expected);
        EXPECT_EQ(runTool(folder, "flip-green -q - -o piped-" + name, "cat " + name + " |").exit_code, 0);
        EXPECT_EQ(folder.read("piped-" + name), expected);
    }
    const ToolRun json = runTool(folder, "flip-green --json - -o - < n.png");
    EXPECT_EQ(json.out, folder.read("out/n.png"));
    EXPECT_EQ(nlohmann::json::parse(json.err)["output"], "-");
    for (const auto& [arguments, exit_code, says] :
         {std::tuple("flip-green - -o - < /dev/null", 3, "standard input is empty"),
          {"flip-green - -o - < made.txt", 3, "neither PNG, JPEG, WebP, EXR, KTX2, DDS nor TGA"},
          {"flip-green - --in-place < n.png", 2, "standard input"}}) {
        folder.write("made.txt", "text");
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
        EXPECT_EQ(run.out, "");
    }
    const ToolRun full = runTool(folder, "flip-green n.png -o -", kIntoFullDisk);
    EXPECT_EQ(full.exit_code, 4);
    EXPECT_NE(full.err.find("cannot write standard output: No space left on device"), std::string::npos) << full.err;
}

TEST(FlipGreenCommand, WritesNothingInADryRun) {
    const TempFolder folder;
    const std::string png = pngFile(normalMapOf(16, bumps));
    folder.write("n.png", png);
    const std::set<std::string> before = folder.files();
    const ToolRun run = runTool(folder, "flip-green --dry-run n.png -o new/b.png");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("n.png -> new/b.png (not written)"), std::string::npos) << run.out;
    EXPECT_EQ(runTool(folder, "flip-green --dry-run --in-place n.png").exit_code, 0);
    EXPECT_EQ(runTool(folder, "flip-green --dry-run -q n.png -o -").out, "");
    EXPECT_EQ(runTool(folder, "flip-green --dry-run n.png -o b.tga").exit_code, 2) << "it says what would go wrong";
    EXPECT_EQ(nlohmann::json::parse(runTool(folder, "flip-green --json --dry-run n.png -o b.png").out)["dryRun"], true);
    EXPECT_EQ(folder.files(), before);
    EXPECT_EQ(folder.read("n.png"), png);
}

TEST(FlipGreenCommand, RejectsInputsWithOneLineAndWritesNothing) {
    const TempFolder folder;
    const std::string png = pngFile(normalMapOf(16, bumps));
    folder.write("n.png", png);
    folder.write("broken.png", png.substr(0, png.size() / 2));
    folder.write("text.png", "not an image");
    const std::set<std::string> before = folder.files();
    const std::pair<const char*, int> cases[] = {
        {"flip-green n.png", 2},
        {"flip-green n.png -o n.png", 2},
        {"flip-green n.png -o ./n.png", 2},
        {"flip-green n.png --in-place -o b.png", 2},
        {"flip-green n.png -o b.jpg", 2},
        {"flip-green n.png -o b.tga", 2},
        {"flip-green broken.png -o b.png", 3},
        {"flip-green broken.png --in-place", 3},
        {"flip-green text.png -o b.png", 3},
        {"flip-green none.png -o b.png", 4},
        {"flip-green n.png -o n.png/b.png", 4},
    };
    for (const auto& [arguments, exit_code] : cases) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << ": " << run.err;
        EXPECT_EQ(run.errorLines(), 1) << arguments << ": " << run.err;
        EXPECT_EQ(run.out, "") << arguments;
    }
    EXPECT_EQ(folder.files(), before);
    EXPECT_EQ(folder.read("n.png"), png);
}

TEST(FlipGreenCommand, FixesAModelWithTheCommandOfCheck) {
    const TempFolder folder;
    folder.write("m.mtl", "newmtl a\nnorm n.png\n");
    folder.write("n.png", pngFile(normalMapOf(256, bumps, true)));
    folder.write("a.obj",
                 "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                 "usemtl a\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
    ASSERT_EQ(runTool(folder, "generate a.obj -o a.glb").exit_code, 0);
    const ToolRun found = runTool(folder, "check --fail-on warning a.glb");
    EXPECT_EQ(found.exit_code, 1);
    EXPECT_NE(found.out.find("tspace generate --flip-green"), std::string::npos) << found.out;
    const ToolRun mended = runTool(folder, "generate --flip-green a.glb -o b.glb");
    EXPECT_EQ(mended.exit_code, 0) << mended.err;
    EXPECT_NE(mended.out.find("green inverted"), std::string::npos) << mended.out;
    EXPECT_EQ(runTool(folder, "check --fail-on note b.glb").exit_code, 0);
    const auto json = nlohmann::json::parse(runTool(folder, "generate --json --flip-green b.glb -o c.glb").out);
    EXPECT_EQ(json["files"][0]["normalMaps"][0]["flipped"], false);
    EXPECT_EQ(folder.read("b.glb"), folder.read("c.glb"));
}

}  // namespace
}  // namespace tspace::test
