// SPDX-License-Identifier: MIT
// Temporary files: their names, which tell whose they are, and the list of this process's, which a signal handler removes.
#pragma once

#include "model/io/path.h"
#include "model/io/system_files.h"

namespace tspace {

inline constexpr const char* kTemporaryEnding = ".tmp";
/// The old file while new ones are renamed.
inline constexpr const char* kAsideEnding = ".old";

/// An unpredictable name beside `target`: TARGET.tspace-MACHINE-PROCESS-RANDOM and the ending. Long names of targets are
/// cut, so that it has at most 255 bytes.
Path besideName(const Path& target, const char* ending);

/// A critical section in which temporary files are created, removed or renamed; signals are blocked, and one thread at a
/// time is inside. Never returns once removeTemporaryFiles() was called.
class TemporaryFilesInWork {
  public:
    TemporaryFilesInWork();
    ~TemporaryFilesInWork();
    TemporaryFilesInWork(const TemporaryFilesInWork&) = delete;
    TemporaryFilesInWork& operator=(const TemporaryFilesInWork&) = delete;

    /// Call before the file is created.
    void add(const Path& path);
    /// Call when the file is removed or renamed.
    void forget(const Path& path) noexcept;

  private:
    HeldSignals signals_;
};

/// Removes all temporary files, and stops threads that would make others: the program ends. Async-signal-safe.
void removeTemporaryFiles();

}  // namespace tspace
