// SPDX-License-Identifier: MIT
// Thread pool that lives as long as one public call, and the bridge to the caller's executor.
#include "core/parallel.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace tspace {

namespace {

/// How long a thread looks out for the next loop (or the last task of this one) before it sleeps. Waking a sleeping
/// thread takes about this long, and the loops of one call follow each other quickly.
constexpr std::chrono::microseconds kLookOut{40};

void pauseBriefly() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

}  // namespace

/// Loops are open to helpers while their caller works on them. A helper that comes late finds the loop closed, and
/// nobody waits for it.
class Parallel::Pool {
  public:
    explicit Pool(bool looks_out) : look_out_(looks_out ? kLookOut : kLookOut.zero()) {}

    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
            calls_.fetch_add(1, std::memory_order_release);
        }
        wake_.notify_all();
        for (std::thread& helper : helpers_) helper.join();
    }

    void startHelpers(std::size_t count) {
        try {
            helpers_.reserve(count);
            while (helpers_.size() < count) helpers_.emplace_back([this] { serve(); });
        } catch (...) {
            // No more threads (or memory for them): the ones there are, and the caller, do the work.
        }
    }

    void run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
        bool anyone_sleeps;
        {
            const std::lock_guard lock(mutex_);
            task_ = task;
            context_ = context;
            count_ = count;
            next_.store(0, std::memory_order_relaxed);
            is_open_ = true;
            calls_.fetch_add(1, std::memory_order_release);
            anyone_sleeps = sleeping_ > 0;
        }
        if (anyone_sleeps) wake_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        is_open_ = false;
        if (working_.load(std::memory_order_relaxed) == 0) return;
        lock.unlock();
        lookOut([this] { return working_.load(std::memory_order_acquire) == 0; });
        lock.lock();
        idle_.wait(lock, [this] { return working_.load(std::memory_order_relaxed) == 0; });
    }

  private:
    void work() {
        for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) task_(context_, i);
    }

    template <class Condition>
    void lookOut(Condition&& condition) const {
        const auto end = std::chrono::steady_clock::now() + look_out_;
        while (!condition() && std::chrono::steady_clock::now() < end) {
            for (int i = 0; i < 16; ++i) pauseBriefly();
        }
    }

    void serve() {
        std::size_t seen = 0;
        std::unique_lock lock(mutex_);
        while (true) {
            lock.unlock();
            lookOut([&] { return calls_.load(std::memory_order_acquire) != seen; });
            lock.lock();
            ++sleeping_;
            wake_.wait(lock, [&] { return calls_.load(std::memory_order_relaxed) != seen; });
            --sleeping_;
            seen = calls_.load(std::memory_order_relaxed);
            if (stopping_) return;
            if (!is_open_) continue;
            working_.fetch_add(1, std::memory_order_relaxed);
            lock.unlock();
            work();
            lock.lock();
            if (working_.fetch_sub(1, std::memory_order_release) == 1) idle_.notify_one();
        }
    }

    const std::chrono::microseconds look_out_;
    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    // Changed under the mutex only, and never while a helper works.
    void (*task_)(void*, std::size_t) = nullptr;
    void* context_ = nullptr;
    std::size_t count_ = 0;
    bool is_open_ = false;
    bool stopping_ = false;
    std::size_t sleeping_ = 0;
    // Also changed under the mutex, but looked at without it.
    std::atomic<std::size_t> calls_{0};
    std::atomic<std::size_t> working_{0};
    std::atomic<std::size_t> next_{0};
};

Parallel::Parallel(const Execution& execution, std::uint64_t corners) {
    constexpr unsigned kMostThreads = 256;  // a wrong request must not exhaust the machine
    constexpr std::uint64_t kWorthAThread = 48 * 1024;
    if (execution.executor != nullptr && execution.executor->run != nullptr) {
        executor_ = execution.executor;
        width_ = std::clamp(executor_->concurrency, 1u, kMostThreads);
        return;
    }
    const auto useful = static_cast<unsigned>(std::min<std::uint64_t>(corners / kWorthAThread, kMostThreads));
    if (useful <= 1) return;  // without asking the system how many there are
    const unsigned wanted =
        execution.thread_count != kAllThreads ? execution.thread_count : std::thread::hardware_concurrency();
    width_ = std::clamp(wanted, 1u, useful);
}

Parallel::~Parallel() { delete pool_; }

void Parallel::run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
    if (executor_ != nullptr) {
        executor_->run(executor_->user, count, task, context);
        return;
    }
    // More threads than cores would only take time from each other while they look out.
    if (pool_ == nullptr) pool_ = new Pool(width_ <= std::thread::hardware_concurrency());
    pool_->startHelpers(std::min<std::size_t>(width_, count) - 1);
    pool_->run(count, task, context);
}

}  // namespace tspace
