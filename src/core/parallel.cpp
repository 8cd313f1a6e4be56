// SPDX-License-Identifier: MIT
// Thread pool that lives as long as one public call, and the bridge to the caller's executor.
#include "core/parallel.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace tspace {

class Parallel::Pool {
  public:
    explicit Pool(unsigned helper_count) {
        helpers_.reserve(helper_count);
        for (unsigned i = 0; i < helper_count; ++i) {
            try {
                helpers_.emplace_back([this] { serve(); });
            } catch (...) {
                break;  // no more threads (or memory for them): the ones there are, and the caller, do the work
            }
        }
    }

    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        wake_.notify_all();
        for (std::thread& helper : helpers_) helper.join();
    }

    void run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
        {
            const std::lock_guard lock(mutex_);
            task_ = task;
            context_ = context;
            count_ = count;
            next_.store(0, std::memory_order_relaxed);
            busy_ = helpers_.size();
            ++generation_;
        }
        wake_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        idle_.wait(lock, [this] { return busy_ == 0; });
    }

  private:
    void work() {
        for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) task_(context_, i);
    }

    void serve() {
        std::size_t seen = 0;
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [&] { return stopping_ || generation_ != seen; });
            if (stopping_) return;
            seen = generation_;
            lock.unlock();
            work();
            lock.lock();
            if (--busy_ == 0) idle_.notify_one();
        }
    }

    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    void (*task_)(void*, std::size_t) = nullptr;
    void* context_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_{0};
    std::size_t busy_ = 0;
    std::size_t generation_ = 0;
    bool stopping_ = false;
};

Parallel::Parallel(const Execution& execution) {
    constexpr unsigned kMostThreads = 256;  // a wrong request must not exhaust the machine
    if (execution.executor != nullptr && execution.executor->run != nullptr && execution.thread_count != 1) {
        executor_ = execution.executor;
        width_ = std::clamp(executor_->concurrency, 1u, kMostThreads);
        return;
    }
    const unsigned wanted = execution.thread_count != 0 ? execution.thread_count : std::thread::hardware_concurrency();
    width_ = std::clamp(wanted, 1u, kMostThreads);
}

Parallel::~Parallel() = default;

void Parallel::run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
    if (executor_ != nullptr) {
        executor_->run(executor_->user, count, task, context);
        return;
    }
    if (!pool_) pool_ = std::make_unique<Pool>(width_ - 1);
    pool_->run(count, task, context);
}

}  // namespace tspace
