// SPDX-License-Identifier: MIT
// The record of a batch: one line of JSON per file that was worked on, so that a later run knows what is done.
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
    Job job = {};              ///< input, output, and the error if there was one
    bool changed = false;
    double seconds = 0;
    std::vector<HashedFile> inputs = {};   ///< everything that was read, but for files that were written over
    std::vector<HashedFile> outputs = {};  ///< everything that was written
};

/// Records of earlier runs. If several lines have the same input and output, the last one counts.
class ManifestRecord {
  public:
    /// A file that is not there is an empty record. Lines that are not whole (a run that was killed) or of another
    /// schema are left out.
    static Result<ManifestRecord> read(const std::string& path);

    /// True when the job was done with the same options and version, and no file of it has changed since.
    [[nodiscard]] bool isDone(const Job& job, const std::string& options) const;

  private:
    std::map<std::string, ManifestEntry> entries_;
};

/// Appends lines, each by one write, so that a reader never meets half of two.
class ManifestWriter {
  public:
    static Result<ManifestWriter> open(const std::string& path);
    Result<Done> append(const ManifestEntry& entry);

  private:
    std::string path_;
    CFile file_;
};

/// The manifest of a batch while it runs, if it has one; and what all of its outputs keep off. Any thread may call.
class BatchRecord {
  public:
    /// Removes the temporary files that killed runs left beside the outputs, but in a dry run; reads the manifest and opens it
    /// as the arguments say. An error ends the run before anything was done.
    Result<Done> open(const BatchArguments& batch, const std::vector<Job>& jobs, bool is_dry_run);
    /// With --resume: whether it is done already.
    [[nodiscard]] bool isDone(const Job& job, const std::string& options) const {
        return record_ && record_->isDone(job, options);
    }
    [[nodiscard]] bool isKept() const { return !path_.empty(); }
    /// Appends a line. Where that fails it is said, and no more is appended.
    report::ExitCode append(const ManifestEntry& entry);

  private:
    std::string path_ = {};
    std::optional<ManifestRecord> record_ = {};
    std::optional<KeptFiles> kept_ = {};
    OneRun one_run_ = {};
    std::mutex mutex_ = {};  ///< protects the writer
    std::optional<ManifestWriter> writer_ = {};
};

/// Hashes files, in their order. Those that cannot be read are left out.
std::vector<HashedFile> hashFiles(const std::vector<std::string>& paths);

}  // namespace tspace::tool
