// SPDX-License-Identifier: MIT
// Avatars: a .vrm file is a GLB with another extension.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// An extension in JSON that is formatted unlike the output of any JSON writer, to test that its text is preserved.
constexpr const char* kAvatar =
    R"("VRMC_vrm":{"specVersion":"1.0","expressions":{"preset":{"blink":{"morphTargetBinds":[{"node":0,"index":3,"weight":1.0}]}}},"humanoid":{"humanBones":{}}})";

std::string word(std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
    return bytes;
}

std::uint32_t wordAt(const std::string& bytes, std::size_t place) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[place + i])} << (8 * i);
    return value;
}

std::string jsonOf(const std::string& glb) { return glb.substr(20, wordAt(glb, 12)); }

/// Writes an avatar that lacks tangents, although its material needs them.
void writeAvatar(const TempFolder& folder, const std::string& name) {
    writeFoldedObj(folder, "made/folded.obj");
    folder.write("made/bump.png", kFlatPng);
    ASSERT_EQ(runTool(folder, "generate -q made/folded.obj -o embedded/folded.glb").exit_code, 0);
    const std::string glb = folder.read("embedded/folded.glb");
    auto json = nlohmann::json::parse(jsonOf(glb));
    json["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
    json["extensionsUsed"] = {"VRMC_vrm"};
    std::string text = json.dump();
    text.insert(1, std::string("\"extensions\":{") + kAvatar + "},");
    while (text.size() % 4 != 0) text += ' ';
    const std::string rest = glb.substr(20 + wordAt(glb, 12));
    const auto size = static_cast<std::uint32_t>(text.size());
    folder.write(name, "glTF" + word(2) + word(static_cast<std::uint32_t>(20 + text.size() + rest.size())) +
                           word(size) + "JSON" + text + rest);
}

bool hasTangents(const TempFolder& folder, const std::string& name) {
    return jsonOf(folder.read(name)).find("TANGENT") != std::string::npos;
}

TEST(Vrm, IsFoundInFoldersAndPatternsAndKeepsItsName) {
    const TempFolder folder;
    writeAvatar(folder, "models/a/hero.vrm");
    for (const std::string input : {"models/", "'models/**/*.vrm'"}) {
        const ToolRun run = runTool(folder, "generate " + input + " -o out/");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        ASSERT_TRUE(folder.has("out/a/hero.vrm")) << input;
        EXPECT_TRUE(hasTangents(folder, "out/a/hero.vrm"));
        std::filesystem::remove_all(folder.path("out"));
    }
    EXPECT_NE(runTool(folder, "inspect models/").out.find("hero.vrm"), std::string::npos);
    EXPECT_NE(runTool(folder, "check models/").out.find("hero.vrm"), std::string::npos);
}

TEST(Vrm, IsWrittenInPlaceAndByName) {
    const TempFolder folder;
    writeAvatar(folder, "hero.vrm");
    EXPECT_EQ(runTool(folder, "generate hero.vrm -o named.vrm").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate hero.vrm -o plain.glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate hero.vrm -o unnamed --container glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate hero.vrm -o parts.gltf").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate hero.vrm -o named.vrm --container gltf").exit_code, 2);
    EXPECT_EQ(folder.read("named.vrm"), folder.read("plain.glb"));
    EXPECT_EQ(folder.read("named.vrm"), folder.read("unnamed.vrm"));
    EXPECT_EQ(runTool(folder, "generate --in-place hero.vrm").exit_code, 0);
    EXPECT_EQ(folder.read("hero.vrm"), folder.read("named.vrm"));
    EXPECT_TRUE(hasTangents(folder, "hero.vrm"));
}

TEST(Vrm, ItsExtensionsStayByteForByte) {
    const TempFolder folder;
    writeAvatar(folder, "hero.vrm");
    ASSERT_NE(jsonOf(folder.read("hero.vrm")).find(kAvatar), std::string::npos);
    ASSERT_EQ(runTool(folder, "generate hero.vrm -o out.vrm --overwrite").exit_code, 0);
    EXPECT_NE(jsonOf(folder.read("out.vrm")).find(kAvatar), std::string::npos) << jsonOf(folder.read("out.vrm"));
}

/// VRM 0.x describes materials at the root of the file, with indices of textures. Its readers use only these.
TEST(Vrm, OfVersion0ShowsTheMapThatWasBaked) {
    for (const bool shares_texture : {false, true}) {
        const TempFolder folder;
        writeAvatar(folder, "hero.vrm");
        const std::string glb = folder.read("hero.vrm");
        auto json = nlohmann::json::parse(jsonOf(glb));
        const auto old = json["materials"][0]["normalTexture"]["index"].get<std::size_t>();
        json["extensions"] = nlohmann::json::parse(
            R"({"VRM":{"materialProperties":[{"name":"a","shader":"VRM/MToon","textureProperties":{},"keywordMap":{}}]}})");
        auto& textures = json["extensions"]["VRM"]["materialProperties"][0]["textureProperties"];
        textures["_BumpMap"] = old;
        if (shares_texture) textures["_MainTex"] = old;
        std::string text = json.dump();
        while (text.size() % 4 != 0) text += ' ';
        const std::string rest = glb.substr(20 + wordAt(glb, 12));
        folder.write("hero.vrm", "glTF" + word(2) + word(static_cast<std::uint32_t>(20 + text.size() + rest.size())) +
                                     word(static_cast<std::uint32_t>(text.size())) + "JSON" + text + rest);
        const ToolRun bake = runTool(folder, "bake hero.vrm --high hero.vrm -o map.png --size 16 --out-mesh new.vrm");
        if (bake.err.find("Embree") != std::string::npos) GTEST_SKIP();
        ASSERT_EQ(bake.exit_code, 0) << bake.err;
        const auto after = nlohmann::json::parse(jsonOf(folder.read("new.vrm")));
        const auto& shown = after["extensions"]["VRM"]["materialProperties"][0];
        EXPECT_EQ(shown["textureProperties"]["_BumpMap"], after["materials"][0]["normalTexture"]["index"]);
        EXPECT_EQ(shown["keywordMap"]["_NORMALMAP"], true);
        // A texture that other properties use is preserved.
        if (shares_texture) {
            EXPECT_NE(shown["textureProperties"]["_MainTex"], shown["textureProperties"]["_BumpMap"]);
            EXPECT_EQ(shown["textureProperties"]["_MainTex"], old);
        }
    }
}

TEST(Vrm, IsShownRenderedAndBakedFor) {
    const TempFolder folder;
    writeAvatar(folder, "hero.vrm");
    const ToolRun render = runTool(folder, "render hero.vrm -o hero.png --size 32");
    EXPECT_EQ(render.exit_code, 0) << render.err;
    const ToolRun view = runTool(folder, "view hero.vrm -o hero.html");
    EXPECT_EQ(view.err.find("the page supports"), std::string::npos) << view.err;
    const ToolRun bake = runTool(folder, "bake hero.vrm --high hero.vrm -o map.png --size 16 --out-mesh new.vrm");
    if (bake.err.find("Embree") == std::string::npos) {
        EXPECT_EQ(bake.exit_code, 0) << bake.err;
        EXPECT_NE(jsonOf(folder.read("new.vrm")).find("VRMC_vrm"), std::string::npos);
    }
}

}  // namespace
}  // namespace tspace::test
