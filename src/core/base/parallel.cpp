// SPDX-License-Identifier: MIT
// Thread pool that exists during one public call, and the adapter to the caller's executor.
#include "core/base/parallel.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <thread>
#include <vector>

namespace tspace {
namespace {

/// Time for which a thread spins while it waits for the next loop (or the last task of this one), before it sleeps.
/// Waking a sleeping thread takes about this long, and the loops of a call follow each other quickly.
constexpr std::chrono::microseconds kSpinTime{40};

void pauseBriefly() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

}  // namespace

/// Pool of helper threads. Helpers may join a loop while its caller works on it. A helper that wakes up too late finds
/// the loop closed; the caller does not wait for it.
class Parallel::Pool {
  public:
    explicit Pool(bool spins) : spins_(spins ? kSpinTime : kSpinTime.zero()) {}

    ~Pool() {
        is_ending_ = true;
        callHelpers();
        for (std::thread& helper : helpers_) helper.join();
    }

    void startHelpers(std::size_t count) {
        const auto start = [&] {
            helpers_.reserve(count);
            while (helpers_.size() < count) helpers_.emplace_back([this] { runHelper(); });
        };
#ifdef __cpp_exceptions
        try {
            start();
        } catch (...) {
            // The system provides no more threads (or no memory for them): existing threads and the caller do the work.
        }
#else
        start();
#endif
    }

    void run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
        task_ = task;
        context_ = context;
        count_ = count;
        next_.store(0, std::memory_order_relaxed);
        inside_.fetch_sub(kClosed, std::memory_order_release);
        callHelpers();
        work();
        inside_.fetch_add(kClosed, std::memory_order_relaxed);
        waitWhile(inside_, [](std::uint32_t inside) { return inside != kClosed; });
    }

  private:
    static constexpr std::uint32_t kClosed = 0x80000000u;

    void work() {
        for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) task_(context_, i);
    }

    void callHelpers() {
        calls_.fetch_add(1, std::memory_order_release);
        calls_.notify_all();
    }

    void runHelper() {
        std::uint32_t seen = 0;
        while (true) {
            seen = waitWhile(calls_, [seen](std::uint32_t calls) { return calls == seen; });
            if (is_ending_) return;
            if (inside_.fetch_add(1, std::memory_order_acquire) < kClosed) work();
            if (inside_.fetch_sub(1, std::memory_order_release) == kClosed + 1) inside_.notify_one();
        }
    }

    /// Waits while condition(value) holds; returns the value that ended the wait.
    template <class Condition>
    std::uint32_t waitWhile(const std::atomic<std::uint32_t>& number, Condition&& condition) const {
        const auto end = std::chrono::steady_clock::now() + spins_;
        std::uint32_t value;
        while (condition(value = number.load(std::memory_order_acquire))) {
            if (std::chrono::steady_clock::now() >= end) {
                number.wait(value, std::memory_order_acquire);
            } else {
                for (int i = 0; i < 16; ++i) pauseBriefly();
            }
        }
        return value;
    }

    const std::chrono::microseconds spins_;
    std::vector<std::thread> helpers_;
    // The current task and its argument, which are written only while the loop is closed.
    void (*task_)(void*, std::size_t) = nullptr;
    void* context_ = nullptr;
    std::size_t count_ = 0;
    std::atomic<bool> is_ending_{false};
    std::atomic<std::uint32_t> calls_{0};  ///< number of times that helper threads were woken
    /// Number of helpers in the loop, with a flag that is set while the loop is closed.
    std::atomic<std::uint32_t> inside_{kClosed};
    std::atomic<std::size_t> next_{0};
};

Parallel::Parallel(const Execution& execution, std::uint64_t corners) {
    constexpr unsigned kMostThreads = 256;  // an invalid request must not exhaust the machine
    constexpr std::uint64_t kWorthAThread = 48 * 1024;
    if (execution.executor != nullptr && execution.executor->run != nullptr) {
        executor_ = execution.executor;
        width_ = std::clamp(executor_->concurrency, 1u, kMostThreads);
        return;
    }
    const auto useful = static_cast<unsigned>(std::min<std::uint64_t>(corners / kWorthAThread, kMostThreads));
    if (useful <= 1) return;  // skips the system call that counts the cores
    const unsigned wanted =
        execution.thread_count != kAllThreads ? execution.thread_count : std::thread::hardware_concurrency();
    width_ = std::clamp(wanted, 1u, useful);
}

Parallel::~Parallel() { delete pool_; }

void Parallel::runTasks(std::size_t count, void (*task)(void*, std::size_t), void* context) {
    if (executor_ != nullptr) {
        executor_->run(executor_->user, count, task, context);
        return;
    }
    // Threads spin only if each has its own core: otherwise spinning threads would take time from working ones.
    if (pool_ == nullptr) pool_ = new Pool(width_ <= std::thread::hardware_concurrency());
    pool_->startHelpers(std::min<std::size_t>(width_, count) - 1);
    pool_->run(count, task, context);
}

#ifdef __cpp_exceptions

namespace {

/// Runs tasks that may throw, and keeps one of their exceptions. An exception on a helper's stack would terminate the
/// program, and an exception on the caller's stack would leave the loop while helpers still work on it.
struct ThrowingTasks {
    void (*task)(void*, std::size_t);
    void* context;
    std::atomic<bool> has_failed{false};
    std::exception_ptr first = {};

    static void run(void* tasks, std::size_t number) {
        auto& self = *static_cast<ThrowingTasks*>(tasks);
        if (self.has_failed.load(std::memory_order_relaxed)) return;
        try {
            self.task(self.context, number);
        } catch (...) {
            if (!self.has_failed.exchange(true)) self.first = std::current_exception();
        }
    }
};

}  // namespace

void Parallel::run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
    ThrowingTasks tasks{task, context};
    runTasks(count, ThrowingTasks::run, &tasks);
    if (tasks.first) std::rethrow_exception(tasks.first);
}

#else

void Parallel::run(std::size_t count, void (*task)(void*, std::size_t), void* context) {
    runTasks(count, task, context);
}

#endif

}  // namespace tspace
