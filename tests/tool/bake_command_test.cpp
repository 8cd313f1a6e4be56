// SPDX-License-Identifier: MIT
// tspace bake.
#include "tool/baked_sheets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace tspace::test {
namespace {

TEST_F(BakeCommand, WritesAMapThatShowsTheHighPoly) {
    const ToolRun run = runTool(folder,
                                "bake low.obj --high high.obj -o out/normal.png --size 64 --bits 16 --report r.json "
                                "--misses misses.png --heat heat.png");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("error"), std::string::npos) << run.out;
    const FloatImage map = imageOf(folder, "out/normal.png");
    ASSERT_EQ(map.width, 64U);
    EXPECT_EQ(map.bits, 16U);
    // Slope of the bumps at the center of a texel. y points up, against v.
    const double x = 20.5 / 64, y = 1 - 40.5 / 64;
    const double slope_x = 0.02 * 12 * std::cos(12 * x) * std::sin(9 * y),
                 slope_y = 0.02 * 9 * std::sin(12 * x) * std::cos(9 * y);
    const Vec3& texel = map.texels[40 * 64 + 20];
    const double z = 2.0 * texel.z - 1;
    EXPECT_NEAR((2.0 * texel.x - 1) / z, -slope_x, 0.02);
    EXPECT_NEAR((2.0 * texel.y - 1) / z, -slope_y, 0.02);
    const auto json = nlohmann::json::parse(folder.read("r.json"));
    EXPECT_EQ(json["schema"], "tspace.bake/1");
    EXPECT_LT(json["files"][0]["error"]["meanDeg"], 0.3);
    EXPECT_EQ(json["files"][0]["texels"]["missed"], 0);
    EXPECT_EQ(json["framesMade"], true);
    EXPECT_EQ(imageOf(folder, "misses.png").width, 64U);
    EXPECT_EQ(imageOf(folder, "heat.png").width, 64U);
}

/// Returns a flat sheet whose vertices have random heights, uniformly distributed up to a fifth of a cell above and
/// below.
std::string noisySheet(int cells) {
    std::uint32_t state = 1;
    std::string text;
    for (int i = 0; i < (cells + 1) * (cells + 1); ++i) {
        state = state * 1664525u + 1013904223u;
        const double off = 0.4 * ((state >> 8) * (1.0 / (1 << 24)) - 0.5) / cells;
        text += "v " + std::to_string(static_cast<double>(i % (cells + 1)) / cells) + " " +
                std::to_string(static_cast<double>(i / (cells + 1)) / cells) + " " + std::to_string(off) + "\n";
    }
    const std::string flat = sheet(cells, 0, false);
    return text + flat.substr(flat.find("s 1\n"));
}

/// Returns the mean square of x and y over the texels of a map. For a map of a flat surface this is its noise.
double leanOf(const FloatImage& map) {
    double sum = 0;
    for (const Vec3& texel : map.texels) {
        const double x = 2.0 * texel.x - 1, y = 2.0 * texel.y - 1;
        sum += x * x + y * y;
    }
    return sum / static_cast<double>(map.texels.size());
}

TEST_F(BakeCommand, DenoisesPositionsOnRequest) {
    folder.write("high.obj", noisySheet(80));
    const std::string common = "bake low.obj --high high.obj --size 64 --report r.json -q -o ";
    ASSERT_EQ(runTool(folder, common + "noisy.png").exit_code, 0);
    EXPECT_NE(folder.read("r.json").find("use --denoise auto to bake normals without it"), std::string::npos);
    ASSERT_EQ(runTool(folder, common + "smooth.png --denoise auto").exit_code, 0);
    EXPECT_NE(folder.read("r.json").find("normals were computed without the noise (--denoise)"), std::string::npos);
    EXPECT_LT(leanOf(imageOf(folder, "smooth.png")), 0.2 * leanOf(imageOf(folder, "noisy.png")));
}

TEST_F(BakeCommand, DoesNotReportNoiseOnSmoothMeshes) {
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj --size 32 --report r.json -q -o a.png").exit_code, 0);
    EXPECT_EQ(folder.read("r.json").find("noisy"), std::string::npos);
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj --size 32 -q -o b.png --denoise auto").exit_code, 0);
    EXPECT_EQ(folder.read("a.png"), folder.read("b.png"));
}

TEST_F(BakeCommand, WritesCompressedTexturesDirectly) {
    const std::string common = "bake low.obj --high high.obj -q --size 64 -o ";
    for (const std::string name : {"n.png", "n.ktx2", "n.dds"}) ASSERT_EQ(runTool(folder, common + name).exit_code, 0);
    ASSERT_EQ(runTool(folder, "compress-map -q n.png -o after.ktx2").exit_code, 0);
    const auto errorOf = [&](const std::string& name) {
        const ToolRun run = runTool(folder, "map-error --json " + name + " --source n.png");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out)["meanErrorDeg"].get<double>();
    };
    EXPECT_LT(errorOf("n.ktx2"), 1.02 * errorOf("after.ktx2"));
    EXPECT_EQ(errorOf("n.dds"), errorOf("n.ktx2"));
    for (const std::string more : {"n.ktx2 --out-mesh m.glb", "n.ktx2 --space object", "n.exr"})
        EXPECT_NE(runTool(folder, common + more).exit_code, 0) << more;
}

TEST_F(BakeCommand, GivesTheSameBytesForAnyNumberOfThreads) {
    for (const std::string bits : {"8", "16"}) {
        const std::string common = "bake low.obj --high high.obj -q --size 40 --bits " + bits;
        ASSERT_EQ(runTool(folder, common + " -o 1.png --threads 1").exit_code, 0);
        ASSERT_EQ(runTool(folder, common + " -o 2.png --threads 2").exit_code, 0);
        EXPECT_EQ(folder.read("1.png"), folder.read("2.png"));
    }
}

TEST_F(BakeCommand, DirectxInvertsGreen) {
    const std::string common = "bake low.obj --high high.obj -q --size 32 --fit texel -o ";
    ASSERT_EQ(runTool(folder, common + "gl.png").exit_code, 0);
    ASSERT_EQ(runTool(folder, common + "dx.png --convention directx").exit_code, 0);
    const FloatImage gl = imageOf(folder, "gl.png"), dx = imageOf(folder, "dx.png");
    for (std::size_t i = 0; i < gl.texels.size(); ++i) EXPECT_NEAR(gl.texels[i].y, 1 - dx.texels[i].y, 2e-5F);
}

/// Returns the OBJ text with all vertices moved by (x, y).
std::string moved(const std::string& obj, double x, double y) {
    std::istringstream lines(obj);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        double at[3] = {};
        if (words >> keyword && keyword == "v" && words >> at[0] >> at[1] >> at[2]) {
            line = "v " + std::to_string(at[0] + x) + " " + std::to_string(at[1] + y) + " " + std::to_string(at[2]);
        }
        text += line + "\n";
    }
    return text;
}

TEST_F(BakeCommand, FarFromTheOriginTheMapIsTheSame) {
    constexpr double kX = 456123, kY = 5261789;
    const std::string low = sheet(4, 0, true), high = sheet(40, 0.02, false);
    folder.write("far_low.obj", moved(low, kX, kY));
    // Another sheet next to the high poly causes another offset to be subtracted.
    folder.write("far_high.obj", moved(high, kX, kY) + moved(sheet(40, 0.02, false, "other", 0, 41 * 41), kX + 30, kY));
    ASSERT_EQ(runTool(folder, "generate -q far_high.obj -o far_high.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "bake -q low.obj --high high.obj -o near.png --size 32 --bits 16").exit_code, 0);
    const FloatImage near = imageOf(folder, "near.png");
    for (const std::string far_high : {"far_high.obj", "far_high.glb"}) {
        const ToolRun run =
            runTool(folder, "bake far_low.obj --high " + far_high + " -o far.png --size 32 --bits 16 --report r.json");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(nlohmann::json::parse(folder.read("r.json"))["files"][0]["texels"]["missed"], 0);
        const FloatImage far = imageOf(folder, "far.png");
        double sum = 0;
        for (std::size_t i = 0; i < near.texels.size(); ++i) {
            const Vec3 &a = near.texels[i], &b = far.texels[i];
            sum += std::fabs(double{a.x} - b.x) + std::fabs(double{a.y} - b.y) + std::fabs(double{a.z} - b.z);
        }
        EXPECT_LT(sum / static_cast<double>(near.texels.size()), 1e-3) << far_high;
    }
}

TEST_F(BakeCommand, MatchesMeshesByName) {
    // Each low sheet is at the position of the high sheet that belongs to the other one.
    folder.write("two_low.obj", sheet(4, 0, true, "a_low"));
    std::string high = sheet(40, 0.02, false, "a_high", 0.04);
    folder.write("one_high.obj", high);
    const auto json =
        nlohmann::json::parse(runTool(folder, "bake two_low.obj --high one_high.obj -o n.png --size 16 --json").out);
    EXPECT_EQ(json["matchedByName"], false) << "one mesh needs no name";
}

TEST_F(BakeCommand, WritesAFilePerTile) {
    std::string low = sheet(2, 0, true);
    // Move the UVs of the right half into the next tile.
    std::string moved;
    std::istringstream lines(low);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("vt ", 0) == 0) {
            std::istringstream numbers(line.substr(3));
            double u = 0, v = 0;
            numbers >> u >> v;
            line = "vt " + std::to_string(2 * u) + " " + std::to_string(v);
        }
        moved += line + "\n";
    }
    folder.write("tiles.obj", moved);
    const auto json =
        nlohmann::json::parse(runTool(folder, "bake tiles.obj --high high.obj -o n.png --size 16 --udim --json").out);
    EXPECT_EQ(json["files"].size(), 2U) << json;
    EXPECT_EQ(imageOf(folder, "n.1001.png").width, 16U);
    EXPECT_EQ(imageOf(folder, "n.1002.png").width, 16U);
    // The ray distance of each tile is that of the whole model, and the map of each tile can be measured separately.
    const auto whole =
        nlohmann::json::parse(runTool(folder, "bake tiles.obj --high high.obj -o w.png --size 16 --json").out);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string tile = std::to_string(1001 + i);
        EXPECT_EQ(json["files"][i]["reach"], whole["files"][0]["reach"]);
        const ToolRun run =
            runTool(folder, "map-error n." + tile + ".png tiles.obj --high high.obj --json --tile " + tile);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NEAR(nlohmann::json::parse(run.out)["angles"]["meanDeg"].get<double>(),
                    json["files"][i]["error"]["meanDeg"].get<double>(), 1e-6);
    }
    EXPECT_EQ(runTool(folder, "map-error n.1001.png tiles.obj --high high.obj --tile 1003").exit_code, 3);
}

TEST_F(BakeCommand, MeasuresAMapWithItsWrapMode) {
    ASSERT_EQ(
        runTool(folder, "bake low.obj --high high.obj -o n.png --size 32 --fit texel --out-mesh game.gltf").exit_code,
        0);
    const auto seamOf = [&](int wrap) {
        auto model = nlohmann::json::parse(folder.read("game.gltf"));
        model["samplers"] = {{{"wrapS", wrap}, {"wrapT", wrap}}};
        model["textures"][0]["sampler"] = 0;
        folder.write("wrapped.gltf", model.dump());
        const ToolRun run = runTool(folder, "map-error n.png wrapped.gltf --high high.obj --json");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out)["angles"]["seamMeanDeg"].get<double>();
    };
    const double repeated = seamOf(10497), clamped = seamOf(33071), mirrored = seamOf(33648);
    EXPECT_LT(clamped, 0.5 * repeated) << "a texture that repeats shows the other edge beside each";
    EXPECT_EQ(clamped, mirrored) << "both show the edge's own texels there";
}

TEST_F(BakeCommand, BakesAMapForItsWrapMode) {
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj -o n.png --size 8 --out-mesh game.gltf").exit_code, 0);
    const auto seamOf = [&](int wrap, const std::string& options) {
        auto model = nlohmann::json::parse(folder.read("game.gltf"));
        model["samplers"] = {{{"wrapS", wrap}, {"wrapT", wrap}}};
        model["textures"][0]["sampler"] = 0;
        folder.write("wrapped.gltf", model.dump());
        const std::string bake = "bake wrapped.gltf --high high.obj -o again.png --json --size 32 " + options;
        const ToolRun run = runTool(folder, bake);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out)["files"][0]["error"]["seamMeanDeg"].get<double>();
    };
    for (const int wrap : {33071, 33648}) {
        const double seam = seamOf(wrap, "");
        EXPECT_LT(seam, 0.5 * seamOf(10497, ""));
        // The sampler of the written model reads the map in the way for which it was baked.
        EXPECT_EQ(seamOf(wrap, "--out-mesh new.gltf"), seam);
        const ToolRun run = runTool(folder, "map-error again.png new.gltf --high high.obj --json");
        EXPECT_NEAR(nlohmann::json::parse(run.out)["angles"]["seamMeanDeg"].get<double>(), seam, 1e-7);
    }
}

TEST_F(BakeCommand, CountsTrianglesBeyondAClampedImage) {
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj -o n.png --size 8 --out-mesh game.gltf").exit_code, 0);
    auto model = nlohmann::json::parse(folder.read("game.gltf"));
    model["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33071}}};
    model["textures"][0]["sampler"] = 0;
    model["extensionsUsed"] = {"KHR_texture_transform"};
    model["materials"][0]["normalTexture"]["extensions"] = {{"KHR_texture_transform", {{"scale", {2, 1}}}}};
    folder.write("wide.gltf", model.dump());
    const ToolRun run = runTool(folder, "bake wide.gltf --high high.obj -o wide.png --size 32");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("16 triangles extend beyond the texture"), std::string::npos) << run.out;
}

TEST_F(BakeCommand, AMapReplacesAnImageWithoutABufferView) {
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj -o n.png --size 8 --out-mesh game.gltf").exit_code, 0);
    auto model = nlohmann::json::parse(folder.read("game.gltf"));
    for (const std::uint64_t view : {std::uint64_t{9}, std::uint64_t{1} << 40}) {
        model["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
        folder.write("odd.gltf", model.dump());
        const TempFolder out;
        const std::string file = (out.path() / "new").string();
        const ToolRun run =
            runTool(folder, "bake odd.gltf --high high.obj -o " + file + ".png --size 8 --out-mesh " + file + ".gltf");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(nlohmann::json::parse(out.read("new.gltf"))["images"][0]["uri"], "new.png");
    }
}

TEST_F(BakeCommand, ReportsModelsInDifferentUnits) {
    std::istringstream lines(sheet(40, 0.02, false));
    std::string scaled;
    for (std::string line; std::getline(lines, line); scaled += line + "\n") {
        if (line.rfind("v ", 0) != 0) continue;
        std::istringstream in(line.substr(2));
        line = "v";
        for (double value = 0; in >> value;) line += " " + std::to_string(100 * value);
    }
    folder.write("cm.obj", scaled);
    const std::string says = "the high poly is 100 times as large as the low poly";
    const ToolRun run = runTool(folder, "bake low.obj --high cm.obj -o cm.png --size 32");
    EXPECT_NE((run.out + run.err).find(says), std::string::npos) << run.out << run.err;
    const ToolRun measured = runTool(folder, "map-error first.png low.obj --high cm.obj");
    EXPECT_NE((measured.out + measured.err).find(says), std::string::npos) << measured.out << measured.err;
}

TEST_F(BakeCommand, AnErrorIsOneLineAndNothingIsWritten) {
    folder.write("bare.obj", sheet(4, 0, false));
    folder.write("far.obj", sheet(4, 0, false, "far", 50));
    folder.write("broken.glb", "glTF and no more");
    for (const auto& [arguments, exit_code, says] :
         {std::tuple("bake low.obj --high high.obj -o n.png --size 0", 2, "1 to 16384"),
          {"bake low.obj --high high.obj -o n.png --size 65536", 2, "1 to 16384"},
          {"bake low.obj --high high.obj -o n.png --bits 12 --size 32", 2, "--bits"},
          {"bake low.obj --high high.obj -o n.png --reach 0 --size 32", 2, "greater than 0"},
          {"bake low.obj -o n.png", 2, "--high"},
          {"bake low.obj --high high.obj", 2, "--output"},
          {"bake low.obj --high high.obj -o n.jpg", 2, ".png"},
          {"bake low.obj --high high.obj -o low.obj", 2, "is an input"},
          {"bake bare.obj --high high.obj -o n.png --size 32", 3, "no UVs"},
          {"bake low.obj --high far.obj -o n.png --size 32", 3, "do not overlap"},
          {"bake low.obj --high broken.glb -o n.png --size 32", 3, ""},
          {"bake low.obj --high none.obj -o n.png", 4, "none.obj"},
          {"bake low.obj --high high.obj -o n.png --cage high.obj --size 32", 3, "cage"},
          {"bake low.obj --high high.obj -o n.png --size 8192 --memory-limit 200M", 3, "limit"},
          {"bake low.obj --high high.obj -o no/such/../n.png --misses /proc/m.png --size 32", 4, ""}}) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << '\n' << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path("n.png"))) << arguments;
    }
}

TEST_F(BakeCommand, AnErrorNamesTheFileThatItIsAbout) {
    folder.write("broken.glb", "glTF and no more");
    folder.write("broken.png", "\x89PNG and no more");
    for (const auto& [arguments, begins] :
         {std::pair("bake broken.glb --high high.obj -o n.png --size 32", "tspace: broken.glb: "),
          {"bake low.obj --high broken.glb -o n.png --size 32", "tspace: broken.glb: "},
          {"bake low.obj --high high.obj --cage broken.glb -o n.png --size 32", "tspace: broken.glb: "},
          {"bake low.obj --high high.obj --cage high.obj -o n.png --size 32", "tspace: high.obj: "},
          {"map-error broken.png low.obj --high high.obj", "tspace: broken.png: "},
          {"map-error first.png broken.glb --high high.obj", "tspace: broken.glb: "},
          {"map-error first.png low.obj --high broken.glb", "tspace: broken.glb: "}}) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, 3) << arguments;
        EXPECT_EQ(run.err.rfind(begins, 0), 0U) << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
}

/// Writes the low poly as a .gltf file. Its only material has a normal map with this texture transform.
std::string withTransform(const TempFolder& folder, const nlohmann::json& transform) {
    EXPECT_EQ(runTool(folder, "generate low.obj -o plain.gltf --all").exit_code, 0);
    auto model = nlohmann::json::parse(folder.read("plain.gltf"));
    model["images"] = {{{"uri", "old.png"}}};
    model["textures"] = {{{"source", 0}}};
    model["materials"] = {
        {{"name", "stone"},
         {"normalTexture", {{"index", 0}, {"scale", 0.5}, {"extensions", {{"KHR_texture_transform", transform}}}}}}};
    model["extensionsUsed"] = {"KHR_texture_transform"};
    for (auto& primitive : model["meshes"][0]["primitives"]) primitive["material"] = 0;
    return model.dump();
}

TEST_F(BakeCommand, TheWrittenModelAndItsMapHaveTheErrorThatTheBakeReports) {
    for (const std::string model : {"out/low.glb", "out/low.gltf"}) {
        const ToolRun run =
            runTool(folder, "bake low.obj --high high.obj -o out/maps/n.png --size 64 --json --out-mesh " + model);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const ToolRun measured = runTool(folder, "map-error out/maps/n.png " + model + " --high high.obj --json");
        ASSERT_EQ(measured.exit_code, 0) << measured.err;
        EXPECT_NEAR(meanOf(run.out, true), meanOf(measured.out, false), 1e-7);
        EXPECT_EQ(nlohmann::json::parse(measured.out)["framesMade"], false);
    }
    const auto model = nlohmann::json::parse(folder.read("out/low.gltf"));
    EXPECT_EQ(model["images"][0]["uri"], "maps/n.png");
    const std::string glb = folder.read("out/low.glb");
    EXPECT_NE(glb.find(folder.read("out/maps/n.png")), std::string::npos) << "a GLB holds its map";
}

TEST_F(BakeCommand, AMapIsBakedForTheUvsThatItsTransformGives) {
    const nlohmann::json transform = {{"scale", {0.5, 0.5}}, {"offset", {0.25, 0.3}}, {"rotation", 0.2}};
    folder.write("low.gltf", withTransform(folder, transform));
    const ToolRun run = runTool(folder, "bake low.gltf --high high.obj -o n.png --size 64 --json --out-mesh new.gltf");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto report = nlohmann::json::parse(run.out);
    // The map covers a quarter of the image's 64 x 64 texels.
    EXPECT_NEAR(report["files"][0]["texels"]["baked"].get<double>(), 1024, 60);
    const ToolRun measured = runTool(folder, "map-error n.png new.gltf --high high.obj --json");
    EXPECT_NEAR(meanOf(run.out, true), meanOf(measured.out, false), 1e-7) << measured.err;
    EXPECT_LT(meanOf(run.out, true), 0.6);
    const auto model = nlohmann::json::parse(folder.read("new.gltf"));
    ASSERT_EQ(model["images"].size(), 1U) << "the old map, which nothing else shows, is replaced";
    EXPECT_EQ(model["images"][0]["uri"], "n.png");
    const auto& reference = model["materials"][0]["normalTexture"];
    EXPECT_FALSE(reference.contains("scale")) << "the scale of the map must be 1 when a map is baked";
    EXPECT_EQ(reference["extensions"]["KHR_texture_transform"], transform);
}

TEST_F(BakeCommand, TexelsOfAUnitMapHaveTheZOfTheirXAndY) {
    for (const std::string bits : {"8", "16"}) {
        const ToolRun run =
            runTool(folder, "bake low.obj --high high.obj -o n.png --size 32 --unit --json --bits " + bits);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const FloatImage map = imageOf(folder, "n.png");
        const float step = bits == "8" ? 2.0F / 255 : 2.0F / 65535;
        for (const Vec3& texel : map.texels) {
            const float x = 2 * texel.x - 1, y = 2 * texel.y - 1;
            EXPECT_NEAR(2 * texel.z - 1, std::sqrt(1 - x * x - y * y), 0.51F * step);
        }
        const ToolRun measured = runTool(folder, "map-error n.png low.obj --high high.obj --two-channels --json");
        EXPECT_NEAR(meanOf(run.out, true), meanOf(measured.out, false), 1e-7) << measured.err;
    }
}

TEST_F(BakeCommand, AMapWithoutBlueIsFoundToHaveTwoChannels) {
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj -o n.png --size 32 --unit").exit_code, 0);
    FloatImage map = imageOf(folder, "n.png");
    for (Vec3& texel : map.texels) texel.z = 0;
    const auto png = encodePng(map, 16);
    ASSERT_TRUE(png);
    folder.write("bc5.png", std::string(png->begin(), png->end()));
    const ToolRun run = runTool(folder, "map-error bc5.png low.obj --high high.obj");
    EXPECT_NE(run.out.find("two channels"), std::string::npos) << run.out;
}

TEST_F(BakeCommand, EachMaterialOfTheWrittenModelHasItsMap) {
    std::string two = sheet(4, 0, true);
    two.insert(two.rfind("\nf", two.size() - 60) + 1, "usemtl second\n");
    two.insert(two.find("\nf") + 1, "usemtl first\n");
    folder.write("two.obj", "mtllib two.mtl\n" + two);
    folder.write("two.mtl", "newmtl first\nKd 1 0 0\nnewmtl second\nKd 0 1 0\n");
    const ToolRun run = runTool(folder, "bake two.obj --high high.obj -o n.png --size 32 --json --out-mesh two.gltf");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto model = nlohmann::json::parse(folder.read("two.gltf"));
    for (const auto& material : model["materials"]) {
        const auto& texture = model["textures"][material["normalTexture"]["index"].get<std::size_t>()];
        EXPECT_EQ(model["images"][texture["source"].get<std::size_t>()]["uri"],
                  "n." + material["name"].get<std::string>() + ".png");
    }
    for (const char* name : {"first", "second"}) {
        const ToolRun measured = runTool(
            folder, std::string("map-error n.") + name + ".png two.gltf --high high.obj --json --material " + name);
        EXPECT_LT(meanOf(measured.out, false), 0.5) << measured.err;
    }
}

/// Returns `wanted` of the corrupt models, evenly distributed over the sorted list of their names.
std::vector<std::string> badModels(std::size_t wanted) {
    std::vector<std::string> all, some;
    const std::filesystem::path folder = std::filesystem::path(TSPACE_SHARED_DIR) / "bad";
    if (!std::filesystem::is_directory(folder)) return {};
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".glb" || ending == ".gltf" || ending == ".obj") all.push_back(entry.path().string());
    }
    std::sort(all.begin(), all.end());
    for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(1, all.size() / wanted)) some.push_back(all[i]);
    return some;
}

TEST_F(BakeCommand, AMalformedModelCausesOneLineAndNoFile) {
    const std::vector<std::string> models = badModels(12);
    if (models.empty()) GTEST_SKIP() << "the bad models are missing";
    for (const std::string& model : models) {
        for (const std::string& inputs : {"'" + model + "' --high high.obj", "low.obj --high '" + model + "'",
                                          "low.obj --high high.obj --cage '" + model + "'"}) {
            const ToolRun run = runTool(folder, "bake " + inputs + " -q --size 8 -o n.png --out-mesh n.glb");
            EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 1 || run.exit_code == 3 || run.exit_code == 4) << inputs;
            // Exit code 1: rays hit little or nothing. If no map is written, a line explains why.
            const bool is_written = run.exit_code == 1 && run.err.empty();
            if (run.exit_code == 0 || is_written) {
                std::filesystem::remove(folder.path("n.png"));
                std::filesystem::remove(folder.path("n.glb"));
                continue;
            }
            EXPECT_EQ(run.errorLines(), 1) << inputs << run.err;
            EXPECT_FALSE(std::filesystem::exists(folder.path("n.png"))) << inputs;
            EXPECT_FALSE(std::filesystem::exists(folder.path("n.glb"))) << inputs;
        }
    }
}

TEST_F(BakeCommand, AModelIsWrittenWithItsMapsOrNotAtAll) {
    for (const auto& [arguments, exit_code, says] :
         {std::tuple("--out-mesh new.obj", 2, "must end in .glb, .vrm or .gltf"),
          {"--out-mesh new.glb --udim", 2, "--udim"},
          {"--out-mesh new.glb --space object", 2, "tangent space"},
          {"--out-mesh new.glb --convention directx", 2, "green must point up"},
          {"--out-mesh low.obj", 2, "is an input"},
          {"--out-mesh n.png", 2, "n.png"},
          {"--out-mesh /proc/new.glb", 4, ""}}) {
        const ToolRun run =
            runTool(folder, std::string("bake low.obj --high high.obj -o n.png --size 16 ") + arguments);
        EXPECT_EQ(run.exit_code, exit_code) << arguments << '\n' << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path("n.png"))) << arguments;
        EXPECT_FALSE(std::filesystem::exists(folder.path("new.glb"))) << arguments;
    }
}

}  // namespace
}  // namespace tspace::test
