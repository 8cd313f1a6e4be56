// SPDX-License-Identifier: MIT
// tspace convert-map.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/vec_math.h"
#include "images/float_image.h"
#include "images/images.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// Writes bump.png, and a bent sheet with uneven UVs that uses it: a.glb with tangents of the default method, and b.glb
/// with those of the method flat.
void writeSheet(const TempFolder& folder) {
    folder.write("sheet.mtl", "newmtl skin\nmap_Bump bump.png\n");
    folder.write("a.obj",
                 "mtllib sheet.mtl\no sheet\n"
                 "v 0 0 0\nv 1 0 0\nv 2 0 -1\nv 0 1 0.5\nv 1 1 0\nv 2 1 -1\n"
                 "vn -0.3 -0.1 0.95\nvn 0.3 0 0.95\nvn 0.7 0 0.7\nvn -0.2 0.3 0.93\nvn 0.4 0.1 0.9\nvn 0.7 0.2 0.7\n"
                 "vt 0 0\nvt 0.4 0\nvt 1 0\nvt 0 1\nvt 0.6 1\nvt 1 1\n"
                 "usemtl skin\nf 1/1/1 2/2/2 5/5/5\nf 1/1/1 5/5/5 4/4/4\n"
                 "f 2/2/2 3/3/3 6/6/6\nf 2/2/2 6/6/6 5/5/5\n");
    folder.write("bump.png", pngFile(normalMapOf(32, bumps)));
    for (const std::string arguments :
         {"generate -q a.obj -o a.glb", "generate -q a.glb -o b.glb --overwrite --method flat"}) {
        ASSERT_EQ(runTool(folder, arguments).exit_code, 0);
    }
}

// convert-map also reads models of other formats.
TEST(ConvertMapCommand, FindsTheImporter) {
    const TempFolder folder;
    writeSheet(folder);
    folder.write("sheet.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    if (runTool(folder, "inspect sheet.ply").exit_code != 0) GTEST_SKIP() << "there is no tspace-import";
    const ToolRun run = runTool(folder, "convert-map bump.png --mesh sheet.ply --to object -o object.png");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.err.find("tspace-import"), std::string::npos) << run.err;
}

TEST(ConvertMapCommand, ConvertsAndComesBack) {
    const TempFolder folder;
    writeSheet(folder);
    const ToolRun run = runTool(folder, "convert-map bump.png --mesh a.glb --to-mesh b.glb -o out/b.png");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("bump.png -> out/b.png"), std::string::npos) << run.out;
    const FloatImage before = imageIn(folder, "bump.png"), there = imageIn(folder, "out/b.png");
    EXPECT_EQ(there.bits, 16u);
    EXPECT_TRUE(there.texels != before.texels);
    ASSERT_EQ(runTool(folder, "convert-map -q out/b.png --mesh b.glb --to-mesh a.glb -o back.png").exit_code, 0);
    const FloatImage back = imageIn(folder, "back.png");
    for (std::size_t i = 0; i < back.texels.size(); ++i) {
        EXPECT_NEAR(back.texels[i].x, before.texels[i].x, 5e-5);
        EXPECT_NEAR(back.texels[i].y, before.texels[i].y, 5e-5);
        EXPECT_NEAR(back.texels[i].z, before.texels[i].z, 5e-5);
    }
    ASSERT_EQ(runTool(folder, "convert-map -q bump.png --mesh a.glb --to object -o object.png").exit_code, 0);
    ASSERT_EQ(runTool(folder, "convert-map -q object.png --from object --mesh a.glb -o again.png --bits 8").exit_code,
              0);
    const FloatImage again = imageIn(folder, "again.png");
    for (std::size_t i = 0; i < again.texels.size(); ++i) {
        const auto slope = [](const Vec3& texel) { return (2 * texel.x - 1) / (2 * texel.z - 1); };
        EXPECT_NEAR(slope(again.texels[i]), slope(before.texels[i]), 0.012);
    }
}

TEST(ConvertMapCommand, ChangesNothingForTheSameFrames) {
    const TempFolder folder;
    writeSheet(folder);
    std::filesystem::copy_file(folder.path() / "a.glb", folder.path() / "copy.glb");
    const FloatImage before = imageIn(folder, "bump.png");
    for (const std::string bits : {"8", "16"}) {
        const ToolRun run =
            runTool(folder, "convert-map bump.png --mesh a.glb --to-mesh copy.glb -o same.png --bits " + bits);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("no texel was changed"), std::string::npos) << run.out;
        const FloatImage after = imageIn(folder, "same.png");
        for (std::size_t i = 0; i < before.texels.size(); ++i) EXPECT_EQ(after.texels[i], before.texels[i]);
    }
}

TEST(ConvertMapCommand, InvertsGreenExactly) {
    const TempFolder folder;
    const RgbImage map = normalMapOf(16, bumps);
    folder.write("n.png", pngFile(map));
    for (const std::string how : {"--flip-green", "--from-convention directx", "--to-convention directx",
                                  "--flip-green --from-convention unity --to-convention unity"}) {
        ASSERT_EQ(runTool(folder, "convert-map -q n.png --bits 8 -o f.png " + how).exit_code, 0);
        const FloatImage flipped = imageIn(folder, "f.png");
        for (std::size_t i = 0; i < flipped.texels.size(); ++i) {
            EXPECT_EQ(std::lround(flipped.texels[i].y * 255), 255 - map.rgb[3 * i + 1]) << how;
            EXPECT_EQ(std::lround(flipped.texels[i].x * 255), map.rgb[3 * i]) << how;
            EXPECT_EQ(std::lround(flipped.texels[i].z * 255), map.rgb[3 * i + 2]) << how;
        }
    }
    EXPECT_EQ(runTool(folder, "convert-map -q - -o - --bits 8 < n.png").out.substr(1, 3), "PNG");
}

TEST(ConvertMapCommand, AcceptsBitangentsBeforeOrAfterConventions) {
    const TempFolder folder;
    writeSheet(folder);
    const std::string command = "convert-map -q bump.png --mesh a.glb -o ";
    ASSERT_EQ(runTool(folder, command + "1.png --to-convention three --to-bitangent pixel").exit_code, 0);
    ASSERT_EQ(runTool(folder, command + "2.png --to-bitangent pixel --to-convention three").exit_code, 0);
    ASSERT_EQ(runTool(folder, command + "3.png --to-convention three").exit_code, 0);
    EXPECT_TRUE(folder.read("1.png") == folder.read("2.png"));
    EXPECT_TRUE(folder.read("1.png") != folder.read("3.png"));
}

TEST(ConvertMapCommand, ChoosesTheTrianglesOfAMaterial) {
    const TempFolder folder;
    writeSheet(folder);
    const auto json = [&](const std::string& more) {
        const ToolRun run = runTool(folder, "convert-map --json -o c.png --to object " + more);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return Json::parse(run.out);
    };
    EXPECT_EQ(json("bump.png --mesh a.glb")["from"]["materials"], Json({"skin"}));
    EXPECT_EQ(json("bump.png --mesh a.glb --material skin")["from"]["triangles"], 4);
    const ToolRun none = runTool(folder, "convert-map bump.png --mesh a.glb --to object --material bone -o d.png");
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_NE(none.err.find("bone"), std::string::npos) << none.err;
    EXPECT_EQ(json("bump.png --mesh a.obj")["from"]["tangentsMade"], true);
}

TEST(ConvertMapCommand, TakesTheTrianglesOfATile) {
    const TempFolder folder;
    writeSheet(folder);
    // Copies of the right half: in a model of its own, and with UVs in the tile that is to the right and above.
    const std::string points =
        "v 1 0 0\nv 2 0 -1\nv 1 1 0\nv 2 1 -1\nvn 0.3 0 0.95\nvn 0.7 0 0.7\nvn 0.4 0.1 0.9\nvn 0.7 0.2 0.7\n";
    const std::string uvs = "vt 0.4 0\nvt 1 0\nvt 0.6 1\nvt 1 1\n", moved = "vt 1.4 1\nvt 2 1\nvt 1.6 2\nvt 2 2\n";
    const std::string faces = "f 1/1/1 2/2/2 4/4/4\nf 1/1/1 4/4/4 3/3/3\n";
    folder.write("half.obj", points + uvs + faces);
    folder.write("moved.obj", points + moved + faces);
    folder.write("tiles.obj", points + uvs + faces + points + moved + "f 5/5/5 6/6/6 8/8/8\nf 5/5/5 8/8/8 7/7/7\n");
    for (const std::string space : {"object", "world"}) {
        const std::string to = "convert-map -q bump.png --to " + space;
        ASSERT_EQ(runTool(folder, to + " --mesh half.obj -o 1.png").exit_code, 0);
        ASSERT_EQ(runTool(folder, to + " --mesh tiles.obj --tile 1001 -o 2.png").exit_code, 0);
        EXPECT_TRUE(imageIn(folder, "1.png").texels == imageIn(folder, "2.png").texels);
        ASSERT_EQ(runTool(folder, to + " --mesh moved.obj -o 3.png").exit_code, 0);
        const ToolRun run =
            runTool(folder, "convert-map bump.png --to " + space + " --json --mesh tiles.obj --tile 1012 -o 4.png");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(Json::parse(run.out)["from"]["triangles"], 2);
        EXPECT_TRUE(imageIn(folder, "3.png").texels == imageIn(folder, "4.png").texels);
    }
    const ToolRun none = runTool(folder, "convert-map bump.png --to object --mesh tiles.obj --tile 1002 -o 5.png");
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_NE(none.err.find("tile 1002"), std::string::npos) << none.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "5.png"));
}

/// Writes the model as a .gltf file and changes its JSON by edit(json).
template <class Edit>
void writeEdited(const TempFolder& folder, const std::string& model, const std::string& name, const Edit& edit) {
    ASSERT_EQ(runTool(folder, "generate -q " + model + " -o " + name).exit_code, 0);
    Json json = Json::parse(folder.read(name));
    edit(json);
    folder.write(name, json.dump());
}

DVec3 directionIn(const Vec3& texel) {
    DVec3 direction{2.0 * texel.x - 1, 2.0 * texel.y - 1, 2.0 * texel.z - 1};
    normalize(direction);
    return direction;
}

constexpr double kRounding = 6e-5;  // twice the rounding of 16 bits

TEST(ConvertMapCommand, TransformsWorldSpaceWithTheNodesOfTheMesh) {
    const TempFolder folder;
    writeSheet(folder);
    struct Case {
        Json node;
        std::array<DVec3, 3> rows;  // rows of the matrix from object to world space for normals
    };
    const double c = std::sqrt(0.5);
    const Case cases[] = {
        {{{"rotation", {0, 0, std::sin(std::numbers::pi / 8), std::cos(std::numbers::pi / 8)}},
          {"translation", {3, 4, 5}}},
         {DVec3{c, -c, 0}, {c, c, 0}, {0, 0, 1}}},
        {{{"scale", {-1, 1, 1}}}, {DVec3{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {{{"scale", {7, 7, 7}}}, {DVec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    };
    ASSERT_EQ(runTool(folder, "convert-map -q bump.png --mesh a.glb --to object -o object.png").exit_code, 0);
    const FloatImage bump = imageIn(folder, "bump.png"), object = imageIn(folder, "object.png");
    for (const Case& one : cases) {
        writeEdited(folder, "a.glb", "placed.gltf", [&](Json& json) { json["nodes"][0].update(one.node); });
        const std::string convert = "convert-map -q --mesh placed.gltf -o ";
        ASSERT_EQ(runTool(folder, convert + "world.png bump.png --to world").exit_code, 0);
        ASSERT_EQ(runTool(folder, convert + "turned.png object.png --from object --to world").exit_code, 0);
        ASSERT_EQ(runTool(folder, convert + "back.png world.png --from world").exit_code, 0);
        ASSERT_EQ(runTool(folder, convert + "unturned.png world.png --from world --to object").exit_code, 0);
        const FloatImage world = imageIn(folder, "world.png"), turned = imageIn(folder, "turned.png");
        const FloatImage back = imageIn(folder, "back.png"), unturned = imageIn(folder, "unturned.png");
        for (std::size_t i = 0; i < object.texels.size(); ++i) {
            const DVec3 before = directionIn(object.texels[i]);
            const DVec3 expected{dot(one.rows[0], before), dot(one.rows[1], before), dot(one.rows[2], before)};
            EXPECT_LT(length(directionIn(world.texels[i]) - expected), kRounding);
            EXPECT_LT(length(directionIn(turned.texels[i]) - expected), kRounding);
            EXPECT_LT(length(directionIn(unturned.texels[i]) - before), kRounding);
            EXPECT_LT(length(directionIn(back.texels[i]) - directionIn(bump.texels[i])), kRounding);
        }
    }
}

TEST(ConvertMapCommand, RejectsWorldSpaceForMeshesWithSeveralTransforms) {
    const TempFolder folder;
    writeSheet(folder);
    const auto run_with = [&](const Json& second) {
        writeEdited(folder, "a.glb", "twice.gltf", [&](Json& json) {
            Json node = json["nodes"][0];
            node.update(second);
            json["nodes"].push_back(node);
            json["scenes"][0]["nodes"] = {0, 1};
            json["meshes"][0]["name"] = "Sheet";
        });
        return runTool(folder, "convert-map bump.png --mesh twice.gltf --to world -o world.png");
    };
    EXPECT_EQ(run_with({{"translation", {9, 0, 0}}, {"scale", {2, 2, 2}}}).exit_code, 0);
    std::filesystem::remove(folder.path() / "world.png");
    const ToolRun turned = run_with({{"rotation", {1, 0, 0, 0}}});
    EXPECT_EQ(turned.exit_code, 3);
    EXPECT_NE(turned.err.find("Sheet"), std::string::npos) << turned.err;
    EXPECT_EQ(std::count(turned.err.begin(), turned.err.end(), '\n'), 1) << turned.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "world.png"));
}

TEST(ConvertMapCommand, AppliesTheScaleOfBothMaterials) {
    const TempFolder folder;
    writeSheet(folder);
    const auto scaled = [&](const std::string& model, const std::string& name, double scale) {
        writeEdited(folder, model, name, [&](Json& json) { json["materials"][0]["normalTexture"]["scale"] = scale; });
    };
    scaled("a.glb", "a.gltf", 1.5);
    scaled("b.glb", "b.gltf", 0.75);
    scaled("b.glb", "none.gltf", 0);
    for (const auto& [bits, most] : {std::pair{"16", 1e-4}, std::pair{"8", 0.02}}) {
        const ToolRun run = runTool(
            folder, "convert-map --json bump.png --mesh a.gltf --to-mesh b.gltf -o b.png --bits " + std::string(bits));
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(Json::parse(run.out)["from"]["scale"], 1.5);
        EXPECT_EQ(Json::parse(run.out)["to"]["scale"], 0.75);
        ASSERT_EQ(runTool(folder, "convert-map -q bump.png --mesh a.gltf --to object -o before.png").exit_code, 0);
        ASSERT_EQ(
            runTool(folder, "convert-map -q b.png --mesh b.gltf --material skin --to object -o after.png").exit_code,
            0);
        const FloatImage before = imageIn(folder, "before.png"), after = imageIn(folder, "after.png");
        for (std::size_t i = 0; i < before.texels.size(); ++i)
            EXPECT_LT(length(directionIn(before.texels[i]) - directionIn(after.texels[i])), most) << bits;
    }
    // With the same file on both sides nothing changes, whatever the scale of the map.
    ASSERT_EQ(runTool(folder, "convert-map -q bump.png --mesh a.gltf -o same.png").exit_code, 0);
    EXPECT_TRUE(imageIn(folder, "same.png").texels == imageIn(folder, "bump.png").texels);
    EXPECT_EQ(runTool(folder, "convert-map bump.png --mesh a.gltf --to-mesh none.gltf -o b.png").exit_code, 3);
}

TEST(ConvertMapCommand, WarnsWhenRoundingUndoesTheChange) {
    const TempFolder folder;
    writeSheet(folder);
    ASSERT_EQ(runTool(folder, "generate -q a.obj -o smooth.glb --method best").exit_code, 0);
    const auto json = Json::parse(
        runTool(folder, "convert-map bump.png --mesh a.glb --to-mesh smooth.glb --bits 8 -o c.png --json").out);
    const bool is_small = json["meanChangeDeg"] > 0 && json["meanChangeDeg"] < json["halfStepDeg"];
    EXPECT_EQ(json["belowHalfStep"], is_small && json["changed"] > 0);
    EXPECT_EQ(json["warnings"].dump().find("rounding") != std::string::npos, json["belowHalfStep"] == true);
}

TEST(ConvertMapCommand, ReportsErrorsInOneLine) {
    const TempFolder folder;
    writeSheet(folder);
    folder.write("broken.png", folder.read("bump.png").substr(0, 100));
    folder.write("broken.glb", folder.read("a.glb").substr(0, 200));
    folder.write("text.png", "no image");
    folder.write("no-uvs.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (const auto& [arguments, exit_code] : std::vector<std::pair<std::string, int>>{
             {"bump.png", 2},
             {"bump.png -o bump.png", 2},
             {"bump.png -o b.png --to object", 2},
             {"bump.png -o b.png --from object", 2},
             {"bump.png -o b.png --from object --to world", 2},
             {"bump.png -o b.png --to-mesh a.glb", 2},
             {"bump.png -o b.png --to-convention three", 2},
             {"bump.png -o b.png --bits 12", 2},
             {"bump.png -o b.png --from-convention quake", 2},
             {"bump.png -o b.bmp", 2},
             {"broken.png -o b.png", 3},
             {"text.png -o b.png", 3},
             {"bump.png -o b.png --mesh broken.glb", 3},
             {"bump.png -o b.png --mesh no-uvs.obj", 3},
             {"none.png -o b.png", 4},
             {"bump.png -o b.png --mesh none.glb", 4},
             {"bump.png -o bump.png/b.png", 4},
         }) {
        const ToolRun run = runTool(folder, "convert-map " + arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << "\n" << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << arguments << "\n" << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.png")) << arguments;
    }
    EXPECT_EQ(runTool(folder, "convert-map bump.png --flip-green -o new/b.png --dry-run").exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
    folder.write("large.png", pngFile({2048, 2048, std::vector<std::uint8_t>(2048 * 2048 * 3, 128)}));
    EXPECT_EQ(runTool(folder, "convert-map large.png --flip-green -o b.png --memory-limit 64M").exit_code, 3);
    EXPECT_EQ(runTool(folder, "convert-map -q large.png --flip-green -o b.png").exit_code, 0);
}

}  // namespace
}  // namespace tspace::test
