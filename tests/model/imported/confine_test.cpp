// SPDX-License-Identifier: MIT
// What a confined process can do. Each attempt is made by a separate child process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "../tools/tspace_import/confine.h"
#include "support/temp_folder.h"

namespace tspace::test {
namespace {

/// Exit code of a child whose kernel supports neither mechanism.
constexpr int kHasNone = 77;

/// Ends the process by a system call. _exit would not do: with sanitizers it queries the signal stack, which a confined
/// process must not do.
void end(int status) { syscall(SYS_exit_group, status); }

/// Returns the exit status of a child that is confined to `folder` and then makes the attempt: 0 if the attempt
/// succeeded.
int tryConfined(const std::string& folder, const std::function<bool()>& attempt,
                bool import::Confinement::*part = &import::Confinement::of_files) {
    const pid_t child = fork();
    if (child == 0) {
        const import::Confinement made = import::confine({folder});
        if (!(made.*part)) end(kHasNone);
        end(attempt() ? 0 : 1);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    return WEXITSTATUS(status);
}

bool reads(const std::string& path) {
    char byte = 0;
    const int file = open(path.c_str(), O_RDONLY);
    return file >= 0 && read(file, &byte, 1) == 1;
}

bool makes(const std::string& path) { return open(path.c_str(), O_WRONLY | O_CREAT, 0600) >= 0; }

TEST(Confinement, OnlyFilesOfTheFolderAreReadable) {
    const TempFolder folder, other;
    const std::string inside = folder.write("a.txt", "a"), outside = other.write("b.txt", "b");
    std::filesystem::create_symlink(outside, folder.path("link.txt"));
    const int read_inside = tryConfined(folder.path().string(), [&] { return reads(inside); });
    if (read_inside == kHasNone) GTEST_SKIP() << "this kernel has no Landlock";
    EXPECT_EQ(read_inside, 0);
    EXPECT_EQ(tryConfined(folder.path().string(), [&] { return reads(outside); }), 1);
    EXPECT_EQ(tryConfined(folder.path().string(), [&] { return reads(folder.path("link.txt").string()); }), 1);
    EXPECT_EQ(tryConfined(folder.path().string(), [&] { return reads(inside + "/../../../etc/passwd"); }), 1);
    EXPECT_EQ(tryConfined(folder.path().string(), [] { return reads("/etc/passwd"); }), 1);
    EXPECT_EQ(tryConfined("/", [] { return reads("/etc/passwd"); }), 0);
    EXPECT_EQ(tryConfined(inside, [&] { return reads(inside); }), 0) << "one file alone";
}

TEST(Confinement, WritingCreatingAndRenamingFail) {
    const TempFolder folder;
    const std::string root = folder.path().string(), file = folder.write("a.txt", "a"), fresh = root + "/b.txt";
    const std::function<bool()> attempts[] = {
        [&] { return makes(fresh); },
        [&] { return open(file.c_str(), O_RDWR) >= 0; },
        [&] { return truncate(file.c_str(), 0) == 0; },
        [&] { return std::rename(file.c_str(), fresh.c_str()) == 0; },
        [&] { return link(file.c_str(), fresh.c_str()) == 0; },
        [&] { return unlink(file.c_str()) == 0; },
        [&] { return mkdir(fresh.c_str(), 0700) == 0; },
    };
    for (const auto part : {&import::Confinement::of_files, &import::Confinement::of_calls}) {
        for (const std::function<bool()>& attempt : attempts) {
            const int status = tryConfined(root, attempt, part);
            if (status == kHasNone) continue;
            EXPECT_EQ(status, 1) << &attempt - attempts;
            EXPECT_EQ(folder.read("a.txt"), "a");
            EXPECT_FALSE(std::filesystem::exists(fresh));
        }
    }
}

TEST(Confinement, ProgramsProcessesConnectionsAndSignalsFail) {
    const std::function<bool()> attempts[] = {
        [] { return socket(AF_INET, SOCK_STREAM, 0) >= 0; },
        [] {
            int ends[2];
            return socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0;
        },
        [] {
            const pid_t child = fork();
            if (child == 0) _exit(0);
            return child > 0;
        },
        [] {
            char name[] = "true";
            char* arguments[] = {name, nullptr};
            execv("/bin/true", arguments);
            return false;  // execv returned, so the program did not run
        },
        [] { return kill(getppid(), 0) == 0; },
    };
    for (const std::function<bool()>& attempt : attempts) {
        const int status = tryConfined("/", attempt, &import::Confinement::of_calls);
        if (status == kHasNone) GTEST_SKIP() << "no filter of system calls here";
        EXPECT_EQ(status, 1) << &attempt - attempts;
    }
}

}  // namespace
}  // namespace tspace::test
