// SPDX-License-Identifier: MIT
// tspace generate from a user's point of view.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "support/shared_data.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

bool isCompleteGlb(const std::string& bytes) {
    if (bytes.size() < 12 || bytes.compare(0, 4, "glTF") != 0) return false;
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length |= std::size_t{static_cast<unsigned char>(bytes[8 + i])} << (8 * i);
    return length == bytes.size();
}

TEST(Generate, WritesTheOutputAndReportsIt) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    const ToolRun run = runTool(folder, "generate folded.obj -o out/folded.glb");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_TRUE(isCompleteGlb(folder.read("out/folded.glb")));
    EXPECT_EQ(run.out.rfind("folded.obj -> out/folded.glb\n", 0), 0U) << run.out;
    for (const char* text : {"1 primitive: 1 generated", "triangles", "repaired", "time", "written", "skin"}) {
        EXPECT_NE(run.out.find(text), std::string::npos) << text << "\n" << run.out;
    }
    EXPECT_EQ(run.out.find('\x1b'), std::string::npos) << "no colors into a pipe";
}

TEST(Generate, QuietPrintsNothing) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    const ToolRun run = runTool(folder, "generate folded.obj -o out.glb --quiet");
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.out + run.err, "");
    EXPECT_TRUE(folder.has("out.glb"));
}

/// Two triangles with vertices of their own become a sheet of four vertices.
TEST(Generate, DoesNotCallMergedVerticesSplit) {
    const float numbers[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0,  // positions
                             0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1,  // normals
                             0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1};                   // UVs
    const TempFolder folder;
    folder.write("soup.bin", std::string(reinterpret_cast<const char*>(numbers), sizeof numbers));
    folder.write("soup.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"soup.bin","byteLength":192}],
        "bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":72},
                       {"buffer":0,"byteOffset":144,"byteLength":48}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                     {"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"},
                     {"bufferView":2,"componentType":5126,"count":6,"type":"VEC2"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}]}]})");
    const ToolRun run = runTool(folder, "generate soup.gltf --all --overwrite-normals -o out.glb");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("6 -> 4 (2 merged)"), std::string::npos) << run.out;
}

TEST(Generate, WritesBitangentsOfObjFilesToo) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    const ToolRun run = runTool(folder, "generate folded.obj -o out.glb --method best --bitangents");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("bitangents"), std::string::npos) << run.out;
    EXPECT_NE(runTool(folder, "inspect out.glb").out.find("_BITANGENT float3"), std::string::npos);
    ASSERT_EQ(runTool(folder, "generate folded.obj -o plain.glb --method best").exit_code, 0);
    EXPECT_EQ(runTool(folder, "inspect plain.glb").out.find("_BITANGENT"), std::string::npos);
}

TEST(Generate, PacksFramesOfObjFilesToo) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    const ToolRun run = runTool(folder, "generate folded.obj -o out.glb --pack frame48 --format snorm8");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("packed    frames of 1 primitive\n"), std::string::npos) << run.out;
    EXPECT_NE(runTool(folder, "inspect out.glb").out.find("_FRAME48 uint16x3"), std::string::npos);
    ASSERT_EQ(runTool(folder, "generate out.glb -o again.glb --pack frame48").exit_code, 0);
    EXPECT_EQ(folder.read("again.glb"), folder.read("out.glb")) << "the words are those that a glTF file gets";
    ASSERT_EQ(runTool(folder, "generate folded.obj -o alone.glb --pack oct32 --pack-drop all").exit_code, 0);
    const std::string alone = runTool(folder, "inspect alone.glb").out;
    EXPECT_NE(alone.find("_OCT32 uint8x4"), std::string::npos) << alone;
    EXPECT_EQ(alone.find("NORMAL"), std::string::npos) << alone;
    EXPECT_EQ(alone.find("TANGENT"), std::string::npos) << alone;
}

TEST(Generate, ReportsThatBasisTangentsFollowNoUvs) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    EXPECT_NE(runTool(folder, "generate folded.obj -o basis.glb --method basis").out.find("do not follow the UVs"),
              std::string::npos);
    EXPECT_EQ(runTool(folder, "generate folded.obj -o plain.glb").out.find("do not follow the UVs"), std::string::npos);
}

TEST(Generate, ReportsOptionsWithoutEffect) {
    const TempFolder folder;
    folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n");
    ASSERT_EQ(runTool(folder, "generate -q --all bare.obj -o has.glb").exit_code, 0);
    for (const char* option :
         {"--no-sanitize", "--orthogonalize", "--format snorm8", "--refine 2", "--fix-maps", "--flip-green",
          "--convention directx", "--texture-transform ignore", "--compress none", "--keep-coordinates"}) {
        const std::string name = std::string(option).substr(0, std::string(option).find(' '));
        const ToolRun run = runTool(folder, "generate --all has.glb -o out.glb " + std::string(option));
        EXPECT_NE(run.out.find(name + " has no effect: "), std::string::npos) << option << run.out << run.err;
    }
    EXPECT_NE(
        runTool(folder, "generate --all bare.obj -o out.glb --refine 2").out.find("it only applies to --method best"),
        std::string::npos);
    EXPECT_NE(runTool(folder, "generate bare.obj -o out.glb --strip").out.find("--strip has no effect"),
              std::string::npos);
    const ToolRun packed = runTool(folder, "generate --all has.glb -o packed.glb --compress meshopt");
    if (packed.exit_code == 0) {
        EXPECT_EQ(packed.out.find("no effect"), std::string::npos);
        EXPECT_EQ(runTool(folder, "generate --all packed.glb -o out.glb --compress none").out.find("no effect"),
                  std::string::npos);
        EXPECT_NE(runTool(folder, "generate --all packed.glb -o out.glb --compress meshopt")
                      .out.find("--compress has no effect"),
                  std::string::npos);
    }
    EXPECT_EQ(
        runTool(folder, "generate --all --overwrite has.glb -o out.glb --convention directx").out.find("no effect"),
        std::string::npos);
    EXPECT_EQ(
        runTool(folder, "generate --all bare.obj -o out.glb --method best --refine 2 --format snorm8 --no-sanitize")
            .out.find("no effect"),
        std::string::npos);
}

TEST(Generate, PackDropNeedsPack) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    for (const char* arguments : {"generate a.obj -o a.glb --pack-drop all", "generate a.obj -o a.glb --pack frame33",
                                  "generate a.obj -o a.glb --pack frame32 --pack-drop normals"}) {
        const ToolRun run = runTool(folder, arguments);
        EXPECT_EQ(run.exit_code, 2) << arguments;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
    EXPECT_FALSE(folder.has("a.glb"));
}

TEST(Generate, HintsAtAllWhenNothingNeedsTangents) {
    const TempFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    EXPECT_NE(runTool(folder, "generate a.obj -o a.glb").out.find("--all"), std::string::npos);
    EXPECT_NE(runTool(folder, "generate a.obj -o a.glb --all").out.find("1 generated"), std::string::npos);
}

TEST(Generate, RepairKeepsItsOwnOutput) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    ASSERT_EQ(runTool(folder, "generate folded.obj -o a.glb").exit_code, 0);
    const ToolRun run = runTool(folder, "generate a.glb -o b.glb --repair");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("1 kept"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("its tangents are correct"), std::string::npos) << run.out;
    EXPECT_EQ(folder.read("a.glb"), folder.read("b.glb"));
    const ToolRun inverted = runTool(folder, "generate a.glb -o c.glb --repair --convention opengl");
    EXPECT_NE(inverted.out.find("1 replaced"), std::string::npos) << inverted.out;
    EXPECT_NE(inverted.out.find("note: mesh 0, primitive 0: its tangents were wrong: "), std::string::npos)
        << inverted.out;
}

TEST(Generate, StripRemovesUnneededTangents) {
    const TempFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    ASSERT_EQ(runTool(folder, "generate a.obj -o a.glb --all").exit_code, 0);
    const ToolRun run = runTool(folder, "generate a.glb -o b.glb --strip");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("1 removed"), std::string::npos) << run.out;
    EXPECT_EQ(runTool(folder, "inspect b.glb").out.find("TANGENT"), std::string::npos);
}

TEST(Generate, ChoosesTheContainerIfTheNameHasNoExtension) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    EXPECT_EQ(runTool(folder, "generate a.obj -o b").exit_code, 0);
    EXPECT_TRUE(folder.has("b.glb"));
    EXPECT_EQ(runTool(folder, "generate a.obj -o c --container gltf").exit_code, 0);
    EXPECT_TRUE(folder.has("c.gltf"));
    EXPECT_EQ(runTool(folder, "generate a.obj -o d/ --container gltf").exit_code, 0);
    EXPECT_TRUE(folder.has("d/a.gltf"));
}

TEST(Generate, FoldersKeepTheirRelativePaths) {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    writeFoldedObj(folder, "in/deep/b.OBJ");
    folder.write("in/readme.txt", "not a model");
    const ToolRun run = runTool(folder, "generate in -o out");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.files("out"), (std::set<std::string>{"a.glb", "deep/b.glb"}));
    EXPECT_NE(run.out.find("2 of 2 files written"), std::string::npos) << run.out;
}

TEST(Generate, OneBadFileDoesNotStopTheOthersAndTheWorstDecides) {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    folder.write("in/b.obj", "v 0 0 0\n");
    folder.write("in/c.glb", "glTF rubbish");
    writeFoldedObj(folder, "in/d.obj");
    ToolRun run = runTool(folder, "generate in -o out");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.errorLines(), 2) << run.err;
    EXPECT_NE(run.err.find("tspace: in/b.obj: the OBJ file has no faces\n"), std::string::npos) << run.err;
    EXPECT_EQ(folder.files("out"), (std::set<std::string>{"a.glb", "d.glb"}));
    run = runTool(folder, "generate in missing.obj -o out");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(run.errorLines(), 3) << run.err;
}

TEST(Generate, AFolderWithoutModelsIsBadInput) {
    const TempFolder folder;
    folder.write("in/readme.txt", "not a model");
    const ToolRun run = runTool(folder, "generate in -o out");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_FALSE(folder.has("out"));
}

TEST(Generate, TwoInputsNeverShareAnOutput) {
    const TempFolder folder;
    writeFoldedObj(folder, "x/a.obj");
    writeFoldedObj(folder, "y/a.obj");
    const ToolRun run = runTool(folder, "generate x/a.obj y/a.obj -o out");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.errorLines(), 1) << run.err;
    EXPECT_EQ(folder.files("out"), std::set<std::string>{"a.glb"});
}

TEST(Generate, InputsThatDifferInTheExtensionOnlyBothGetAnOutput) {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    ASSERT_EQ(runTool(folder, "generate in/a.obj -o in/a.gltf").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate in -o out --container glb").exit_code, 0);
    EXPECT_EQ(folder.files("out"), (std::set<std::string>{"a.glb", "a.obj.glb"}));
}

TEST(Generate, AFolderAsOutputNeverOverwritesInputs) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    ASSERT_EQ(runTool(folder, "generate a.obj -o in/a.glb").exit_code, 0);
    const std::string before = folder.read("in/a.glb");
    const ToolRun run = runTool(folder, "generate in --overwrite --method flat -o in");
    EXPECT_EQ(run.exit_code, 2) << run.out;
    EXPECT_EQ(folder.read("in/a.glb"), before);
}

TEST(Generate, OutputsInsideTheInputFolderAreNotInputsOfTheNextRun) {
    const TempFolder folder;
    writeFoldedObj(folder, "in/a.obj");
    for (int i = 0; i < 2; ++i) EXPECT_EQ(runTool(folder, "generate in -o in/out").exit_code, 0);
    EXPECT_EQ(folder.files("in/out"), std::set<std::string>{"a.glb"});
}

TEST(Generate, InPlaceReplacesTheInput) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    ASSERT_EQ(runTool(folder, "generate a.obj -o a.glb").exit_code, 0);
    const std::string before = folder.read("a.glb");
    EXPECT_EQ(runTool(folder, "generate a.glb --in-place --all --overwrite --convention opengl").exit_code, 0);
    EXPECT_TRUE(folder.read("a.glb") != before);
    EXPECT_TRUE(isCompleteGlb(folder.read("a.glb")));
    EXPECT_EQ(folder.files(), (std::set<std::string>{"a.glb", "a.obj", "folded.mtl"}));
}

TEST(Generate, AFailedRunLeavesTheOldOutput) {
    const TempFolder folder;
    folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    folder.write("out.glb", "old");
    const ToolRun run = runTool(folder, "generate bad.obj -o out.glb");
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.err, "tspace: bad.obj: a face refers to vertex 2, but the number of vertices is 1 (at line 2)\n");
    EXPECT_EQ(folder.read("out.glb"), "old");
    EXPECT_EQ(folder.files(), (std::set<std::string>{"bad.obj", "out.glb"}));
}

TEST(Generate, AnUnwritableOutputExitsWithFourAndLeavesNothing) {
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("file", "in the way");
    folder.write("taken.glb/x", "a folder");
    for (const std::string out : {"file/out.glb", "taken.glb/../file/b.gltf", "/proc/no/out.glb"}) {
        const ToolRun run = runTool(folder, "generate a.obj -o " + out);
        EXPECT_EQ(run.exit_code, 4) << out << " " << run.err;
        EXPECT_EQ(run.errorLines(), 1) << run.err;
    }
    EXPECT_EQ(folder.files(), (std::set<std::string>{"a.obj", "file", "folded.mtl", "taken.glb/x"}));
}

TEST(Generate, AFolderWithoutPermissionExitsWithFour) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    folder.write("closed/old.glb", "old");
    std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms(0555));
    EXPECT_EQ(runTool(folder, "generate a.obj -o closed/old.glb").exit_code, 4);
    EXPECT_EQ(folder.files("closed"), std::set<std::string>{"old.glb"});
    std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms(0755));
    EXPECT_EQ(folder.read("closed/old.glb"), "old");
}

TEST(Generate, AFullStandardOutputExitsWithFour) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    const TempFolder folder;
    writeFoldedObj(folder, "a.obj");
    runTool(folder, "generate a.obj -o a.glb > /dev/full 2> err; echo $? > code; true");
    EXPECT_EQ(folder.read("code"), "4\n");
    EXPECT_EQ(folder.read("err"),
              "tspace: cannot write the report to standard output; all output files are complete: a.glb\n");
}

TEST(Generate, AnInterruptLeavesACompleteFileOrNone) {
    const TempFolder folder;
    std::ostringstream grid;
    constexpr int kSide = 250;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) grid << "v " << x << ' ' << y << " 0\nvt " << x << ' ' << y << '\n';
    }
    for (int y = 0; y + 1 < kSide; ++y) {
        for (int x = 1; x < kSide; ++x) {
            const int a = y * kSide + x;
            grid << "f " << a << '/' << a << ' ' << a + 1 << '/' << a + 1 << ' ' << a + 1 + kSide << '/'
                 << a + 1 + kSide << ' ' << a + kSide << '/' << a + kSide << '\n';
        }
    }
    folder.write("grid.obj", grid.str());
    for (const std::string delay : {"0.01", "0.03", "0.06", "0.1", "0.15", "0.2"}) {
        const ToolRun run = runTool(folder, "generate grid.obj --all -o out/grid.glb", "timeout -s INT " + delay);
        EXPECT_LE(run.errorLines(), 1) << run.err;
        const std::set<std::string> files = folder.files("out");
        if (files.empty()) continue;
        EXPECT_EQ(files, std::set<std::string>{"grid.glb"});
        EXPECT_TRUE(isCompleteGlb(folder.read("out/grid.glb")));
        std::filesystem::remove_all(folder.path() / "out");
    }
}

TEST(Generate, PathsThatLeadOutsideAreRejected) {
    const TempFolder folder;
    folder.write("data.bin", std::string(36, '\0'));
    folder.write("in/a.gltf",
                 R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"../data.bin"}],)"
                 R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
                 R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
                 R"("min":[0,0,0],"max":[0,0,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
    const ToolRun run = runTool(folder, "generate in/a.gltf -o out.glb");
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_EQ(runTool(folder, "generate in/a.gltf -o out.glb --allow-external").exit_code, 0);
}

TEST(Generate, ThreadsChangeNoByte) {
    TSPACE_NEEDS_SHARED("models/obj/mikktspace/tangeract.obj");
    const TempFolder folder;
    std::filesystem::copy(shared("models/obj/mikktspace/tangeract.obj"), folder.path() / "in.obj");
    for (const std::string n : {"1", "2", "3", "8"}) {
        ASSERT_EQ(runTool(folder, "generate in.obj --all -o t" + n + ".glb --threads " + n).exit_code, 0);
        EXPECT_EQ(folder.read("t" + n + ".glb"), folder.read("t1.glb"));
    }
}

/// Writes a tube of 40 x 120 squares. `is_noisy`: points deviate by up to a fifth of an edge.
void writeNoisyTube(const TempFolder& folder, const std::string& name, bool is_noisy) {
    constexpr int kSides = 40, kRows = 120;
    std::string text;
    std::uint32_t state = 1;
    for (int row = 0; row <= kRows; ++row) {
        for (int side = 0; side < kSides; ++side) {
            state = state * 1664525u + 1013904223u;
            const double away = is_noisy ? 0.03 * (2 * (state >> 8) / double{1 << 24} - 1) : 0;
            const double angle = 2 * 3.14159265358979 * side / kSides, radius = 1 + away;
            text += "v " + std::to_string(radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) +
                    " " + std::to_string(0.157 * row) + "\n";
        }
    }
    for (int row = 0; row < kRows; ++row) {
        for (int side = 0; side < kSides; ++side) {
            const int a = 1 + row * kSides + side, b = 1 + row * kSides + (side + 1) % kSides;
            const auto face = [&](int x, int y, int z) {
                text += "f " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
            };
            face(a, b, b + kSides);
            face(a, b + kSides, a + kSides);
        }
    }
    folder.write(name, text);
}

TEST(Generate, DenoisesNormalsAndReportsIt) {
    const TempFolder folder;
    writeNoisyTube(folder, "noisy.obj", true);
    writeNoisyTube(folder, "clean.obj", false);
    const std::string command = " --all --method basis --normals best --denoise auto --crease auto";
    const ToolRun noisy = runTool(folder, "generate noisy.obj -o noisy.glb" + command);
    EXPECT_EQ(noisy.exit_code, 0) << noisy.err;
    EXPECT_NE(noisy.out.find("its positions are noisy (0.1"), std::string::npos) << noisy.out;
    EXPECT_NE(noisy.out.find("degrees are hard (--crease auto)"), std::string::npos) << noisy.out;
    const ToolRun clean = runTool(folder, "generate clean.obj -o clean.glb" + command);
    EXPECT_EQ(clean.out.find("noisy"), clean.out.find("no positions are noisy") + 17) << clean.out;
    const ToolRun other =
        runTool(folder, "generate noisy.obj -o other.glb --all --method basis --normals area --denoise 2");
    EXPECT_NE(other.out.find("--denoise has no effect: it only applies to --normals best"), std::string::npos)
        << other.out;
    for (const char* wrong : {"--denoise 5", "--denoise loud", "--crease -1", "--crease 181"})
        EXPECT_EQ(runTool(folder, std::string("generate noisy.obj -o x.glb ") + wrong).exit_code, 2) << wrong;
}

TEST(Check, NotesNoisyPositions) {
    const TempFolder folder;
    writeNoisyTube(folder, "noisy.obj", true);
    writeNoisyTube(folder, "clean.obj", false);
    EXPECT_NE(runTool(folder, "check noisy.obj").out.find("positionsNoisy"), std::string::npos);
    EXPECT_EQ(runTool(folder, "check clean.obj").out.find("positionsNoisy"), std::string::npos);
    EXPECT_NE(runTool(folder, "inspect noisy.obj").out.find("noisy (0.1"), std::string::npos);
    EXPECT_EQ(runTool(folder, "inspect clean.obj").out.find("noisy"), std::string::npos);
}

}  // namespace
}  // namespace tspace::test
