// SPDX-License-Identifier: MIT
// The importer as a process: its resource limits, and that neither the process nor its files outlive the tool.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "support/temp_folder.h"
#include "tool/started_tool.h"
#include "tspace/inspect.h"
#include "tspace/result.h"

namespace tspace::test {
namespace {

namespace fs = std::filesystem;

/// Writes 58 bytes that keep Assimp 5 busy for minutes, and returns the path.
std::string endlessPly(const TempFolder& folder) {
    return folder.write("endless.ply", "ply\nformat ascii 1.0\nelement vertex 2147483647\nend_header\n");
}

double childProcessorSeconds() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

std::string errorOf(const Result<Inspection>& result) { return result ? "" : result.error().message; }

TEST(ImportProcess, FilesWithHugeCountsAreStoppedAfterTwoSeconds) {
    const TempFolder folder;
    for (const char* claim : {"vertex", "face"}) {
        const std::string path =
            folder.write("a.ply", "ply\nformat ascii 1.0\nelement " + std::string(claim) + " 2147483647\nend_header\n");
        const double before = childProcessorSeconds();
        const Result<Inspection> result = inspectFile(path, {.importer = TSPACE_IMPORTER});
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::invalidFile);
        EXPECT_EQ(errorOf(result),
                  "the importer was stopped after 2 s of CPU time; use --import-seconds to allow more");
        EXPECT_LT(childProcessorSeconds() - before, 3.5);
    }
}

/// Writes a script that is used in place of the importer.
std::string script(const TempFolder& folder, const std::string& commands) {
    const std::string path = folder.write("importer", "#!/bin/sh\n" + commands);
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

TEST(ImportProcess, LimitsGrowWithTheFile) {
    const TempFolder folder;
    FileOptions options{.importer = script(folder, "echo \"$2 $3 $4\" >&2\nexit 3\n")};
    const std::string small = folder.write("a.ply", std::string(60, ' '));
    const std::string large = folder.write("b.ply", std::string(std::size_t{10} << 20, ' '));
    EXPECT_EQ(errorOf(inspectFile(small, options)), std::to_string((192 << 20) + 256 * 60) + " 2 20");
    EXPECT_EQ(errorOf(inspectFile(large, options)),
              std::to_string((std::uint64_t{192} << 20) + (std::uint64_t{2560} << 20)) + " 12 120");
    options.import_max_seconds = 7;
    EXPECT_EQ(errorOf(inspectFile(small, options)).substr(10), "7 7");
}

TEST(ImportProcess, AnEndlessResultIsStopped) {
    const TempFolder folder;
    FileOptions options{.importer = script(folder, "exec cat /dev/zero\n")};
    options.memory_limit_bytes = std::uint64_t{1} << 20;
    options.import_max_seconds = 60;
    EXPECT_NE(errorOf(inspectFile(folder.write("a.ply", "ply"), options)).find("exceeded the memory limit"),
              std::string::npos);
}

TEST(ImportProcess, EndlessMessagesAndClosedPipesEndAtTheTimeLimit) {
    const TempFolder folder;
    FileOptions options{.importer = script(folder, "exec cat /dev/zero >&2\n")};
    options.import_max_seconds = 1;
    const std::string path = folder.write("a.ply", "ply");
    EXPECT_NE(errorOf(inspectFile(path, options)).find("stopped after 1 s"), std::string::npos);
    script(folder, "exec >/dev/null 2>&1\nexec sleep 60\n");
    EXPECT_EQ(errorOf(inspectFile(path, options)),
              "the importer was stopped after 1 s; use --import-seconds to allow more");
}

TEST(ImportProcess, SignalsThatTheProgramIgnoresStillEndTheImporter) {
    const TempFolder folder;
    const auto old = signal(SIGXCPU, SIG_IGN);
    FileOptions options{.importer = TSPACE_IMPORTER};
    options.import_max_seconds = 1;
    EXPECT_NE(errorOf(inspectFile(endlessPly(folder), options)).find("stopped after 1 s"), std::string::npos);
    signal(SIGXCPU, old);
}

#ifdef __linux__

using std::chrono::seconds;

bool soon(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + seconds(20);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

std::string textOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// Returns the processes whose command line contains both texts. Processes that have ended but wait for their parent
/// have no command line.
std::vector<pid_t> processesWith(const std::string& program, const std::string& path) {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const std::string line = textOf(entry.path() / "cmdline");
        if (line.find(program) != std::string::npos && line.find(path) != std::string::npos)
            found.push_back(std::stoi(name));
    }
    return found;
}

/// A tool that is processing a file, with a folder of its own for temporary files.
class RunningTool : public StartedTool {
  public:
    RunningTool(const TempFolder& folder, std::vector<std::string> arguments)
        : StartedTool(folder.path(), std::move(arguments), {"TMPDIR=" + makeFolder(folder.path("tmp"))}),
          folder_(folder.path()) {}
    ~RunningTool() {
        for (const pid_t importer : importers()) kill(importer, SIGKILL);
    }
    RunningTool(const RunningTool&) = delete;
    RunningTool& operator=(const RunningTool&) = delete;

    [[nodiscard]] std::vector<pid_t> importers() const { return processesWith("tspace-import", folder_.string()); }

  private:
    static std::string makeFolder(const fs::path& path) {
        fs::create_directories(path);
        return path.string();
    }

    fs::path folder_;
};

TEST(ImportProcess, EndsWithTheToolAndLeavesNoFile) {
    for (const char* command : {"inspect", "generate"}) {
        for (const int signal : {SIGKILL, SIGTERM, SIGINT, SIGHUP}) {
            const TempFolder folder;
            std::vector<std::string> arguments = {command, endlessPly(folder), "--import-seconds", "100"};
            if (command == std::string("generate"))
                arguments.insert(arguments.end(), {"-o", folder.path("out/").string(), "--jobs", "2"});
            RunningTool tool(folder, arguments);
            ASSERT_TRUE(soon([&] { return !tool.importers().empty(); })) << command;
            EXPECT_EQ(tool.endBy(signal).first, 128 + signal) << command;
            EXPECT_TRUE(soon([&] { return tool.importers().empty(); })) << command << " " << signal;
            EXPECT_EQ(folder.files("tmp"), std::set<std::string>());
            EXPECT_FALSE(folder.has("out")) << command << " " << signal;
        }
    }
}

TEST(ImportProcess, OpensOnlyItsModelAndItsPipes) {
    const TempFolder folder;
    folder.write("secret", "x");
    const int secret = open(folder.path("secret").c_str(), O_RDONLY);
    ASSERT_GE(secret, 0);
    RunningTool tool(folder, {"inspect", endlessPly(folder), "--import-seconds", "100"});
    // The importer opens the model last.
    const auto open_files = [&] {
        std::set<std::string> files;
        for (const pid_t importer : tool.importers()) {
            std::error_code error;
            for (const auto& entry : fs::directory_iterator("/proc/" + std::to_string(importer) + "/fd", error)) {
                std::string target = fs::read_symlink(entry.path(), error).string();
                if (!error) files.insert(target.starts_with("pipe:") ? "pipe" : std::move(target));
            }
        }
        return files;
    };
    const std::string model = folder.path("endless.ply").string();
    EXPECT_TRUE(soon([&] { return open_files().contains(model); }));
    EXPECT_EQ(open_files(), (std::set<std::string>{"/dev/null", "pipe", model}));
    close(secret);
}

TEST(ImportProcess, IsConfinedBeforeItReadsTheModel) {
    const TempFolder folder;
    RunningTool tool(folder, {"inspect", endlessPly(folder), "--import-seconds", "100"});
    std::string status;
    const auto says = [&](const char* line) { return status.find(line) != std::string::npos; };
    const auto isConfined = [&] {
        for (const pid_t importer : tool.importers()) status = textOf("/proc/" + std::to_string(importer) + "/status");
        return says("NoNewPrivs:\t1");
    };
    EXPECT_TRUE(soon(isConfined)) << status;
#ifndef TSPACE_SANITIZED  // sanitizers need more than the filter allows
    if (!says("Seccomp:")) GTEST_SKIP() << "this kernel has no filter of system calls";
    EXPECT_TRUE(soon([&] { return isConfined() && says("Seccomp:\t2"); })) << status;
#endif
}

#endif

}  // namespace
}  // namespace tspace::test
