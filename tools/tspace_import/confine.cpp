// SPDX-License-Identifier: MIT
// Uses Linux mechanisms that do not require root privileges: Landlock for paths (since Linux 5.13), and a system call
// filter.
#include "confine.h"

#ifdef __linux__
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>

#if __has_include(<linux/landlock.h>)
#include <linux/landlock.h>
#endif
#endif

namespace tspace::import {

#ifdef __linux__

namespace {

#if defined(LANDLOCK_CREATE_RULESET_VERSION) && defined(SYS_landlock_create_ruleset)

/// Returns all file rights that this version of Landlock can restrict; the headers may be older than the kernel.
std::uint64_t rightsOf(long version) {
    constexpr unsigned kOfFirst = 13;
    unsigned count = kOfFirst;
    if (version >= 2) ++count;  // version 2 adds linking and renaming into another folder
    if (version >= 3) ++count;  // version 3 adds truncation of files
    if (version >= 5) ++count;  // version 5 adds ioctl
    return (std::uint64_t{1} << count) - 1;
}

void allowReading(int rules, const std::string& path) {
    const int place = open(path.c_str(), O_PATH | O_CLOEXEC);
    if (place < 0) return;  // the error is reported when the file is read
    struct stat status = {};
    landlock_path_beneath_attr rule = {};
    rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
    if (fstat(place, &status) == 0 && S_ISDIR(status.st_mode)) rule.allowed_access |= LANDLOCK_ACCESS_FS_READ_DIR;
    rule.parent_fd = place;
    syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0U);
    close(place);
}

bool confineFiles(const std::vector<std::string>& readable) {
    const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    if (version < 1) return false;
    landlock_ruleset_attr rights = {};
    rights.handled_access_fs = rightsOf(version);
    const auto rules =
        static_cast<int>(syscall(SYS_landlock_create_ruleset, &rights, sizeof rights.handled_access_fs, 0U));
    if (rules < 0) return false;
    for (const std::string& path : readable) allowReading(rules, path);
    const bool holds = syscall(SYS_landlock_restrict_self, rules, 0U) == 0;
    close(rules);
    return holds;
}

#else

bool confineFiles(const std::vector<std::string>&) { return false; }

#endif

// Sanitizers start threads and read kernel information about this process, which the filter would block.
#if (defined(__x86_64__) || defined(__aarch64__)) && !defined(TSPACE_SANITIZED)

#ifdef __x86_64__
constexpr std::uint32_t kMachine = AUDIT_ARCH_X86_64;
#else
constexpr std::uint32_t kMachine = AUDIT_ARCH_AARCH64;
#endif

/// System calls that a parser needs: memory, reading files, open descriptors, clocks, and exit. Programs for x32 use
/// different numbers, so they are rejected.
constexpr std::uint32_t kCalls[] = {
    // Memory and locks:
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mprotect,
    SYS_mremap,
    SYS_madvise,
    SYS_futex,
    SYS_getrandom,
    // Open descriptors:
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_write,
    SYS_writev,
    SYS_lseek,
    SYS_close,
    SYS_fstat,
    // File names:
    SYS_newfstatat,
    SYS_readlinkat,
    SYS_faccessat,
    SYS_getdents64,
    SYS_getcwd,
#ifdef SYS_statx
    SYS_statx,
#endif
#ifdef SYS_faccessat2
    SYS_faccessat2,
#endif
#ifdef SYS_stat
    SYS_stat,
    SYS_lstat,
    SYS_readlink,
    SYS_access,
#endif
    // This process, its time, and its exit:
    SYS_getpid,
    SYS_gettid,
    SYS_sysinfo,
    SYS_sched_getaffinity,
    SYS_sched_yield,
    SYS_clock_gettime,
    SYS_gettimeofday,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_exit,
    SYS_exit_group,
};

constexpr std::uint32_t kWritingFlags = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND;

/// Returns the offset of the lower half of an argument: both architectures are little-endian.
constexpr std::uint32_t argumentAt(std::size_t i) {
    return static_cast<std::uint32_t>(offsetof(seccomp_data, args) + i * sizeof(std::uint64_t));
}

/// Installs the filter. Calls that are not on the list fail as if the kernel did not support them, and libraries use
/// alternatives.
bool confineCalls() {
    std::vector<sock_filter> filter;
    const auto load = [&](std::size_t offset) {
        filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
    };
    const auto end = [&](std::uint32_t action) { filter.push_back(BPF_STMT(BPF_RET | BPF_K, action)); };
    /// Skips the next `skipped` instructions if the loaded word is not `value`.
    const auto onlyIf = [&](std::uint32_t value, std::uint8_t skipped) {
        filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skipped));
    };
    const auto allowReadingOpen = [&](std::uint32_t call, std::size_t flags) {
        onlyIf(call, 4);
        load(argumentAt(flags));
        filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, kWritingFlags, 1, 0));
        end(SECCOMP_RET_ALLOW);
        end(SECCOMP_RET_ERRNO | EACCES);
    };
    load(offsetof(seccomp_data, arch));
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kMachine, 1, 0));
    end(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
    allowReadingOpen(SYS_openat, 2);
#ifdef SYS_open
    allowReadingOpen(SYS_open, 1);
#endif
    for (const std::uint32_t call : kCalls) {
        onlyIf(call, 1);
        end(SECCOMP_RET_ALLOW);
    }
    end(SECCOMP_RET_ERRNO | ENOSYS);
    const sock_fprog program = {static_cast<unsigned short>(filter.size()), filter.data()};
    return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

#else

bool confineCalls() { return false; }

#endif

}  // namespace

Confinement confine(const std::vector<std::string>& readable) {
    // Both mechanisms require either this setting or root privileges.
    if (prctl(PR_SET_NO_NEW_PRIVS, 1UL, 0UL, 0UL, 0UL) != 0) return {};
    Confinement made;
    made.of_files = confineFiles(readable);
    made.of_calls = confineCalls();
    return made;
}

#else

Confinement confine(const std::vector<std::string>&) { return {}; }

#endif

}  // namespace tspace::import
