// SPDX-License-Identifier: MIT
// tspace bake --maps: file names, their report, and the model that uses them.
#include <nlohmann/json.hpp>

#include "tool/baked_sheets.h"

namespace tspace::test {
namespace {

class BakeMaps : public BakeCommand {
  protected:
    [[nodiscard]] nlohmann::json report(const std::string& arguments) const {
        const ToolRun run = runTool(folder, "bake low.obj --high high.obj --size 16 --json " + arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out, nullptr, false);
    }
    /// Returns the JSON chunk of a GLB.
    [[nodiscard]] nlohmann::json modelIn(const std::string& name) const {
        const std::string bytes = folder.read(name);
        const std::size_t begin = bytes.find('{'), size = static_cast<unsigned char>(bytes[12]) |
                                                          static_cast<unsigned char>(bytes[13]) << 8 |
                                                          static_cast<unsigned char>(bytes[14]) << 16;
        return nlohmann::json::parse(bytes.substr(begin, size), nullptr, false);
    }
    /// Writes a high poly of two objects with a material each. Each object is a sheet over half of the low poly.
    void writeTwoSheets() const {
        folder.write("m.mtl",
                     "newmtl red\nKd 1 0 0\nPr 0.25\nPm 1\nKe 0 0 1\nnewmtl green\nKd 0 1 0\nPr 0.75\nKe 0 0 0\n");
        std::string obj = "mtllib m.mtl\n";
        for (int i = 0; i < 2; ++i) {
            const std::string left = i == 0 ? "0" : "0.5", right = i == 0 ? "0.5" : "1";
            obj += "o part" + std::to_string(i) + "\nusemtl " + (i == 0 ? "red" : "green") + "\n";
            obj += "v " + left + " 0 0\nv " + right + " 0 0\nv " + right + " 1 0\nv " + left + " 1 0\n";
            const int first = 4 * i;
            obj += "f";
            for (int k = 1; k <= 4; ++k) obj += " " + std::to_string(first + k);
            obj += "\n";
        }
        folder.write("two.obj", obj);
    }
};

TEST_F(BakeMaps, AreWrittenNextToTheOutputWhichIsTheNormalMap) {
    const auto json = report(
        "-o out/n.png --maps normal,ao,bent,curvature,height,position,thickness,id,color,orm,emission "
        "--samples 8");
    std::vector<std::string> wanted = {"out/n.png"}, names;
    for (const auto& map : json["files"][0]["maps"]) {
        names.push_back(map["map"]);
        wanted.push_back("out/n_" + names.back() + ".png");
        EXPECT_EQ(map["path"], wanted.back());
        const FloatImage image = imageOf(folder, wanted.back());
        EXPECT_EQ(image.width, 16U);
        EXPECT_EQ(image.bits, map["bits"].get<unsigned>());
    }
    EXPECT_EQ(names.size(), 10U);
    EXPECT_EQ(json["outputFiles"].get<std::vector<std::string>>(), wanted);
    EXPECT_EQ(json["files"][0]["path"], "out/n.png");
    EXPECT_FALSE(json["files"][0]["error"].is_null());
}

TEST_F(BakeMaps, WithoutTheNormalMapItIsNeitherWrittenNorMeasured) {
    const auto json = report("-o n.png --maps ao,height --samples 4");
    EXPECT_EQ(json["outputFiles"], nlohmann::json({"n_ao.png", "n_height.png"}));
    EXPECT_EQ(json["files"][0]["path"], "");
    EXPECT_TRUE(json["files"][0]["error"].is_null());
    EXPECT_FALSE(folder.has("n.png"));
    EXPECT_EQ(runTool(folder, "bake low.obj --high high.obj -o n.png --maps ao --heat h.png").exit_code, 2);
}

TEST_F(BakeMaps, HeightsMatchTheSheetInTheReportedRange) {
    const auto json = report("-o n.png --maps height,position");
    const double range = json["files"][0]["maps"][0]["white"][0];
    EXPECT_NEAR(range, 0.02, 0.001);
    const FloatImage image = imageOf(folder, "n_height.png");
    const FloatImage position = imageOf(folder, "n_position.png");
    const auto& box = json["files"][0]["maps"][1];
    for (std::uint32_t i = 0; i < 256; ++i) {
        const double x = (i % 16 + 0.5) / 16, y = 1 - (i / 16 + 0.5) / 16;
        const double height = 0.02 * std::sin(12 * x) * std::sin(9 * y);
        EXPECT_NEAR((2 * double{image.texels[i].x} - 1) * range, height, 3e-4);
        const double low = box["black"][2], high = box["white"][2];
        EXPECT_NEAR(low + (high - low) * double{position.texels[i].z}, height, 3e-4);
    }
}

TEST_F(BakeMaps, MaterialsAndObjectsAndShellsHaveColorsThatTheReportNames) {
    writeTwoSheets();
    for (const std::string by : {"material", "object", "shell"}) {
        const ToolRun run =
            runTool(folder, "bake low.obj --high two.obj --size 16 --json -o n.png --maps id --id " + by);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const auto map = nlohmann::json::parse(run.out)["files"][0]["maps"][0];
        // The two sheets share an edge, so they are one shell.
        EXPECT_EQ(map["idCount"], by == "shell" ? 1 : 2);
        const FloatImage image = imageOf(folder, "n_id.png");
        EXPECT_EQ(image.texels[0] == image.texels[15], by == "shell");
        if (by == "material") {
            EXPECT_EQ(map["ids"][0]["name"], "red");
            EXPECT_EQ(map["ids"][1]["color"], "#008000");
        }
        if (by == "object") {
            EXPECT_EQ(map["ids"][1]["name"], "part1");
        }
    }
}

TEST_F(BakeMaps, ColorsMetalAndEmissionAreThoseOfTheMaterials) {
    writeTwoSheets();
    ASSERT_EQ(runTool(folder, "generate -q two.obj -o two.glb").exit_code, 0);
    for (const std::string high : {"two.obj", "two.glb"}) {
        const ToolRun run = runTool(
            folder, "bake low.obj --high " + high + " --size 16 -q --fit texel -o n.png --maps color,orm,emission");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const FloatImage color = imageOf(folder, "n_color.png"), orm = imageOf(folder, "n_orm.png"),
                         emission = imageOf(folder, "n_emission.png");
        EXPECT_EQ(color.texels[0], (Vec3{1, 0, 0})) << high;
        EXPECT_EQ(color.texels[15], (Vec3{0, 1, 0})) << high;
        EXPECT_NEAR(orm.texels[0].y, 0.25, 0.002) << high;
        EXPECT_EQ(orm.texels[0].z, 1) << high;
        EXPECT_NEAR(orm.texels[15].y, 0.75, 0.002) << high;
        EXPECT_EQ(orm.texels[15].z, 0) << high;
        EXPECT_EQ(emission.texels[0], (Vec3{0, 0, 1})) << high;
        EXPECT_EQ(emission.texels[15], (Vec3{0, 0, 0})) << high;
    }
}

TEST_F(BakeMaps, TheModelShowsAllOfThem) {
    writeTwoSheets();
    const ToolRun run = runTool(folder,
                                "bake low.obj --high two.obj --size 16 -q -o n.png --samples 4 --out-mesh game.glb "
                                "--maps normal,ao,color,orm,emission,height");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto model = modelIn("game.glb");
    const auto& material = model["materials"][0];
    const auto nameOf = [&](const nlohmann::json& reference) -> std::string {
        return model["images"][model["textures"][reference["index"].get<std::size_t>()]["source"].get<std::size_t>()]
                    ["name"];
    };
    EXPECT_EQ(nameOf(material["normalTexture"]), "n");
    EXPECT_EQ(nameOf(material["pbrMetallicRoughness"]["baseColorTexture"]), "n_color");
    EXPECT_EQ(nameOf(material["pbrMetallicRoughness"]["metallicRoughnessTexture"]), "n_orm");
    EXPECT_EQ(nameOf(material["occlusionTexture"]), "n_orm");
    EXPECT_EQ(nameOf(material["emissiveTexture"]), "n_emission");
    EXPECT_EQ(material["emissiveFactor"], nlohmann::json({1, 1, 1}));
    EXPECT_EQ(model["images"].size(), 4U) << model["images"];
    EXPECT_EQ(runTool(folder, "check -q game.glb").exit_code, 0);
    // Maps that the model does not use are written nevertheless.
    EXPECT_TRUE(folder.has("n_height.png"));
    EXPECT_TRUE(folder.has("n_ao.png"));
    // Bake again with the written model as input: the new maps replace the previous ones.
    ASSERT_EQ(runTool(folder,
                      "bake game.glb --high two.obj --size 16 -q -o n.png --samples 4 --out-mesh again.glb "
                      "--maps normal,ao,color,orm,emission")
                  .exit_code,
              0);
    EXPECT_EQ(modelIn("again.glb")["images"].size(), 4U);
}

TEST_F(BakeMaps, NumbersOfRaysAndNamesOfMapsAreChecked) {
    const std::string common = "bake low.obj --high high.obj -o n.png --maps ";
    EXPECT_EQ(runTool(folder, common + "ao,depth").exit_code, 2);
    EXPECT_EQ(runTool(folder, common + "ao --samples 0").exit_code, 2);
    EXPECT_EQ(runTool(folder, common + "ao --samples 4097").exit_code, 2);
    EXPECT_EQ(runTool(folder, common + "ao --ao-distance -1").exit_code, 2);
    EXPECT_EQ(runTool(folder, common + "height,position --size 16384 --memory-limit 1G").exit_code, 3);
}

TEST_F(BakeMaps, GiveTheSameBytesForAnyNumberOfThreads) {
    const std::string common =
        "bake low.obj --high high.obj -q --size 40 --samples 8 --maps ao,bent,thickness,curvature,color -o ";
    ASSERT_EQ(runTool(folder, common + "1.png --threads 1").exit_code, 0);
    ASSERT_EQ(runTool(folder, common + "2.png --threads 2").exit_code, 0);
    for (const std::string map : {"ao", "bent", "thickness", "curvature", "color"})
        EXPECT_EQ(folder.read("1_" + map + ".png"), folder.read("2_" + map + ".png")) << map;
}

}  // namespace
}  // namespace tspace::test
