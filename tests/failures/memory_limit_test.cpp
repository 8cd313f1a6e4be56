// SPDX-License-Identifier: MIT
// Images whose headers declare far more pixels than the size of the file justifies: every command that reads a map
// rejects them by default.
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "images/images.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

void writeOneColor(const TempFolder& folder, const std::string& name, std::uint32_t side) {
    folder.write(name, pngFile({side, side, std::vector<std::uint8_t>(std::size_t{3} * side * side, 128)}));
}

TEST(MemoryLimit, HoldsByDefaultForEveryImageThatIsReadAsAMap) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    // The header of a small file declares 4096 x 4096 pixels. It is rejected before anything is decoded.
    writeOneColor(folder, "bomb.png", 16);
    std::string bomb = folder.read("bomb.png");
    for (const std::size_t side_at : {16, 20}) bomb.replace(side_at, 4, std::string("\0\0\x10\0", 4));
    folder.write("bomb.png", bomb);
    const std::set<std::string> files = folder.files();
    for (const char* command :
         {"convert-map bomb.png -o new.png", "convert-map bomb.png --mesh folded.obj --to object -o new.png",
          "compress-map bomb.png -o new.ktx2", "height-to-normal bomb.png -o new.png",
          "compress-map bump.png --roughness bomb.png --roughness-output new2.png -o new.ktx2",
          "map-error bump.png --source bomb.png", "map-error bomb.png folded.obj --high folded.obj",
          "bake folded.obj --high folded.obj --skew bomb.png --size 16 -o new.png"}) {
        const ToolRun run = runTool(folder, command);
        if (run.err.find("not built with") != std::string::npos) continue;
        EXPECT_EQ(run.exit_code, 3) << command << ": " << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
        EXPECT_NE(run.err.find("--memory-limit"), std::string::npos) << run.err;
        EXPECT_EQ(folder.files(), files) << command;
    }
}

TEST(MemoryLimit, AcceptsABlankMapOfCommonSize) {
    const TempFolder folder;
    writeOneColor(folder, "blank.png", 2048);
    for (const char* command : {"convert-map -q blank.png -o new.png", "height-to-normal -q blank.png -o new2.png"})
        EXPECT_EQ(runTool(folder, command).exit_code, 0) << command;
}

}  // namespace
}  // namespace tspace::test
