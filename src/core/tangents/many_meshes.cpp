// SPDX-License-Identifier: MIT
// Tangents for many meshes in one call: threads process whole meshes, and each reuses its scratch memory.
#include <algorithm>
#include <atomic>
#include <mutex>

#include "core/base/border.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/tangents/method_kind.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

/// Wrapper that serializes the calls of the caller's allocator.
class LockedAllocator {
  public:
    explicit LockedAllocator(const Allocator* locked) : locked_(locked) {}
    LockedAllocator(const LockedAllocator&) = delete;
    LockedAllocator& operator=(const LockedAllocator&) = delete;

    /// Returns the wrapper, or null if the caller provided no allocator: operator new needs no lock.
    [[nodiscard]] const Allocator* allocator() const { return locked_ == nullptr ? nullptr : &allocator_; }

  private:
    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<LockedAllocator*>(user);
        const std::lock_guard lock(self.mutex_);
        return self.locked_->allocate(self.locked_->user, bytes, alignment);
    }
    static void release(void* user, void* memory, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<LockedAllocator*>(user);
        const std::lock_guard lock(self.mutex_);
        self.locked_->release(self.locked_->user, memory, bytes, alignment);
    }

    const Allocator* locked_;
    std::mutex mutex_;
    Allocator allocator_{allocate, release, this};
};

}  // namespace

Result<std::vector<Result<TangentReport>>> generateTangents(std::span<const MeshJob> jobs, const Execution& execution) {
    using Results = std::vector<Result<TangentReport>>;
    return atBorder([&]() -> Result<Results> {
        constexpr std::size_t kScratchBytes = 128 * 1024;
        constexpr std::size_t kJobsPerTask = 16;  // jobs per task: adjacent results share cache lines
        const auto workOf = [](const MeshJob& job) { return tangentWork(job.options.method, job.mesh.cornerCount()); };
        Results results(jobs.size(), TangentReport{});
        std::uint64_t total_work = 0;
        for (const MeshJob& job : jobs) total_work += workOf(job);
        Parallel parallel(execution, total_work);
        const auto isLarge = [&](const MeshJob& job) { return workOf(job) > total_work / parallel.width(); };
        const auto run = [&](std::size_t number, const Execution& own) {
            results[number] = generateTangents(jobs[number].mesh, jobs[number].options, jobs[number].out, own);
        };
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            if (isLarge(jobs[i])) run(i, execution);
        }
        LockedAllocator shared(execution.allocator);
        std::atomic<std::size_t> next{0};
        parallel.forTasks(parallel.width(), [&](std::size_t) {
            Buffer<std::byte> room(shared.allocator(), kScratchBytes);
            for (std::size_t begin; (begin = next.fetch_add(kJobsPerTask)) < jobs.size();) {
                for (std::size_t i = begin; i < std::min(begin + kJobsPerTask, jobs.size()); ++i) {
                    if (isLarge(jobs[i])) continue;
                    const ScratchBlock scratch(shared.allocator(), {room.data(), room.size()});
                    run(i, {.allocator = scratch.allocator(), .simd = execution.simd});
                }
            }
        });
        return results;
    });
}

}  // namespace tspace
