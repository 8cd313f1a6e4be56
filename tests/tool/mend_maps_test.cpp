// SPDX-License-Identifier: MIT
// Runs each command that check names for a map. Afterwards no finding may be left, and the normals must be correct.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "images/float_image.h"
#include "images/images.h"
#include "images/textures.h"
#include "maps/texels/shading.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"
#include "tspace/map_files.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

RgbImage soundMap(bool green_down = false) {
    return normalMapOf(
        128, [](double x, double y) { return 2 * bumps(x, y); }, green_down);
}

FloatImage floatsOf(const RgbImage& map) {
    FloatImage image{map.width, map.height, 8, {}, {}};
    for (std::size_t i = 0; i < map.rgb.size(); i += 3)
        image.texels.push_back({map.rgb[i] / 255.0F, map.rgb[i + 1] / 255.0F, map.rgb[i + 2] / 255.0F});
    return image;
}

void writeImage(const TempFolder& folder, const std::string& name, const FloatImage& image) {
    const auto file = encodePng(image, 8);
    ASSERT_TRUE(file);
    folder.write(name, std::string(file->begin(), file->end()));
}

double meanError(const FloatImage& a, const FloatImage& b) {
    double sum = 0;
    if (a.texels.size() != b.texels.size()) return 180;
    for (std::size_t i = 0; i < a.texels.size(); ++i)
        sum += degreesBetween(decodeTexel(a.texels[i], {}), decodeTexel(b.texels[i], {}));
    return sum / static_cast<double>(a.texels.size());
}

/// Writes the model NAME.gltf of a square that uses NAME.png.
void writeSquare(const TempFolder& folder, const std::string& name) {
    folder.write(name + ".mtl", "newmtl a\nnorm " + name + ".png\n");
    folder.write(name + ".obj", "mtllib " + name +
                                    ".mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                    "vn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
    ASSERT_EQ(runTool(folder, "generate -q " + name + ".obj -o " + name + ".gltf").exit_code, 0);
}

struct Kind {
    const char* code;
    const char* options;  ///< options that the remedy names
    const char* others;   ///< options for inverted relief, if both kinds of relief look the same; otherwise null
    Vec3 (*store)(const Vec3& texel);
    float (*alpha)(const Vec3& texel) = nullptr;
};

float curved(float c) {
    return static_cast<float>(c <= 0.0031308F ? 12.92F * c : 1.055 * std::pow(static_cast<double>(c), 1 / 2.4) - 0.055);
}

const Kind kKinds[] = {
    {"normalMapTwoChannels", "--channels rg", nullptr,
     [](const Vec3& t) {
         return Vec3{t.x, t.y, 0};
     }},
    {"normalMapTwoChannels", "--channels rg", nullptr,
     [](const Vec3& t) {
         return Vec3{t.x, t.y, 1};
     }},
    {"normalMapUnsigned", "--channels rg", nullptr,
     [](const Vec3& t) {
         return Vec3{t.x, t.y, 2 * t.z - 1};
     }},
    {"normalMapChannels", "--channels bgr", "--channels BGr",
     [](const Vec3& t) {
         return Vec3{t.z, t.y, t.x};
     }},
    {"normalMapChannels", "--channels brg", "--channels BRg",
     [](const Vec3& t) {
         return Vec3{t.y, t.z, t.x};
     }},
    {"normalMapChannels", "--channels rgB", "--channels RGB",
     [](const Vec3& t) {
         return Vec3{t.x, t.y, 1 - t.z};
     }},
    {"normalMapChannels", "--channels ag", nullptr,
     [](const Vec3& t) {
         return Vec3{1, t.y, 1};
     },
     [](const Vec3& t) { return t.x; }},
    {"normalMapChannels", "--channels ag", nullptr,
     [](const Vec3& t) {
         return Vec3{1, t.y, t.y};
     },
     [](const Vec3& t) { return t.x; }},
    {"normalMapChannels", "--channels ag", nullptr,
     [](const Vec3& t) {
         return Vec3{t.z, t.y, t.z};
     },
     [](const Vec3& t) { return t.x; }},
    {"normalMapIsSrgb", "--srgb", nullptr,
     [](const Vec3& t) {
         return Vec3{curved(t.x), curved(t.y), curved(t.z)};
     }},
};

TEST(FixMaps, RemediesOfCheckFixTheModelAndTheImage) {
    const FloatImage right = floatsOf(soundMap());
    for (const Kind& kind : kKinds) {
        const TempFolder folder;
        FloatImage wrong = right;
        for (std::size_t i = 0; i < right.texels.size(); ++i) {
            wrong.texels[i] = kind.store(right.texels[i]);
            if (kind.alpha != nullptr) wrong.alpha.push_back(kind.alpha(right.texels[i]));
        }
        writeImage(folder, "map.png", wrong);
        writeSquare(folder, "map");
        const std::string old_file = folder.read("map.png");
        const Json found = findingsIn(folder, "map.gltf");
        ASSERT_EQ(found.size(), 1U) << kind.code << found.dump(1);
        EXPECT_EQ(found[0]["code"], kind.code);
        const std::string remedy = found[0]["remedy"];
        EXPECT_NE(remedy.find("tspace generate --fix-maps."), std::string::npos) << remedy;
        const std::string start = "convert-map map.png -o OUT.png ", command = start + kind.options;
        const std::string last = kind.others == nullptr ? command : start + kind.others;
        EXPECT_NE(remedy.find("tspace " + command), std::string::npos) << remedy;
        EXPECT_TRUE(remedy.ends_with("tspace " + last)) << remedy;

        ASSERT_EQ(runTool(folder, "generate --fix-maps map.gltf -o mended.gltf").exit_code, 0);
        EXPECT_EQ(findingsIn(folder, "mended.gltf"), Json::array()) << kind.code;
        EXPECT_LT(meanError(imageIn(folder, "map-mended.png"), right), 1) << kind.code;
        EXPECT_TRUE(folder.read("map.png") == old_file) << "the old one stays";

        ASSERT_EQ(runTool(folder, command).exit_code, 0) << command;
        EXPECT_LT(meanError(imageIn(folder, "OUT.png"), right), 1) << kind.code;
        ASSERT_EQ(runTool(folder, last).exit_code, 0) << last;
        writeSquare(folder, "OUT");
        EXPECT_EQ(findingsIn(folder, "OUT.gltf"), Json::array()) << kind.code;
    }
}

TEST(FixMaps, TexturesBecomePngsWithoutAnExtension) {
    const TempFolder folder;
    const RgbImage map = normalMapOf(64, bumps);
    folder.write("n.png", pngFile(map));
    writeSquare(folder, "n");
    std::string linear(map.rgb.begin(), map.rgb.end());
    Ktx2Parts claims{.format = 29, .width = 64, .height = 64, .levels = {linear}};
    claims.transfer = 2;
    folder.write("two.dds", ddsFile(83, 64, 64, bc5Blocks(map)));
    folder.write("claims.ktx2", ktx2File(claims));
    ASSERT_EQ(runTool(folder, "convert-map -q two.dds -o two.png --channels rg").exit_code, 0);
    const struct {
        const char *extension, *file, *code, *truth;
    } kinds[] = {{"MSFT_texture_dds", "two.dds", "normalMapTwoChannels", "two.png"},
                 {"KHR_texture_basisu", "claims.ktx2", "normalMapIsSrgb", "n.png"}};
    for (const auto& kind : kinds) {
        Json model = Json::parse(folder.read("n.gltf"));
        model["images"][0] = {{"uri", kind.file}};
        model["textures"][0] = {{"extensions", {{kind.extension, {{"source", 0}}}}}};
        model["extensionsUsed"] = model["extensionsRequired"] = {kind.extension};
        folder.write("t.gltf", model.dump());
        const Json findings = findingsIn(folder, "t.gltf");
        ASSERT_FALSE(findings.empty());
        EXPECT_EQ(findings[0]["code"], kind.code);
        EXPECT_NE(findings[0]["remedy"].get<std::string>().find("generate --fix-maps"), std::string::npos);
        const ToolRun run = runTool(folder, "generate t.gltf -o mended.gltf --fix-maps");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const Json mended = Json::parse(folder.read("mended.gltf"));
        EXPECT_EQ(mended["textures"][0], Json({{"source", 0}})) << mended["textures"];
        EXPECT_FALSE(mended.contains("extensionsUsed") || mended.contains("extensionsRequired"));
        const std::string name = mended["images"][0]["uri"];
        EXPECT_EQ(name.substr(name.size() - 11), "-mended.png");
        EXPECT_LT(meanError(imageIn(folder, name), imageIn(folder, kind.truth)), 0.01);
        EXPECT_EQ(findingsIn(folder, "mended.gltf"), Json::array()) << run.out;
    }
}

TEST(FixMaps, FixesExchangedRedAndGreen) {
    const TempFolder folder;
    const FloatImage right = floatsOf(normalMapOf(256, bumpsApart));
    FloatImage wrong = right;
    writeImage(folder, "map.png", right);
    writeSquare(folder, "map");
    EXPECT_EQ(findingsIn(folder, "map.gltf"), Json::array());
    for (Vec3& texel : wrong.texels) std::swap(texel.x, texel.y);
    writeImage(folder, "map.png", wrong);
    const Json found = findingsIn(folder, "map.gltf");
    ASSERT_EQ(found.size(), 1U) << found.dump(1);
    EXPECT_EQ(found[0]["code"], "normalMapChannels");
    const std::string remedy = found[0]["remedy"];
    EXPECT_NE(remedy.find("--channels grb. "), std::string::npos) << remedy;
    EXPECT_TRUE(remedy.ends_with("--channels GRb")) << remedy;
    ASSERT_EQ(runTool(folder, "generate --fix-maps map.gltf -o mended.gltf").exit_code, 0);
    EXPECT_EQ(findingsIn(folder, "mended.gltf"), Json::array());
    EXPECT_LT(meanError(imageIn(folder, "map-mended.png"), right), 1);
}

TEST(FixMaps, ReadsXAndYFromGrayAndAlpha) {
    const FloatImage right = floatsOf(normalMapOf(256, bumpsApart));
    for (const bool is_x_in_alpha : {false, true}) {
        const TempFolder folder;
        FloatImage wrong = right;
        for (Vec3& texel : wrong.texels) {
            wrong.alpha.push_back(is_x_in_alpha ? texel.x : texel.y);
            texel = is_x_in_alpha ? Vec3{texel.y, texel.y, texel.y} : Vec3{texel.x, texel.x, texel.x};
        }
        writeImage(folder, "map.png", wrong);
        writeSquare(folder, "map");
        const Json found = findingsIn(folder, "map.gltf");
        ASSERT_EQ(found.size(), 1U) << found.dump(1);
        const std::string places = is_x_in_alpha ? "x in alpha and y in red" : "x in red and y in alpha";
        EXPECT_NE(found[0]["message"].get<std::string>().find(places), std::string::npos) << found[0]["message"];
        const std::string command = std::string("--channels ") + (is_x_in_alpha ? "ar" : "ra");
        EXPECT_TRUE(found[0]["remedy"].get<std::string>().ends_with(command)) << found[0]["remedy"];
        const ToolRun run = runTool(folder, "generate --fix-maps map.gltf -o mended.gltf");
        EXPECT_NE(run.out.find("the map stored " + places), std::string::npos) << run.out;
        EXPECT_LT(meanError(imageIn(folder, "map-mended.png"), right), 1);
    }
}

TEST(FixMaps, NamesBothOrdersOfGrayAndAlpha) {
    const TempFolder folder;
    const FloatImage right =
        floatsOf(normalMapOf(128, [](double x, double y) { return 0.02 * std::sin(30 * x) * std::sin(30 * y); }));
    FloatImage wrong = right;
    for (Vec3& texel : wrong.texels) {
        wrong.alpha.push_back(texel.x);
        texel = {texel.y, texel.y, texel.y};
    }
    writeImage(folder, "map.png", wrong);
    writeSquare(folder, "map");
    const Json found = findingsIn(folder, "map.gltf");
    ASSERT_EQ(found.size(), 1U) << found.dump(1);
    const std::string remedy = found[0]["remedy"];
    EXPECT_EQ(remedy.find("--fix-maps"), std::string::npos) << remedy;
    for (const std::string letters : {"ra", "ar"}) {
        const std::string command = "convert-map map.png -o OUT.png --channels " + letters;
        EXPECT_NE(remedy.find("tspace " + command + ". "), std::string::npos) << remedy;
        ASSERT_EQ(runTool(folder, command).exit_code, 0);
        EXPECT_EQ(meanError(imageIn(folder, "OUT.png"), right) < 1, letters == "ar");
    }
    const ToolRun run = runTool(folder, "generate --fix-maps map.gltf -o mended.gltf");
    EXPECT_NE(run.out.find("its slopes do not show which of red and alpha is x"), std::string::npos) << run.out;
    EXPECT_EQ(findingsIn(folder, "mended.gltf")[0]["code"], "normalMapChannels");
}

TEST(FixMaps, NamesBothRotationsOfTheVectorsOfARotatedImage) {
    const TempFolder folder;
    const FloatImage right = floatsOf(normalMapOf(256, bumpsApart));
    FloatImage wrong = right;
    for (Vec3& texel : wrong.texels) texel = {texel.y, 1 - texel.x, texel.z};
    writeImage(folder, "map.png", wrong);
    writeSquare(folder, "map");
    const Json found = findingsIn(folder, "map.gltf");
    ASSERT_EQ(found.size(), 1U) << found.dump(1);
    EXPECT_EQ(found[0]["code"], "normalMapChannels");
    const std::string remedy = found[0]["remedy"];
    EXPECT_EQ(remedy.find("--fix-maps"), std::string::npos) << remedy;
    for (const std::string letters : {"Grb", "gRb"}) {
        const std::string command = "convert-map map.png -o OUT.png --channels " + letters;
        EXPECT_NE(remedy.find("tspace " + command + ". "), std::string::npos) << remedy;
        ASSERT_EQ(runTool(folder, command).exit_code, 0);
        EXPECT_EQ(meanError(imageIn(folder, "OUT.png"), right) < 1, letters == "Grb");
        writeSquare(folder, "OUT");
        EXPECT_EQ(findingsIn(folder, "OUT.gltf"), Json::array());
    }
    const ToolRun run = runTool(folder, "generate --fix-maps map.gltf -o mended.gltf");
    EXPECT_NE(run.out.find("rotated by 90 or 270 degrees"), std::string::npos) << run.out;
    EXPECT_EQ(findingsIn(folder, "mended.gltf")[0]["code"], "normalMapChannels");
}

TEST(FixMaps, OneCommandFixesChannelsAndGreen) {
    const TempFolder folder;
    const FloatImage right = floatsOf(soundMap());
    FloatImage wrong = right;
    for (Vec3& texel : wrong.texels) texel = {texel.x, 1 - texel.y, 1};
    writeImage(folder, "map.png", wrong);
    writeSquare(folder, "map");
    const Json found = findingsIn(folder, "map.gltf");
    ASSERT_EQ(found.size(), 2U) << found.dump(1);
    EXPECT_EQ(found[0]["code"], "normalMapTwoChannels");
    EXPECT_EQ(found[1]["code"], "greenFlipped");
    const std::string remedy = found[0]["remedy"];
    EXPECT_NE(remedy.find("tspace generate --fix-maps --flip-green."), std::string::npos) << remedy;
    EXPECT_TRUE(remedy.ends_with("convert-map map.png -o OUT.png --channels rg --flip-green")) << remedy;
    ASSERT_EQ(runTool(folder, "generate --fix-maps --flip-green map.gltf -o mended.gltf").exit_code, 0);
    EXPECT_EQ(findingsIn(folder, "mended.gltf"), Json::array());
    EXPECT_LT(meanError(imageIn(folder, "map-mended.png"), right), 1);
    ASSERT_EQ(runTool(folder, "convert-map map.png -o OUT.png --channels rg --flip-green").exit_code, 0);
    EXPECT_LT(meanError(imageIn(folder, "OUT.png"), right), 1);
}

TEST(FixMaps, ConvertsAMapFromObjectSpace) {
    const TempFolder folder;
    writeImage(folder, "map.png", floatsOf(soundMap()));
    folder.write("map.mtl", "newmtl a\nnorm map.png\n");
    // Almost half of a tube.
    std::string obj = "mtllib map.mtl\nusemtl a\n";
    constexpr int kSteps = 8;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = 3.0 * i / kSteps;
        for (const int y : {0, 2}) {
            obj += "v " + std::to_string(std::sin(angle)) + " " + std::to_string(y) + " " +
                   std::to_string(std::cos(angle)) + "\n";
            obj += "vt " + std::to_string(double(i) / kSteps) + " " + std::to_string(y / 2) + "\n";
            obj += "vn " + std::to_string(std::sin(angle)) + " 0 " + std::to_string(std::cos(angle)) + "\n";
        }
    }
    for (int i = 1; i < 2 * kSteps; i += 2) {
        const auto corner = [](int at) {
            const std::string n = std::to_string(at);
            return " " + n + "/" + n + "/" + n;
        };
        obj += "f" + corner(i) + corner(i + 2) + corner(i + 3) + corner(i + 1) + "\n";
    }
    folder.write("tube.obj", obj);
    ASSERT_EQ(runTool(folder, "generate -q tube.obj -o tube.gltf").exit_code, 0);
    ASSERT_EQ(findingsIn(folder, "tube.gltf"), Json::array());
    const FloatImage right = imageIn(folder, "map.png");
    ASSERT_EQ(runTool(folder, "convert-map map.png --mesh tube.gltf --to object --bits 8 -o object.png").exit_code, 0);
    folder.write("map.png", folder.read("object.png"));
    const Json found = findingsIn(folder, "tube.gltf");
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0]["code"], "normalMapInObjectSpace");
    EXPECT_TRUE(
        found[0]["remedy"].get<std::string>().ends_with("convert-map map.png -o OUT.png --from object --mesh MODEL"));
    ASSERT_EQ(runTool(folder, "generate --fix-maps tube.gltf -o mended.gltf").exit_code, 0);
    EXPECT_EQ(findingsIn(folder, "mended.gltf"), Json::array());
    EXPECT_LT(meanError(imageIn(folder, "map-mended.png"), right), 1);
    ASSERT_EQ(runTool(folder, "convert-map map.png -o OUT.png --from object --mesh tube.gltf").exit_code, 0);
    EXPECT_LT(meanError(imageIn(folder, "OUT.png"), right), 1);
}

TEST(FixMaps, NamesBothCausesOfAnInvertedCurl) {
    for (const bool is_red : {false, true}) {
        const TempFolder folder;
        const FloatImage right = floatsOf(soundMap());
        FloatImage wrong = right;
        for (Vec3& texel : wrong.texels) (is_red ? texel.x : texel.y) = 1 - (is_red ? texel.x : texel.y);
        writeImage(folder, "map.png", wrong);
        writeSquare(folder, "map");
        const Json found = findingsIn(folder, "map.gltf");
        ASSERT_EQ(found.size(), 1U);
        EXPECT_EQ(found[0]["code"], "greenFlipped");
        EXPECT_NE(found[0]["message"].get<std::string>().find("red or green is inverted"), std::string::npos);
        const std::string remedy = found[0]["remedy"];
        EXPECT_NE(remedy.find("tspace generate --flip-green"), std::string::npos);
        EXPECT_NE(remedy.find("tspace convert-map MAP -o OUT.png --flip-red"), std::string::npos);
        ASSERT_EQ(runTool(folder, std::string("convert-map map.png --bits 8 -o OUT.png ") +
                                      (is_red ? "--flip-red" : "--flip-green"))
                      .exit_code,
                  0);
        EXPECT_LT(meanError(imageIn(folder, "OUT.png"), right), .1);
        writeSquare(folder, "OUT");
        EXPECT_EQ(findingsIn(folder, "OUT.gltf"), Json::array());
    }
}

TEST(FixMaps, ReadsWhatTheFileDeclares) {
    const TempFolder folder;
    writeImage(folder, "map.png", floatsOf(soundMap(true)));
    writeSquare(folder, "map");
    EXPECT_EQ(findingsIn(folder, "map.gltf").size(), 1U);
    Json json = Json::parse(folder.read("map.gltf"));
    json["extensionsUsed"] = {"ASOBO_normal_map_convention"};
    json["asset"]["extensions"]["ASOBO_normal_map_convention"]["tangent_space_convention"] = "DirectX";
    folder.write("declared.gltf", json.dump());
    EXPECT_EQ(findingsIn(folder, "declared.gltf"), Json::array());
    const ToolRun run = runTool(folder, "generate --json --flip-green declared.gltf -o out/out.gltf");
    const Json map = Json::parse(run.out)["files"][0]["normalMaps"][0];
    EXPECT_EQ(map["flipped"], false);
    EXPECT_NE(map["reason"].get<std::string>().find("declares"), std::string::npos);
}

TEST(FixMaps, NotesAScaleThatIsNotPositive) {
    for (const double scale : {1.0, 0.0, -1.0}) {
        const TempFolder folder;
        writeImage(folder, "map.png", floatsOf(soundMap()));
        writeSquare(folder, "map");
        Json json = Json::parse(folder.read("map.gltf"));
        json["materials"][0]["normalTexture"]["scale"] = scale;
        folder.write("map.gltf", json.dump());
        const Json found = findingsIn(folder, "map.gltf");
        ASSERT_EQ(found.size(), scale > 0 ? 0U : 1U);
        if (scale <= 0) {
            EXPECT_EQ(found[0]["code"], "normalMapScale");
        }
    }
}

double pictureDifference(const FloatImage& a, const FloatImage& b) {
    double sum = 0;
    if (a.texels.size() != b.texels.size() || a.texels.empty()) return 1;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        sum += std::fabs(a.texels[i].x - b.texels[i].x) + std::fabs(a.texels[i].y - b.texels[i].y) +
               std::fabs(a.texels[i].z - b.texels[i].z);
    }
    return sum / static_cast<double>(a.texels.size());
}

TEST(FixMaps, WithoutImagesRepairKeepsInvertedSignsAndOverwriteReadsNone) {
    const TempFolder folder;
    writeImage(folder, "map.png", floatsOf(soundMap(false)));
    writeSquare(folder, "map");
    ASSERT_EQ(runTool(folder, "generate -q --overwrite --convention opengl map.gltf -o inverted.glb").exit_code, 0);
    const auto actionOf = [&](const std::string& options) {
        const ToolRun done = runTool(folder, "generate --json inverted.glb -o out.glb " + options);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return Json::parse(done.out)["files"][0]["primitives"][0]["action"].get<std::string>();
    };
    EXPECT_EQ(actionOf("--repair"), "replaced");
    EXPECT_EQ(actionOf("--repair --no-images"), "kept");
    EXPECT_EQ(runTool(folder, "generate inverted.glb -o out.glb --no-images --fix-maps").exit_code, 2);
    // With --overwrite, the map is not examined, and a warning says so.
    const ToolRun done = runTool(folder, "generate --json inverted.glb -o out.glb --overwrite");
    EXPECT_NE(done.out.find("Their normal maps were not examined"), std::string::npos) << done.out;
    EXPECT_NE(runTool(folder, "generate inverted.glb -o out.glb --overwrite --no-images")
                  .out.find("--no-images has no effect"),
              std::string::npos);
}

TEST(FixMaps, OverwriteWarnsWhereSignsAndGreenCancel) {
    const TempFolder folder;
    writeImage(folder, "map.png", floatsOf(soundMap(true)));
    writeSquare(folder, "map");
    const auto picture = [&](const std::string& model) {
        EXPECT_EQ(runTool(folder, "render -q " + model + " -o " + model + ".png --size 200").exit_code, 0);
        return imageIn(folder, model + ".png");
    };
    ASSERT_EQ(runTool(folder, "generate -q --overwrite --convention opengl map.gltf -o before.glb").exit_code, 0);
    const FloatImage before = picture("before.glb");
    const Json found = findingsIn(folder, "before.glb");
    EXPECT_EQ(found.size(), 2U) << found.dump(1);
    for (const Json& finding : found) {
        EXPECT_TRUE(finding["remedy"].get<std::string>().ends_with("tspace generate --overwrite --flip-green."))
            << finding["remedy"];
    }
    const auto run = [&](const std::string& arguments) {
        const ToolRun done = runTool(folder, "generate --json before.glb " + arguments);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return Json::parse(done.out)["files"][0]["warnings"];
    };
    const Json warnings = run("-o alone.glb --overwrite");
    ASSERT_EQ(warnings.size(), 1U) << warnings.dump();
    for (const char* text : {"inverted signs", "canceled out", "--flip-green", "omit --overwrite"})
        EXPECT_NE(warnings[0].get<std::string>().find(text), std::string::npos) << warnings[0];
    EXPECT_NE(runTool(folder, "generate before.glb -o alone.glb --overwrite").out.find("canceled out"),
              std::string::npos);
    EXPECT_EQ(run("-o both.glb --overwrite --flip-green"), Json::array());
    EXPECT_LT(pictureDifference(before, picture("both.glb")), 0.002);
    EXPECT_GT(pictureDifference(before, picture("alone.glb")), 0.02);
    EXPECT_EQ(runTool(folder, "check --fail-on note both.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "generate -q --overwrite both.glb -o again.glb").exit_code, 0);
    EXPECT_EQ(
        Json::parse(runTool(folder, "generate --json both.glb -o again.glb --overwrite").out)["files"][0]["warnings"],
        Json::array());
}

}  // namespace
}  // namespace tspace::test
