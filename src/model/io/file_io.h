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

/// Allocates as Buffer does, with pages touched at once unless the block is large, and leaves new elements uninitialised:
/// readers overwrite them anyway.
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

}  // namespace tspace

// Its functions are in file_io.cpp, optimised. Without this each program has one copy of all that its files make of them, and
// where one file is not optimised it may be that copy: a destructor there walks over every byte, which took 40 % of
// model_golden_test. (Modules of WebAssembly have no file_io.cpp.)
#ifndef __EMSCRIPTEN__
extern template class std::vector<std::uint8_t, tspace::UnsetAllocator<std::uint8_t>>;
#endif

namespace tspace {

/// Reads a regular file, a large one with all threads. Fails with cannotRead, or with invalidFile when `place` (where a
/// model names the file) is not empty.
Bytes readFile(const Path& path, const std::string& place = {}, const Execution& execution = {.thread_count = 1});

/// Whether the path exists; false where the system cannot tell.
bool isThere(const Path& path);
bool isFolder(const Path& path);

/// True when both paths name the same existing file.
bool isOneFile(const Path& a, const Path& b);
/// Equal for all names of a file, which need not exist yet.
std::string identityOf(const Path& path);
/// True when both paths name the same existing file, or are the same path where nothing exists yet.
bool isSameFile(const Path& a, const Path& b);

/// In bytes; 0 where there is no such file.
std::uint64_t fileSize(const Path& path);

/// The path of `file` relative to `folder`, with slashes; empty where it lies elsewhere.
std::string pathBelow(const Path& folder, const Path& file);

/// Whether a model written to this path is a GLB: isGlbName(), or a stream (kindOf()) that is not called .gltf.
bool isGlbOutput(const Path& path);

}  // namespace tspace
