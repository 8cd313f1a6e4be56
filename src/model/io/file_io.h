// SPDX-License-Identifier: MIT
// Whole files in and out of memory.
#pragma once

#include <cstdint>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "core/base/memory.h"
#include "model/io/path.h"
#include "tspace/execution.h"

namespace tspace {

inline constexpr std::size_t kLargeBytes = 2 * kHugePage;

/// Takes memory as Buffer does, with its pages at once where it is not large, and leaves new elements as they are: what
/// is to be overwritten need not be zero before.
template <class T>
struct UnsetAllocator {
    using value_type = T;

    UnsetAllocator() = default;
    template <class U>
    UnsetAllocator(const UnsetAllocator<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < kLargeBytes) return static_cast<T*>(allocateArray(nullptr, bytes, 1));
        // Several threads may fill it, each with pages of its own.
        void* memory = ::operator new(bytes, std::align_val_t(defaultAlignment(bytes)), std::nothrow);
        if (memory == nullptr) throw OutOfMemory{};
        askForHugePages(memory, bytes);
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

/// Bytes(n) and resize(n) leave new bytes unset; say Bytes(n, 0) for zeros.
using Bytes = std::vector<std::uint8_t, UnsetAllocator<std::uint8_t>>;

/// Reads a regular file, a large one with all threads. Fails with cannotRead; with invalidFile when `place` says where
/// a model names it.
Bytes readFile(const Path& path, const std::string& place = {}, const Execution& execution = {.thread_count = 1});

/// Whether there is something of that name; false where nobody can tell.
bool isThere(const Path& path);
bool isFolder(const Path& path);

/// True when both paths name the same existing file.
bool isOneFile(const Path& a, const Path& b);
/// One text for all names of a file, also of one that is not there yet.
std::string identityOf(const Path& path);
/// True when both paths name the same existing file, or are the same path where nothing exists yet.
bool isSameFile(const Path& a, const Path& b);

}  // namespace tspace
