// SPDX-License-Identifier: MIT
// Outputs whose paths already exist as inputs, links, pipes or devices; and programs without standard file descriptors.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <map>
#include <sstream>

#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

namespace fs = std::filesystem;

/// Writes plain.glb and made.glb, and separate.gltf with separate.bin and bump.png.
void writeModels(const TempFolder& folder) {
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate folded.obj -q -o plain.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "generate plain.glb -q --overwrite --method angle -o made.glb").exit_code, 0);
    ASSERT_EQ(runTool(folder, "generate folded.obj -q -o separate.gltf").exit_code, 0);
}

std::map<std::string, std::string> contentsOf(const TempFolder& folder) {
    std::map<std::string, std::string> contents;
    for (const std::string& name : folder.files()) contents[name] = folder.read(name);
    return contents;
}

TEST(Outputs, NeverReplaceAnInput) {
    const TempFolder folder;
    writeModels(folder);
    fs::create_directory(folder.path("sub"));
    fs::create_symlink("plain.glb", folder.path("link.png"));
    fs::create_symlink("plain.glb", folder.path("link.html"));
    fs::create_hard_link(folder.path("plain.glb"), folder.path("hard.html"));
    fs::create_symlink("bump.png", folder.path("map.png"));
    const auto before = contentsOf(folder);
    std::string bin;
    for (const auto& [name, bytes] : before) {
        if (name.ends_with(".bin")) bin = name;
    }
    ASSERT_FALSE(bin.empty());
    for (const std::string& command :
         {std::string("check plain.glb --html plain.glb"),
          std::string("check plain.glb --html sub/../plain.glb"),
          std::string("check plain.glb --html link.html"),
          std::string("check plain.glb --html hard.html"),
          std::string("check . --html plain.glb"),
          std::string("check plain.glb --sarif plain.glb"),
          "check separate.gltf --html " + bin,
          "check separate.gltf --sarif " + bin,
          std::string("check separate.gltf --html bump.png"),
          std::string("diff plain.glb made.glb --html plain.glb"),
          std::string("diff plain.glb made.glb --html made.glb"),
          "diff separate.gltf made.glb --html " + bin,
          std::string("generate plain.glb -o new.glb --manifest plain.glb"),
          std::string("generate plain.glb -o new.glb --manifest made.glb"),
          std::string("generate plain.glb -o new.glb --manifest bump.png"),
          std::string("render plain.glb -o link.png"),
          std::string("render separate.gltf -o bump.png"),
          std::string("render separate.gltf -o map.png"),
          std::string("convert-map bump.png --mesh plain.glb -o link.png --from gltf --to directx"),
          std::string("convert-map bump.png -o map.png --from gltf --to directx"),
          std::string("map-error bump.png --low plain.glb --high made.glb --heat link.png"),
          std::string("bake plain.glb --high made.glb -o link.png"),
          std::string("bake plain.glb --high made.glb -o n.png --report plain.glb"),
          std::string("bake plain.glb --high made.glb -o n.png --heat link.png"),
          std::string("view plain.glb -o plain.glb"),
          std::string("flip-green bump.png -o map.png")}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_TRUE(run.exit_code == 2 || run.exit_code == 4) << command << ": " << run.exit_code << run.err;
        EXPECT_EQ(run.errorLines(), 1) << command << ": " << run.err;
        EXPECT_TRUE(contentsOf(folder) == before) << command;
    }
}

TEST(Outputs, AReportNeverReplacesAnInputOfTheBake) {
    const TempFolder folder;
    writeModels(folder);
    std::string bin;
    for (const std::string& name : folder.files()) {
        if (name.ends_with(".bin")) bin = name;
    }
    ASSERT_FALSE(bin.empty());
    fs::create_symlink(bin, folder.path("link.json"));
    const auto before = contentsOf(folder);
    for (const std::string& command :
         {"plain.glb --high separate.gltf --report " + bin, "separate.gltf --high plain.glb --report " + bin,
          std::string("plain.glb --high separate.gltf --report link.json"),
          std::string("folded.obj --high plain.glb --report folded.mtl"),
          std::string("plain.glb --high folded.obj --report folded.mtl"),
          "plain.glb --high made.glb --cage separate.gltf --report " + bin}) {
        const ToolRun run = runTool(folder, "bake " + command + " -q --size 16 -o n.png");
        EXPECT_EQ(run.exit_code, 2) << command << run.err;
        EXPECT_NE(run.err.find("is an input"), std::string::npos) << run.err;
        EXPECT_TRUE(contentsOf(folder) == before) << command;
    }
}

TEST(Outputs, OfParallelModelsKeepTheirOwnBuffers) {
    const TempFolder folder;
    // Two triangles that differ only in the contents of their buffers, whose files have the same name.
    for (const auto& [name, byte] : {std::pair("p/a.gltf", '\x3f'), std::pair("q/b.gltf", '\x40')}) {
        std::string buffer(36, '\0');
        buffer[15] = buffer[31] = byte;
        buffer[14] = buffer[30] = '\x20';
        const fs::path beside = fs::path(name).parent_path();
        folder.write((beside / "shared.bin").string(), buffer);
        folder.write(name, std::string(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"shared.bin"}],
            "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,
            "type":"VEC3","min":[0,0,0],"max":[3,3,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})"));
    }
    for (int round = 0; round < 20; ++round) {
        fs::remove_all(folder.path("o"));
        const ToolRun run = runTool(folder, "generate p/a.gltf q/b.gltf -q -o o/ --jobs 2");
        ASSERT_EQ(run.exit_code, 4) << run.err;
        ASSERT_NE(folder.has("o/a.gltf"), folder.has("o/b.gltf")) << run.err;
        const char* whose = folder.has("o/a.gltf") ? "p/shared.bin" : "q/shared.bin";
        ASSERT_EQ(folder.read("o/shared.bin"), folder.read(whose));
    }
}

TEST(Outputs, OfOneRunAreDifferentFiles) {
    const TempFolder folder;
    writeModels(folder);
    const auto before = contentsOf(folder);
    fs::create_directory(folder.path("sub"));
    for (const char* command :
         {"check plain.glb --html new --sarif new", "check plain.glb --html new --sarif sub/../new",
          "generate plain.glb -o new.glb --manifest new.glb", "generate plain.glb -o new.glb --manifest ./new.glb",
          "bake plain.glb --high made.glb -o new.png --heat new.png",
          "bake plain.glb --high made.glb -o new.png --report sub/../new.png"}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_EQ(run.exit_code, 2) << command << run.err;
        EXPECT_TRUE(contentsOf(folder) == before) << command;
    }
}

TEST(Outputs, WithDerivedNamesReplaceNoReportAndNoManifest) {
    const TempFolder folder;
    writeModels(folder);
    folder.write("two.obj",
                 "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                 "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n");
    folder.write("two.mtl", "newmtl a\nnewmtl b\n");
    struct Case {
        const char* command;
        const char* kept;
        const char* other;  ///< output that must not be written in this case
    };
    for (const Case& one : {Case{"generate plain.glb -o m.gltf --manifest m.bin", "m.bin", "m.gltf"},
                            Case{"generate folded.obj -o m.gltf --manifest m.bin", "m.bin", "m.gltf"}}) {
        for (const bool is_there : {false, true}) {
            if (!is_there) fs::remove(folder.path(one.kept));
            const ToolRun run = runTool(folder, std::string(one.command) + " -q");
            EXPECT_EQ(run.exit_code, 4) << one.command << run.err;
            EXPECT_NE(run.err.find("another output of this run is the same file"), std::string::npos)
                << one.command << run.err;
            EXPECT_EQ(folder.read(one.kept).substr(0, 1), "{") << one.command;
            EXPECT_FALSE(folder.has(one.other)) << one.command;
        }
    }
    fs::remove(folder.path("m.bin"));
    const auto before = contentsOf(folder);
    for (const char* command :
         {"bake two.obj --high two.obj --out-mesh m.gltf -o n.png --report m.bin",
          "bake two.obj --high two.obj -o n.png --report n.a.png",
          "bake two.obj --high two.obj -o n.png --maps normal,ao --report n_ao.b.png",
          "bake two.obj --high two.obj -o o.png --heat h.png --report h.b.png",
          "bake two.obj --high two.obj -o o.png --misses o_ao.png --maps normal,ao",
          "bake plain.glb --high made.glb --udim -o u.png --report u.1001.png",
          "finish two.obj --low two.obj -o f.glb --html f_normal.a.png",
          "finish two.obj --low two.obj -o f.glb --report f_ao.b.png",
          "finish made.glb --low plain.glb -o f.glb --html f_normal.png",
          "finish made.glb --low plain.glb -o f.glb --html f_ao.png", "finish made.glb -o f.glb --html f.glb",
          "finish made.glb -o f.glb --html made.glb", "finish made.glb --low plain.glb -o f.glb --html plain.glb",
          "finish made.glb --low plain.glb -o f.glb --html a.html --report sub/../a.html",
          "compress-map bump.png --roughness bump.png -o p/ -o2 p/"}) {
        const bool has_size = std::string(command).find("bake") == 0;
        const ToolRun run = runTool(folder, std::string(command) + (has_size ? " --size 16" : ""));
        EXPECT_EQ(run.exit_code, 2) << command << run.err;
        EXPECT_EQ(run.errorLines(), 1) << command << run.err;
        EXPECT_TRUE(contentsOf(folder) == before) << command;
    }
    EXPECT_EQ(runTool(folder, "generate plain.glb -q -o m.glb --manifest m.bin").exit_code, 0);
    EXPECT_EQ(runTool(folder, "bake two.obj --high two.obj -q -o n.png --report n.c.json --size 16").exit_code, 0);
}

TEST(Outputs, RemoveTemporaryFilesOfKilledRunsInAllTheirFolders) {
    const TempFolder folder;
    writeModels(folder);
    folder.write("two.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":"textures/bump.png"}]})");
    folder.write("textures/bump.png", folder.read("bump.png"));
    for (const auto& [command, targets] :
         {std::pair<std::string, std::vector<std::string>>{"compress-map bump.png --roughness bump.png -o p/ -o2 r/",
                                                           {"p/bump.0.png", "r/bump.0.png"}},
          {"check plain.glb --html h/a.html --sarif s/a.sarif", {"h/a.html", "s/a.sarif"}},
          {"generate two.gltf --convention opengl -o g/two.gltf", {"g/two.gltf", "g/textures/bump.png"}},
          {"bake plain.glb --high made.glb --size 16 -o n/a.png --heat m/a.png --report j/a.json",
           {"n/a.png", "m/a.png", "j/a.json"}},
          {"finish made.glb -o f/a.glb --html x/a.html --report y/a.json", {"f/a.glb", "x/a.html", "y/a.json"}}}) {
        for (const std::string& target : targets) leaveTemporaryFile(folder, target);
        const ToolRun run = runTool(folder, command);
        if (run.err.find("built") != std::string::npos) continue;
        EXPECT_LE(run.exit_code, 1) << command << run.err;
        for (const std::string& name : folder.files())
            EXPECT_EQ(name.find(".tspace-"), std::string::npos) << command << ": " << name;
    }
}

TEST(Outputs, KeepExistingPermissions) {
    const TempFolder folder;
    writeModels(folder);
    for (const char* name : {"page.html", "page.sarif", "out.glb", "picture.png"}) {
        folder.write(name, "");
        fs::permissions(folder.path(name), fs::perms::owner_read | fs::perms::owner_write);
    }
    runTool(folder, "check plain.glb --html page.html --sarif page.sarif");
    runTool(folder, "generate plain.glb -o out.glb");
    runTool(folder, "render plain.glb -o picture.png");
    for (const char* name : {"page.html", "page.sarif", "out.glb", "picture.png"}) {
        EXPECT_FALSE(folder.read(name).empty()) << name;
        EXPECT_EQ(fs::status(folder.path(name)).permissions(), fs::perms::owner_read | fs::perms::owner_write) << name;
    }
}

TEST(Outputs, AreWrittenToPipesAndDevicesWithoutReplacingThem) {
    const TempFolder folder;
    writeModels(folder);
    ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
    fs::create_symlink("pipe", folder.path("pipe.png"));
    fs::create_symlink("pipe", folder.path("pipe.glb"));
    struct Case {
        const char* command;
        const char* begin;
    };
    for (const Case& one :
         {Case{"check plain.glb --html pipe", "<!doctype html>"}, Case{"check plain.glb --sarif pipe", "{"},
          Case{"render plain.glb -o pipe.png", "\x89PNG"}, Case{"generate plain.glb -o pipe.glb", "glTF"},
          Case{"generate plain.glb -o pipe", "glTF"}, Case{"generate folded.obj -o pipe", "glTF"},
          Case{"generate separate.gltf -o pipe --manifest m.jsonl", "glTF"},
          Case{"generate plain.glb -o new.glb --manifest pipe", "{\"schema\""}}) {
        runTool(folder, one.command, R"(sh -c 'timeout 20 cat pipe > got & timeout 20 "$0" "$@"; wait')");
        EXPECT_TRUE(fs::is_fifo(folder.path("pipe"))) << one.command;
        EXPECT_EQ(folder.read("got").substr(0, std::string(one.begin).size()), one.begin) << one.command;
    }
    EXPECT_EQ(runTool(folder, "generate plain.glb -o pipe --container gltf").exit_code, 2);
    // Process substitution passes links in /proc whose text is not a path.
    for (const char* option : {"check plain.glb --html", "check plain.glb --sarif",
                               "bake plain.glb --high made.glb --size 16 -o n.png --report"}) {
        const ToolRun substituted =
            runTool(folder, option, R"(bash -c '"$0" "$@" >(cat > got); code=$?; wait $!; exit $code')");
        EXPECT_EQ(substituted.exit_code, 0) << option << substituted.err;
        EXPECT_FALSE(folder.read("got").empty()) << option;
        fs::remove(folder.path("got"));
        const ToolRun piped = runTool(folder, std::string(option) + " /proc/self/fd/1 -q",
                                      R"(bash -c 'set -o pipefail; "$0" "$@" | cat > got')");
        EXPECT_EQ(piped.exit_code, 0) << option << piped.err;
        EXPECT_TRUE(folder.read("got").starts_with("<!doctype html>") || folder.read("got").starts_with("{")) << option;
        fs::remove(folder.path("got"));
    }
    // A device like /dev/null, which must never be replaced by a file.
    if (mknod(folder.path("null").c_str(), S_IFCHR | 0600, makedev(1, 3)) != 0) GTEST_SKIP() << "no device can be made";
    fs::create_symlink("null", folder.path("null.png"));
    for (const char* command : {"check plain.glb --html null --sarif null", "render plain.glb -o null.png",
                                "generate plain.glb -o new.glb --manifest null"}) {
        runTool(folder, command);
        EXPECT_TRUE(fs::is_character_file(folder.path("null"))) << command;
    }
}

TEST(Outputs, FollowNoLinkOfAnotherUserInAFolderForAll) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can make links of others";
    const TempFolder folder;
    writeModels(folder);
    fs::create_directory(folder.path("shared"));
    ASSERT_EQ(chmod(folder.path("shared").c_str(), 01777), 0);
    folder.write("precious", "mine");
    for (const char* name : {"trap.html", "trap.glb", "trap.png"}) {
        fs::create_symlink("../precious", folder.path(std::string("shared/") + name));
        ASSERT_EQ(lchown(folder.path(std::string("shared/") + name).c_str(), 65533, 65533), 0);
    }
    for (const char* command :
         {"check plain.glb --html shared/trap.html", "generate plain.glb -o shared/trap.glb",
          "render plain.glb -o shared/trap.png", "generate plain.glb -o new.glb --manifest shared/trap.html"}) {
        const ToolRun run = runTool(folder, command);
        EXPECT_EQ(run.exit_code, 4) << command << run.err;
        EXPECT_NE(run.err.find("another user"), std::string::npos) << run.err;
        EXPECT_EQ(folder.read("precious"), "mine") << command;
    }
}

TEST(Outputs, SupportNamesOfMaximumLength) {
    const TempFolder folder;
    writeModels(folder);
    const std::string longest = std::string(251, 'n');
    EXPECT_EQ(runTool(folder, "generate plain.glb -q -o " + longest + ".glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "render plain.glb -q -o " + longest + ".png").exit_code, 0);
    EXPECT_EQ(runTool(folder, "check plain.glb -q --html " + longest + ".htm").exit_code, 0);
    EXPECT_TRUE(folder.has(longest + ".glb") && folder.has(longest + ".png") && folder.has(longest + ".htm"));
}

TEST(Outputs, AreTheSameWithoutWaitingForTheDisk) {
    const TempFolder folder;
    writeModels(folder);
    EXPECT_EQ(runTool(folder, "generate plain.glb -q --overwrite -o a.glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate plain.glb -q --overwrite --no-sync -o b.glb").exit_code, 0);
    EXPECT_EQ(folder.read("a.glb"), folder.read("b.glb"));
}

TEST(Names, WithBidirectionalControlsAreEscaped) {
    const TempFolder folder;
    writeModels(folder);
    // A right-to-left override, a line separator and an isolate are escaped. A joiner in a Persian word is kept.
    for (const std::string name : {"a\xe2\x80\xae"
                                   "blg.glb",
                                   "a\xe2\x80\xa8"
                                   "b.glb",
                                   "a\xe2\x81\xa6"
                                   "b.glb"}) {
        folder.write(name, folder.read("plain.glb"));
        for (const std::string& said :
             {runTool(folder, "check '" + name + "'").out, runTool(folder, "inspect '" + name + "x'").err}) {
            EXPECT_EQ(said.find("\xe2"), std::string::npos) << said;
            EXPECT_NE(said.find("a\\u20"), std::string::npos) << said;
        }
    }
    const std::string joined = "\xd9\x85\xdb\x8c\xe2\x80\x8c\xd8\xb4.glb";
    folder.write(joined, folder.read("plain.glb"));
    EXPECT_NE(runTool(folder, "check '" + joined + "'").out.find(joined), std::string::npos);
}

TEST(Folders, UnreadableFoldersAffectNoOther) {
    if (std::system("test $(id -u) = 0 && command -v setpriv > /dev/null") != 0) GTEST_SKIP() << "needs another user";
    const TempFolder folder;
    writeModels(folder);
    for (const char* name : {"in/a/x.glb", "in/b/x.glb", "in/c/x.glb", "in/y.glb"})
        folder.write(name, folder.read("plain.glb"));
    fs::permissions(folder.path(), fs::perms::all);
    fs::permissions(folder.path("in/b"), fs::perms::none);
    const ToolRun run = runTool(folder, "inspect in", "setpriv --reuid 65531 --clear-groups");
    if (run.exit_code > 125) GTEST_SKIP() << "another user cannot start the tool here: " << run.err;
    EXPECT_EQ(run.exit_code, 4) << run.err;
    for (const char* name : {"in/a/x.glb", "in/c/x.glb", "in/y.glb"})
        EXPECT_NE(run.out.find(name), std::string::npos) << name << run.out;
    EXPECT_EQ(run.errorLines(), 1) << run.err;
    EXPECT_NE(run.err.find("in/b"), std::string::npos) << run.err;
    fs::permissions(folder.path("in/b"), fs::perms::all);
}

TEST(Descriptors, ClosedOrFullDescriptorsEndNoRun) {
    const TempFolder folder;
    writeModels(folder);
    folder.write("bad.glb", "no model");
    for (const char* command : {"check none.glb", "check bad.glb", "inspect bad.glb", "generate bad.glb -o new.glb",
                                "render bad.glb -o new.png", "check", "nonsense", "diff bad.glb plain.glb"}) {
        const int code = runTool(folder, command).exit_code;
        for (const char* broken : {"2>&-", "2> /dev/full", "<&- 2>&-", "<&- >&- 2>&-"}) {
            const ToolRun run = runTool(folder, command, std::string("sh -c '\"$0\" \"$@\" ") + broken + "'");
            EXPECT_EQ(run.exit_code, code) << command << " " << broken;
        }
    }
}

TEST(Descriptors, ClosedDescriptorsPutNoMessageIntoAFile) {
    const TempFolder folder;
    writeModels(folder);
    folder.write("in/bad.glb", "no model");
    for (int i = 0; i < 12; ++i) folder.write("in/" + std::to_string(i) + ".glb", folder.read("plain.glb"));
    ASSERT_EQ(runTool(folder, "generate in -q --overwrite -o whole/ --jobs 4").exit_code, 3);
    for (const char* closed : {"2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        for (int round = 0; round < 5; ++round) {
            fs::remove_all(folder.path("out"));
            fs::remove(folder.path("m.jsonl"));
            runTool(folder, "generate in -q --overwrite -o out/ --jobs 4 --manifest m.jsonl",
                    std::string("sh -c '\"$0\" \"$@\" ") + closed + "'");
            EXPECT_EQ(folder.files("out"), folder.files("whole"));
            for (const std::string& name : folder.files("out"))
                EXPECT_EQ(folder.read("out/" + name), folder.read("whole/" + name)) << closed << name;
            EXPECT_EQ(folder.read("m.jsonl").find("tspace: "), std::string::npos);
            std::istringstream lines(folder.read("m.jsonl"));
            for (std::string line; std::getline(lines, line);) EXPECT_EQ(line.front(), '{') << line;
        }
    }
}

TEST(Descriptors, AFullStdoutCausesOneLineIfItIsTheOutput) {
    const TempFolder folder;
    writeModels(folder);
    for (const char* command :
         {"check plain.glb", "check plain.glb --json", "check plain.glb --sarif -", "inspect plain.glb",
          "identify plain.glb", "diff plain.glb plain.glb", "generate plain.glb -o -", "generate plain.glb -o new.glb",
          "render plain.glb -o -", "--help", "--version", "help check"}) {
        for (const char* broken : {"> /dev/full", ">&-"}) {
            const ToolRun run = runTool(folder, command, std::string("sh -c '\"$0\" \"$@\" ") + broken + "'");
            EXPECT_EQ(run.exit_code, 4) << command << " " << broken << run.err;
            EXPECT_EQ(run.errorLines(), 1) << command << run.err;
        }
    }
}

TEST(Descriptors, AFullStdoutKeepsTheOutputsAndTheMessageNamesThem) {
    const TempFolder folder;
    writeModels(folder);
    for (const char* command :
         {"generate plain.glb -o new.glb", "generate plain.glb --json -o new.glb", "finish folded.obj -o new.glb",
          "bake plain.glb --high plain.glb --size 16 --json -o new.png", "render plain.glb --size 16 -o new.png",
          "flip-green bump.png --json -o new.png", "compress-map bump.png -o new.ktx2",
          "check plain.glb --json --sarif new.sarif", "height-to-normal bump.png -o new.png"}) {
        const std::string name = std::string(command).substr(std::string(command).rfind(' ') + 1);
        ASSERT_LE(runTool(folder, command).exit_code, 1) << command;
        const std::string whole = folder.read(name);
        fs::remove(folder.path(name));
        const ToolRun run = runTool(folder, command, kIntoFullDisk);
        EXPECT_EQ(run.exit_code, 4) << command;
        EXPECT_EQ(run.errorLines(), 1) << command << run.err;
        EXPECT_NE(run.err.find("; all output files are complete: "), std::string::npos) << command << run.err;
        EXPECT_NE(run.err.find(name), std::string::npos) << command << run.err;
        EXPECT_EQ(folder.read(name).size(), whole.size()) << command;
        fs::remove(folder.path(name));
    }
    folder.write("pairs.txt", "plain.glb = plain.glb = a.png\nplain.glb = plain.glb = b.png\n");
    for (const char* command : {"bake --pairs pairs.txt --size 16 -o maps/ --jobs 1",
                                "bake --pairs pairs.txt --size 16 -o maps/ --jobs 1 --json"}) {
        const ToolRun run = runTool(folder, command, kIntoFullDisk);
        EXPECT_EQ(run.exit_code, 4) << command << run.err;
        EXPECT_NE(run.err.find("all output files are complete: maps/a.png"), std::string::npos) << command << run.err;
    }
}

}  // namespace
}  // namespace tspace::test
