// SPDX-License-Identifier: MIT
// The only module that uses threads. Work is divided into tasks whose results do not depend on the executing thread, so
// results have the same bits for any thread count.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "tspace/execution.h"

namespace tspace {

/// Runs loops during one public call. Threads are started by the first loop with several tasks, at most one per task,
/// and joined by the destructor. Starting and joining a thread takes about 20 us, so a task should take longer. Not
/// thread-safe itself: one owner, loops one after the other.
class Parallel {
  public:
    /// Default minimum number of items per task.
    static constexpr std::size_t kGrain = 4096;

    /// `corners`: amount of work, in corners that take about 20 ns each; corners of a method that takes n times as long
    /// count n times. A thread with less than its share would cost more than it gains, and is not started. An
    /// executor's threads already exist: work of any size is divided for them.
    ///
    /// With TSPACE_SERIAL, no threads are started, and loops are compiled for one thread, which takes a third less
    /// code.
#ifdef TSPACE_SERIAL
    explicit Parallel(const Execution&, std::uint64_t = 0) {}
#else
    explicit Parallel(const Execution& execution, std::uint64_t corners = ~std::uint64_t{0});
    ~Parallel();
#endif
    Parallel(const Parallel&) = delete;
    Parallel& operator=(const Parallel&) = delete;

    /// Number of tasks that can run at the same time; 1 means serial.
#ifdef TSPACE_SERIAL
    [[nodiscard]] static constexpr unsigned width() { return 1; }
#else
    [[nodiscard]] unsigned width() const { return width_; }
#endif

    /// Calls body(begin, end) for disjoint ranges that cover [0, count). Ranges have at least `grain` items (except the
    /// last), so that small loops stay on the calling thread. A body may throw, as with forTasks.
    template <class Body>
    void forRanges(std::size_t count, std::size_t grain, Body&& body) {
        if (count == 0) return;
        const std::size_t most = std::max<std::size_t>(1, count / std::max<std::size_t>(1, grain));
        const std::size_t tasks = width() == 1 ? 1 : std::min<std::size_t>(most, std::size_t{width()} * 8);
        forTasks(tasks, [&](std::size_t task) { body(count * task / tasks, count * (task + 1) / tasks); });
    }

    /// Calls body(task) once for each task in [0, count). If bodies throw, this call throws one of the exceptions after
    /// all running tasks have ended; tasks that had not started are skipped.
    template <class Body>
    void forTasks(std::size_t count, Body&& body) {
#ifdef TSPACE_SERIAL
        for (std::size_t task = 0; task < count; ++task) body(task);
#else
        using Type = std::remove_reference_t<Body>;
        void* const context = const_cast<void*>(static_cast<const void*>(&body));
        if (count > 1 && width_ > 1) return run(count, call<Type>, context);
        for (std::size_t task = 0; task < count; ++task) call<Type>(context, task);
#endif
    }

#ifndef TSPACE_SERIAL
  private:
    class Pool;
    /// Never inlined, so that bodies are compiled once, rather than once for one thread and once for several.
    template <class Body>
    [[gnu::noinline]] static void call(void* context, std::size_t task) {
        (*static_cast<Body*>(context))(task);
    }
    void run(std::size_t count, void (*task)(void*, std::size_t), void* context);
    void runTasks(std::size_t count, void (*task)(void*, std::size_t), void* context);

    unsigned width_ = 1;
    const Executor* executor_ = nullptr;
    Pool* pool_ = nullptr;
#endif
};

/// Returns the sum of body(begin, end) over the ranges of Parallel::forRanges. Integers only, so their order cannot
/// change the result.
template <class Body>
std::uint64_t sumRanges(Parallel& parallel, std::size_t count, std::size_t grain, Body&& body) {
    std::atomic<std::uint64_t> total{0};
    parallel.forRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        total.fetch_add(body(begin, end), std::memory_order_relaxed);
    });
    return total;
}

}  // namespace tspace
