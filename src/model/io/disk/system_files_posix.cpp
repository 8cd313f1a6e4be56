// SPDX-License-Identifier: MIT
#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <string_view>

#include "model/io/disk/stepped_writer.h"
#include "model/io/system_files.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

void throwIfOutOfMemory(int error) {
    if (error == ENOMEM) throw std::bad_alloc();
}

}  // namespace

CFile openFile(const Path& path, const char* mode) {
    CFile file(std::fopen(path.string().c_str(), mode));
    if (!file) throwIfOutOfMemory(errno);
    return file;
}

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

Path canonicalPath(const Path& path) {
    try {
        return fs::weakly_canonical(fs::absolute(fs::path(path)));
    } catch (const fs::filesystem_error& failure) {
        throwIfOutOfMemory(failure.code().value());
        throw;
    }
}

std::string fileIdentity(const Path& path) {
    struct stat status = {};
    if (::stat(path.string().c_str(), &status) != 0) return {};
    return std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

namespace {

PathKind kindOf(const struct stat& status) {
    if (S_ISREG(status.st_mode)) return PathKind::file;
    if (S_ISDIR(status.st_mode)) return PathKind::folder;
    return S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode) ? PathKind::stream : PathKind::other;
}

}  // namespace

PathKind kindOf(const Path& path) {
    struct stat status = {};
    return ::stat(path.string().c_str(), &status) == 0 ? kindOf(status) : PathKind::nothing;
}

int listFolder(const Path& folder, std::vector<FolderEntry>& entries) {
    struct Close {
        void operator()(::DIR* open) const { ::closedir(open); }
    };
    const std::unique_ptr<::DIR, Close> open(::opendir(folder.string().c_str()));
    if (!open) {
        throwIfOutOfMemory(errno);
        return errno;
    }
    for (errno = 0; const ::dirent* const found = ::readdir(open.get()); errno = 0) {
        const std::string_view name = found->d_name;
        if (name == "." || name == "..") continue;
        FolderEntry entry{.name = std::string(name)};
        if (found->d_type == DT_REG || found->d_type == DT_DIR) {
            entry.kind = found->d_type == DT_REG ? PathKind::file : PathKind::folder;
        } else {
            struct stat status = {};
            const int number = ::dirfd(open.get());
            entry.is_link =
                ::fstatat(number, found->d_name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode);
            if (::fstatat(number, found->d_name, &status, 0) == 0) entry.kind = kindOf(status);
        }
        entries.push_back(std::move(entry));
    }
    throwIfOutOfMemory(errno);
    return errno;
}

bool isForeignLink(const Path& path) {
    struct stat link = {}, folder = {};
    if (::lstat(path.string().c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) return false;
    if (::stat(folderOf(path).string().c_str(), &folder) != 0) return false;
    const bool is_shared = (folder.st_mode & S_ISVTX) != 0 && (folder.st_mode & S_IWOTH) != 0;
    return is_shared && link.st_uid != ::geteuid() && link.st_uid != folder.st_uid;
}

CFile createFile(const Path& path, const Path& like) {
    struct stat old = {};
    const bool is_like = ::stat(like.string().c_str(), &old) == 0 && S_ISREG(old.st_mode);
    const ::mode_t mode = is_like ? old.st_mode & S_IRWXU : S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
    const int number = ::open(path.string().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (number < 0) return nullptr;
    CFile file(::fdopen(number, "wb"));
    if (!file) {
        const int why = errno;
        ::close(number);
        ::unlink(path.string().c_str());
        throwIfOutOfMemory(why);
        errno = why;
    }
    return file;
}

void takePermissions(std::FILE* file, const Path& like) {
    const int number = ::fileno(file);
    struct stat old = {}, made = {};
    if (::stat(like.string().c_str(), &old) != 0 || !S_ISREG(old.st_mode)) return;
    // Keeps the owner if this user may set it, otherwise only the group.
    if (::fchown(number, old.st_uid, old.st_gid) != 0)
        static_cast<void>(::fchown(number, ~::uid_t{0}, old.st_gid) == 0);  // the result is checked below
    ::mode_t mode = old.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO);
    // If the group could not be kept, the file's group gets at most the permissions of others.
    if (::fstat(number, &made) != 0 || made.st_gid != old.st_gid) mode &= ~S_IRWXG | (mode & S_IRWXO) << 3;
    static_cast<void>(::fchmod(number, mode));
}

bool syncFile(std::FILE* file) {
    if (std::fflush(file) != 0) return false;
    // Some file systems do not support fsync.
    return ::fsync(::fileno(file)) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

namespace {

#if defined(SYNC_FILE_RANGE_WRITE) && !defined(__EMSCRIPTEN__)
void flushRange(std::FILE* file, std::size_t begin, std::size_t byte_count, unsigned flags) {
    static_cast<void>(
        ::sync_file_range(::fileno(file), static_cast<::off_t>(begin), static_cast<::off_t>(byte_count), flags));
}
constexpr unsigned kStartFlush = SYNC_FILE_RANGE_WRITE, kFinishFlush = SYNC_FILE_RANGE_WAIT_BEFORE;
#else
void flushRange(std::FILE*, std::size_t, std::size_t, unsigned) {}
constexpr unsigned kStartFlush = 0, kFinishFlush = 0;
#endif

}  // namespace

void startFlush(std::FILE* file, std::size_t begin, std::size_t byte_count) noexcept {
    flushRange(file, begin, byte_count, kStartFlush);
}

void finishFlush(std::FILE* file, std::size_t begin, std::size_t byte_count) noexcept {
    flushRange(file, begin, byte_count, kFinishFlush);
}

void syncFolder(const Path& folder) {
    const int number = ::open(folder.string().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (number < 0) return;
    static_cast<void>(::fsync(number));
    ::close(number);
}

int renameFile(const Path& from, const Path& to) noexcept {
    return ::rename(from.string().c_str(), to.string().c_str()) == 0 ? 0 : errno;
}
int linkFile(const Path& from, const Path& to) noexcept {
    return ::link(from.string().c_str(), to.string().c_str()) == 0 ? 0 : errno;
}
int removePath(const Path& path) noexcept { return std::remove(path.string().c_str()) == 0 ? 0 : errno; }

std::uint64_t randomNumber() {
    std::uint64_t number = 0;
    if (::getentropy(&number, sizeof number) == 0) return number;
    // Fallback for kernels before 2014, which lack getentropy. The time is predictable, but O_EXCL still protects
    // against files that were planted under this name.
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
}

HeldSignals::HeldSignals() {
    static_assert(sizeof(sigset_t) <= sizeof before_);
    sigset_t held, before;
    sigfillset(&held);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS}) sigdelset(&held, fault);
    pthread_sigmask(SIG_SETMASK, &held, &before);
    std::memcpy(before_, &before, sizeof before);
}
HeldSignals::~HeldSignals() {
    sigset_t before;
    std::memcpy(&before, before_, sizeof before);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void waitBriefly() { ::poll(nullptr, 0, 1); }

std::uint32_t processNumber() { return static_cast<std::uint32_t>(::getpid()); }

bool isRunning(std::uint32_t process) {
    // kill() interprets IDs that are not positive as process groups.
    if (process == 0 || process > static_cast<std::uint32_t>(std::numeric_limits<pid_t>::max())) return true;
    return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
}

std::string processSpace() {
    std::array<char, 256> name = {};
    ::gethostname(name.data(), name.size() - 1);
    std::string text = name.data();
    std::string line;
    // On Linux, the host name is followed by the IDs of this boot and of the PID namespace.
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
