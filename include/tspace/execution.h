// SPDX-License-Identifier: MIT
// Threads and memory of a call. They do not affect any bit of a result.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tspace {

/// Job system of the caller. `run` must call task(context, i) exactly once for each i in [0, task_count), on any
/// threads and in any order, and return when all calls have returned. Tasks never call `run`, and never throw.
struct Executor {
    void (*run)(void* user, std::size_t task_count, void (*task)(void* context, std::size_t task_index),
                void* context) = nullptr;
    void* user = nullptr;
    unsigned concurrency = 1;  ///< number of tasks that can run at the same time
};

/// Allocator of the caller. `allocate` returns memory of the given alignment (a power of two, at most 64) or null,
/// which makes the call fail with ErrorCode::outOfMemory. Called from the calling thread only.
struct Allocator {
    void* (*allocate)(void* user, std::size_t bytes, std::size_t alignment) = nullptr;
    void (*release)(void* user, void* memory, std::size_t bytes, std::size_t alignment) = nullptr;
    void* user = nullptr;
};

/// SIMD instruction set of the inner loops. Results have the same bits for every target.
enum class SimdTarget : std::uint32_t {
    best = 0,    ///< the best target that this CPU supports
    scalar = 1,  ///< no SIMD: for CPUs that support no other target; elsewhere available only in tests of tspace
    sse2 = 2,    ///< baseline of x86-64
    avx2 = 3,
    avx512 = 4,  ///< AVX-512 F and DQ
    neon = 5,    ///< 64-bit ARM, supported by every CPU
};

/// Value of Execution::thread_count for one thread per core.
inline constexpr std::uint32_t kAllThreads = 0xffffffffu;

/// Threads and memory of a call: the last argument of functions on arrays, a member of the options of functions on
/// files. The objects it points to must outlive the call, and any plan made with it.
struct Execution {
    std::uint32_t thread_count = 1;  ///< 0 and 1: only the calling thread; kAllThreads: one thread per core
    /// Runs all tasks, whatever thread_count is. Null: threads are started and joined within the call.
    const Executor* executor = nullptr;
    /// Allocates scratch memory and plans. Null: operator new, and no memory is kept between calls. With an Arena,
    /// consecutive calls take a tenth less time (generateTangents with more than 4096 corners).
    const Allocator* allocator = nullptr;
    /// SIMD target, for tests and measurements. A target that this CPU does not support is replaced by the best one
    /// with a lower number.
    SimdTarget simd = SimdTarget::best;
};

// Memory that is reused between calls: from the second call on, no pages are requested from the system.

/// Scratch memory for consecutive calls. Pass allocator() in Execution::allocator; plans may use it too. A call that
/// follows a similar call on the same arena requests no memory from the system.
///
/// Memory: the largest amount in use at one time, plus gaps between allocations of different sizes (a few percent for
/// calls of this library) and up to 2 MiB. It is kept until trim() or the destructor. Large blocks use huge pages where
/// the system supports them.
///
/// For one call at a time: not thread-safe, like every Allocator. Use one arena per calling thread. It must outlive the
/// plans whose memory it holds. It cannot be moved.
class Arena {
  public:
    Arena();
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Returns the allocator for Execution::allocator. Valid as long as the arena exists.
    [[nodiscard]] const Allocator* allocator() const { return &allocator_; }

    /// Returns the number of bytes that the arena holds, in use or not. Excludes address space that is only reserved.
    [[nodiscard]] std::size_t heldBytes() const;
    /// Returns the number of bytes in use: 0 between calls, except for plans.
    [[nodiscard]] std::size_t usedBytes() const;

    /// Releases the memory behind the last allocation in use; between calls without plans, that is all memory.
    void trim();

  private:
    class Impl;
    Impl* impl_;
    Allocator allocator_;
};

}  // namespace tspace
