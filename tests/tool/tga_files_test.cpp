// SPDX-License-Identifier: MIT
// TGA files in the commands that read images: results equal those for a PNG with the same values. glTF does not support
// TGA.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "images/float_image.h"
#include "images/image.h"
#include "images/images.h"
#include "images/tga.h"
#include "run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

std::string textOf(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

/// Tests with a square without tangents, and with normal maps of bumps whose green points down, as PNG and TGA.
class TgaFiles : public testing::Test {
  protected:
    TgaFiles() {
        const RgbImage map = normalMapOf(128, bumps, true);
        folder.write("n.png", pngFile(map));
        folder.write("n.tga", textOf(*encodeTga(map)));
        for (const std::string ending : {"png", "tga"}) {
            folder.write(ending + ".mtl", "newmtl skin\nnorm n." + ending + "\n");
            folder.write(ending + ".obj",
                         "mtllib " + ending +
                             ".mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                             "vn 0 0 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
        }
    }

    /// Returns the names of the findings of a model.
    std::vector<std::string> findingsOf(const std::string& model) {
        const ToolRun run = runTool(folder, "check --json " + model);
        const Json report = Json::parse(run.out);
        std::vector<std::string> names;
        for (const Json& file : report["files"]) {
            for (const Json& finding : file["findings"]) names.push_back(finding["code"].get<std::string>());
        }
        return names;
    }

    const TempFolder folder = {};
};

TEST_F(TgaFiles, BecomeTheSamePngsAndTexturesAsThePng) {
    for (const std::string name : {"n.png", "n.tga"}) {
        const std::string out = name.substr(2);
        EXPECT_EQ(runTool(folder, "convert-map --flip-green " + name + " -o " + out + "1.png").exit_code, 0);
        EXPECT_EQ(runTool(folder, "flip-green " + name + " -o " + out + "2.png").exit_code, 0);
        EXPECT_EQ(runTool(folder, "height-to-normal " + name + " -o " + out + "3.png").exit_code, 0);
        EXPECT_EQ(runTool(folder, "compress-map " + name + " -o " + out + "4.dds").exit_code, 0);
    }
    for (const std::string made : {"1.png", "3.png", "4.dds"})
        EXPECT_EQ(folder.read("png" + made), folder.read("tga" + made)) << made;
    std::string why;
    EXPECT_EQ(decodeImage(bytesOf(folder.read("png2.png")), 1 << 20, why)->rgb,
              decodeImage(bytesOf(folder.read("tga2.png")), 1 << 20, why)->rgb);
}

TEST_F(TgaFiles, OfAnObjAreJudgedAndInvertedIntoAPng) {
    EXPECT_EQ(findingsOf("tga.obj"), findingsOf("png.obj"));
    const std::vector<std::string> found = findingsOf("tga.obj");
    EXPECT_NE(std::find(found.begin(), found.end(), "greenFlipped"), found.end());
    const ToolRun left_out = runTool(folder, "generate tga.obj -o plain.gltf");
    EXPECT_EQ(left_out.exit_code, 0);
    EXPECT_NE(left_out.out.find("'n.tga' was ignored: it is neither PNG nor JPEG"), std::string::npos) << left_out.out;
    EXPECT_EQ(runTool(folder, "generate --flip-green tga.obj -o flipped.glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate --flip-green png.obj -o flipped_png.glb").exit_code, 0);
    EXPECT_EQ(findingsOf("flipped.glb"), findingsOf("flipped_png.glb"));
}

TEST_F(TgaFiles, OfAGltfAreIgnored) {
    ASSERT_EQ(runTool(folder, "generate png.obj -o png.gltf").exit_code, 0);
    std::string gltf = folder.read("png.gltf");
    const std::size_t name = gltf.find("n.png");
    ASSERT_NE(name, std::string::npos);
    gltf.replace(name, 5, "n.tga");
    folder.write("tga.gltf", gltf);
    const std::vector<std::string> found = findingsOf("tga.gltf");
    EXPECT_NE(std::find(found.begin(), found.end(), "normalMapUnreadable"), found.end());
    const ToolRun run = runTool(folder, "check tga.gltf");
    EXPECT_NE(run.out.find("glTF does not allow TGA images"), std::string::npos) << run.out;
    EXPECT_EQ(runTool(folder, "generate tga.gltf -o tga.glb").exit_code, 0);
}

TEST_F(TgaFiles, TruncatedFilesCauseOneLineAndExitCode3) {
    const std::string whole = folder.read("n.tga");
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{17}, std::size_t{18}, std::size_t{1000}, whole.size() - 27}) {
        folder.write("cut.tga", whole.substr(0, size));
        for (const std::string command : {"convert-map --flip-green cut.tga -o o.png", "flip-green cut.tga -o o.png",
                                          "height-to-normal cut.tga -o o.png", "compress-map cut.tga -o o.dds"}) {
            const ToolRun run = runTool(folder, command);
            EXPECT_EQ(run.exit_code, 3) << command;
            EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        }
    }
}

TEST_F(TgaFiles, AreInvertedIntoAPngAndNothingElse) {
    for (const auto& [command, wanted] : {std::pair("flip-green n.tga -o - > out", 3),
                                          {"flip-green --in-place n.tga", 2},
                                          {"flip-green n.tga -o o.jpg", 3}}) {
        const std::string before = folder.read("n.tga");
        EXPECT_EQ(runTool(folder, command).exit_code, wanted) << command;
        EXPECT_EQ(folder.read("n.tga"), before);
    }
}

}  // namespace
}  // namespace tspace::test
