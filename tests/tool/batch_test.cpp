// SPDX-License-Identifier: MIT
// Batches of files: parallel processing, shards, patterns, and resuming from a manifest.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "model/io/temporary_files.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

std::vector<Json> linesOf(const std::string& text) {
    std::vector<Json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
    return lines;
}

/// Writes the models in/00.obj to in/NN.obj, distributed over several folders.
void writeModels(const TempFolder& folder, int count) {
    for (int i = 0; i < count; ++i) {
        const std::string place = "in/" + std::string(i % 2 == 0 ? "even" : "odd") + "/";
        writeFoldedObj(folder, place + "m" + std::to_string(i) + ".obj");
    }
}

/// Returns the action for each input, from the JSON of a run.
std::map<std::string, std::string> doneBy(const ToolRun& run) {
    std::map<std::string, std::string> done;
    const Json document = Json::parse(run.out);
    for (const Json& file : document["files"]) {
        const bool ok = file["ok"].get<bool>();
        done[file["input"]] = !ok ? "failed" : file["skipped"].get<bool>() ? "skipped" : "written";
    }
    return done;
}

std::size_t countOf(const std::map<std::string, std::string>& done, const std::string& what) {
    return static_cast<std::size_t>(
        std::count_if(done.begin(), done.end(), [&](const auto& entry) { return entry.second == what; }));
}

TEST(Batch, JobsChangeNeitherFilesNorTheOrderOfReports) {
    const TempFolder folder;
    writeModels(folder, 17);
    folder.write("in/even/bad.glb", "no glTF");
    const ToolRun serial = runTool(folder, "generate in -o one --json");
    const ToolRun parallel = runTool(folder, "generate in -o four --json --jobs 4");
    EXPECT_EQ(serial.exit_code, 3);
    EXPECT_EQ(parallel.exit_code, 3);
    EXPECT_EQ(serial.err, parallel.err);
    EXPECT_EQ(folder.files("one"), folder.files("four"));
    for (const std::string& file : folder.files("one")) {
        EXPECT_EQ(folder.read("one/" + file), folder.read("four/" + file)) << file;
    }
    const Json a = Json::parse(serial.out)["files"], b = Json::parse(parallel.out)["files"];
    ASSERT_EQ(a.size(), 18U);
    ASSERT_EQ(b.size(), a.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i]["input"], b[i]["input"]);
}

TEST(Batch, PrintsFilesInTheirOrder) {
    const TempFolder folder;
    writeModels(folder, 9);
    const std::string text = runTool(folder, "generate in -o out --jobs 3").out;
    std::size_t last = 0;
    for (const char* name : {"even/m0", "even/m2", "even/m8", "odd/m1", "odd/m7"}) {
        const std::size_t at = text.find(std::string(name) + ".obj -> ");
        ASSERT_NE(at, std::string::npos) << name;
        EXPECT_GE(at, last);
        last = at;
    }
    EXPECT_NE(text.find("9 of 9 files written, 0 failed"), std::string::npos) << text;
}

TEST(Batch, ShardsCoverAllFilesOnceAndAreStableWhenFilesAreAdded) {
    const TempFolder folder;
    writeModels(folder, 20);
    const auto share = [&](int i) {
        return doneBy(
            runTool(folder, "generate in -o out" + std::to_string(i) + " --json --shard " + std::to_string(i) + "/3"));
    };
    std::map<std::string, int> shard_of;
    for (int i = 1; i <= 3; ++i) {
        const auto done = share(i);
        for (const auto& [file, what] : done) EXPECT_TRUE(shard_of.emplace(file, i).second) << file;
    }
    EXPECT_EQ(shard_of.size(), 20U);
    writeModels(folder, 27);
    std::size_t covered = 0;
    for (int i = 1; i <= 3; ++i) {
        const auto done = share(i);
        for (const auto& [file, what] : done) {
            ++covered;
            if (shard_of.count(file) != 0) {
                EXPECT_EQ(shard_of[file], i) << file;
            }
        }
    }
    EXPECT_EQ(covered, 27U);
}

TEST(Batch, AnInvalidShardIsWrongUsage) {
    const TempFolder folder;
    writeModels(folder, 1);
    for (const char* shard : {"0/3", "4/3", "2", "a/b", "1/0", "-1/3", ""}) {
        const ToolRun run = runTool(folder, std::string("generate in -o out --shard '") + shard + "'");
        EXPECT_EQ(run.exit_code, 2) << shard << run.err;
        EXPECT_EQ(run.errorLines(), 1);
    }
}

TEST(Batch, AnEmptyShardSucceeds) {
    const TempFolder folder;
    writeModels(folder, 1);
    std::size_t written = 0;
    for (int i = 1; i <= 5; ++i) {
        const ToolRun run = runTool(folder, "generate in -o out --json --shard " + std::to_string(i) + "/5");
        EXPECT_EQ(run.exit_code, 0) << run.err;
        written += countOf(doneBy(run), "written");
    }
    EXPECT_EQ(written, 1U);
}

TEST(Batch, PatternsMatchLikeAShellAndTwoStarsMatchSubfolders) {
    const TempFolder folder;
    writeModels(folder, 6);
    writeFoldedObj(folder, "in/.hidden/x.obj");
    writeFoldedObj(folder, "in/top.obj");
    const auto inputs = [&](const std::string& pattern) {
        std::set<std::string> names;
        const auto done = doneBy(runTool(folder, "generate '" + pattern + "' -o out --json"));
        for (const auto& [file, what] : done) names.insert(file);
        return names;
    };
    EXPECT_EQ(inputs("in/even/*.obj"), (std::set<std::string>{"in/even/m0.obj", "in/even/m2.obj", "in/even/m4.obj"}));
    EXPECT_EQ(inputs("in/*/m[01].obj"), (std::set<std::string>{"in/even/m0.obj", "in/odd/m1.obj"}));
    EXPECT_EQ(inputs("in/**/*.obj").size(), 7U);
    EXPECT_EQ(inputs("**/m?.obj").size(), 6U);
    EXPECT_TRUE(folder.has("out/in/even/m0.glb")) << "paths are kept below the part without wildcards";
    EXPECT_EQ(runTool(folder, "generate 'in/*.fbx' -o out").exit_code, 4);
}

TEST(Batch, TheManifestListsProcessedFiles) {
    const TempFolder folder;
    writeModels(folder, 3);
    folder.write("in/bad.glb", "no glTF");
    EXPECT_EQ(runTool(folder, "generate in -o out --all --method angle --manifest m.jsonl --quiet").exit_code, 3);
    const std::vector<Json> lines = linesOf(folder.read("m.jsonl"));
    ASSERT_EQ(lines.size(), 4U);
    std::size_t failed = 0;
    for (const Json& line : lines) {
        EXPECT_EQ(line["schema"], "tspace.manifest/1");
        EXPECT_EQ(reportFaults(line.dump()), "");
        EXPECT_EQ(line["options"], "--all --method=angle");
        EXPECT_EQ(line["inputs"][0]["path"], line["input"]);
        EXPECT_EQ(line["inputs"][0]["hash"].get<std::string>().size(), 5U + 32U);
        if (line["ok"].get<bool>()) {
            EXPECT_EQ(line["inputs"].size(), 2U) << "the model and its materials";
            EXPECT_EQ(line["outputs"][0]["path"], line["output"]);
        } else {
            ++failed;
            EXPECT_EQ(line["error"]["code"], "invalidFile");
        }
    }
    EXPECT_EQ(failed, 1U);
}

TEST(Batch, ResumeSkipsCompletedUnchangedFiles) {
    const TempFolder folder;
    writeModels(folder, 6);
    const std::string command = "generate in -o out --json --manifest m.jsonl --resume";
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "written"), 6U);
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "skipped"), 6U);

    folder.write("in/even/m0.obj", folder.read("in/even/m0.obj") + "# changed\n");
    std::filesystem::remove(folder.path() / "out/even/m2.glb");
    folder.write("out/even/m4.glb", "damaged");
    const auto done = doneBy(runTool(folder, command));
    EXPECT_EQ(done.at("in/even/m0.obj"), "written") << "its input changed";
    EXPECT_EQ(done.at("in/even/m2.obj"), "written") << "its output is gone";
    EXPECT_EQ(done.at("in/even/m4.obj"), "written") << "its output is another";
    EXPECT_EQ(countOf(done, "skipped"), 3U);

    folder.write("in/odd/folded.mtl", folder.read("in/odd/folded.mtl") + "# changed\n");
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "written"), 3U) << "a file that models name changed";
    EXPECT_EQ(countOf(doneBy(runTool(folder, command + " --method angle")), "skipped"), 0U) << "other options";
    EXPECT_EQ(countOf(doneBy(runTool(folder, command + " --method angle --threads 1 --jobs 2")), "skipped"), 6U)
        << "options that change no byte";
}

TEST(Batch, ResumeRetriesFailedFiles) {
    const TempFolder folder;
    writeModels(folder, 2);
    folder.write("in/bad.glb", "no glTF");
    const std::string command = "generate in -o out --json --manifest m.jsonl --resume";
    EXPECT_EQ(runTool(folder, command).exit_code, 3);
    const ToolRun again = runTool(folder, command);
    EXPECT_EQ(again.exit_code, 3);
    EXPECT_EQ(countOf(doneBy(again), "skipped"), 2U);
    EXPECT_EQ(countOf(doneBy(again), "failed"), 1U);
}

TEST(Batch, ResumeSurvivesAManifestThatEndsInsideALine) {
    const TempFolder folder;
    writeModels(folder, 4);
    const std::string command = "generate in -o out --json --manifest m.jsonl --resume";
    runTool(folder, command);
    const std::string whole = folder.read("m.jsonl");
    folder.write("m.jsonl", whole.substr(0, whole.size() - 40));
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "written"), 1U);
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "skipped"), 4U);
    folder.write("m.jsonl", "not JSON\n[]\n{\"schema\":\"tspace.manifest/1\"}\n{\"schema\":7}\n");
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "written"), 4U);
}

TEST(Batch, ResumeInPlaceComparesTheWrittenFile) {
    const TempFolder folder;
    writeModels(folder, 3);
    runTool(folder, "generate in -o models");
    const std::string command = "generate models --in-place --overwrite --json --manifest m.jsonl --resume";
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "written"), 3U);
    EXPECT_EQ(countOf(doneBy(runTool(folder, command)), "skipped"), 3U);
}

TEST(Batch, ResumeRemovesTemporaryFilesOfKilledRuns) {
    const TempFolder folder;
    writeModels(folder, 2);
    leaveTemporaryFile(folder, "out/even/a.glb");
    leaveTemporaryFile(folder, "out/even/deep/b.glb");
    leaveTemporaryFile(folder, "elsewhere/c.glb");
    EXPECT_EQ(folder.files("out").size(), 2U);
    // One temporary file of this process, which is still running, and one file of the user.
    const std::string mine =
        std::filesystem::path(temporaryName(Path("out/even/d.glb"), kTemporaryEnding).string()).string();
    folder.write(mine, "at work");
    folder.write("out/even/e.glb.tmp", "the user's");
    const std::string command = "generate in -o out -q --manifest m.jsonl";
    ASSERT_EQ(runTool(folder, command).exit_code, 0);
    EXPECT_EQ(folder.files("out").size(), 5U) << "in the folders of outputs themselves, not below them";
    ASSERT_EQ(runTool(folder, command + " --resume").exit_code, 0);
    EXPECT_EQ(folder.files("out").size(), 4U);
    EXPECT_TRUE(folder.has(mine));
    EXPECT_TRUE(folder.has("out/even/e.glb.tmp"));
    EXPECT_EQ(folder.files("elsewhere").size(), 1U) << "not a folder of outputs";
}

TEST(Batch, ResumeWithoutAManifestIsWrongUsage) {
    const TempFolder folder;
    writeModels(folder, 1);
    EXPECT_EQ(runTool(folder, "generate in -o out --resume").exit_code, 2);
}

TEST(Batch, AnUnwritableManifestPreventsTheRun) {
    const TempFolder folder;
    writeModels(folder, 1);
    folder.write("file", "");
    const ToolRun run = runTool(folder, "generate in -o out --manifest file/m.jsonl");
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_EQ(run.errorLines(), 1);
    EXPECT_FALSE(folder.has("out"));
}

TEST(Batch, InspectSupportsJobsAndShards) {
    const TempFolder folder;
    writeModels(folder, 8);
    EXPECT_EQ(runTool(folder, "inspect in --json").out, runTool(folder, "inspect in --json --jobs 4").out);
    std::size_t seen = 0;
    for (const char* shard : {"1/2", "2/2"}) {
        seen += Json::parse(runTool(folder, std::string("inspect in --json --shard ") + shard).out)["files"].size();
    }
    EXPECT_EQ(seen, 8U);
}

}  // namespace
}  // namespace tspace::test
