// SPDX-License-Identifier: MIT
// Bytes of a file in memory.
#pragma once

#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "core/base/memory.h"

namespace tspace {

inline constexpr std::size_t kLargeBytes = 2 * kHugePage;

/// Allocates like Buffer, touching pages immediately unless the block is large, and leaves new elements uninitialized,
/// because readers overwrite them anyway.
template <class T>
struct UnsetAllocator {
    using value_type = T;

    UnsetAllocator() = default;
    template <class U>
    UnsetAllocator(const UnsetAllocator<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < kLargeBytes) return static_cast<T*>(allocateArray(nullptr, bytes, 1));
        // Pages of large blocks are touched by the threads that fill them.
        void* memory = ::operator new(bytes, std::align_val_t(defaultAlignment(bytes)), std::nothrow);
        if (memory == nullptr) throw OutOfMemory{};
        requestHugePages(memory, bytes);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) { releaseBytes(nullptr, memory, count * sizeof(T)); }
    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
    template <class U>
    bool operator==(const UnsetAllocator<U>&) const {
        return true;
    }
};

/// Bytes(n) and resize(n) leave new bytes uninitialized; use Bytes(n, 0) for zeros.
using Bytes = std::vector<std::uint8_t, UnsetAllocator<std::uint8_t>>;

}  // namespace tspace

// The functions are instantiated in bytes.cpp, with optimization. Otherwise each program would use a copy that one of
// its files instantiates. In an unoptimized copy, the destructor loops over every byte, which took 40 % of the time of
// model_golden_test. (WebAssembly modules have no bytes.cpp.)
#ifndef __EMSCRIPTEN__
extern template class std::vector<std::uint8_t, tspace::UnsetAllocator<std::uint8_t>>;
#endif
