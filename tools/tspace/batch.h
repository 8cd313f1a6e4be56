// SPDX-License-Identifier: MIT
// Processing of many files: several in parallel, results in file order, and shards for several machines.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "jobs.h"

namespace tspace::tool {

/// Shard of a batch: number `index` (1-based) of `count`.
struct Shard {
    unsigned index = 1;
    unsigned count = 1;
};

/// Number of files processed in parallel, and their selection.
struct BatchArguments {
    unsigned jobs = 1;  ///< number of files processed in parallel; 0: one per core
    Shard shard = {};
    std::string manifest = {};  ///< path of the manifest; empty: none
    bool resume = false;        ///< skip files that are done and unchanged according to the manifest
    bool verbose = false;       ///< print details for every file, even with several inputs
};

/// Returns whether a job belongs to the shard. Depends only on the hash of the path relative to the input, so it does
/// not change with other files.
bool isInShard(const Job& job, const Shard& shard);
/// Removes all jobs outside the shard.
void takeShard(std::vector<Job>& jobs, const Shard& shard);

/// Returns the number of files processed in parallel.
unsigned workerCount(const BatchArguments& batch, std::size_t job_count);

/// Returns the default number of threads per file: the cores, divided among the files in progress.
unsigned threadsPerFile(unsigned asked, unsigned workers);

/// Calls work(i) for every i below `count` on `workers` threads, or fewer if the system provides fewer. Calls
/// finished(i) in ascending order, one call at a time, as soon as the jobs 0 to i are done. Starts no work after stop()
/// returns true; finished() is then called only for jobs that were processed.
void runBatch(std::size_t count, unsigned workers, const std::function<void(std::size_t)>& work,
              const std::function<void(std::size_t)>& finished, const std::function<bool()>& stop);

}  // namespace tspace::tool
