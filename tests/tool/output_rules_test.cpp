// SPDX-License-Identifier: MIT
// Outputs that conflict with each other or with files that models reference; names that are too long or not UTF-8;
// reports that cannot be written; dry runs.
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <set>
#include <tuple>

#include "model/io/atomic_output.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> treeOf(const TempFolder& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
        const std::string name = entry.path().lexically_relative(folder.path()).string();
        contents[name] = entry.is_regular_file() ? folder.read(name) : std::string();
    }
    return contents;
}

/// Returns the JSON of a triangle. `buffer`, `image`: names of the files that it references; without an image there is
/// no normal map.
std::string triangle(const std::string& buffer, const std::string& image = "") {
    const std::string material =
        image.empty() ? ""
                      : R"("images":[{"uri":")" + image +
                            R"("}],"textures":[{"source":0}],"materials":[{"normalTexture":{"index":0}}],)";
    return R"({"asset":{"version":"2.0"},)" + material + R"("buffers":[{"byteLength":60,"uri":")" + buffer +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],"accessors":[
        {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[3,3,0]},
        {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],"meshes":[{"primitives":[{"attributes":{
        "POSITION":0,"TEXCOORD_0":1})" +
           (image.empty() ? "" : R"(,"material":0)") +
           R"(}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})";
}

/// Returns the buffer of the triangle: positions 0 0 0, x 0 0 and 0 x 0, and UVs. x depends on `byte`: it is 2.5 for
/// 0x40.
std::string triangleBytes(char byte = '\x40') {
    std::string buffer(60, '\0');
    buffer[15] = buffer[31] = byte;
    buffer[14] = buffer[30] = '\x20';
    buffer[47] = buffer[59] = '\x3f';
    return buffer;
}

TEST(LongNames, InAModelAreBadInput) {
    const TempFolder folder;
    writeBumpMap(folder);
    folder.write("a.bin", triangleBytes());
    std::string deep;
    for (int i = 0; i < 30; ++i) deep += std::string(200, 'b') + "/";
    for (const auto& [buffer, image, place] :
         {std::tuple(std::string(300, 'n') + ".bin", std::string("bump.png"), "/buffers/0/uri"),
          {deep + "a.bin", "bump.png", "/buffers/0/uri"},
          {deep + "./a.bin", "bump.png", "/buffers/0/uri"}}) {
        folder.write("a.gltf", triangle(buffer, image));
        const auto before = treeOf(folder);
        for (const char* command :
             {"check a.gltf", "check a.gltf --html a.html --allow-external", "inspect a.gltf", "identify a.gltf",
              "diff a.gltf a.gltf", "generate a.gltf -o x.glb", "generate a.gltf -o sub/x.gltf",
              "generate a.gltf -o x.glb --allow-external", "generate a.gltf -o x.glb --dry-run",
              "generate --in-place a.gltf", "generate a.gltf -o x.glb --repair", "render a.gltf -o a.png",
              "bake a.gltf --high a.gltf -o n.png", "convert-map bump.png --mesh a.gltf --to object -o n.png",
              "height-to-normal bump.png --mesh a.gltf -o n.png"}) {
            const ToolRun run = runTool(folder, std::string(command) + " -q");
            EXPECT_EQ(run.exit_code, 3) << command << run.err;
            EXPECT_EQ(run.errorLines(), 1) << command << run.err;
            EXPECT_LT(run.err.size(), 500U) << command << run.err;
            EXPECT_NE(run.err.find(place), std::string::npos) << command << run.err;
            fs::remove(folder.path("a.html"));
            EXPECT_TRUE(treeOf(folder) == before) << command;
        }
    }
    // The geometry is complete even if the image cannot be read.
    for (const std::string& image : {std::string(300, 'n') + ".png", deep + "bump.png"}) {
        folder.write("a.gltf", triangle("a.bin", image));
        for (const char* command : {"check a.gltf", "inspect a.gltf", "generate a.gltf -o x.glb"}) {
            const ToolRun run = runTool(folder, command);
            EXPECT_EQ(run.exit_code, 0) << command << run.err;
            EXPECT_EQ(run.err, "") << command;
        }
    }
}

TEST(LongNames, OnTheCommandLineCannotBeReadOrWritten) {
    const TempFolder folder;
    writeBumpMap(folder);
    folder.write("a.bin", triangleBytes());
    folder.write("a.gltf", triangle("a.bin", "bump.png"));
    ASSERT_EQ(runTool(folder, "generate a.gltf -q -o a.glb").exit_code, 0);
    std::string deep;
    for (int i = 0; i < 30; ++i) deep += std::string(200, 'b') + "/";
    for (const std::string& name : {std::string(300, 'n'), deep + "n", std::string(300, 'n') + "/n"}) {
        const auto before = treeOf(folder);
        for (const auto& [begin, end] : {std::pair("check ", ".glb"),
                                         {"inspect ", ".gltf"},
                                         {"identify ", ".obj"},
                                         {"diff a.glb ", ".glb"},
                                         {"diff a.glb a.glb --html ", ""},
                                         {"check a.glb --html ", ""},
                                         {"check a.glb --sarif ", ""},
                                         {"generate -o x.glb ", ".glb"},
                                         {"generate a.glb -o ", ".glb"},
                                         {"generate a.glb -o ", ".gltf"},
                                         {"generate a.glb -o ", "/"},
                                         {"generate --in-place ", ".glb"},
                                         {"generate a.glb -o x.glb --manifest ", ""},
                                         {"generate a.glb -o x.glb --resume --manifest ", ""},
                                         {"render a.glb -o ", ".png"},
                                         {"bake -o n.png a.glb --high ", ".glb"},
                                         {"bake a.glb --high a.glb --size 4 -o ", ".png"},
                                         {"bake a.glb --high a.glb --size 4 -o n.png --heat ", ".png"},
                                         {"bake a.glb --high a.glb --size 4 -o n.png --out-mesh ", ".glb"},
                                         {"convert-map bump.png --to object --mesh a.glb -o ", ".png"},
                                         {"convert-map --to object --mesh a.glb -o n.png ", ".png"},
                                         {"flip-green --in-place ", ".png"},
                                         {"flip-green bump.png -o ", ".png"},
                                         {"height-to-normal bump.png -o ", ".png"}}) {
            const std::string command = begin + name + end;
            const ToolRun run = runTool(folder, command + " -q");
            EXPECT_EQ(run.exit_code, 4) << begin << end << run.exit_code << run.err;
            EXPECT_EQ(run.errorLines(), 1) << begin << end << run.err;
            EXPECT_TRUE(treeOf(folder) == before) << begin << end;
        }
    }
}

TEST(NamesThatAreNotUtf8, AreKnownToTheManifest) {
    const TempFolder folder;
    const std::string data = triangleBytes();
    // The first two names are equal once invalid bytes are replaced. The third one equals the percent-encoding of the
    // first.
    for (const char* name : {"b\xff", "b\xfe", "b%FF"}) {
        folder.write(std::string("in/") + name + ".bin", data);
        std::string uri = name;
        if (uri == "b\xff")
            uri = "b%FF";
        else if (uri == "b\xfe")
            uri = "b%FE";
        else
            uri = "b%25FF";
        folder.write(std::string("in/") + name + ".gltf", triangle(uri + ".bin"));
    }
    ASSERT_EQ(runTool(folder, "generate in -q --all -o out/ --manifest m.jsonl").exit_code, 0);
    const std::string first = folder.read("m.jsonl");
    EXPECT_NE(first.find(R"("inputEncoded":"in/b%FF.gltf")"), std::string::npos) << first;
    ToolRun again = runTool(folder, "generate in --all -o out/ --manifest m.jsonl --resume");
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(folder.read("m.jsonl"), first) << again.out;
    // Only the file that has changed is processed again.
    folder.write("in/b\xfe.bin", triangleBytes('\x41'));
    again = runTool(folder, "generate in -q --all -o out/ --manifest m.jsonl --resume");
    EXPECT_EQ(again.exit_code, 4) << again.err;  // out/ contains the old output
    fs::remove_all(folder.path("out"));
    ASSERT_EQ(runTool(folder, "generate in -q --all -o out/ --manifest m.jsonl --resume").exit_code, 0);
    const std::string second = folder.read("m.jsonl");
    folder.write("in/b\xff.bin", triangleBytes('\x41'));
    fs::remove(folder.path("out/b\xff.bin"));
    ASSERT_EQ(runTool(folder, "generate in -q --all -o out/ --manifest m.jsonl --resume").exit_code, 0);
    const std::string added = folder.read("m.jsonl").substr(second.size());
    EXPECT_EQ(std::count(added.begin(), added.end(), '\n'), 1) << added;
    EXPECT_NE(added.find(R"("inputEncoded":"in/b%FF.gltf")"), std::string::npos) << added;
}

TEST(Reports, CreateMissingFolders) {
    const TempFolder folder;
    folder.write("a.bin", triangleBytes());
    folder.write("a.gltf", triangle("a.bin"));
    ASSERT_EQ(runTool(folder, "generate a.gltf -q --all -o a.glb").exit_code, 0);
    for (const auto& [command, file] :
         {std::pair("check a.glb -q --html r/s/a.html", "r/s/a.html"),
          {"check a.glb -q --sarif r/s/a.sarif", "r/s/a.sarif"},
          {"diff a.glb a.glb -q --html r/s/d.html", "r/s/d.html"},
          {"generate a.glb -q -o x.glb --manifest r/s/m.jsonl", "r/s/m.jsonl"},
          {"bake a.glb --high a.glb -q --size 4 -o n.png --report r/s/b.json", "r/s/b.json"},
          {"bake a.glb --high a.glb -q --size 4 -o n.png --heat r/s/h.png", "r/s/h.png"}}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_EQ(run.exit_code, 0) << command << run.err;
        EXPECT_FALSE(folder.read(file).empty()) << command;
        fs::remove_all(folder.path("r"));
    }
}

TEST(Reports, UnwritableReportsAffectNothingElse) {
    const TempFolder folder;
    folder.write("a.bin", triangleBytes());
    folder.write("a.gltf", triangle("a.bin"));
    folder.write("file", "");
    ASSERT_EQ(runTool(folder, "generate a.gltf -q --all -o a.glb").exit_code, 0);
    // The errors are represented by a folder that cannot be created.
    const std::string bake = "bake a.glb --high a.glb -q --size 4 ";
    struct Case {
        std::string command;
        std::set<std::string> made;
        bool report_has_failure = false;
    };
    for (const Case& one :
         {Case{bake + "-o n.png --report file/r", {"n.png"}},
          Case{bake + "-o n.png --out-mesh m.glb --report file/r", {"m.glb", "n.png"}},
          Case{bake + "-o file/n.png --report r", {"r"}, true},
          Case{bake + "-o n.png --heat file/h.png --report r", {"r"}, true},
          Case{bake + "-o n.png --misses file/h.png --report r", {"r"}, true},
          Case{bake + "-o n.png --out-mesh file/m.glb --report r", {"r"}, true},
          Case{bake + "-o file/n.png --report file/r", {}}, Case{"check a.glb -q --html file/h --sarif r", {"r"}, true},
          Case{"check a.glb -q --html h --sarif file/r", {"h"}}, Case{"diff a.glb a.glb -q --html file/h", {}},
          Case{"generate a.gltf --all -q -o file/x.glb --manifest r", {"r"}, true},
          Case{"generate a.gltf --all -q -o file/x.gltf --manifest r", {"r"}, true}}) {
        const auto before = treeOf(folder);
        const ToolRun run = runTool(folder, one.command);
        EXPECT_EQ(run.exit_code, 4) << one.command << run.err;
        EXPECT_GE(run.errorLines(), 1) << one.command;
        std::set<std::string> made;
        for (const auto& [name, bytes] : treeOf(folder)) {
            if (!before.contains(name)) made.insert(name);
        }
        EXPECT_EQ(made, one.made) << one.command;
        if (one.report_has_failure) {
            const std::string report = folder.read("r");
            const bool says_so = report.find("\"ok\": false") != std::string::npos ||
                                 report.find("\"ok\":false") != std::string::npos ||
                                 report.find("\"exitCode\": 4") != std::string::npos;
            EXPECT_TRUE(says_so) << one.command << report;
        }
        for (const std::string& name : made) fs::remove(folder.path(name));
    }
}

TEST(OneRun, WritesNoTwoFilesOfOneName) {
    // a.gltf requires a copy of its shared.bin. shared.glb is split into shared.gltf and another shared.bin.
    for (const char* order : {"p/a.gltf q/shared.glb", "q/shared.glb p/a.gltf"}) {
        const TempFolder folder;
        folder.write("p/shared.bin", triangleBytes());
        folder.write("p/a.gltf", triangle("shared.bin"));
        folder.write("q/c.bin", triangleBytes('\x41'));
        folder.write("q/c.gltf", triangle("c.bin"));
        ASSERT_EQ(runTool(folder, "generate q/c.gltf --all -q -o q/shared.glb").exit_code, 0);
        for (const bool is_there : {false, true}) {
            fs::remove_all(folder.path("o"));
            if (is_there) folder.write("o/shared.bin", triangleBytes());  // the same contents as p/shared.bin
            const ToolRun run = runTool(folder, std::string("generate -q -o o/ --container gltf --jobs 1 ") + order);
            EXPECT_EQ(run.exit_code, 4) << order << is_there << run.err;
            EXPECT_EQ(run.errorLines(), 1) << run.err;
            const bool has_a = folder.has("o/a.gltf");
            ASSERT_NE(has_a, folder.has("o/shared.gltf")) << run.err;
            if (has_a) {
                EXPECT_EQ(folder.read("o/shared.bin"), folder.read("p/shared.bin")) << order;
            } else {
                EXPECT_NE(folder.read("o/shared.bin"), folder.read("p/shared.bin")) << order;
            }
        }
    }
}

TEST(OneRun, ChangesUnsharedFilesInPlace) {
    for (const char* order : {"a.gltf b.gltf", "b.gltf a.gltf", "a.gltf b.gltf --jobs 2"}) {
        const TempFolder folder;
        folder.write("x.bin", triangleBytes());
        folder.write("x.gltf", triangle("x.bin"));
        // Both models refer to a.tspace.bin, which is also the name of the buffer that a new a.gltf gets.
        ASSERT_EQ(runTool(folder, "generate x.gltf -q --all -o a.gltf").exit_code, 0);
        ASSERT_TRUE(folder.has("a.tspace.bin"));
        folder.write("b.gltf", folder.read("a.gltf"));
        const auto before = treeOf(folder);
        const ToolRun run = runTool(folder, std::string("generate --in-place -q --overwrite --all --method area --pack "
                                                        "frame32 --bitangents ") +
                                                order);
        if (treeOf(folder).at("a.tspace.bin") != before.at("a.tspace.bin")) {
            EXPECT_EQ(run.exit_code, 4) << order << run.err;
        }
        // Both models match their buffers: all data that the JSON declares can be read.
        for (const char* model : {"a.gltf", "b.gltf"}) {
            const ToolRun check = runTool(folder, std::string("check -q ") + model);
            EXPECT_LE(check.exit_code, 1) << order << model << check.err;
        }
    }
}

TEST(OneRun, ProcessesARepeatedModelOnce) {
    const TempFolder folder;
    folder.write("x.bin", triangleBytes());
    folder.write("x.gltf", triangle("x.bin"));
    ASSERT_EQ(runTool(folder, "generate x.gltf -q --all -o in/a.glb").exit_code, 0);
    const ToolRun run =
        runTool(folder, "generate in in/a.glb in/../in/a.glb --in-place --overwrite --method area -q --json");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out.find("\"input\""), run.out.rfind("\"input\"")) << run.out;
}

TEST(ReferencedFiles, AreInputsEvenIfTheyAreNotRead) {
    const TempFolder folder;
    writeBumpMap(folder);
    folder.write("height.png", folder.read("bump.png"));
    folder.write("named.png", folder.read("bump.png"));
    folder.write("a.bin", triangleBytes());
    folder.write("named.html", folder.read("bump.png"));
    folder.write("a.gltf", triangle("a.bin", "named.png"));
    folder.write("page.gltf", triangle("a.bin", "named.html"));
    ASSERT_EQ(runTool(folder, "generate a.gltf -q -o b.glb").exit_code, 0);
    const auto before = treeOf(folder);
    for (const char* command :
         {"convert-map bump.png --mesh a.gltf --to object -o named.png",
          "convert-map bump.png --mesh b.glb --to-mesh a.gltf -o named.png",
          "height-to-normal height.png --mesh a.gltf -o named.png",
          "bake b.glb --high a.gltf --size 4 -o n.png --heat named.png",
          "bake a.gltf --high b.glb --size 4 -o n.png --misses named.png", "render a.gltf -o named.png",
          "diff page.gltf b.glb --html named.html", "check page.gltf --html named.html", "check a.gltf --sarif a.bin",
          "map-error bump.png a.gltf --high b.glb --heat named.png"}) {
        const ToolRun run = runTool(folder, command + std::string(" -q"));
        EXPECT_EQ(run.exit_code, 4) << command << run.exit_code << run.err;
        EXPECT_NE(run.err.find("it is an input"), std::string::npos) << command << run.err;
        EXPECT_TRUE(treeOf(folder) == before) << command;
    }
    // A file that does not exist yet may be written: a model may refer to the map that is to be baked for it.
    folder.write("c.gltf", triangle("a.bin", "new.png"));
    EXPECT_EQ(runTool(folder, "bake c.gltf --high b.glb -q --size 4 -o new.png").exit_code, 0);
}

TEST(ReferencedFiles, MayBeReplacedByABakeThatDoesNotReadThem) {
    const TempFolder folder;
    writeBumpMap(folder);
    folder.write("named.png", folder.read("bump.png"));
    folder.write("a.bin", triangleBytes());
    folder.write("a.gltf", triangle("a.bin", "named.png"));
    ASSERT_EQ(runTool(folder, "generate a.gltf -q -o b.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "bake b.glb --high b.glb -q --ignore-high-maps --size 4 -o fresh.png").exit_code, 0);
    fs::create_symlink("named.png", folder.path("link.png"));
    for (const char* command : {"bake a.gltf --high b.glb -o named.png", "bake a.gltf --high b.glb -o ./link.png",
                                "bake b.glb --high a.gltf -o named.png"}) {
        folder.write("named.png", folder.read("bump.png"));
        const ToolRun run = runTool(folder, command + std::string(" -q --ignore-high-maps --size 4"));
        EXPECT_EQ(run.exit_code, 0) << command << run.err;
        EXPECT_EQ(folder.read("named.png"), folder.read("fresh.png")) << command;
    }
    // Bake again over the map that was baked before.
    EXPECT_EQ(runTool(folder, "bake a.gltf --high b.glb -q --ignore-high-maps --size 4 -o named.png").exit_code, 0);
    EXPECT_EQ(folder.read("named.png"), folder.read("fresh.png"));
    // No other output may replace the file, even if the command also writes a map that may.
    for (const char* command : {"bake a.gltf --high b.glb -o n.png --report named.png",
                                "bake a.gltf --high b.glb -o n.png --heat named.png --misses named.png",
                                "bake a.gltf --high b.glb -o named.png --heat link.png",
                                "bake a.gltf --high b.glb -o named.png --misses named.png",
                                "bake a.gltf --high b.glb -o named.png --report named.png",
                                // Writing a model copies its images.
                                "bake a.gltf --high b.glb -o named.png --out-mesh new/new.gltf"}) {
        folder.write("named.png", folder.read("bump.png"));
        const ToolRun run = runTool(folder, command + std::string(" -q --size 4"));
        EXPECT_NE(run.exit_code, 0) << command;
        EXPECT_EQ(folder.read("named.png"), folder.read("bump.png")) << command;
    }
}

TEST(DryRuns, CreateAndRemoveNothing) {
    const TempFolder folder;
    writeBumpMap(folder);
    folder.write("a.bin", triangleBytes());
    folder.write("a.gltf", triangle("a.bin", "bump.png"));
    ASSERT_EQ(runTool(folder, "generate a.gltf -q -o a.glb").exit_code, 0);
    fs::create_directory(folder.path("sub"));
    leaveTemporaryFile(folder, "sub/n.png");
    leaveTemporaryFile(folder, "n.png");
    ASSERT_EQ(folder.files("sub").size(), 1U);
    for (const char* command :
         {"convert-map bump.png --mesh a.glb --to object -o sub/n.png", "height-to-normal bump.png -o sub/n.png",
          "flip-green bump.png -o sub/n.png", "render a.glb -o sub/n.png", "generate a.glb -o sub/n.glb",
          "convert-map bump.png --mesh a.glb --to object -o new/n.png", "height-to-normal bump.png -o new/n.png",
          "height-to-normal bump.png -o n.png", "flip-green bump.png -o new/n.png", "render a.glb -o new/n.png"}) {
        const auto before = treeOf(folder);
        EXPECT_EQ(runTool(folder, std::string(command) + " -q --dry-run").exit_code, 0) << command;
        EXPECT_TRUE(treeOf(folder) == before) << command;
    }
    fs::create_symlink("a.glb", folder.path("link.png"));
    EXPECT_EQ(runTool(folder, "render a.glb -o link.png --dry-run").exit_code, 2) << "what the run would refuse";
    ASSERT_EQ(runTool(folder, "height-to-normal bump.png -q -o sub/n.png").exit_code, 0);
    EXPECT_EQ(folder.files("sub").size(), 1U) << "the run tidies";
}

}  // namespace
}  // namespace tspace::test
