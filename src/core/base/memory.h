// SPDX-License-Identifier: MIT
// Scratch memory from the caller's allocator. Running out is the one failure inside the core: it is thrown as
// OutOfMemory and turned into an Error by atBorder (border.h), so no exception leaves the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "tspace/execution.h"

namespace tspace {

struct OutOfMemory {};

/// Throws OutOfMemory. Where exceptions are compiled out it calls a function of the program, which must end the call.
[[noreturn]] void throwOutOfMemory();

inline constexpr std::size_t kMemoryAlignment = 64;  // a cache line, and the widest SIMD register

inline constexpr std::size_t kHugePage = std::size_t{2} << 20;
inline std::size_t defaultAlignment([[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    if (bytes >= kHugePage) return kHugePage;
#endif
    return kMemoryAlignment;
}

/// A hint only.
inline void askForHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= kHugePage) madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

/// Page faults of fresh memory can cost as much as all the computing on it (0.5 us and more for each 4 KB on a virtual
/// machine). So a large block is populated at once, with huge pages. Hints only: they may fail.
inline void askForPages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
    constexpr std::size_t kPage = 4096, kWorthACall = 32 * kPage;
    if (bytes < kWorthACall) return;
    askForHugePages(memory, bytes);
    const std::size_t skip = -reinterpret_cast<std::uintptr_t>(memory) % kPage;
    madvise(static_cast<std::byte*>(memory) + skip, (bytes - skip) / kPage * kPage, MADV_POPULATE_WRITE);
#endif
}

/// Never inlined, as releaseBytes: each use would take some hundred bytes of a program.
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
    askForPages(memory, bytes);
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

/// An array of plain values of fixed size, uninitialised unless a value is given. Move-only. The allocator must outlive
/// it.
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
        : allocator_(other.allocator_),
          data_(std::exchange(other.data_, nullptr)),
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

}  // namespace tspace
