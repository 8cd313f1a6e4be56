// SPDX-License-Identifier: MIT
// Scratch memory from the caller's allocator. Running out of memory is the only failure inside the core: it is thrown
// as OutOfMemory and converted to an Error by atBorder (border.h), so no exception leaves the library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

#if defined(TSPACE_SIMD_X86)
#include <xmmintrin.h>
#endif

#include "tspace/execution.h"

namespace tspace {

struct OutOfMemory {};

/// Throws OutOfMemory. Without exceptions, calls a function of the program that must abort the call.
[[noreturn]] void throwOutOfMemory();

inline constexpr std::size_t kMemoryAlignment = 64;  // cache line size, and size of the widest SIMD register

inline constexpr std::size_t kHugePage = std::size_t{2} << 20;
inline std::size_t defaultAlignment([[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    if (bytes >= kHugePage) return kHugePage;
#endif
    return kMemoryAlignment;
}

/// Requests huge pages for a block. This is a hint, which the system may ignore.
inline void requestHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= kHugePage) madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

/// Populates a large block at once, with huge pages: page faults of fresh memory can cost as much as all computations
/// on it (0.5 us and more for each 4 KB on a virtual machine). This is a hint, which the system may ignore.
inline void populatePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
    constexpr std::size_t kPage = 4096, kWorthACall = 32 * kPage;
    if (bytes < kWorthACall) return;
    requestHugePages(memory, bytes);
    const std::size_t skip = -reinterpret_cast<std::uintptr_t>(memory) % kPage;
    madvise(static_cast<std::byte*>(memory) + skip, (bytes - skip) / kPage * kPage, MADV_POPULATE_WRITE);
#endif
}

/// Allocates an array, or throws OutOfMemory. Never inlined, like releaseBytes: each inlined use would add some hundred
/// bytes of code.
[[gnu::noinline]] inline void* allocateArray(const Allocator* allocator, std::size_t count, std::size_t element_bytes) {
    std::size_t bytes;
    if (__builtin_mul_overflow(count, element_bytes, &bytes)) throwOutOfMemory();
    if (bytes == 0) return nullptr;
    if (allocator != nullptr) {
        void* memory = allocator->allocate(allocator->user, bytes, kMemoryAlignment);
        if (memory == nullptr) throwOutOfMemory();
        return memory;
    }
    void* memory = ::operator new(bytes, std::align_val_t(defaultAlignment(bytes)), std::nothrow);
    if (memory == nullptr) throwOutOfMemory();
    populatePages(memory, bytes);
    return memory;
}

[[gnu::noinline]] inline void releaseBytes(const Allocator* allocator, void* memory, std::size_t bytes) noexcept {
    if (memory == nullptr) return;
    if (allocator != nullptr) {
        allocator->release(allocator->user, memory, bytes, kMemoryAlignment);
    } else {
        ::operator delete(memory, std::align_val_t(defaultAlignment(bytes)));
    }
}

/// Array of trivial values with a fixed size, uninitialized unless a value is given. Move-only. The allocator must
/// outlive it.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    static_assert(alignof(T) <= kMemoryAlignment);

  public:
    Buffer() = default;
    Buffer(const Allocator* allocator, std::size_t count)
        : allocator_(allocator), data_(static_cast<T*>(allocateArray(allocator, count, sizeof(T)))), count_(count) {}
    [[gnu::noinline]] Buffer(const Allocator* allocator, std::size_t count, T value) : Buffer(allocator, count) {
        for (std::size_t i = 0; i < count; ++i) data_[i] = value;
    }
    Buffer(Buffer&& other) noexcept
        : allocator_(other.allocator_), data_(std::exchange(other.data_, nullptr)),
          count_(std::exchange(other.count_, 0)) {}
    Buffer& operator=(Buffer&& other) noexcept {
        std::swap(allocator_, other.allocator_);
        std::swap(data_, other.data_);
        std::swap(count_, other.count_);
        return *this;
    }
    ~Buffer() { releaseBytes(allocator_, data_, count_ * sizeof(T)); }

    [[nodiscard]] T* data() { return data_; }
    [[nodiscard]] const T* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }
    T* begin() { return data_; }
    T* end() { return data_ + count_; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + count_; }

  private:
    const Allocator* allocator_ = nullptr;
    T* data_ = nullptr;
    std::size_t count_ = 0;
};

// Block of memory for the many small buffers of a short call, or for scratch memory that is placed in the memory of an
// output. Requests that do not fit into the block are passed to the caller's allocator.

/// Allocator for the duration of a call: allocates from a block in order. Memory is reused if the most recent buffer is
/// released first. Like every Allocator, it is used by the calling thread only.
class ScratchBlock {
  public:
    ScratchBlock(const Allocator* parent, std::size_t bytes)
        : parent_(parent), own_(parent, bytes), block_(own_.data()), size_(bytes) {}
    /// Allocates from memory that the caller owns.
    ScratchBlock(const Allocator* parent, std::span<std::byte> memory) : parent_(parent) {
        const std::size_t skip = -reinterpret_cast<std::uintptr_t>(memory.data()) % kMemoryAlignment;
        if (memory.size() <= skip) return;
        block_ = memory.data() + skip;
        size_ = memory.size() - skip;
    }
    ScratchBlock(const ScratchBlock&) = delete;
    ScratchBlock& operator=(const ScratchBlock&) = delete;

    [[nodiscard]] const Allocator* allocator() const { return &allocator_; }
    /// Returns whether an allocation of this size would come from the block.
    [[nodiscard]] bool has(std::size_t bytes) const { return bytes <= size_ - used_; }

  private:
    static std::size_t rounded(std::size_t bytes) {
        return (bytes + kMemoryAlignment - 1) / kMemoryAlignment * kMemoryAlignment;
    }

    static void* allocate(void* user, std::size_t bytes, std::size_t) {
        auto& self = *static_cast<ScratchBlock*>(user);
        if (!self.has(bytes)) return allocateArray(self.parent_, bytes, 1);
        void* memory = self.block_ + self.used_;
        self.used_ = std::min(self.used_ + rounded(bytes), self.size_);
        return memory;
    }

    static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
        auto& self = *static_cast<ScratchBlock*>(user);
        // The addresses are compared as integers, because comparing pointers into different arrays is undefined.
        const std::size_t offset =
            reinterpret_cast<std::uintptr_t>(memory) - reinterpret_cast<std::uintptr_t>(self.block_);
        if (offset >= self.size_) {
            releaseBytes(self.parent_, memory, bytes);
            return;
        }
        if (std::min(offset + rounded(bytes), self.size_) == self.used_) self.used_ = offset;
    }

    const Allocator* parent_;
    Buffer<std::byte> own_;
    std::byte* block_ = nullptr;
    std::size_t size_ = 0, used_ = 0;
    Allocator allocator_{allocate, release, this};
};

// Prefetching of cache lines, and streaming stores for large outputs: such outputs are evicted from the caches before
// they are read, and an ordinary store first reads each cache line.

/// Prefetches `bytes` bytes that start `ahead` bytes after `place`, for reading or writing. Hardware prefetchers do not
/// cross pages. The addresses need not be valid.
template <bool kToWrite = false>
inline void prefetchLines(const void* place, std::size_t bytes, std::size_t ahead = 4096) {
    constexpr std::size_t kLine = 64;
    const auto first = reinterpret_cast<std::uintptr_t>(place) + ahead;
    for (std::size_t i = 0; i < bytes; i += kLine)
        __builtin_prefetch(reinterpret_cast<const void*>(first + i), kToWrite ? 1 : 0);
}

/// Returns whether rows at `to`, `bytes` bytes in total, should be streamed. The rows must be contiguous.
inline bool areStreamed([[maybe_unused]] const void* to, [[maybe_unused]] std::size_t bytes) {
#if defined(TSPACE_SIMD_X86)
    constexpr std::size_t kLarge = std::size_t{32} << 20;  // typical size of the last-level cache
    return bytes >= kLarge && reinterpret_cast<std::uintptr_t>(to) % 16 == 0;
#else
    return false;
#endif
}

/// Performs to[0..3] = row[0..3]; both pointers must be aligned to 16 bytes. No thread may read the result before this
/// one calls endOfRows.
inline void streamRow(float* to, const float* row) {
#if defined(TSPACE_SIMD_X86)
    _mm_stream_ps(to, _mm_load_ps(row));
#else
    std::memcpy(to, row, 4 * sizeof(float));
#endif
}

inline void endOfRows() {
#if defined(TSPACE_SIMD_X86)
    _mm_sfence();
#endif
}

}  // namespace tspace
