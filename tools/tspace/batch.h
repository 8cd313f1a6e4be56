// SPDX-License-Identifier: MIT
// Many files: several at one time, results in the order of the files, and a share of them for each of several machines.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "jobs.h"

namespace tspace::tool {

/// Share `index` (from 1) of `count`.
struct Shard {
    unsigned index = 1;
    unsigned count = 1;
};

/// Number of files processed in parallel, and their selection.
struct BatchArguments {
    unsigned jobs = 1;  ///< files at one time; 0: as many as there are cores
    Shard shard = {};
    std::string manifest = {};  ///< empty: none
    bool resume = false;        ///< leave out files that are done and unchanged by the manifest
    bool verbose = false;       ///< the details of every file, also where there are several
};

/// The hash of a file's name below its input decides, so its shard does not depend on other files.
bool isInShard(const Job& job, const Shard& shard);
/// Keeps the jobs of the shard.
void takeShard(std::vector<Job>& jobs, const Shard& shard);

/// Number of files processed in parallel.
unsigned workerCount(const BatchArguments& batch, std::size_t job_count);

/// Default number of threads per file: the cores, divided among the files in progress.
unsigned threadsPerFile(unsigned asked, unsigned workers);

/// Calls work(i) for every i below `count` on `workers` threads, or as many of them as the system gives, and finished(i) for
/// each in ascending order, one at a time, as soon as it and all before it are done. No work begins after stop() is true;
/// finished() is then called only for those that were worked on.
void runBatch(std::size_t count, unsigned workers, const std::function<void(std::size_t)>& work,
              const std::function<void(std::size_t)>& finished, const std::function<bool()>& stop);

}  // namespace tspace::tool
