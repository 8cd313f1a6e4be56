// SPDX-License-Identifier: MIT
// Where work runs and where its memory comes from. Neither changes a single bit of any result.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace {

/// The caller's job system. `run` must call task(context, i) exactly once for each i in [0, task_count), on any
/// threads and in any order, and return when all are done. Tasks never call back into `run`, never throw.
struct Executor {
    void (*run)(void* user, std::size_t task_count, void (*task)(void* context, std::size_t task_index),
                void* context) = nullptr;
    void* user = nullptr;
    unsigned concurrency = 1;  ///< number of tasks that can run at the same time
};

/// The caller's memory. `allocate` returns memory of that alignment (a power of two, at most 64) or null, which
/// makes the call fail with ErrorCode::outOfMemory. Called from the calling thread only.
struct Allocator {
    void* (*allocate)(void* user, std::size_t bytes, std::size_t alignment) = nullptr;
    void (*release)(void* user, void* memory, std::size_t bytes, std::size_t alignment) = nullptr;
    void* user = nullptr;
};

/// The instructions that the hot loops use. Results have the same bits with all of them.
enum class SimdTarget : std::uint32_t {
    best = 0,    ///< the best that this CPU has
    scalar = 1,  ///< no SIMD: for CPUs without any of these; elsewhere only tests of tspace have it
    sse2 = 2,    ///< x86-64 without anything else
    avx2 = 3,
    avx512 = 4,  ///< AVX-512 F and DQ
    neon = 5,    ///< 64-bit ARM, every CPU
};

/// For Execution::thread_count: as many as there are cores.
inline constexpr std::uint32_t kAllThreads = 0xffffffffu;

/// Where work runs and where its memory comes from. A call has one, for all that it does: the last argument of functions on
/// arrays, a member of the options of functions on files. What it points to must outlive the call (and a plan made with it).
struct Execution {
    std::uint32_t thread_count = 1;  ///< 0 and 1: the calling thread only; kAllThreads
    /// Runs all work, whatever thread_count says; null: threads that are started and joined within the call.
    const Executor* executor = nullptr;
    /// Only for scratch memory and plans. Null: operator new, and nothing is kept between calls. With an Arena calls that
    /// follow each other take a tenth less time (generateTangents with more than 4096 corners).
    const Allocator* allocator = nullptr;
    /// For tests and measurements. What this CPU lacks becomes the best of a lower number.
    SimdTarget simd = SimdTarget::best;
};

// Memory that is kept from call to call: from the second call on, no page is taken from the system.

/// Scratch memory for calls that follow each other. Pass allocator() in Execution::allocator; the memory of plans may
/// come from it as well. A call on an arena that another one like it has used takes nothing from the system.
///
/// Memory: the most that was in use at one time, plus the holes between allocations of different sizes (a few percent
/// for calls of this library) and up to 2 MiB. It is kept until trim() or the end of the arena. Large parts use
/// huge pages where the system has them.
///
/// For one call at a time: not thread-safe, as no Allocator is. One arena per thread that makes calls. It must outlive
/// the plans whose memory it holds; it does not move.
class Arena {
  public:
    Arena();
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// For Execution::allocator. Valid as long as the arena.
    [[nodiscard]] const Allocator* allocator() const { return &allocator_; }

    /// Bytes of memory that the arena holds now, in use or not. Reserved address space without memory does not count.
    [[nodiscard]] std::size_t heldBytes() const;
    /// Bytes in use now: 0 between calls, except for plans.
    [[nodiscard]] std::size_t usedBytes() const;

    /// Gives back what lies behind the last allocation in use; between calls without plans, that is everything.
    void trim();

  private:
    class Impl;
    Impl* impl_;
    Allocator allocator_;
};

}  // namespace tspace
