// SPDX-License-Identifier: MIT
// The tool with limited address space (ulimit -v): each command works or reports that it is out of memory.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// A waved grid with UVs and a material with a normal map, large enough for helper threads and arenas.
void writeGrid(const TempFolder& folder) {
    constexpr int kSide = 150;
    std::string text = "mtllib folded.mtl\nusemtl skin\n";
    for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) {
            text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string((x * y) % 3) + "\n";
            text += "vt " + std::to_string(x / 150.0) + " " + std::to_string(y / 150.0) + "\n";
        }
    }
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int a = y * (kSide + 1) + x + 1, b = a + kSide + 1;
            for (const int corner : {a, a + 1, b + 1, b})
                text += (corner == a ? "f " : " ") + std::to_string(corner) + "/" + std::to_string(corner);
            text += "\n";
        }
    }
    folder.write("grid.obj", text);
    EXPECT_EQ(runTool(folder, "generate grid.obj --all -q -o grid.glb").exit_code, 0);
}

ToolRun runWithin(const TempFolder& folder, const std::string& arguments, std::uint64_t kilobytes) {
    return runTool(folder, arguments,
                   "ulimit -c 0; ulimit -v " + std::to_string(kilobytes) + " || exit 99; timeout -s KILL 20");
}

/// Runs a command within each limit. It must end as without a limit or with exit code 5, one line, and no output.
void sweep(const TempFolder& folder, const std::string& arguments) {
    const std::set<std::string> inputs = folder.files();
    const ToolRun unlimited = runTool(folder, arguments);
    if (unlimited.exit_code > 1) {
        EXPECT_NE(unlimited.err.find("not built with"), std::string::npos) << arguments << ": " << unlimited.err;
        return;
    }
    const auto removeOutputs = [&] {
        for (const std::string& name : folder.files())
            if (!inputs.contains(name)) std::filesystem::remove(folder.path(name));
    };
    constexpr std::uint64_t kLeast = 16, kMost = 256;
    for (std::uint64_t megabytes = kLeast; megabytes <= kMost; megabytes += TSPACE_LIMIT_STEP) {
        removeOutputs();
        const ToolRun run = runWithin(folder, arguments, megabytes << 10);
        const std::string where = arguments + ", " + std::to_string(megabytes) + " MB: " + run.err;
        if (run.exit_code == unlimited.exit_code) continue;
        EXPECT_EQ(run.exit_code, 5) << where;
        EXPECT_NE(run.err.find("memory"), std::string::npos) << where;
        EXPECT_EQ(folder.files(), inputs) << where;
    }
    removeOutputs();
}

TEST(ScarceAddresses, EndNoCommandBySignalOrHang) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    writeGrid(folder);
    EXPECT_EQ(runTool(folder, "compress-map bump.png -q -o bump.ktx2").exit_code, 0);
    for (const char* command :
         {"generate grid.glb --overwrite --all --jobs 1 -o new.glb", "generate grid.obj --all -o new.glb",
          "generate grid.glb --overwrite --method best --threads 8 -o new.glb", "check grid.glb", "inspect grid.glb",
          "identify grid.glb", "diff grid.glb grid.glb", "flip-green bump.png -o new.png",
          "convert-map bump.png --mesh grid.glb --to object -o new.png", "convert-map bump.ktx2 -o new.png",
          "height-to-normal bump.png -o new.png", "compress-map bump.png -o new.ktx2",
          "render grid.glb --size 64 -o new.png", "bake grid.glb --high grid.glb --size 16 --maps normal,ao -o new.png",
          "finish grid.obj -o new.glb", "map-error bump.png grid.glb --high grid.glb"})
        sweep(folder, command);
}

}  // namespace
}  // namespace tspace::test
