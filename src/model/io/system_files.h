// SPDX-License-Identifier: MIT
// System calls that std::filesystem does not provide; implemented in disk/system_files_posix.cpp and
// system_files_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/io/path.h"

namespace tspace {

/// C library file that is closed automatically.
struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using CFile = std::unique_ptr<std::FILE, CloseFile>;

/// Opens a file like fopen, for UTF-8 paths: returns null and sets errno on failure. Functions of this header that are
/// not noexcept throw std::bad_alloc if the system is out of memory.
CFile openFile(const Path& path, const char* mode);

/// Fills `to` with the bytes of an open file from `begin` on, independently of the file position. Thread-safe. Returns
/// false if the file is too short.
bool readAt(std::FILE* file, std::size_t begin, std::span<std::uint8_t> to);

/// Resolves links and ".." in the existing part of the path; the rest is unchanged.
Path canonicalPath(const Path& path);

/// Returns a string that is equal for all names of an existing file; empty if there is none.
std::string fileIdentity(const Path& path);

/// Kind of file at a path, with links followed. A stream is a character device or FIFO.
enum class PathKind { nothing, file, folder, stream, other };
PathKind kindOf(const Path& path);

/// File or folder in a folder.
struct FolderEntry {
    std::string name = {};
    PathKind kind = PathKind::nothing;  ///< result of kindOf()
    bool is_link = false;
};
/// Appends the entries of a folder. Returns 0, or errno if it could not be read completely. (The increment of GCC's
/// std::filesystem::directory_iterator terminates the process if an allocation fails.)
int listFolder(const Path& folder, std::vector<FolderEntry>& entries);

/// Returns whether a path is a symbolic link that another user may have planted: in a world-writable sticky folder
/// (/tmp), and owned by neither this user nor the folder's owner. This is the rule of protected_symlinks in Linux.
bool isForeignLink(const Path& path);

/// Creates a file exclusively for writing; fails if a file or link exists. If `like` exists, the new file gets at most
/// the permissions of its owner. Returns null and sets errno on failure.
CFile createFile(const Path& path, const Path& like);
/// Copies owner, group and permissions of `like`, as far as this user may; never grants more permissions than `like`
/// has.
void takePermissions(std::FILE* file, const Path& like);

/// Flushes a file to the disk (fsync). Returns false and sets errno on failure.
bool syncFile(std::FILE* file);
/// Flushes a folder's entries, if the file system supports this.
void syncFolder(const Path& folder);

// The following functions return 0 or errno, and do not throw.

int renameFile(const Path& from, const Path& to) noexcept;
/// Creates a hard link.
int linkFile(const Path& from, const Path& to) noexcept;
/// Removes a file or an empty folder.
int removePath(const Path& path) noexcept;

/// Returns an unpredictable number.
std::uint64_t randomNumber();

/// Blocks signals of this thread while it exists, except those caused by its own faults (SIGSEGV etc.).
class HeldSignals {
  public:
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

  private:
    [[maybe_unused]] unsigned char before_[128] = {};  ///< holds the system's signal mask
};
/// Sleeps for about a millisecond; async-signal-safe.
void waitBriefly();

/// Returns the ID of this process.
std::uint32_t processNumber();
/// Returns whether a process with this ID may exist; false only if there is certainly none.
bool isRunning(std::uint32_t process);
/// Returns a text that identifies the machine. On Linux it also identifies the boot and the PID namespace, so that it
/// differs after a reboot and in another container.
std::string processSpace();

/// Returns the path of the running program; empty if it cannot be determined.
Path ownProgram();

}  // namespace tspace
