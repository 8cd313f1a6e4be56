// SPDX-License-Identifier: MIT
// tspace height-to-normal, and height maps of OBJ files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "images/float_image.h"
#include "images/images.h"
#include "maps/texels/shading.h"
#include "run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kSize = 128;

/// Returns heights from 0 to 1 that repeat at the borders.
double hill(double x, double y) {
    return .5 + .25 * std::sin(12.566370614 * x) * std::cos(6.283185307 * y) + .2 * std::cos(12.566370614 * y);
}

void writeHeights(const TempFolder& folder, unsigned bits) {
    FloatImage image{kSize, kSize, bits, {}, {}};
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column) {
            const auto h = static_cast<float>(hill((column + .5) / kSize, 1 - (row + .5) / kSize));
            image.texels.push_back({h, h, h});
        }
    }
    const auto file = encodePng(image, bits);
    ASSERT_TRUE(file);
    folder.write("height.png", std::string(file->begin(), file->end()));
}

/// Writes a square with an edge length of 2 units, whose material has the height map.
void writeWall(const TempFolder& folder) {
    folder.write("wall.mtl", "newmtl a\nmap_bump -bm 0.1 height.png\n");
    folder.write("wall.obj",
                 "mtllib wall.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                 "vn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
}

/// Returns the mean angle, in degrees, between the texels and the normals of the hill. `height`: height of white, in
/// widths of the image.
double errorOf(const std::string& file, double height) {
    std::string why;
    const auto image = decodeFloatImage(bytesOf(file), 1 << 22, why);
    EXPECT_TRUE(image) << why;
    if (!image || image->width != kSize) return 180;
    double sum = 0;
    constexpr double kStep = 1e-4;
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column) {
            const double x = (column + .5) / kSize, y = 1 - (row + .5) / kSize;
            const DVec3 wanted{-height * (hill(x + kStep, y) - hill(x - kStep, y)) / (2 * kStep),
                               -height * (hill(x, y + kStep) - hill(x, y - kStep)) / (2 * kStep), 1};
            sum += degreesBetween(decodeTexel(image->texels[row * kSize + column], {}), wanted);
        }
    }
    return sum / kSize / kSize;
}

TEST(HeightToNormalCommand, MakesANormalMapOfEightAndSixteenBits) {
    for (const unsigned bits : {8U, 16U}) {
        const TempFolder folder;
        writeHeights(folder, bits);
        const ToolRun run =
            runTool(folder, "height-to-normal height.png -o n.png --strength 6.4 --bits " + std::to_string(bits));
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("6.4 texels"), std::string::npos) << run.out;
        EXPECT_LT(errorOf(folder.read("n.png"), 0.05), bits == 8 ? 0.6 : 0.06);
        ASSERT_EQ(runTool(folder, "height-to-normal - -o - --strength 6.4 --bits " + std::to_string(bits) +
                                      " < height.png > piped.png")
                      .exit_code,
                  0);
    }
}

TEST(HeightToNormalCommand, TakesTheStrengthInUnitsOfTheMesh) {
    const TempFolder folder;
    writeHeights(folder, 16);
    writeWall(folder);
    const ToolRun run = runTool(folder, "height-to-normal height.png -o n.png --strength 0.1 --mesh wall.obj");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_LT(errorOf(folder.read("n.png"), 0.05), 0.06);
    ASSERT_EQ(
        runTool(folder, "height-to-normal height.png -o dx.png --strength 0.1 --mesh wall.obj --convention directx")
            .exit_code,
        0);
    EXPECT_GT(errorOf(folder.read("dx.png"), 0.05), 3);
    ASSERT_EQ(runTool(folder, "flip-green dx.png -o up.png").exit_code, 0);
    EXPECT_LT(errorOf(folder.read("up.png"), 0.05), 0.06);
}

TEST(HeightToNormalCommand, ReportsUnusualInputs) {
    const TempFolder folder;
    writeHeights(folder, 8);
    EXPECT_NE(runTool(folder, "height-to-normal height.png -o n.png --strength 1e6").out.find("warning"),
              std::string::npos);
    EXPECT_NE(runTool(folder, "height-to-normal height.png -o n.png --strength 0").out.find("warning"),
              std::string::npos);
    folder.write("color.png", pngFile(normalMapOf(16, bumps)));
    EXPECT_NE(runTool(folder, "height-to-normal color.png -o n.png").out.find("is not gray"), std::string::npos);
    EXPECT_EQ(runTool(folder, "height-to-normal height.png -o n.jpg").exit_code, 2);
    EXPECT_EQ(runTool(folder, "height-to-normal height.png -o n.png --strength x").exit_code, 2);
    EXPECT_EQ(runTool(folder, "height-to-normal none.png -o n.png").exit_code, 4);
}

/// Returns heights that increase by 1/8 m per texel to the right, and by 2 m per texel downward, in one of the
/// encodings of elevation tiles.
std::string terrainPng(bool is_terrarium) {
    RgbImage image{32, 16, {}};
    for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
        const double height = 1234 + 0.125 * (i % image.width) + 2.0 * (i / image.width);
        const auto number =
            static_cast<std::uint32_t>(is_terrarium ? (height + 32768) * 256 + 0.5 : (height + 10000) * 10 + 0.5);
        for (const unsigned shift : {16U, 8U, 0U}) image.rgb.push_back(static_cast<std::uint8_t>(number >> shift));
    }
    return pngFile(image);
}

TEST(HeightToNormalCommand, ReadsTerrainInMeters) {
    const TempFolder folder;
    for (const std::string encoding : {"terrarium", "terrain-rgb"}) {
        folder.write("tile.png", terrainPng(encoding == "terrarium"));
        const ToolRun run =
            runTool(folder, "height-to-normal tile.png -o n.png --clamp --texel-size 2 --json --encoding " + encoding);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(Json::parse(run.out)["warnings"].size(), 0U) << run.out;
        EXPECT_EQ(Json::parse(run.out)["texelSize"], 2);
        std::string why;
        const std::string file = folder.read("n.png");
        const auto image = decodeFloatImage(bytesOf(file), 1 << 20, why);
        ASSERT_TRUE(image) << why;
        // Terrain-RGB has steps of 0.1 m.
        for (const Vec3& texel : image->texels)
            EXPECT_LT(degreesBetween(decodeTexel(texel, {}), {-0.0625, 1, 1}), encoding == "terrarium" ? 0.01 : 2.1);
    }
    const ToolRun plain = runTool(folder, "height-to-normal tile.png -o n.png --encoding terrarium --strength 2");
    EXPECT_EQ(plain.exit_code, 0);
    EXPECT_NE(plain.out.find("set its width with --texel-size"), std::string::npos) << plain.out;
    folder.write("tile.jpg", jpegFile(normalMapOf(16, bumps), 90));
    EXPECT_EQ(runTool(folder, "height-to-normal tile.jpg -o n.png --encoding terrarium").exit_code, 2);
    writeHeights(folder, 16);
    EXPECT_EQ(runTool(folder, "height-to-normal height.png -o n.png --encoding terrarium").exit_code, 2);
    writeWall(folder);
    EXPECT_EQ(runTool(folder, "height-to-normal height.png -o n.png --mesh wall.obj --texel-size 3").exit_code, 2);
    EXPECT_EQ(runTool(folder, "height-to-normal height.png -o n.png --texel-size 0").exit_code, 2);
}

/// Returns the image in the GLB that generate wrote.
std::string normalMapIn(const TempFolder& folder, const std::string& name) {
    const std::string glb = folder.read(name);
    const std::size_t json_size = static_cast<unsigned char>(glb[12]) + 256U * static_cast<unsigned char>(glb[13]);
    const Json json = Json::parse(glb.substr(20, json_size));
    EXPECT_FALSE(json["materials"][0]["normalTexture"].contains("scale"));
    const Json& view = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
    return glb.substr(28 + json_size + view.value("byteOffset", 0U), view["byteLength"].get<std::size_t>());
}

TEST(HeightToNormalCommand, GenerateConvertsMapBumpOfObj) {
    const TempFolder folder;
    writeHeights(folder, 8);
    writeWall(folder);
    const ToolRun check = runTool(folder, "check wall.obj --fail-on warning");
    EXPECT_EQ(check.exit_code, 0) << check.out;
    EXPECT_NE(check.out.find("normalMapIsHeight"), std::string::npos);
    const ToolRun run = runTool(folder, "generate --json wall.obj -o wall.glb");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Json map = Json::parse(run.out)["files"][0]["normalMaps"][0];
    EXPECT_EQ(map["mended"], true);
    EXPECT_NE(map["reason"].get<std::string>().find("was a height map"), std::string::npos);
    EXPECT_LT(errorOf(normalMapIn(folder, "wall.glb"), 0.05), 0.6);
    EXPECT_EQ(runTool(folder, "check wall.glb --fail-on note").exit_code, 0);
    // If map_bump is a normal map, it is used as it is.
    folder.write("height.png", pngFile(normalMapOf(16, bumps)));
    ASSERT_EQ(runTool(folder, "generate -q wall.obj -o own.glb").exit_code, 0);
    EXPECT_NE(folder.read("own.glb").find(R"("uri":"height.png")"), std::string::npos);
}

TEST(HeightToNormalCommand, EachCommandWarnsOfHeightsThatAreNotFinite) {
    if (whyNotRead(ImageFormat::exr) != nullptr) GTEST_SKIP() << "without OpenEXR";
    const TempFolder folder;
    std::vector<float> heights(std::size_t{kSize} * kSize, 0.5F);
    for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = static_cast<float>(hill((i % kSize + .5) / kSize, 1 - (i / kSize + .5) / kSize));
    heights[5] = heights[6] = std::numeric_limits<float>::quiet_NaN();
    folder.write("height.exr", exrFile(kSize, kSize, {{"Y", heights}}));
    writeWall(folder);
    folder.write("wall.mtl", "newmtl a\nmap_bump -bm 0.1 height.exr\n");
    for (const char* command : {"generate wall.obj -o wall.glb", "render wall.obj -o wall.png --show mapped --size 64",
                                "height-to-normal height.exr -o n.png --strength 6", "check wall.obj"}) {
        const ToolRun run = runTool(folder, command);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("2 texels of the image are NaN or infinite"), std::string::npos) << command << "\n"
                                                                                                << run.out;
    }
    EXPECT_LT(errorOf(normalMapIn(folder, "wall.glb"), 0.05), 0.6);
}

/// Heights with a slight tint are still heights. A colored picture is neither a height map nor a normal map.
TEST(HeightToNormalCommand, TreatsMapBumpAsHeightsOnlyIfItIsGray) {
    const TempFolder folder;
    writeWall(folder);
    const auto write = [&](double green, double blue) {
        RgbImage image{64, 64, {}};
        for (int i = 0; i < 64 * 64; ++i) {
            const double light = 255 * hill((i % 64 + .5) / 64, 1 - (i / 64 + .5) / 64);
            for (const double tint : {1.0, green, blue}) image.rgb.push_back(static_cast<std::uint8_t>(tint * light));
        }
        folder.write("height.png", pngFile(image));
    };
    write(0.96, 0.92);
    const ToolRun tinted = runTool(folder, "generate --json wall.obj -o tinted.glb");
    EXPECT_NE(tinted.out.find("was a height map"), std::string::npos) << tinted.out;
    write(0.7, 0.4);
    const ToolRun check = runTool(folder, "check wall.obj");
    EXPECT_NE(check.out.find("normalMapIsPicture"), std::string::npos) << check.out;
    const ToolRun picture = runTool(folder, "generate wall.obj -o picture.glb");
    EXPECT_NE(picture.out.find("the image is a color image"), std::string::npos) << picture.out;
}

/// The picture of the OBJ file equals that of the GLB that generate makes from it.
TEST(HeightToNormalCommand, RenderShowsHeightsAsGenerateConvertsThem) {
    const TempFolder folder;
    writeHeights(folder, 8);
    writeWall(folder);
    ASSERT_EQ(runTool(folder, "generate -q wall.obj -o wall.glb").exit_code, 0);
    for (const char* model : {"wall.obj", "wall.glb"}) {
        const std::string output = std::string(model) + ".png";
        const ToolRun run =
            runTool(folder, "render " + std::string(model) + " -o " + output + " --show mapped --size 64");
        ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
    }
    EXPECT_EQ(folder.read("wall.obj.png"), folder.read("wall.glb.png"));
    folder.write("wall.mtl", "newmtl a\nmap_bump -bm 0 height.png\n");
    ASSERT_EQ(runTool(folder, "render wall.obj -o flat.png --show mapped --size 64").exit_code, 0);
    EXPECT_NE(folder.read("wall.obj.png"), folder.read("flat.png"));
}

}  // namespace
}  // namespace tspace::test
