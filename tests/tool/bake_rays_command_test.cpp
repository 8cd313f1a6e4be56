// SPDX-License-Identifier: MIT
// tspace bake and map-error: which surfaces the rays hit, and which maps are told apart.
#include "tool/baked_sheets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace tspace::test {
namespace {

/// Writes two distant sheets with the same UVs, and a high poly with bumps on one of them only.
void writeTwoSheets(const TempFolder& folder) {
    folder.write("two.obj", "mtllib two.mtl\nusemtl first\n" + sheet(4, 0, true, "a_low") + "usemtl second\n" +
                                sheet(4, 0, true, "b_low", 3, 25));
    folder.write("two.mtl", "newmtl first\nnewmtl second\n");
    folder.write("one.obj", sheet(4, 0, true, "a_low") + sheet(4, 0, true, "b_low", 3, 25));
    folder.write("detail.obj", sheet(40, 0.05, false, "a_high") + sheet(40, 0, false, "b_high", 3, 41 * 41));
}

TEST_F(BakeCommand, MatchesSeveralHighPolysToOneLowPolyByName) {
    writeTwoSheets(folder);
    // For sheet a: a base and a buckle above it. For sheet b: a sheet, and detail at the position of sheet a.
    const auto high = [&](const std::string& third) {
        return sheet(40, 0, false, "a_high", 0) + sheet(40, 0.02, false, "a_high_buckle", 0.03, 41 * 41) +
               sheet(40, 0.05, false, third, 0.06, 2 * 41 * 41) + sheet(40, 0, false, "b_hp_001", 3, 3 * 41 * 41);
    };
    folder.write("parts.obj", high("b_high"));
    folder.write("more.obj", high("floor"));
    folder.write("buckle.obj", sheet(40, 0.02, false, "buckle", 0.03));
    const auto bakedWith = [&](const std::string& options) {
        const ToolRun run = runTool(folder, "bake two.obj -o n.png --size 32 --reach 0.2 --json " + options);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const auto errorOfBuckle = [&] {
        const ToolRun run =
            runTool(folder, "map-error n.first.png two.obj --material first --high buckle.obj --reach 0.2 --json");
        return nlohmann::json::parse(run.out)["angles"]["metMeanDeg"].get<double>();
    };
    const auto parts = bakedWith("--high parts.obj");
    EXPECT_EQ(parts["matchedByName"], true);
    EXPECT_TRUE(parts["warnings"].empty() || parts["warnings"][0].get<std::string>().find("name") == std::string::npos)
        << parts["warnings"];
    EXPECT_LT(errorOfBuckle(), 2) << "the buckle is seen, and what is b's is not";
    EXPECT_EQ(bakedWith("--high parts.obj --match all")["matchedByName"], false);
    EXPECT_GT(errorOfBuckle(), 4) << "everything is seen";
    const std::string warnings = bakedWith("--high more.obj")["warnings"].dump();
    EXPECT_NE(warnings.find("'floor'"), std::string::npos) << warnings;
    EXPECT_GT(errorOfBuckle(), 4) << "everything looks at what has no partner";
    folder.write("pairs.txt", "# low = high\na_low = a_high\na_low=a_high_buckle\n\nb_low = floor\nb_low = b_hp_001\n");
    EXPECT_EQ(bakedWith("--high more.obj --match pairs.txt")["matchedByName"], true);
    EXPECT_LT(errorOfBuckle(), 2);
    folder.write("wrong.txt", "a_low\n");
    const ToolRun wrong = runTool(folder, "bake two.obj --high more.obj -o n.png --match wrong.txt");
    EXPECT_EQ(wrong.exit_code, 3);
    EXPECT_NE(wrong.err.find("line 1"), std::string::npos) << wrong.err;
}

TEST_F(BakeCommand, AMapOfOneMaterialIsNotAttributedToAnotherModel) {
    writeTwoSheets(folder);
    const ToolRun run = runTool(folder, "bake two.obj --high detail.obj -o n.png --size 32");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const ToolRun all = runTool(folder, "map-error n.second.png two.obj --high detail.obj");
    EXPECT_NE(all.out.find("--material"), std::string::npos) << all.out;
    const ToolRun one = runTool(folder, "map-error n.second.png two.obj --high detail.obj --material second");
    EXPECT_NE(one.out.find("fits"), std::string::npos) << one.out;
}

TEST_F(BakeCommand, ConflictingTexelsAreAtMostTheOverlappingOnes) {
    // The centers of some texels are on diagonals, so they are inside no triangle.
    writeTwoSheets(folder);
    const ToolRun run = runTool(folder, "bake one.obj --high detail.obj -o n.png --size 32 --json");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto texels = nlohmann::json::parse(run.out)["files"][0]["texels"];
    EXPECT_GT(texels["conflicting"], 0);
    EXPECT_LE(texels["conflicting"], texels["overlapping"]);
}

TEST_F(BakeCommand, TrianglesOfStlAreSmooth) {
    std::string stl = "solid sheet\n";
    constexpr int kCells = 40;
    const auto corner = [](int x, int y) {
        const double u = static_cast<double>(x) / kCells, v = static_cast<double>(y) / kCells;
        return "vertex " + std::to_string(u) + " " + std::to_string(v) + " " +
               std::to_string(0.02 * std::sin(12 * u) * std::sin(9 * v)) + "\n";
    };
    for (int y = 0; y < kCells; ++y) {
        for (int x = 0; x < kCells; ++x) {
            for (const int side : {0, 1}) {
                stl += "facet normal 0 0 1\nouter loop\n" + corner(x, y) + corner(x + 1, y + side) +
                       corner(x + 1 - side, y + 1) + "endloop\nendfacet\n";
            }
        }
    }
    folder.write("high.stl", stl + "endsolid sheet\n");
    if (runTool(folder, "inspect high.stl").exit_code != 0) GTEST_SKIP() << "there is no tspace-import";
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.stl -o n.png --size 64").exit_code, 0);
    // All normals in the file point up, so they must be ignored.
    EXPECT_LT(meanOf(runTool(folder, "map-error n.png low.obj --high high.obj --json").out, false), 0.5);
}

/// Returns the OBJ text with each line changed.
template <class Change>
std::string withLines(const std::string& obj, const Change& change) {
    std::istringstream lines(obj);
    std::string text;
    for (std::string line; std::getline(lines, line);) text += change(line) + "\n";
    return text;
}

TEST_F(BakeCommand, ReportsTheCauseIfMostRaysMiss) {
    const std::string high = sheet(40, 0.02, false);
    const auto reversed = [](const std::string& line) {
        std::istringstream words(line);
        std::string keyword, a, b, c, d;
        words >> keyword >> a >> b >> c >> d;
        return keyword == "f" ? "f " + d + " " + c + " " + b + " " + a : line;
    };
    const auto moved_by = [](double up) {
        return [up](const std::string& line) {
            std::istringstream words(line);
            std::string keyword;
            double x = 0, y = 0, z = 0;
            words >> keyword >> x >> y >> z;
            return keyword == "v" ? "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z + up)
                                  : line;
        };
    };
    folder.write("inside_out.obj", withLines(high, reversed));
    folder.write("lifted.obj", withLines(high, moved_by(0.3)));
    for (const auto& [arguments, name, says] :
         {std::tuple("--high inside_out.obj", "inside_out.obj", "faces point inward"),
          {"--high lifted.obj --reach 0.1", "lifted.obj", "--reach"}}) {
        const ToolRun run =
            runTool(folder, std::string("bake low.obj -o n.png --size 32 --report r.json ") + arguments);
        EXPECT_EQ(run.exit_code, 1) << run.out << run.err;
        const auto json = nlohmann::json::parse(folder.read("r.json"));
        EXPECT_EQ(json["exitCode"], 1);
        ASSERT_EQ(json["findings"].size(), 1U) << json;
        const std::string finding = json["findings"][0];
        EXPECT_EQ(finding.find("'" + std::string(name)), 0U) << "not about the low poly: " << finding;
        EXPECT_NE(finding.find(says), std::string::npos) << finding;
        EXPECT_NE(run.out.find("finding"), std::string::npos) << run.out;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        // No ray hit anything.
        EXPECT_FALSE(std::filesystem::exists(folder.path("n.png")));
        EXPECT_EQ(json["outputFiles"].size(), 0U);
    }
    // Keep only half of the faces of the high poly.
    folder.write("part.obj", withLines(high, [](const std::string& line) {
                     std::istringstream words(line);
                     std::string keyword;
                     int vertex = 0;
                     words >> keyword >> vertex;
                     return keyword == "f" && vertex > 500 ? std::string() : line;
                 }));
    EXPECT_EQ(runTool(folder, "bake low.obj --high part.obj -o n.png --size 32").exit_code, 1);
    EXPECT_TRUE(std::filesystem::exists(folder.path("n.png")));
}

/// Returns the sheet of low.obj with a small separate shell above it.
std::string sheetWithShell() {
    std::istringstream lines(sheet(8, 0.002, false, "shell"));
    std::string shell;
    for (std::string line; std::getline(lines, line); shell += line + "\n") {
        std::istringstream words(line);
        std::string keyword;
        double x = 0, y = 0, z = 0;
        if (words >> keyword && keyword == "v" && words >> x >> y >> z)
            line = "v " + std::to_string(0.3 + 0.4 * x) + " " + std::to_string(0.3 + 0.4 * y) + " " +
                   std::to_string(0.04 + 0.1 * x * x + z);
    }
    // The faces of the shell refer to vertices after the 41 * 41 vertices of the sheet below.
    std::istringstream again(shell);
    std::string moved_faces;
    for (std::string line; std::getline(again, line); moved_faces += line + "\n") {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword != "f") continue;
        line = "f";
        for (int vertex = 0; words >> vertex;) line += " " + std::to_string(vertex + 41 * 41);
    }
    return sheet(40, 0.02, false, "base") + moved_faces;
}

TEST_F(BakeCommand, ReportsSurfacesHiddenByAShell) {
    folder.write("shell.obj", sheetWithShell());
    const auto bakedWith = [&](const std::string& options) {
        const ToolRun run =
            runTool(folder, "bake low.obj --high shell.obj --size 128 --reach 0.2 --report r.json " + options);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return std::pair(run.out, nlohmann::json::parse(folder.read("r.json")));
    };
    const auto [seen_text, seen] = bakedWith("-o seen.png");
    const auto [hidden_text, hidden] = bakedWith("-o hidden.png --rays nearest");
    EXPECT_LT(seen["files"][0]["error"]["meanDeg"], 0.5);
    EXPECT_EQ(seen["files"][0]["rays"], "outermost");
    EXPECT_EQ(seen["files"][0]["ownError"], nullptr);
    EXPECT_GT(hidden["files"][0]["error"]["meanDeg"], 2);
    EXPECT_LT(hidden["files"][0]["ownError"]["meanDeg"], 0.5);
    EXPECT_NEAR(hidden["files"][0]["ownError"]["hidden"].get<double>(), 16000, 500) << "a part of .4 x .4";
    EXPECT_NE(hidden_text.find("another front face of the high poly lies farther out"), std::string::npos)
        << hidden_text;
    EXPECT_EQ(seen_text.find("farther out"), std::string::npos) << seen_text;
    const auto measured = [&](const std::string& map, const std::string& options) {
        const ToolRun run =
            runTool(folder, "map-error " + map + " low.obj --high shell.obj --json --reach 0.2 " + options);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    const auto fits = measured("seen.png", ""), other = measured("hidden.png", ""),
               told = measured("hidden.png", "--rays nearest");
    EXPECT_EQ(fits["fits"], true) << fits["verdict"];
    EXPECT_EQ(fits["angles"], seen["files"][0]["error"]);
    EXPECT_EQ(other["fits"], false) << other["verdict"];
    EXPECT_NE(other["verdict"].get<std::string>().find(
                  "baked with rays along face normals averaged at hard edges to the nearest front face"),
              std::string::npos)
        << other["verdict"];
    EXPECT_EQ(other["rays"][0]["rays"], "nearest");
    EXPECT_EQ(other["angles"], hidden["files"][0]["error"]);
    EXPECT_EQ(told["fits"], true) << told["verdict"];
    EXPECT_EQ(told["angles"], hidden["files"][0]["ownError"]);
}

TEST_F(BakeCommand, AFewTexelsDoNotIndicateTwoChannels) {
    ASSERT_EQ(runTool(folder, "bake low.obj --high high.obj -o dx.png --size 64 --convention directx --bits 16 --unit")
                  .exit_code,
              0);
    FloatImage map = imageOf(folder, "dx.png");
    // One texel in a hundred has blue below the middle, as in undercuts.
    for (std::size_t i = 0; i < map.texels.size(); i += 100) map.texels[i].z = 1 - map.texels[i].z;
    const auto png = encodePng(map, 16);
    ASSERT_TRUE(png);
    folder.write("few.png", std::string(png->begin(), png->end()));
    const ToolRun run = runTool(folder, "map-error few.png low.obj --high high.obj");
    EXPECT_NE(run.out.find("made for green that points down"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("two channels"), std::string::npos) << run.out;
    // A map without blue is a two-channel map.
    for (Vec3& texel : map.texels) texel.z = 0;
    const auto without = encodePng(map, 16);
    folder.write("without.png", std::string(without->begin(), without->end()));
    const ToolRun two = runTool(folder, "map-error without.png low.obj --high high.obj");
    EXPECT_NE(two.out.find("two channels"), std::string::npos) << two.out;
}

TEST_F(BakeCommand, ACageMeshDeterminesTheRays) {
    ASSERT_EQ(
        runTool(folder, "bake low.obj --high high.obj -o n.png --size 32 --cage low.obj --rays nearest").exit_code, 2);
    folder.write("broken.png", "no image");
    const ToolRun run = runTool(folder, "bake low.obj --high high.obj -o n.png --size 32 --skew broken.png");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_NE(run.err.find("broken.png"), std::string::npos) << run.err;
    EXPECT_EQ(runTool(folder, "bake low.obj --high high.obj -o n.png --size 32 --skew first.png").exit_code, 0);
}

}  // namespace
}  // namespace tspace::test
