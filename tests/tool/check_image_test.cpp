// SPDX-License-Identifier: MIT
// tspace check on images that belong to no model.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "images/float_image.h"
#include "images/image.h"
#include "images/images.h"
#include "images/textures.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kMapSide = 256;

/// Returns the image after calling change(texel) with the red, green and blue of each texel.
template <class Change>
RgbImage changed(RgbImage image, const Change& change) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) change(&image.rgb[i]);
    return image;
}

std::string pngWithAlpha(const RgbImage& image, const std::vector<float>& alpha) {
    FloatImage out{image.width, image.height, 8, {}, alpha};
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
        out.texels.push_back({static_cast<float>(image.rgb[i]) / 255.0F, static_cast<float>(image.rgb[i + 1]) / 255.0F,
                              static_cast<float>(image.rgb[i + 2]) / 255.0F});
    const auto file = encodePng(out, 8);
    return file ? std::string(file->begin(), file->end()) : std::string();
}

class CheckImage : public ::testing::Test {
  protected:
    /// Returns the report of check on one image.
    Json check(const std::string& name, const std::string& options = "") {
        const ToolRun run = runTool(folder_, "check --json " + options + " " + name);
        EXPECT_EQ(run.err, "") << name;
        return Json::parse(run.out)["files"][0];
    }
    /// Returns a text such as "warning greenFlipped" for each finding.
    static std::vector<std::string> codes(const Json& report) {
        std::vector<std::string> found;
        for (const Json& finding : report["findings"])
            found.push_back(finding["severity"].get<std::string>() + " " + finding["code"].get<std::string>());
        return found;
    }
    void expectFound(const std::string& name, const RgbImage& image, const std::string& content,
                     const std::vector<std::string>& wanted) {
        folder_.write(name, pngFile(image));
        const Json report = check(name);
        EXPECT_EQ(report["image"]["content"], content) << name;
        EXPECT_EQ(codes(report), wanted) << name << report["findings"];
    }

    TempFolder folder_;
    RgbImage map_ = normalMapOf(kMapSide, bumps);
};

using Codes = std::vector<std::string>;

TEST_F(CheckImage, ReportsTheDirectionOfGreenInEveryFormat) {
    for (const bool is_down : {false, true}) {
        const RgbImage map = normalMapOf(kMapSide, bumps, is_down);
        std::vector<ExrChannel> channels{{"R", {}}, {"G", {}}, {"B", {}}};
        for (std::size_t i = 0; i < map.rgb.size(); ++i)
            channels[i % 3].values.push_back(static_cast<float>(map.rgb[i] / 127.5 - 1));
        std::string rgba;
        for (std::size_t i = 0; i < map.rgb.size(); ++i) {
            rgba += static_cast<char>(map.rgb[i]);
            if (i % 3 == 2) rgba += '\xff';
        }
        folder_.write("n.png", pngFile(map));
        folder_.write("n.jpg", jpegFile(map, 95));
        folder_.write("n.webp", webpFile(map, true));
        folder_.write("n.dds", ddsFile(28, kMapSide, kMapSide, rgba));
        folder_.write("n.ktx2", ktx2File({.format = 37, .width = kMapSide, .height = kMapSide, .levels = {rgba}}));
        ASSERT_EQ(runTool(folder_, "convert-map n.png -q -o n.tga").exit_code, 0);
        Codes names{"n.png", "n.jpg", "n.webp", "n.dds", "n.ktx2", "n.tga"};
        if (whyNotRead(ImageFormat::exr) == nullptr) {
            folder_.write("n.exr", exrFile(kMapSide, kMapSide, channels));
            names.emplace_back("n.exr");
        }
        for (const std::string& name : names) {
            const Json report = check(name);
            EXPECT_EQ(report["image"]["green"], is_down ? "down" : "up") << name;
            EXPECT_EQ(codes(report), is_down ? Codes{"warning greenFlipped"} : Codes{}) << name << report;
            EXPECT_EQ(report["normalMapsWithGreen"], 1);
        }
    }
    const ToolRun run = runTool(folder_, "check n.png");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_NE(run.out.find("green points down, as in DirectX, or red is inverted"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("tspace flip-green n.png -o OUT.png"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("tspace generate"), std::string::npos) << run.out;
    EXPECT_EQ(runTool(folder_, "check n.png --fail-on warning").exit_code, 1);
    ASSERT_EQ(runTool(folder_, "flip-green n.png -q -o OUT.png").exit_code, 0);
    EXPECT_EQ(codes(check("OUT.png")), Codes{});
}

TEST_F(CheckImage, ReportsTheContentOfChannelsAndItsConversion) {
    expectFound("xz.png", changed(map_, [](std::uint8_t* t) { std::swap(t[0], t[2]); }), "exchanged",
                {"warning normalMapChannels"});
    expectFound("srgb.png",
                changed(map_,
                        [](std::uint8_t* t) {
                            for (int i = 0; i < 3; ++i) {
                                const double c = t[i] / 255.0;
                                t[i] = static_cast<std::uint8_t>(
                                    255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055) + 0.5);
                            }
                        }),
                "encoded", {"warning normalMapIsSrgb"});
    expectFound("xy.png", changed(map_, [](std::uint8_t* t) { t[2] = 0; }), "twoChannels",
                {"warning normalMapTwoChannels"});
    for (const std::string name : {"xz.png", "srgb.png", "xy.png"}) {
        const std::string remedy = check(name)["findings"][0]["remedy"];
        EXPECT_EQ(remedy.find("generate"), std::string::npos) << remedy;
        const std::size_t at = remedy.find("tspace convert-map ");
        ASSERT_NE(at, std::string::npos) << remedy;
        // The text after the first full stop is a command for the alternative interpretation.
        const std::string command = remedy.substr(at + 7);
        ASSERT_EQ(runTool(folder_, command.substr(0, command.find(". "))).exit_code, 0) << remedy;
        EXPECT_EQ(codes(check("OUT.png")), Codes{}) << remedy;
    }
    // A DXT5nm map, and then the same map without its alpha channel, which contained x.
    const RgbImage dxt5nm = changed(map_, [](std::uint8_t* t) { t[0] = t[2] = 255; });
    std::vector<float> x;
    for (std::size_t i = 0; i < map_.rgb.size(); i += 3) x.push_back(static_cast<float>(map_.rgb[i]) / 255.0F);
    folder_.write("dxt5nm.png", pngWithAlpha(dxt5nm, x));
    EXPECT_EQ(codes(check("dxt5nm.png")), Codes{"warning normalMapChannels"});
    expectFound("lost.png", dxt5nm, "picture", {"warning normalMapIsPicture"});
    EXPECT_NE(check("lost.png").dump().find("x in alpha (DXT5nm)"), std::string::npos);
    folder_.write("bc5.dds", ddsFile(83, kMapSide, kMapSide, bc5Blocks(map_)));
    EXPECT_EQ(codes(check("bc5.dds")), Codes{"note normalMapTwoChannels"}) << "that is what BC5 is for";
}

TEST_F(CheckImage, RemediesOfInvertedGreenConvertTheChannelsToo) {
    const RgbImage down = normalMapOf(kMapSide, bumps, true);
    std::vector<float> x;
    for (std::size_t i = 0; i < down.rgb.size(); i += 3) x.push_back(static_cast<float>(down.rgb[i]) / 255.0F);
    folder_.write("alpha.png", pngWithAlpha(changed(down, [](std::uint8_t* t) { t[0] = t[2] = 255; }), x));
    folder_.write("bgr.png", pngFile(changed(down, [](std::uint8_t* t) { std::swap(t[0], t[2]); })));
    folder_.write("z.png",
                  pngFile(changed(down, [](std::uint8_t* t) { t[2] = static_cast<std::uint8_t>(255 - t[2]); })));
    for (const std::string name : {"alpha.png", "bgr.png", "z.png"}) {
        const Json report = check(name);
        EXPECT_EQ(codes(report), (Codes{"warning normalMapChannels", "warning greenFlipped"})) << name;
        for (const Json& finding : report["findings"]) {
            std::string rest = finding["remedy"];
            int commands = 0;
            for (std::size_t at; (at = rest.find("tspace ")) != std::string::npos; ++commands) {
                rest.erase(0, at + 7);
                ASSERT_EQ(runTool(folder_, rest.substr(0, rest.find(". "))).exit_code, 0) << rest;
                EXPECT_EQ(codes(check("OUT.png")), Codes{}) << finding;
            }
            EXPECT_GT(commands, 0) << finding;
        }
    }
}

TEST_F(CheckImage, ReportsImagesThatAreNotNormalMaps) {
    RgbImage height{kMapSide, kMapSide, {}}, around{kMapSide, kMapSide, {}};
    for (std::uint32_t i = 0; i < kMapSide * kMapSide; ++i) {
        const double u = (i % kMapSide + 0.5) / kMapSide, v = (i / kMapSide + 0.5) / kMapSide;
        height.rgb.insert(height.rgb.end(), 3, static_cast<std::uint8_t>(128 + 1000 * bumps(u, v)));
        const double a = 6.2831853 * u, h = std::cos(3.1415927 * v), r = std::sin(3.1415927 * v);
        for (const double part : {r * std::cos(a), h, r * std::sin(a)})
            around.rgb.push_back(static_cast<std::uint8_t>(127.5 * part + 128));
    }
    expectFound("height.png", height, "height", {"warning normalMapIsHeight"});
    expectFound("object.png", around, "objectSpace", {"warning normalMapInObjectSpace"});
    // Flow and anisotropy maps: unit vectors in the surface.
    for (const std::uint8_t blue : {0, 128, 255}) {
        RgbImage flow{kMapSide, kMapSide, {}};
        for (std::uint32_t i = 0; i < kMapSide * kMapSide; ++i) {
            const double a = 9.0 * (i % kMapSide) / kMapSide + std::sin(7.0 * (i / kMapSide) / kMapSide);
            for (const double part : {std::cos(a), std::sin(a)})
                flow.rgb.push_back(static_cast<std::uint8_t>(127.5 * part + 128));
            flow.rgb.push_back(blue);
        }
        expectFound("flow.png", flow, "picture", {"warning normalMapIsPicture"});
        EXPECT_NE(check("flow.png").dump().find("flow or anisotropy map"), std::string::npos);
    }
    expectFound("flat.png", changed(map_, [](std::uint8_t* t) { t[0] = t[1] = 128, t[2] = 255; }), "constant",
                {"note normalMapConstant"});
    expectFound("white.png", changed(map_, [](std::uint8_t* t) { t[0] = t[1] = t[2] = 255; }), "constant",
                {"warning normalMapConstant"});
}

TEST_F(CheckImage, ReportsSmallDeviations) {
    expectFound("short.png",
                changed(map_,
                        [](std::uint8_t* t) {
                            for (int i = 0; i < 3; ++i)
                                t[i] = static_cast<std::uint8_t>(127.5 + 0.8 * (t[i] - 127.5) + 0.5);
                        }),
                "normals", {"note normalMapLengths"});
    RgbImage zero = map_;
    for (std::size_t i = 0; i < zero.rgb.size() / 4; i += 3) zero.rgb[i] = zero.rgb[i + 1] = 127, zero.rgb[i + 2] = 255;
    expectFound("zero.png", zero, "normals", {"note normalMapZero"});
}

TEST_F(CheckImage, WorksWithModelsPipesAndPages) {
    folder_.write("n.png", pngFile(normalMapOf(kMapSide, bumps, true)));
    writeFoldedObj(folder_, "folded.obj");
    writeBumpMap(folder_);
    const Json report =
        Json::parse(runTool(folder_, "check --json --html p.html --sarif s.sarif n.png folded.obj").out);
    EXPECT_EQ(report["files"][0]["image"]["green"], "down");
    EXPECT_TRUE(report["files"][1]["image"].is_null());
    EXPECT_NE(folder_.read("p.html").find("green points down"), std::string::npos);
    EXPECT_NE(folder_.read("s.sarif").find("greenFlipped"), std::string::npos);
    EXPECT_NE(runTool(folder_, "check - < n.png").out.find("green points down"), std::string::npos);
    folder_.write("broken.png", folder_.read("n.png").substr(0, 60));
    EXPECT_EQ(runTool(folder_, "check broken.png").exit_code, 3);
    EXPECT_EQ(runTool(folder_, "check none.png").exit_code, 4);
    // A file of a few bytes that declares 4096 x 4096 texels.
    Ktx2Parts parts{.format = 37, .width = 4096, .height = 4096, .levels = {zstdOf(std::string(1 << 26, '\x80'))}};
    parts.unpacked = {std::uint64_t{1} << 26};
    parts.scheme = 2;
    folder_.write("large.ktx2", ktx2File(parts));
    const ToolRun large = runTool(folder_, "check large.ktx2");
    EXPECT_EQ(large.exit_code, 3);
    EXPECT_NE(large.err.find("use --memory-limit to raise it"), std::string::npos) << large.err;
}

TEST_F(CheckImage, FindsImagesInFoldersWithoutModels) {
    const RgbImage down = normalMapOf(kMapSide, bumps, true);
    RgbImage picture = map_, gray = map_;
    for (std::size_t i = 0; i < map_.rgb.size(); ++i) {
        const std::size_t texel = i / 3;
        picture.rgb[i] = static_cast<std::uint8_t>(i % 3 == 0 ? 40 + texel % 90 : i % 3 == 1 ? 20 + texel / 900 : 9);
        gray.rgb[i] = map_.rgb[3 * texel];
    }
    folder_.write("textures/wall.png", pngFile(down));
    folder_.write("textures/deep/floor.png", pngFile(map_));
    folder_.write("textures/wood_color.png", pngFile(picture));
    folder_.write("textures/roughness.png", pngFile(gray));
    folder_.write("textures/wood_N.png", pngFile(picture));
    folder_.write("textures/readme.txt", "");
    for (const std::string input : {"textures", "'textures/**/*.png'"}) {
        const ToolRun run = runTool(folder_, "check --json " + input);
        EXPECT_EQ(run.err, "");
        std::map<std::string, Codes> found;
        const Json report = Json::parse(run.out);
        for (const Json& file : report["files"])
            found[std::filesystem::path(file["input"].get<std::string>()).filename().string()] = codes(file);
        const std::map<std::string, Codes> wanted{{"floor.png", {}},
                                                  {"roughness.png", {}},
                                                  {"wall.png", {"warning greenFlipped"}},
                                                  {"wood_N.png", {"warning normalMapIsPicture"}},
                                                  {"wood_color.png", {}}};
        EXPECT_EQ(found, wanted) << input << report;
    }
    // An image that is named explicitly is always checked.
    EXPECT_EQ(codes(check("textures/wood_color.png")).size(), 1U);
    EXPECT_NE(runTool(folder_, "check textures").out.find("not a normal map"), std::string::npos);
    folder_.write("empty/readme.txt", "");
    const ToolRun empty = runTool(folder_, "check empty");
    EXPECT_EQ(empty.exit_code, 3);
    EXPECT_NE(empty.err.find("this folder contains no model files and no images"), std::string::npos) << empty.err;
    // Other commands require models, and images are ignored in a folder that contains a model.
    EXPECT_EQ(runTool(folder_, "inspect textures").exit_code, 3);
    writeFoldedObj(folder_, "textures/folded.obj");
    EXPECT_EQ(Json::parse(runTool(folder_, "check --json textures").out)["files"].size(), 1U);
}

}  // namespace
}  // namespace tspace::test
