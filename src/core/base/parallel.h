// SPDX-License-Identifier: MIT
// The one place that knows about threads. Work is cut into tasks whose results do not depend on who runs them, so
// every caller gets the same bits for any thread count.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "tspace/execution.h"

namespace tspace {

/// Runs loops for the duration of one public call. Threads are started by the first loop of several tasks, never more
/// than a loop has tasks, and joined when this object goes. Starting and joining one takes about 20 us, so a task
/// should take longer. Not thread-safe itself: one owner, loops one after the other.
class Parallel {
  public:
    /// Items of a loop that a task has at least, where nothing says otherwise.
    static constexpr std::size_t kGrain = 4096;

    /// `corners`: how large the work is, in corners of usual cost (about 20 ns); those of a method that takes n times as
    /// long count n times. A thread that has less than its share of them costs more than it brings, and is not started.
    /// An executor's threads are there already: work of any size is cut for them.
    ///
    /// With TSPACE_SERIAL there are no threads at all, and loops are compiled for one: a third less code.
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

    /// body(begin, end) over disjoint ranges that cover [0, count). Ranges hold at least `grain` items (but for the
    /// last), so that small loops stay on the calling thread. A body may throw, as with forTasks.
    template <class Body>
    void forRanges(std::size_t count, std::size_t grain, Body&& body) {
        if (count == 0) return;
        const std::size_t most = std::max<std::size_t>(1, count / std::max<std::size_t>(1, grain));
        const std::size_t tasks = width() == 1 ? 1 : std::min<std::size_t>(most, std::size_t{width()} * 8);
        forTasks(tasks, [&](std::size_t task) { body(count * task / tasks, count * (task + 1) / tasks); });
    }

    /// body(task) once for each task in [0, count). Where bodies throw, one of the exceptions comes out of this call once
    /// no task runs any more; tasks that had not begun are left out.
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
    /// Never inlined, so that bodies are compiled once, not for one thread and for several.
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

/// The sum of body(begin, end) over the ranges of Parallel::forRanges. Whole numbers only, so their order
/// cannot change the result.
template <class Body>
std::uint64_t sumRanges(Parallel& parallel, std::size_t count, std::size_t grain, Body&& body) {
    std::atomic<std::uint64_t> total{0};
    parallel.forRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        total.fetch_add(body(begin, end), std::memory_order_relaxed);
    });
    return total;
}

}  // namespace tspace
