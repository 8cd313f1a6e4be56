// SPDX-License-Identifier: MIT
// The built tool as a process to which a test sends signals.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tspace::test {

/// Starts the tool in `folder`, with default actions for all signals and without output. `variables`: its environment.
class StartedTool {
  public:
    StartedTool(const std::filesystem::path& folder, std::vector<std::string> arguments,
                std::vector<std::string> variables = {}) {
        arguments.insert(arguments.begin(), TSPACE_TOOL);
        // Tests may run under nohup, and the tool inherits ignored signals.
        posix_spawnattr_t attributes;
        sigset_t all;
        sigfillset(&all);
        EXPECT_EQ(posix_spawnattr_init(&attributes), 0);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
        for (const int output : {STDOUT_FILENO, STDERR_FILENO})
            posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
        EXPECT_EQ(posix_spawn(&process_, TSPACE_TOOL, &actions, &attributes, pointersTo(arguments).data(),
                              pointersTo(variables).data()),
                  0);
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    ~StartedTool() {
        if (has_ended_) return;
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    StartedTool(const StartedTool&) = delete;
    StartedTool& operator=(const StartedTool&) = delete;

    void send(int signal) const { kill(process_, signal); }

    /// Waits until the process ends. Returns its exit code, or 128 plus the number of the signal that ended it.
    int end() {
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        has_ended_ = true;
        return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }

    /// Sends a signal and waits until the process ends. Returns its exit code, and the time in seconds that it took.
    std::pair<int, double> endBy(int signal) {
        const auto start = std::chrono::steady_clock::now();
        send(signal);
        const int code = end();
        return {code, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
    }

  private:
    static std::vector<char*> pointersTo(std::vector<std::string>& texts) {
        std::vector<char*> pointers;
        for (std::string& text : texts) pointers.push_back(text.data());
        pointers.push_back(nullptr);
        return pointers;
    }

    pid_t process_ = 0;
    bool has_ended_ = false;
};

}  // namespace tspace::test
