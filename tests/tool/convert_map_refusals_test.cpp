// SPDX-License-Identifier: MIT
// tspace convert-map on models for which no map can be converted: the tool reports the reason and writes nothing.
#include <cmath>
#include <sstream>

#include "tool/baked_sheets.h"

namespace tspace::test {
namespace {

class ConvertMapRefusals : public testing::Test {
  protected:
    ConvertMapRefusals() {
        FloatImage image{.width = 64, .height = 64, .bits = 16};
        image.texels.assign(64 * 64, {0.74F, 0.68F, 0.9F});
        const auto png = encodePng(image, 16);
        EXPECT_TRUE(png);
        if (png) folder.write("n.png", std::string(png->begin(), png->end()));
    }
    /// Returns a sheet whose lines "v" and "vt" are changed by `change`.
    template <class Change>
    static std::string changed(const Change& change, const std::string& name = "sheet", int before = 0) {
        std::string text;
        std::istringstream lines(sheet(4, 0, true, name, 0, before));
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string keyword;
            double x = 0, y = 0;
            words >> keyword >> x >> y;
            const std::string other = change(keyword, x, y);
            text += (other.empty() ? line : keyword + other) + "\n";
        }
        return text;
    }
    static std::string numbers(double x, double y) { return " " + std::to_string(x) + " " + std::to_string(y); }
    /// Runs convert-map and returns its exit code. Stores the text of stderr in `said`.
    int convert(const std::string& options) {
        const ToolRun run = runTool(folder, "convert-map n.png -o out.png " + options);
        said = run.err;
        return run.exit_code;
    }
    const TempFolder folder;
    std::string said = {};
};

TEST_F(ConvertMapRefusals, ModelsWithOtherUvsOrOtherPositions) {
    folder.write("a.obj", sheet(4, 0, true));
    folder.write("turned.obj", changed([](const std::string& keyword, double x, double y) {
                     return keyword == "vt" ? numbers(y, x) : std::string();
                 }));
    folder.write("away.obj", changed([](const std::string& keyword, double x, double y) {
                     return keyword == "v" ? numbers(x + 1, y) + " 0" : std::string();
                 }));
    for (const std::string other : {"turned.obj", "away.obj"}) {
        EXPECT_EQ(convert("--mesh a.obj --to-mesh " + other), 3) << other;
        EXPECT_NE(said.find("same surface and UVs"), std::string::npos) << said;
        EXPECT_FALSE(folder.has("out.png")) << other;
    }
    // The same surface, with triangles along the other diagonals and in another order.
    folder.write("bumps.obj", sheet(4, 0.001, true));
    EXPECT_EQ(convert("--mesh a.obj --to-mesh bumps.obj"), 0) << said;
}

TEST_F(ConvertMapRefusals, MaterialsThatShareUvsWhereNoneNamesTheMap) {
    const std::string second =
        changed([](const std::string& keyword, double x,
                   double y) { return keyword == "v" ? numbers(x + 2, y) + " 0" : std::string(); },
                "b", 25);
    const std::string sheets = "usemtl first\n" + sheet(4, 0, true, "a") + "usemtl second\n" + second;
    folder.write("two.obj", "mtllib two.mtl\n" + sheets);
    folder.write("two.mtl", "newmtl first\nnewmtl second\n");
    EXPECT_EQ(convert("--mesh two.obj --to object"), 3);
    EXPECT_NE(said.find("--material"), std::string::npos) << said;
    EXPECT_EQ(convert("--mesh two.obj --to object --material second"), 0) << said;
    folder.write("named.obj", "mtllib named.mtl\n" + sheets);
    folder.write("named.mtl", "newmtl first\nnewmtl second\nnorm n.png\n");
    EXPECT_EQ(convert("--mesh named.obj --to object"), 0) << said;
}

TEST_F(ConvertMapRefusals, HalvesThatShareTexelsWithDifferentObjectSpaceNormals) {
    const auto upright = [](const std::string& keyword, double x, double y) {
        return keyword == "v" ? " 0" + numbers(x, y) : std::string();
    };
    const auto beside = [](const std::string& keyword, double x, double y) {
        return keyword == "v" ? numbers(x + 2, y) + " 0" : std::string();
    };
    folder.write("two.obj", sheet(4, 0, true, "a") + changed(upright, "b", 25));
    EXPECT_EQ(convert("--mesh two.obj --to object"), 3);
    EXPECT_NE(said.find("one direction"), std::string::npos) << said;
    folder.write("alike.obj", sheet(4, 0, true, "a") + changed(beside, "b", 25));
    EXPECT_EQ(convert("--mesh alike.obj --to object"), 0) << said;
}

}  // namespace
}  // namespace tspace::test
