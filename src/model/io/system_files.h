// SPDX-License-Identifier: MIT
// What the file layer asks an operating system for, and std::filesystem does not give: one file for each kind of system
// (system_files_posix.cpp, system_files_windows.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "model/io/c_file.h"
#include "model/io/path.h"

namespace tspace {

/// As fopen: null, with errno, where it cannot be opened.
CFile openFile(const Path& path, const char* mode);

/// Fills `to` with the bytes of an open file from `begin` on, whatever was read before; any thread may. False where there
/// are fewer.
bool readAt(std::FILE* file, std::size_t begin, std::span<std::uint8_t> to);

/// The path without links and "..", as far as there is something; what is not there yet follows as it is written.
Path canonicalPath(const Path& path);

/// The same text for all names of an existing file; empty where there is none.
std::string fileIdentity(const Path& path);

/// What is at the end of a path, links followed. A stream (character device, FIFO) takes bytes and keeps none of them.
enum class PathKind { nothing, file, folder, stream, other };
PathKind kindOf(const Path& path);

/// Whether a path is a symbolic link that somebody else may have put there as a trap: in a folder where everybody may
/// write, but nobody takes away what belongs to others (/tmp), and made by neither this user nor the folder's owner.
bool isForeignLink(const Path& path);

/// Makes a file that was not there, for writing; a link of that name is none. Where `like` is there, nobody may do more
/// with the new file than with that one, and its owner alone does anything. Null with errno.
CFile createFile(const Path& path, const Path& like);
/// The owner, group and permissions of `like`, as far as this user may give them; never more permissions than that has.
void takePermissions(std::FILE* file, const Path& like);

/// Sends all to the disk, and not to its cache alone; false with errno.
bool syncFile(std::FILE* file);
/// The same for the names in a folder; a hint, for not every file system can.
void syncFolder(const Path& folder);

// These return 0 or errno, and throw nothing.

int renameFile(const Path& from, const Path& to) noexcept;
/// A second name for a file.
int linkFile(const Path& from, const Path& to) noexcept;
/// Removes a file or an empty folder.
int removePath(const Path& path) noexcept;

/// Bytes that nobody can foresee.
std::uint64_t randomNumber();

/// While one of these lives, no signal interrupts the thread that made it, but for those of its own faults.
class HeldSignals {
  public:
    HeldSignals();
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

  private:
    [[maybe_unused]] unsigned char before_[128] = {};  ///< what the system's type takes at most
};
/// About a millisecond; may be called in handlers of signals.
void waitBriefly();

/// The number of this process.
std::uint32_t processNumber();
/// False only where there is surely no process of that number.
bool isRunning(std::uint32_t process);
/// Where numbers of processes mean something: another machine, start or container gives another text.
std::string processSpace();

/// The program that runs; empty where nobody can tell.
Path ownProgram();

}  // namespace tspace
