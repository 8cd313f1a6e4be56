// SPDX-License-Identifier: MIT
// The record of a batch: one line of JSON per file that was worked on, so that a later run knows what is done.
// docs/json.md describes the lines.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "file_hash.h"
#include "jobs.h"
#include "model/io/system_files.h"

namespace tspace::tool {

struct HashedFile {
    std::string path = {};
    FileHash hash = {};
};

struct ManifestEntry {
    std::string version = {};  ///< of the tool
    std::string options = {};  ///< those that decide about the result
    Job job = {};              ///< input, output, and the error if there was one
    bool changed = false;
    double seconds = 0;
    std::vector<HashedFile> inputs = {};   ///< everything that was read, but for files that were written over
    std::vector<HashedFile> outputs = {};  ///< everything that was written
};

/// What earlier runs recorded. Of several lines about one input and output the last counts.
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

/// Hashes files, in their order. Those that cannot be read are left out.
std::vector<HashedFile> hashFiles(const std::vector<std::string>& paths);

}  // namespace tspace::tool
