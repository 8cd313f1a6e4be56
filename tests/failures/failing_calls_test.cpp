// SPDX-License-Identifier: MIT
// The tool when a system call fails, when a signal arrives, or when no thread can be started.
#include <gtest/gtest.h>

#include <csignal>
#include <map>

#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// Returns a command prefix that preloads failing_calls and sets its environment variables.
std::string with(const std::string& settings) { return settings + " LD_PRELOAD='" TSPACE_FAILING_CALLS "'"; }

std::string writeModel(const TempFolder& folder) {
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    EXPECT_EQ(runTool(folder, "generate folded.obj -q -o made.glb").exit_code, 0);
    EXPECT_EQ(runTool(folder, "generate made.glb -q --overwrite --convention opengl -o plain.glb").exit_code, 0);
    return folder.read("plain.glb");
}

/// Runs the tool with a failing system call (the first one, then every `every`th one) and calls try_one(k, run), until
/// a run makes fewer calls.
template <class TryOne>
void failEachCall(const TempFolder& folder, const std::string& arguments, const TryOne& try_one, int every = 1) {
    constexpr int kMostCalls = 3000;
    int k = 1;
    for (; k <= kMostCalls; k += every) {
        std::filesystem::remove(folder.path("mark"));
        const ToolRun run =
            runTool(folder, arguments, with("TSPACE_FAIL_MARK=mark TSPACE_FAIL_CALL=" + std::to_string(k)));
        if (!folder.has("mark")) break;
        std::filesystem::remove(folder.path("mark"));
        ASSERT_LE(run.exit_code, 5) << arguments << ", call " << k << ": " << run.err;
        try_one(k, run);
        if (::testing::Test::HasFailure()) return;
    }
    EXPECT_GT(k, 20) << "no calls were seen";
    EXPECT_LE(k, kMostCalls);
}

/// Returns whether the outputs exist: the run succeeded, or only its messages could not be printed.
bool hasWritten(const ToolRun& run) {
    return run.exit_code == 0 || run.err.find("standard output") != std::string::npos;
}

TEST(FailingCalls, KeepTheOldFileOrWriteTheNewOne) {
    const TempFolder folder;
    const std::string before = writeModel(folder);
    ASSERT_EQ(runTool(folder, "generate plain.glb -q --overwrite -o new.glb").exit_code, 0);
    const std::string after = folder.read("new.glb");
    ASSERT_FALSE(before == after);
    const std::set<std::string> files = folder.files();
    failEachCall(folder, "generate made.glb -q --overwrite -o new.glb --jobs 1", [&](int k, const ToolRun& run) {
        EXPECT_EQ(folder.files(), files) << "call " << k << ", exit code " << run.exit_code << ": " << run.err;
        EXPECT_TRUE(folder.read("new.glb") == (hasWritten(run) ? after : before)) << "call " << k << ": " << run.err;
        folder.write("new.glb", before);
    });
}

TEST(FailingCalls, OfSeveralFilesLeaveAllOldOnesOrAllNewOnes) {
    const TempFolder folder;
    writeModel(folder);
    ASSERT_EQ(runTool(folder, "generate plain.glb -q -o out.gltf").exit_code, 0);
    std::map<std::string, std::string> before, after;
    const auto contents = [&] {
        std::map<std::string, std::string> found;
        for (const std::string& name : folder.files()) found[name] = folder.read(name);
        return found;
    };
    before = contents();
    const std::string command = "generate plain.glb -q --overwrite -o out.gltf";
    ASSERT_EQ(runTool(folder, command).exit_code, 0);
    after = contents();
    ASSERT_FALSE(before == after);
    for (const auto& [name, bytes] : before) folder.write(name, bytes);
    failEachCall(folder, command, [&](int k, const ToolRun& run) {
        EXPECT_TRUE(contents() == (hasWritten(run) ? after : before)) << "call " << k << ": " << run.err;
        for (const auto& [name, bytes] : before) folder.write(name, bytes);
    });
}

TEST(FailingCalls, OfACheckAreReportedAndLeaveNoPartialPage) {
    const TempFolder folder;
    writeModel(folder);
    const std::string command = "check plain.glb --html page.html --json";
    const ToolRun whole = runTool(folder, command);
    ASSERT_LE(whole.exit_code, 1) << whole.err;
    const std::string page = folder.read("page.html"), page_end = page.substr(page.size() - 30);
    std::set<std::string> files = folder.files();
    folder.write("page.html", "old");
    failEachCall(folder, command, [&](int k, const ToolRun& run) {
        EXPECT_EQ(folder.files(), files) << "call " << k << ": " << run.err;
        const std::string found = folder.read("page.html");
        // A failure while pictures are rendered, for which the model is read again, may leave a page without them.
        EXPECT_TRUE(found == "old" || found.ends_with(page_end)) << "call " << k;
        if (run.exit_code == whole.exit_code) {
            EXPECT_NE(found, "old") << "call " << k << run.err;
            // An unreadable image causes only a remark, because frames can be checked without it.
            EXPECT_TRUE(run.out == whole.out || run.out.find("fileRemark") != std::string::npos)
                << "call " << k << run.err << run.out;
        }
        folder.write("page.html", "old");
    });
}

/// A command line for the files of writeModel, and its outputs.
struct Writing {
    std::string command = {};
    std::vector<std::string> outputs = {};
};

std::vector<Writing> writings() {
    return {
        {"check plain.glb --sarif new.sarif", {"new.sarif"}},
        {"inspect made.glb --json", {}},
        {"identify plain.glb --json", {}},
        {"diff plain.glb made.glb --html new.html", {"new.html"}},
        {"flip-green bump.png -o new.png", {"new.png"}},
        {"convert-map bump.png --mesh plain.glb --to object -o new.png", {"new.png"}},
        {"height-to-normal bump.png -o new.png", {"new.png"}},
        {"compress-map bump.png -o new.ktx2", {"new.ktx2"}},
        {"render plain.glb --size 16 -o new.png", {"new.png"}},
        {"view plain.glb -o new.html", {"new.html"}},
        {"bake plain.glb --high made.glb --size 16 --maps normal,ao -o new.png", {"new.png", "new_ao.png"}},
        {"finish plain.glb -o new.glb --html new.html", {"new.glb", "new.html"}},
        {"map-error bump.png plain.glb --high made.glb --json", {}},
    };
}

/// Runs the command without failures. Returns false if this build lacks a required feature.
bool isThere(const TempFolder& folder, const Writing& writing) {
    const ToolRun run = runTool(folder, writing.command);
    if (run.exit_code <= 1) return true;
    EXPECT_TRUE(run.err.find("without") != std::string::npos || run.err.find("this build") != std::string::npos)
        << writing.command << ": " << run.err;
    return false;
}

/// Returns whether a page or SARIF file is complete. A page may lack a picture, and SARIF may say what could not be
/// read.
bool isWholeReport(const std::string& name, const std::string& text) {
    return (name.ends_with(".html") && text.ends_with("</html>\n")) ||
           (name.ends_with(".sarif") && text.ends_with("}\n"));
}

// SOURCE_DATE_EPOCH makes pages equal; otherwise they contain the time at which they were created.
TEST(FailingCalls, OfAnyCommandLeaveItsOldFilesOrItsNewOnes) {
    const TempFolder folder;
    writeModel(folder);
    setenv("SOURCE_DATE_EPOCH", "1", 1);
    for (const Writing& writing : writings()) {
        if (!isThere(folder, writing)) continue;
        std::map<std::string, std::string> after;
        for (const std::string& name : writing.outputs) {
            after[name] = folder.read(name);
            folder.write(name, "old");
        }
        const std::set<std::string> files = folder.files();
        const auto look = [&](int k, const ToolRun& run) {
            const std::string where = writing.command + ", call " + std::to_string(k) + ": " + run.err;
            EXPECT_EQ(folder.files(), files) << where;
            std::size_t new_count = 0;
            for (const auto& [name, bytes] : after) {
                const std::string found = folder.read(name);
                new_count += found != "old";
                const bool is_warned = run.out.find("  warning  ") != std::string::npos;
                EXPECT_TRUE(found == "old" || found == bytes || is_warned || isWholeReport(name, found))
                    << name << ": " << where << run.out;
                folder.write(name, "old");
            }
            const bool has_written = run.exit_code == 1 || hasWritten(run);
            // SARIF is written even if an input cannot be read.
            if (!after.contains("new.sarif")) {
                EXPECT_EQ(new_count, has_written ? after.size() : 0) << where;
            }
        };
        // Testing each of 1,000 calls takes 95 s of processor time, so only long test runs test all of them.
        failEachCall(folder, writing.command, look, TSPACE_EVERY_FAILING_CALL);
        for (const std::string& name : writing.outputs) std::filesystem::remove(folder.path(name));
    }
    unsetenv("SOURCE_DATE_EPOCH");
}

TEST(Signals, LeaveNoTemporaryFileInAnyCommand) {
    const TempFolder folder;
    writeModel(folder);
    folder.write("old.html", "old");
    const std::set<std::string> files = folder.files();
    std::vector<Writing> all = writings();
    all.push_back({"generate made.glb --overwrite -o plain.glb", {"plain.glb"}});
    all.push_back({"generate made.glb --overwrite -o new/x.gltf", {"new/x.gltf", "new/x.bin", "new/bump.png"}});
    all.push_back({"check plain.glb --html old.html", {"old.html"}});
    for (const Writing& writing : all) {
        if (writing.outputs.empty() || !isThere(folder, writing)) continue;
        for (const std::string& name : writing.outputs)
            if (!files.contains(name)) std::filesystem::remove(folder.path(name));
        folder.write("old.html", "old");
        const std::string& command = writing.command;
        for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGQUIT}) {
            const std::string before = folder.read("plain.glb");
            const ToolRun run =
                runTool(folder, command,
                        "exec env --default-signal " + with("TSPACE_SIGNAL_AT_SYNC=" + std::to_string(signal)));
            EXPECT_EQ(run.exit_code, 128 + signal) << command << run.err;
            EXPECT_EQ(folder.files(), files) << command << ", signal " << signal;
            EXPECT_EQ(folder.read("old.html"), "old");
            EXPECT_EQ(folder.read("plain.glb"), before);
        }
    }
}

/// Runs a command while allocations of the C library fail. The only permitted error is a lack of memory, and the
/// outputs must exist if and only if the exit code says so.
class FailingMallocs {
  public:
    FailingMallocs(const TempFolder& folder, const Writing& writing) : folder_(folder), writing_(writing) {
        is_there_ = isThere(folder, writing);
        for (const std::string& name : writing.outputs) folder.write(name, "old");
        files_ = folder.files();
    }
    ~FailingMallocs() {
        for (const std::string& name : writing_.outputs) std::filesystem::remove(folder_.path(name));
    }
    FailingMallocs(const FailingMallocs&) = delete;
    FailingMallocs& operator=(const FailingMallocs&) = delete;

    /// Lets each allocation fail in turn, or a subset of them in short test runs.
    void failEach() {
        for (const char* const mode : {"0", "1"}) {
            for (int k = 1; is_there_ && fail(k, mode); k += 1 + k / TSPACE_EVERY_MALLOC_UP_TO) {
            }
        }
    }
    /// Lets the last allocations fail, with which reports are prepared and outputs are put in place.
    void failLast() {
        if (!is_there_) return;
        fail(kNone, "0");
        for (int from_end = 0; from_end < count_ && !::testing::Test::HasFailure(); from_end += 1 + 2 * from_end)
            fail(count_ - from_end, "1");
    }

  private:
    /// Lets allocation k fail. Returns false if the run makes fewer allocations, or if the test has failed.
    bool fail(int k, const char* mode) {
        const std::string settings =
            "TSPACE_FAIL_MARK=mark TSPACE_FAIL_MALLOC=" + std::to_string(k) + " TSPACE_FAIL_MALLOC_AFTER=" + mode;
        const ToolRun run = runTool(folder_, writing_.command, "timeout -s KILL 20 env " + with(settings));
        const bool was_reached = folder_.has("mark");
        if (k == kNone) count_ = std::atoi(folder_.read("mark").c_str());
        std::filesystem::remove(folder_.path("mark"));
        const std::string where = writing_.command + ", " + settings + ": " + run.err;
        const bool has_failed = run.exit_code == 5;
        EXPECT_TRUE(has_failed || run.exit_code <= 1 || hasWritten(run)) << run.exit_code << where;
        EXPECT_EQ(folder_.files(), files_) << where;
        for (const std::string& name : writing_.outputs) {
            EXPECT_EQ(folder_.read(name) == "old", has_failed) << name << ": " << where;
            folder_.write(name, "old");
        }
        return was_reached && !::testing::Test::HasFailure();
    }

    static constexpr int kNone = -1;  ///< no allocation fails, but all are counted

    const TempFolder& folder_;
    const Writing& writing_;
    std::set<std::string> files_ = {};
    int count_ = 0;
    bool is_there_ = false;
};

TEST(FailingAllocations, OfTheCLibraryAreReportedAndLeaveNoOutput) {
    const TempFolder folder;
    writeModel(folder);
    runTool(folder, "convert-map bump.png -q -o bump.exr");
    for (const Writing& writing : std::vector<Writing>{
             {"generate made.glb --overwrite --jobs 1 -o new.glb", {"new.glb"}},
             {"flip-green bump.png -o new.png", {"new.png"}},
             {"convert-map bump.png --flip-green -o new.png", {"new.png"}},
             {"convert-map bump.exr -o new.exr", {"new.exr"}},
             {"height-to-normal bump.png --json -o new.png", {"new.png"}},
             {"compress-map bump.png -o new.ktx2", {"new.ktx2"}},
             {"render plain.glb --size 16 -o new.png", {"new.png"}},
         })
        FailingMallocs(folder, writing).failEach();
}

TEST(FailingAllocations, OfAnExceptionDoNotRaiseASignal) {
    const TempFolder folder;
    writeModel(folder);
    const std::set<std::string> files = folder.files();
    for (const char* const command : {"height-to-normal bump.png -o new.png", "check plain.glb"}) {
        for (const int k : {1, 30, 100, 200, 300}) {
            const std::string settings = "TSPACE_NO_RESERVE=1 TSPACE_FAIL_MALLOC_AFTER=1 TSPACE_FAIL_MALLOC=";
            const ToolRun run = runTool(folder, command, "env " + with(settings + std::to_string(k)));
            EXPECT_TRUE(run.exit_code <= 1 || run.exit_code == 5) << command << ", " << k << ": " << run.err;
            EXPECT_TRUE(run.exit_code != 5 || run.err == "tspace: out of memory\n") << run.err;
            std::filesystem::remove(folder.path("new.png"));
            EXPECT_EQ(folder.files(), files) << command << ", " << k;
        }
    }
}

TEST(FailingAllocations, AtTheEndOfAnyCommandLeaveNoOutput) {
    const TempFolder folder;
    writeModel(folder);
    folder.write("pairs.txt", "plain.glb = made.glb\n");
    std::vector<Writing> all = writings();
    for (Writing& writing : all) {
        if (writing.command.find("--json") == std::string::npos) writing.command += " --json";
    }
    all.push_back({"generate made.glb --overwrite --json -o new.glb", {"new.glb"}});
    all.push_back({"check plain.glb --html new.html", {"new.html"}});
    all.push_back({"bake --pairs pairs.txt --size 16 --json -o new/", {"new/plain.png"}});
    all.push_back({"map-error bump.png plain.glb --high made.glb --heat new.png", {"new.png"}});
    for (const Writing& writing : all) {
        if (!writing.outputs.empty()) FailingMallocs(folder, writing).failLast();
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(NoThreads, RunsOnTheCallingThread) {
    const TempFolder folder;
    writeModel(folder);
    for (const char* name : {"a", "b", "c", "d"})
        folder.write(std::string("in/") + name + ".glb", folder.read("made.glb"));
    const std::string none = with("TSPACE_NO_THREADS=1");
    for (const char* command : {"check in", "inspect in", "identify in"}) {
        const ToolRun some = runTool(folder, std::string(command) + " --jobs 8");
        const ToolRun run = runTool(folder, std::string(command) + " --jobs 8", none);
        EXPECT_EQ(run.exit_code, some.exit_code) << command << run.err;
        EXPECT_EQ(run.out, some.out) << command;
    }
    ASSERT_EQ(runTool(folder, "generate in -q --overwrite -o some/ --jobs 8").exit_code, 0);
    const ToolRun run = runTool(folder, "generate in -q --overwrite -o none/ --jobs 8 --threads 8", none);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    for (const char* name : {"a.glb", "b.glb", "c.glb", "d.glb"})
        EXPECT_EQ(folder.read(std::string("none/") + name), folder.read(std::string("some/") + name));
    EXPECT_EQ(runTool(folder, "render plain.glb -o picture.png --threads 8", none).exit_code, 0);
}

TEST(NoThreads, AtALimitOfProcesses) {
    if (std::system("test $(id -u) = 0 && command -v setpriv > /dev/null && command -v prlimit > /dev/null") != 0)
        GTEST_SKIP() << "another user is needed, whose processes are limited";
    const TempFolder folder;
    writeModel(folder);
    folder.write("in/a.glb", folder.read("made.glb"));
    folder.write("in/b.glb", folder.read("made.glb"));
    const int code = runTool(folder, "check in").exit_code;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    std::filesystem::permissions(folder.path("in"), std::filesystem::perms::all);
    const ToolRun run = runTool(folder, "check in --jobs 8", "setpriv --reuid 65531 --clear-groups prlimit --nproc=1");
    if (run.exit_code > 125 && run.err.find("Permission denied") != std::string::npos)
        GTEST_SKIP() << "another user cannot start the tool here: " << run.err;
    EXPECT_EQ(run.exit_code, code) << run.err;
}

}  // namespace
}  // namespace tspace::test
