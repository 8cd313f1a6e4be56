// SPDX-License-Identifier: MIT
// The temporary files of this process, so that a program that a signal ends can take them away.
#pragma once

#include "model/io/path.h"
#include "model/io/system_files.h"

namespace tspace {

/// What must not end half-way by a signal: names of temporary files are made, taken back or put in place inside of one. One
/// thread at a time; where removeTemporaryFiles() was called, nobody any more.
class TemporaryFilesInWork {
  public:
    TemporaryFilesInWork();
    ~TemporaryFilesInWork();
    TemporaryFilesInWork(const TemporaryFilesInWork&) = delete;
    TemporaryFilesInWork& operator=(const TemporaryFilesInWork&) = delete;

    /// Before the file is made.
    void add(const Path& path);
    /// Once it is gone or in its place. Throws nothing.
    void forget(const Path& path) noexcept;

  private:
    HeldSignals signals_;
};

/// Removes all of them, and lets nobody make others: the program ends. May be called in handlers of signals.
void removeTemporaryFiles();

}  // namespace tspace
