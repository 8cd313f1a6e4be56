// SPDX-License-Identifier: MIT
// Signals at random times during each command: the command ends immediately, with all outputs or none, and leaves no
// temporary file.
#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <random>
#include <thread>

#include "support/grid_obj.h"
#include "tool/run_tool.h"
#include "tool/started_tool.h"

namespace tspace::test {
namespace {

namespace fs = std::filesystem;

double secondsOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Returns an uncompressed TGA whose texels are vectors near (0, 0, 1).
std::string mapOf(unsigned side) {
    std::string tga(18, '\0');
    tga[2] = 2;
    tga[12] = tga[14] = static_cast<char>(side & 255);
    tga[13] = tga[15] = static_cast<char>(side >> 8);
    tga[16] = 24;
    for (unsigned i = 0; i < side * side; ++i) {
        tga += static_cast<char>(250);
        tga += static_cast<char>(128 + i % 37 - 18);
        tga += static_cast<char>(128 + i / side % 41 - 20);
    }
    return tga;
}

void writeInputs(const TempFolder& folder) {
    folder.write("skin.mtl", "newmtl skin\nmap_Bump map.tga\n");
    folder.write("low.obj", "mtllib skin.mtl\n" + gridObj(8, 0, "usemtl skin\n"));
    folder.write("high.obj", "mtllib skin.mtl\n" + gridObj(150, 0.01, "usemtl skin\n"));
    folder.write("map.tga", mapOf(512));
    folder.write("small.tga", mapOf(64));
    folder.write("pairs.txt", "low.obj = high.obj\nlow.obj = high.obj = other.png\n");
    EXPECT_EQ(runTool(folder, "generate high.obj -q --all -o high.glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate high.obj -q --all --method angle -o angle.glb").exit_code, 0);
}

std::set<std::string> entriesOf(const TempFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        names.insert(entry.path().lexically_relative(folder.path()).string());
    return names;
}

std::vector<std::string> wordsOf(const std::string& command) {
    std::istringstream text(command);
    return {std::istream_iterator<std::string>(text), {}};
}

TEST(Signals, EndEveryCommandWithinASecondAtAnyMoment) {
    const TempFolder folder;
    writeInputs(folder);
    const std::set<std::string> inputs = entriesOf(folder);
    const auto removeOutputs = [&] {
        for (const std::string& name : entriesOf(folder)) {
            if (!inputs.contains(name)) fs::remove_all(folder.path(name));
        }
    };
    int number = 0;
    for (const char* command :
         {"generate high.obj --all --normals best -o new/a.glb", "generate high.glb high.obj --overwrite -o new/",
          "bake low.obj --high high.obj --size 512 --heat new/h.png --report new/r.json -o new/n.png",
          "bake --pairs pairs.txt --size 128 -o new/", "finish high.obj --html new/a.html -o new/a.glb",
          "finish high.obj --low low.obj --size 128 -o new/a.glb",
          "map-error map.tga low.obj --high high.obj --heat new/h.png",
          "check high.glb --html new/a.html --sarif new/a.sarif", "inspect high.glb angle.glb --json",
          "identify high.glb angle.glb", "diff high.glb angle.glb --html new/a.html",
          "render high.glb --size 1024 -o new/a.png", "convert-map map.tga --mesh high.glb --to object -o new/a.png",
          "height-to-normal map.tga -o new/a.png", "compress-map map.tga -o new/a.ktx2",
          "compress-map map.tga --roughness small.tga -o new/p/ -o2 new/r/", "flip-green map.tga -o new/a.png",
          "view high.glb -o new/a.html"}) {
        int code = 0;
        const double whole = secondsOf([&] { code = StartedTool(folder.path(), wordsOf(command)).end(); });
        const std::set<std::string> outputs = entriesOf(folder);
        removeOutputs();
        if (code > 1) {
            // This build lacks a feature that the command needs.
            EXPECT_NE(runTool(folder, command).err.find("this build"), std::string::npos) << command;
            continue;
        }
        std::mt19937 random(static_cast<unsigned>(++number));
        for (int i = 0; i < TSPACE_SIGNALS_PER_COMMAND; ++i) {
            const double wait = std::uniform_real_distribution<>(0, whole)(random);
            const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
            // Measure the load: other programs on this machine slow the command down.
            const double load = secondsOf([&] { StartedTool(folder.path(), {"--version"}).end(); });
            StartedTool tool(folder.path(), wordsOf(command));
            std::this_thread::sleep_for(std::chrono::duration<double>(wait));
            const auto [end, seconds] = tool.endBy(signal);
            EXPECT_LT(seconds, 1 + 10 * load) << command << " after " << wait;
            EXPECT_TRUE(end == 128 + signal || end == code) << command << " after " << wait << ": " << end;
            const std::set<std::string> left = entriesOf(folder);
            const bool is_batch = std::string(command).find("pairs") != std::string::npos ||
                                  std::string(command).find("high.glb high.obj") != std::string::npos;
            if (is_batch) {
                for (const std::string& name : left) EXPECT_TRUE(outputs.contains(name)) << command << ": " << name;
            } else {
                EXPECT_EQ(left, end == code ? outputs : inputs) << command << " after " << wait << ": " << end;
            }
            removeOutputs();
        }
    }
}

TEST(Signals, AfterTheOutputsAreInPlaceLetTheReportBeWritten) {
    const TempFolder folder;
    writeInputs(folder);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT}) {
        const ToolRun run = runTool(folder, "bake low.obj --high low.obj --size 16 -o new/n.png --report new/r.json",
                                    "exec env --default-signal TSPACE_SIGNAL_AFTER_COMMIT=" + std::to_string(signal) +
                                        " LD_PRELOAD='" TSPACE_FAILING_CALLS "'");
        if (run.err.find("built") != std::string::npos) GTEST_SKIP() << run.err;
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out, "");
        EXPECT_EQ(folder.files("new"), (std::set<std::string>{"n.png", "r.json"}));
        fs::remove_all(folder.path("new"));
    }
}

TEST(Signals, EndABatchDuringALaterFile) {
    const TempFolder folder;
    writeInputs(folder);
    if (!fs::exists(fs::path(TSPACE_TOOL).parent_path() / "tspace-import")) GTEST_SKIP() << "no importer was built";
    // These 58 bytes keep Assimp 5 busy for minutes.
    folder.write("endless.ply", "ply\nformat ascii 1.0\nelement vertex 2147483647\nend_header\n");
    for (const int signals : {1, 2}) {
        StartedTool tool(folder.path(),
                         wordsOf("generate high.glb endless.ply --import-seconds 100 --overwrite --jobs 1 "
                                 "-o new/ --manifest done.jsonl"));
        while (!folder.read("done.jsonl").ends_with('\n')) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        if (signals == 2) tool.send(SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const auto [code, seconds] = tool.endBy(signals == 2 ? SIGINT : SIGTERM);
        EXPECT_EQ(code, 128 + SIGTERM);
        EXPECT_LT(seconds, signals == 2 ? 0.4 : 3.0);
        EXPECT_EQ(folder.files("new"), std::set<std::string>{"high.glb"});
        fs::remove_all(folder.path("new"));
        fs::remove(folder.path("done.jsonl"));
    }
}

}  // namespace
}  // namespace tspace::test
