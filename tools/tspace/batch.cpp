// SPDX-License-Identifier: MIT
// Threads that take jobs from a shared queue.
#include "batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "file_hash.h"
#include "tspace/execution.h"

namespace tspace::tool {

bool isInShard(const Job& job, const Shard& shard) {
    return shard.count <= 1 || hashText(job.name) % shard.count + 1 == shard.index;
}

void takeShard(std::vector<Job>& jobs, const Shard& shard) {
    std::erase_if(jobs, [&](const Job& job) { return !isInShard(job, shard); });
}

unsigned workerCount(const BatchArguments& batch, std::size_t job_count) {
    const unsigned asked = batch.jobs != 0 ? batch.jobs : std::max(1U, std::thread::hardware_concurrency());
    return static_cast<unsigned>(std::clamp<std::size_t>(job_count, 1, asked));
}

unsigned threadsPerFile(unsigned asked, unsigned workers) {
    if (asked != kAllThreads || workers == 1) return asked;
    return std::max(1U, std::thread::hardware_concurrency() / workers);
}

namespace {

/// Runs `work` on this thread and up to `count` further threads; on fewer if the system provides fewer. Rethrows the
/// first exception of `work` after all threads have ended.
void workOnThreads(unsigned count, const std::function<void()>& work) {
    std::mutex mutex;
    std::exception_ptr failure;
    const auto guarded = [&] {
        try {
            work();
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    std::vector<std::thread> threads;
    try {
        threads.reserve(count);
        while (threads.size() < count) threads.emplace_back(guarded);
    } catch (const std::exception&) {  // std::system_error or std::bad_alloc
    }
    guarded();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

void runBatch(std::size_t count, unsigned workers, const std::function<void(std::size_t)>& work,
              const std::function<void(std::size_t)>& finished, const std::function<bool()>& stop) {
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::vector<char> is_done(count, 0);
    std::size_t reported = 0;
    const auto report = [&](std::size_t job) {
        const std::lock_guard lock(mutex);
        is_done[job] = 1;
        while (reported < count && is_done[reported] != 0) finished(reported++);
    };
    const auto take = [&] {
        while (!stop()) {
            const std::size_t job = next.fetch_add(1);
            if (job >= count) return;
            work(job);
            report(job);
        }
    };
    workOnThreads(workers - 1, take);
    // After stop() returned true, some jobs are missing, but later jobs may have been processed.
    for (; reported < count; ++reported) {
        if (is_done[reported] != 0) finished(reported);
    }
}

}  // namespace tspace::tool
