// SPDX-License-Identifier: MIT
// Record of a batch: one line of JSON per processed file, so that a later run can skip finished files.
// docs/reference/json.md describes the lines.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "batch.h"
#include "commands/shared/exit_code.h"
#include "file_hash.h"
#include "jobs.h"
#include "model/io/atomic_output.h"
#include "model/io/system_files.h"

namespace tspace::tool {

struct HashedFile {
    std::string path = {};
    FileHash hash = {};
};

struct ManifestEntry {
    std::string version = {};  ///< version of the tool
    std::string options = {};  ///< options that affect the result
    Job job = {};              ///< input, output, and the error, if any
    bool changed = false;
    double seconds = 0;
    std::vector<HashedFile> inputs = {};   ///< all files that were read, except overwritten ones
    std::vector<HashedFile> outputs = {};  ///< all files that were written
};

/// Records of earlier runs. If several lines have the same input and output, the last one counts.
class ManifestRecord {
  public:
    /// Reads a manifest. A missing file is an empty record. Incomplete lines (of a run that was killed) and lines of
    /// other schemas are skipped.
    static Result<ManifestRecord> read(const std::string& path);

    /// Returns whether the job was done with the same options and version, and none of its files has changed since.
    [[nodiscard]] bool isDone(const Job& job, const std::string& options) const;

  private:
    std::map<std::string, ManifestEntry> entries_;
};

/// Appends lines, each with a single write, so that a reader never sees an incomplete line.
class ManifestWriter {
  public:
    static Result<ManifestWriter> open(const std::string& path);
    Result<Done> append(const ManifestEntry& entry);

  private:
    std::string path_;
    CFile file_;
};

/// The manifest of a running batch, if it has one, and the files that its outputs must not replace. Thread-safe.
class BatchRecord {
  public:
    /// Removes temporary files that killed runs left next to the outputs (except in a dry run), reads the manifest and
    /// opens it according to the arguments. An error ends the run before anything is done.
    Result<Done> open(const BatchArguments& batch, const std::vector<Job>& jobs, bool is_dry_run);
    /// Returns whether the job is already done (with --resume).
    [[nodiscard]] bool isDone(const Job& job, const std::string& options) const {
        return record_ && record_->isDone(job, options);
    }
    [[nodiscard]] bool isKept() const { return !path_.empty(); }
    /// Appends a line. If that fails, prints the error and appends nothing more.
    report::ExitCode append(const ManifestEntry& entry);

  private:
    std::string path_ = {};
    std::optional<ManifestRecord> record_ = {};
    std::optional<ProtectedFiles> kept_ = {};
    OneRun one_run_ = {};
    std::mutex mutex_ = {};  ///< protects the writer
    std::optional<ManifestWriter> writer_ = {};
};

/// Hashes files in order. Files that cannot be read are skipped.
std::vector<HashedFile> hashFiles(const std::vector<std::string>& paths);

}  // namespace tspace::tool
