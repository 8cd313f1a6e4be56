// SPDX-License-Identifier: MIT
// The tool with limited address space (ulimit -v): each command succeeds or reports that it is out of memory.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "support/grid_obj.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// Writes a wavy grid; the default is large enough for helper threads and arenas.
void writeGrid(const TempFolder& folder, int columns = 150) {
    folder.write("grid.obj", "mtllib folded.mtl\n" + gridObj(columns, 0.01, "usemtl skin\n"));
    EXPECT_EQ(runTool(folder, "generate grid.obj --all -q -o grid.glb").exit_code, 0);
}

/// Runs a copy of the tool, next to which there is a page for tspace view.
constexpr const char* kCopy = R"(sh -c 'exec ./bin/tspace "$@"')";

void installCopy(const TempFolder& folder) {
    folder.write("share/tspace/view.html", "<body><!-- model --></body>");
    std::filesystem::create_directories(folder.path("bin"));
    std::filesystem::copy_file(TSPACE_TOOL, folder.path("bin/tspace"));
}

ToolRun runWithin(const TempFolder& folder, const std::string& arguments, std::uint64_t kilobytes) {
    return runTool(folder, arguments,
                   "ulimit -c 0; ulimit -v " + std::to_string(kilobytes) + " || exit 99; timeout -s KILL 20 " + kCopy);
}

/// Runs a command with each limit. It must end as without a limit, or with exit code 5, a message of one line, and no
/// output.
void sweep(const TempFolder& folder, const std::string& arguments, std::uint64_t least = 16, std::uint64_t most = 256,
           std::uint64_t step = TSPACE_LIMIT_STEP) {
    const std::set<std::string> inputs = folder.files();
    const ToolRun unlimited = runTool(folder, arguments, kCopy);
    if (unlimited.exit_code > 1) {
        EXPECT_NE(unlimited.err.find("not built with"), std::string::npos) << arguments << ": " << unlimited.err;
        return;
    }
    const auto removeOutputs = [&] {
        for (const std::string& name : folder.files())
            if (!inputs.contains(name)) std::filesystem::remove(folder.path(name));
    };
    for (std::uint64_t megabytes = least; megabytes <= most; megabytes += step) {
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
    installCopy(folder);
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
          "finish grid.obj -o new.glb", "map-error bump.png grid.glb --high grid.glb", "view grid.glb -o new.html",
          "check bump.png"})
        sweep(folder, command);
}

/// Embree's threads wait for each other forever if memory runs out while several of them build the hierarchy.
TEST(ScarceAddresses, EndNoSearchForSurfacesByAHangOnManyThreads) {
    const TempFolder folder;
    installCopy(folder);
    writeBumpMap(folder);
    writeGrid(folder, 20);
    sweep(folder, "map-error bump.png grid.glb --high grid.glb --threads 12", 84, 130, 2);
}

}  // namespace
}  // namespace tspace::test
