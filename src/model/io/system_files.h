// SPDX-License-Identifier: MIT
// System calls that std::filesystem does not cover; system_files_posix.cpp and system_files_windows.cpp implement them.
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

/// A file of the C library that closes itself.
struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using CFile = std::unique_ptr<std::FILE, CloseFile>;

/// Like fopen, for UTF-8 paths: null, with errno, on failure. Like all functions here that are not noexcept, it throws
/// std::bad_alloc if the system is out of memory.
CFile openFile(const Path& path, const char* mode);

/// Fills `to` with the bytes of an open file from `begin` on, independently of the file's position. Thread-safe. False
/// where the file is shorter.
bool readAt(std::FILE* file, std::size_t begin, std::span<std::uint8_t> to);

/// The path without links and "..", as far as it exists; the rest follows as it is spelled.
Path canonicalPath(const Path& path);

/// Equal for all names of an existing file; empty where there is none.
std::string fileIdentity(const Path& path);

/// The kind of file at a path, with links followed. A stream is a character device or FIFO.
enum class PathKind { nothing, file, folder, stream, other };
PathKind kindOf(const Path& path);

/// A file or folder in a folder.
struct FolderEntry {
    std::string name = {};
    PathKind kind = PathKind::nothing;  ///< kind, as from kindOf()
    bool is_link = false;
};
/// Appends the entries of a folder. Returns 0, or errno where it could not be read to its end. (The increment of GCC's
/// std::filesystem::directory_iterator ends the process where an allocation fails.)
int listFolder(const Path& folder, std::vector<FolderEntry>& entries);

/// Whether a path is a symbolic link that another user may have planted: in a world-writable sticky folder (/tmp), and
/// owned by neither this user nor the folder's owner. The rule of Linux' protected_symlinks.
bool isForeignLink(const Path& path);

/// Creates a file exclusively, for writing: an existing file or link fails. Where `like` exists, the new file gets at
/// most the permissions of its owner. Null, with errno, on failure.
CFile createFile(const Path& path, const Path& like);
/// Copies owner, group and permissions of `like`, as far as this user may; never more permissions than `like` has.
void takePermissions(std::FILE* file, const Path& like);

/// Flushes a file to the disk (fsync); false, with errno, on failure.
bool syncFile(std::FILE* file);
/// Flushes a folder's entries; best effort, as not every file system can.
void syncFolder(const Path& folder);

// The following return 0 or errno, and do not throw.

int renameFile(const Path& from, const Path& to) noexcept;
/// Makes a hard link.
int linkFile(const Path& from, const Path& to) noexcept;
/// Removes a file or an empty folder.
int removePath(const Path& path) noexcept;

/// An unpredictable number.
std::uint64_t randomNumber();

/// Blocks signals of this thread while it lives, except those of its own faults (SIGSEGV and the like).
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

/// The id of this process.
std::uint32_t processNumber();
/// False only if there is certainly no process of this id.
bool isRunning(std::uint32_t process);
/// Identifies the space of process ids: another machine, boot or container gives another text.
std::string processSpace();

/// The path of the running program; empty where the system cannot tell.
Path ownProgram();

}  // namespace tspace
