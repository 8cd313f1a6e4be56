// SPDX-License-Identifier: MIT
// Bumpy sheets as low and high polys, and helpers for tests of tspace bake.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "images/float_image.h"
#include "images/images.h"
#include "run_tool.h"

namespace tspace::test {

/// Returns a sheet of cells x cells quads with bumps over the unit square. `before`: number of vertices of the sheets
/// before it in the file.
inline std::string sheet(int cells, double bump, bool with_uvs, const std::string& name = "sheet", double z = 0,
                         int before = 0) {
    std::string text = "o " + name + "\n";
    const auto at = [&](int i) { return static_cast<double>(i) / cells; };
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const double height = z + bump * std::sin(12 * at(x)) * std::sin(9 * at(y));
            text += "v " + std::to_string(at(x)) + " " + std::to_string(at(y)) + " " + std::to_string(height) + "\n";
            if (with_uvs) text += "vt " + std::to_string(at(x)) + " " + std::to_string(at(y)) + "\n";
        }
    }
    text += "s 1\n";
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            const int a = before + y * (cells + 1) + x + 1;
            text += "f";
            for (const int vertex : {a, a + 1, a + cells + 2, a + cells + 1}) {
                text += " " + std::to_string(vertex);
                if (with_uvs) text += "/" + std::to_string(vertex);
            }
            text += "\n";
        }
    }
    return text;
}

inline FloatImage imageOf(const TempFolder& folder, const std::string& name) {
    std::string why;
    const std::optional<FloatImage> image = decodeFloatImage(bytesOf(folder.read(name)), 1 << 22, why);
    EXPECT_TRUE(image) << why;
    return image ? *image : FloatImage{};
}

class BakeCommand : public testing::Test {
  protected:
    void SetUp() override {
        folder.write("low.obj", sheet(4, 0, true));
        folder.write("high.obj", sheet(40, 0.02, false));
        const ToolRun run = runTool(folder, "bake low.obj --high high.obj -o first.png --size 32");
        if (run.exit_code == 3 && run.err.find("Embree") != std::string::npos) GTEST_SKIP() << run.err;
        EXPECT_EQ(run.exit_code, 0) << run.err;
    }
    const TempFolder folder;
};

inline double meanOf(const std::string& json, bool of_file) {
    const auto parsed = nlohmann::json::parse(json, nullptr, false);
    if (parsed.is_discarded()) return -1;
    const auto& error = of_file ? parsed["files"][0]["error"] : parsed["angles"];
    return error["meanDeg"].get<double>();
}

}  // namespace tspace::test
