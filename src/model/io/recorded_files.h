// SPDX-License-Identifier: MIT
// Files that a run reads and writes, for build systems that need this list.
#pragma once

#include <string>
#include <vector>

namespace tspace {

/// While it exists, records the inputs that calls of this process open (InputFiles) and the outputs that they put in
/// place (AtomicOutput). At most one may exist; it must be created before the first call. Thread-safe.
class RecordedFiles {
  public:
    RecordedFiles();
    ~RecordedFiles();
    RecordedFiles(const RecordedFiles&) = delete;
    RecordedFiles& operator=(const RecordedFiles&) = delete;

    /// Return the recorded files, each once, in the order of their first recording. Files that were written are not
    /// inputs.
    [[nodiscard]] std::vector<std::string> inputs() const;
    [[nodiscard]] std::vector<std::string> outputs() const;
};

/// Record a file if a RecordedFiles exists. Paths are as given to the call.
void recordInput(const std::string& path);
void recordOutput(const std::string& path);

}  // namespace tspace
