// SPDX-License-Identifier: MIT
// The files that a run reads and writes, for build systems that have to know them.
#pragma once

#include <string>
#include <vector>

namespace tspace {

/// While it lives, records the inputs that calls of this process open (InputFiles) and the outputs that they put in place
/// (AtomicOutput). At most one may exist; create it before the first call. Thread-safe.
class RecordedFiles {
  public:
    RecordedFiles();
    ~RecordedFiles();
    RecordedFiles(const RecordedFiles&) = delete;
    RecordedFiles& operator=(const RecordedFiles&) = delete;

    /// Each once, in the order in which they were first recorded. Files that were written are no inputs.
    [[nodiscard]] std::vector<std::string> inputs() const;
    [[nodiscard]] std::vector<std::string> outputs() const;
};

/// Records a file, if there is a RecordedFiles. Paths are as the call spells them.
void recordInput(const std::string& path);
void recordOutput(const std::string& path);

}  // namespace tspace
