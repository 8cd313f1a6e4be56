// SPDX-License-Identifier: MIT
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>

#include "asset/system_files.h"

namespace tspace {

namespace fs = std::filesystem;

CFile openFile(const Path& path, const char* mode) { return CFile(std::fopen(path.string().c_str(), mode)); }

bool readAt(std::FILE* file, std::size_t begin, std::span<std::uint8_t> to) {
    const int number = ::fileno(file);
    while (!to.empty()) {
        const ::ssize_t count = ::pread(number, to.data(), to.size(), static_cast<::off_t>(begin));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        begin += static_cast<std::size_t>(count);
        to = to.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

Path canonicalPath(const Path& path) { return fs::weakly_canonical(fs::absolute(fs::path(path))); }

std::string fileIdentity(const Path& path) {
    struct stat status = {};
    if (::stat(path.string().c_str(), &status) != 0) return {};
    return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

std::uint32_t processNumber() { return static_cast<std::uint32_t>(::getpid()); }

bool isRunning(std::uint32_t process) {
    // kill() takes what is not positive for groups.
    if (process == 0 || process > static_cast<std::uint32_t>(std::numeric_limits<pid_t>::max())) return true;
    return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
}

std::string processSpace() {
    std::array<char, 256> name = {};
    ::gethostname(name.data(), name.size() - 1);
    std::string text = name.data();
    std::string line;
    // Both are Linux's: this start of the kernel, and the container. Empty elsewhere.
    if (std::ifstream boot("/proc/sys/kernel/random/boot_id"); std::getline(boot, line)) text += line;
    std::error_code ignored;
    text += fs::read_symlink("/proc/self/ns/pid", ignored).string();
    return text;
}

Path ownProgram() {
    std::error_code failed;
    return fs::read_symlink("/proc/self/exe", failed);
}

}  // namespace tspace
