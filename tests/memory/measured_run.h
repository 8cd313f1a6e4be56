// SPDX-License-Identifier: MIT
// Runs the built tool and measures its peak memory.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace tspace::test {

struct MeasuredRun {
    int exit_code = -1;  ///< for a run that was ended by a signal: 128 plus its number
    std::uint64_t peak_bytes = 0;
    double processor_seconds = 0;
};

/// Limits the address space of this process and of the tool, to protect the machine from a tool that ignores its
/// limits.
inline void limitAddressSpace() {
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = std::min(limit.rlim_max, rlim_t{4} << 30);
    setrlimit(RLIMIT_AS, &limit);
}

/// Runs the tool and measures its peak memory. The measured peak is at least the memory that this process had when it
/// started the tool, so tests keep little data in memory.
inline MeasuredRun runMeasured(const std::vector<std::string>& arguments, const std::filesystem::path& messages) {
    limitAddressSpace();
    std::vector<std::string> words = {TSPACE_TOOL};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    pid_t child = 0;
    MeasuredRun run;
    const bool started = posix_spawn(&child, TSPACE_TOOL, &actions, nullptr, pointers.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    if (!started) return run;
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child) return run;
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
    };
    run.processor_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    return run;
}

}  // namespace tspace::test
