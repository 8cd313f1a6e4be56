// SPDX-License-Identifier: MIT
// tspace bake on typical models: high polys with maps of their own, copies outside of the UV range, and mirrored halves
// that share texels.
#include "tool/baked_sheets.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/base/vec_math.h"
#include "maps/texels/shading.h"
#include "support/shared_data.h"

namespace tspace::test {
namespace {

using nlohmann::json;

class BakeModels : public BakeCommand {
  protected:
    /// Writes a sheet whose u increases along y, and whose v increases along x. Its material uses the map.
    void writeMapped(const std::string& name, const std::string& map) const {
        std::string text = "mtllib " + name + ".mtl\n", faces = sheet(4, 0, true);
        std::istringstream lines(faces);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string keyword, u, v;
            words >> keyword >> u >> v;
            if (keyword == "vt") line = "vt " + v + " " + u;
            if (keyword == "s") line += "\nusemtl skin";
            text += line + "\n";
        }
        folder.write(name + ".obj", text);
        folder.write(name + ".mtl", "newmtl skin\nnorm " + map + "\n");
    }
    template <class VectorAt>
    void writeMap(const std::string& name, std::uint32_t side, const VectorAt& vectorAt) const {
        FloatImage image{.width = side, .height = side, .bits = 16};
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                DVec3 vector = vectorAt((x + 0.5) / side, (y + 0.5) / side);
                normalize(vector);
                image.texels.push_back(toFloat(0.5 * (vector + DVec3{1, 1, 1})));
            }
        }
        const auto png = encodePng(image, 16);
        ASSERT_TRUE(png);
        folder.write(name, std::string(png->begin(), png->end()));
    }
    [[nodiscard]] json bake(const std::string& options, const std::string& output = "out.png") const {
        const ToolRun run = runTool(folder, "bake " + options + " -o " + output + " --json");
        EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
        return json::parse(run.out, nullptr, false);
    }
    [[nodiscard]] DVec3 middleOf(const std::string& png) const {
        const FloatImage image = imageOf(folder, png);
        DVec3 vector = decodeTexel(image.texels[image.width * (image.height / 2) + image.width / 2], {});
        normalize(vector);
        return vector;
    }
    static bool warns(const json& report, const std::string& words) {
        for (const json& warning : report["warnings"]) {
            if (warning.get<std::string>().find(words) != std::string::npos) return true;
        }
        return false;
    }
};

TEST_F(BakeModels, TheMapOfTheHighPolyIsBakedThroughOnOtherUvs) {
    writeMap("tilt.png", 8, [](double, double) { return DVec3{0.48, 0.36, 0.8}; });
    writeMapped("mapped", "tilt.png");
    const json report = bake("low.obj --high mapped.obj --size 32");
    // u of the map increases along y of the sheet, and v (pointing up) along x.
    EXPECT_LT(degreesBetween(middleOf("out.png"), {0.36, 0.48, 0.8}), 0.02);
    ASSERT_EQ(report["highMaps"].size(), 1U);
    EXPECT_EQ(report["highMaps"][0]["image"], "tilt.png");
    EXPECT_EQ(report["highMaps"][0]["triangles"], 32);
    EXPECT_LT(report["files"][0]["error"]["maxDeg"], 0.02) << "the error counts the map";
    // map-error uses the same normals of the high poly.
    const ToolRun measured = runTool(folder, "map-error out.png low.obj --high mapped.obj --json");
    EXPECT_LT(json::parse(measured.out)["angles"]["maxDeg"], 0.02) << measured.out;
    const json without = bake("low.obj --high mapped.obj --size 32 --ignore-high-maps");
    EXPECT_LT(degreesBetween(middleOf("out.png"), {0, 0, 1}), 0.02);
    EXPECT_EQ(without["highMaps"].size(), 0U);
}

TEST_F(BakeModels, TheGreenDirectionOfTheHighPolysMapIsDetectedOrGiven) {
    const auto slopes = [](double green) {
        return [green](double u, double v) {
            // The height is sin(12 u) sin(9 v'), where v' points up.
            return DVec3{-0.6 * std::cos(12 * u) * std::sin(9 * (1 - v)),
                         -green * 0.45 * std::sin(12 * u) * std::cos(9 * (1 - v)), 1};
        };
    };
    writeMap("up.png", 256, slopes(1));
    writeMap("down.png", 256, slopes(-1));
    writeMapped("up", "up.png");
    writeMapped("down", "down.png");
    const json up = bake("low.obj --high up.obj --size 64", "of_up.png");
    const json down = bake("low.obj --high down.obj --size 64", "of_down.png");
    EXPECT_EQ(up["highMaps"][0]["green"], "up");
    EXPECT_EQ(down["highMaps"][0]["green"], "down");
    EXPECT_EQ(down["highMaps"][0]["greenIs"], "seen");
    EXPECT_TRUE(warns(down, "points down")) << down["warnings"];
    EXPECT_LT(degreesBetween(middleOf("of_up.png"), middleOf("of_down.png")), 0.1);
    const json told = bake("low.obj --high down.obj --size 64 --high-green up", "told.png");
    EXPECT_EQ(told["highMaps"][0]["greenIs"], "told");
    EXPECT_GT(degreesBetween(middleOf("of_up.png"), middleOf("told.png")), 1);
}

TEST_F(BakeModels, AGrayMapOfTheHighPolyIsNotANormalMap) {
    writeMap("gray.png", 8, [](double u, double) { return DVec3{u, u, u}; });
    writeMapped("gray", "gray.png");
    const json report = bake("low.obj --high gray.obj --size 32");
    EXPECT_EQ(report["highMaps"].size(), 0U);
    EXPECT_TRUE(warns(report, "height-to-normal")) << report["warnings"];
    EXPECT_LT(degreesBetween(middleOf("out.png"), {0, 0, 1}), 0.02);
}

/// Returns a sheet and a second one next to it, which is a little larger and whose UVs are moved by `by`.
std::string twoSheets(double by) {
    std::string text = sheet(4, 0, true, "a");
    std::istringstream lines(sheet(4, 0, true, "b", 0, 25));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        double x = 0, y = 0;
        words >> keyword >> x >> y;
        if (keyword == "v") line = "v " + std::to_string(x + 2) + " " + std::to_string(1.2 * y) + " 0";
        if (keyword == "vt") line = "vt " + std::to_string(x + by) + " " + std::to_string(y);
        text += line + "\n";
    }
    return text;
}

/// Returns a high poly with different detail over each of the two sheets.
std::string twoDetails() {
    std::string text = sheet(40, 0.02, false, "a");
    std::istringstream lines(sheet(40, -0.02, false, "b", 0, 41 * 41));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword, z;
        double x = 0, y = 0;
        words >> keyword >> x >> y >> z;
        if (keyword == "v") line = "v " + std::to_string(x + 2) + " " + std::to_string(1.2 * y) + " " + z;
        text += line + "\n";
    }
    return text;
}

TEST_F(BakeModels, IgnoresCopiesOutsideTheUvRange) {
    folder.write("moved.obj", twoSheets(1));
    folder.write("details.obj", twoDetails());
    const std::string options = " --high details.obj --size 32 --match all --reach 0.1";
    const json report = bake("moved.obj" + options);
    EXPECT_EQ(report["files"][0]["outsideTriangles"], 32);
    EXPECT_EQ(report["files"][0]["texels"]["overlapping"], 0);
    EXPECT_TRUE(warns(report, "--wrap")) << report["warnings"];
    const json alone = bake("low.obj" + options, "alone.png");
    EXPECT_EQ(alone["files"][0]["outsideTriangles"], 0);
    EXPECT_EQ(folder.read("out.png"), folder.read("alone.png"));
    const json wrapped = bake("moved.obj --wrap" + options, "wrapped.png");
    EXPECT_EQ(wrapped["files"][0]["outsideTriangles"], 0);
    EXPECT_GT(wrapped["files"][0]["texels"]["conflicting"], 100);
    EXPECT_NE(folder.read("out.png"), folder.read("wrapped.png"));
}

TEST_F(BakeModels, BakesAMaterialThatIsCompletelyOutsideTheUvRange) {
    folder.write("moved.obj", twoSheets(1));
    std::string away = sheet(4, 0, true);
    std::string text;
    std::istringstream lines(away);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string keyword;
        double u = 0, v = 0;
        words >> keyword >> u >> v;
        text += (keyword == "vt" ? "vt " + std::to_string(u + 1) + " " + std::to_string(v) : line) + "\n";
    }
    folder.write("away.obj", text);
    const json report = bake("away.obj --high high.obj --size 32");
    EXPECT_TRUE(warns(report, "all triangles")) << report["warnings"];
    EXPECT_EQ(report["files"][0]["texels"]["missed"], 0);
    EXPECT_GT(report["files"][0]["texels"]["baked"], 1000);
}

TEST_F(BakeModels, OverlapSelectsOneOfTwoPieces) {
    folder.write("shared.obj", twoSheets(0));
    folder.write("details.obj", twoDetails());
    const std::string options = " --high details.obj --size 32 --match all --reach 0.1";
    const json mean = bake("shared.obj" + options);
    EXPECT_GT(mean["files"][0]["texels"]["conflicting"], 100);
    EXPECT_GT(mean["files"][0]["conflictMeanDeg"], 2);
    EXPECT_GE(mean["files"][0]["conflictMaxDeg"], mean["files"][0]["conflictMeanDeg"]);
    static_cast<void>(bake("shared.obj --overlap first" + options, "first.png"));
    static_cast<void>(bake("shared.obj --overlap larger" + options, "larger.png"));
    static_cast<void>(bake("low.obj" + options, "alone.png"));
    EXPECT_LT(degreesBetween(middleOf("first.png"), middleOf("alone.png")), 0.05);
    EXPECT_GT(degreesBetween(middleOf("larger.png"), middleOf("alone.png")), 2);
}

TEST_F(BakeModels, AMapInObjectSpaceMayHaveZUp) {
    static_cast<void>(bake("low.obj --high high.obj --size 32 --space object", "y.png"));
    static_cast<void>(bake("low.obj --high high.obj --size 32 --space object --axes z-up", "z.png"));
    static_cast<void>(bake("low.obj --high high.obj --size 32 --space object --axes x,-z,y", "same.png"));
    EXPECT_EQ(folder.read("z.png"), folder.read("same.png"));
    const DVec3 y = middleOf("y.png"), z = middleOf("z.png");
    EXPECT_LT(degreesBetween(z, {y.x, -y.z, y.y}), 0.02);
    // map-error recognizes the axes of the map, and both maps give the same map in tangent space.
    const ToolRun run = runTool(folder, "map-error z.png low.obj --high high.obj --json");
    const json measured = json::parse(run.out);
    EXPECT_EQ(measured["readings"][0]["frames"], "object");
    EXPECT_EQ(measured["readings"][0]["axes"], "z-up");
    EXPECT_NE(measured["verdict"].get<std::string>().find("z up"), std::string::npos) << measured["verdict"];
    for (const std::string options : {"y.png", "z.png", "z.png --axes z-up"}) {
        const ToolRun converted =
            runTool(folder, "convert-map " + options + " --from object --mesh low.obj -o t.png --json");
        ASSERT_EQ(converted.exit_code, 0) << converted.err;
        EXPECT_EQ(warns(json::parse(converted.out), "z points up"), options == "z.png") << options;
        EXPECT_LT(degreesBetween(middleOf("t.png"), y), 0.05) << "the sheet lies in the plane of x and y";
    }
    ASSERT_EQ(runTool(folder, "convert-map t.png --to object --mesh low.obj --axes z-up -o back.png").exit_code, 0);
    EXPECT_LT(degreesBetween(middleOf("back.png"), z), 0.05);
    for (const std::string axes : {"x,y", "x,y,y", "x,y,w", "up", "x,y,z,x"})
        EXPECT_EQ(runTool(folder, "bake low.obj --high high.obj -o o.png --space object --axes " + axes).exit_code, 2)
            << axes;
}

TEST_F(BakeModels, InstancesOfAMirroredHalfGetTheRayDistanceOfTheWhole) {
    TSPACE_NEEDS_SHARED("reports/second/bake_low_negnode.glb");
    const std::filesystem::path file = shared("reports/second/bake_low_negnode.glb");
    const std::string both = "'" + file.string() + "'";
    std::ostringstream bytes;
    bytes << std::ifstream(file, std::ios::binary).rdbuf();
    // Write the scene without the mirrored node.
    std::string half = bytes.str();
    const std::string nodes = R"("nodes": [0, 1])";
    const std::size_t at = half.find(nodes);
    ASSERT_NE(at, std::string::npos);
    half.replace(at, nodes.size(), R"("nodes": [0   ])");
    folder.write("half.glb", half);
    const auto distanceOf = [&](const std::string& low, const std::string& high) {
        const ToolRun run = runTool(folder, "bake " + low + " --high " + high + " --size 16 --json -o n.png");
        return json::parse(run.out)["files"][0]["reach"].get<double>();
    };
    const double alone = distanceOf("half.glb", "half.glb");
    EXPECT_DOUBLE_EQ(distanceOf(both, "half.glb"), alone);
    // The distance depends on the size of the whole model, not on how far the mirrored half of the high poly is from
    // the first instance of the low poly.
    EXPECT_LT(distanceOf(both, both), 1.5 * alone);
}

/// The accessor of COLOR_0 is that of the UVs, which has too few components.
TEST_F(BakeModels, AnAttributeThatCannotBeReadCostsNoTexel) {
    ASSERT_EQ(runTool(folder, "generate --all low.obj -o low.glb").exit_code, 0);
    std::string bytes = folder.read("low.glb");
    const std::string uvs = "\"TEXCOORD_0\":", tangents = "\"TANGENT\":";
    const std::size_t from = bytes.find(uvs), to = bytes.find(tangents);
    ASSERT_TRUE(from != std::string::npos && to != std::string::npos);
    bytes.replace(to, tangents.size() + 1, "\"COLOR_0\":" + bytes.substr(from + uvs.size(), 1));
    folder.write("faulty.glb", bytes);
    EXPECT_EQ(runTool(folder, "check faulty.glb").exit_code, 1) << "the attribute is an error";
    static_cast<void>(bake("faulty.glb --high high.obj --size 32", "faulty.png"));
    static_cast<void>(bake("low.obj --high high.obj --size 32", "sound.png"));
    EXPECT_EQ(folder.read("faulty.png"), folder.read("sound.png"));
    const json written = bake("faulty.glb --high high.obj --size 32 --out-mesh out.glb", "written.png");
    EXPECT_TRUE(warns(written, "COLOR_0 was removed"));
    EXPECT_EQ(folder.read("written.png"), folder.read("sound.png"));
    EXPECT_EQ(runTool(folder, "check out.glb").exit_code, 0);
}

TEST_F(BakeModels, ASizeMayBeWiderThanHigh) {
    const json report = bake("low.obj --high high.obj --size 64x32");
    EXPECT_EQ(report["files"][0]["width"], 64);
    EXPECT_EQ(report["files"][0]["height"], 32);
    EXPECT_LT(report["files"][0]["error"]["meanDeg"], 0.2);
    for (const std::string size : {"0x8", "8x", "x8", "8x16385", "8y8"}) {
        const ToolRun run = runTool(folder, "bake low.obj --high high.obj -o out.png --size " + size);
        EXPECT_EQ(run.exit_code, 2) << size;
    }
}

}  // namespace
}  // namespace tspace::test
