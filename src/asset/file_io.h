// SPDX-License-Identifier: MIT
// Whole files in and out of memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "core/memory.h"

namespace tspace {

/// Takes memory as Buffer does, with its pages at once, and leaves new elements as they are: what is to be overwritten
/// need not be zero before.
template <class T>
struct UnsetAllocator {
    using value_type = T;

    UnsetAllocator() = default;
    template <class U>
    UnsetAllocator(const UnsetAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(allocateBytes(nullptr, count * sizeof(T))); }
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

/// Reads a regular file. Fails with cannotRead; with invalidFile when `place` says where a model names it.
Bytes readFile(const std::filesystem::path& path, const std::string& place = {});

/// The folder that a file lies in; "." for a bare name.
std::filesystem::path folderOf(const std::filesystem::path& file);

/// True when both paths name the same existing file, or are the same path where nothing exists yet.
bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// The extension in lower case with its dot, or "".
std::string lowerExtension(const std::filesystem::path& path);

}  // namespace tspace
