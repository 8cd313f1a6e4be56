// SPDX-License-Identifier: MIT
// Temporary files next to outputs. Their names identify the process that owns them. The files of this process are
// listed, so that a signal handler can remove them, together with the folders that were created for them.
#pragma once

#include "model/io/path.h"
#include "model/io/system_files.h"

namespace tspace {

inline constexpr const char* kTemporaryEnding = ".tmp";
/// Name ending of the old file while new files are renamed.
inline constexpr const char* kBackupEnding = ".old";

/// Returns an unpredictable name next to `target`: TARGET.tspace-MACHINE-PROCESS-RANDOM and the ending. Long target
/// names are cut, so that the result has at most 255 bytes.
Path temporaryName(const Path& target, const char* ending);

/// Critical section for creating, removing or renaming temporary files; signals are blocked, and only one thread can be
/// inside. The constructor does not return once removeTemporaryFiles() has removed the files.
class TemporaryFilesLock {
  public:
    TemporaryFilesLock();
    ~TemporaryFilesLock();
    TemporaryFilesLock(const TemporaryFilesLock&) = delete;
    TemporaryFilesLock& operator=(const TemporaryFilesLock&) = delete;

    /// Must be called before the file or folder is created.
    void add(const Path& path);
    /// Must be called when the file or folder is removed, renamed, or kept permanently.
    void forget(const Path& path) noexcept;
    /// Must be called after outputs have been put in place.
    void noteCommit() noexcept;

  private:
    HeldSignals signals_;
};

/// Removes all temporary files, and blocks threads that would create others: the caller must terminate the program. If
/// outputs of this process are in place and `even_after_commit` is false, removes nothing and returns false.
/// Async-signal-safe.
bool removeTemporaryFiles(bool even_after_commit);

/// Removes files that killed runs left in a folder, like removeAbandonedFiles(), on the first call for the folder in
/// this process. AtomicOutput calls it for each folder that it writes into; commands call it before they read inputs,
/// because it restores files that were set aside.
void removeAbandonedOnce(const Path& folder);

}  // namespace tspace
