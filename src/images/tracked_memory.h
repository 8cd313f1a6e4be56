// SPDX-License-Identifier: MIT
// Allocator for C libraries whose error codes do not distinguish a lack of memory from a corrupt file.
#pragma once

#include <cstddef>
#include <cstdlib>

#include "core/base/memory.h"

namespace tspace {

/// True if an allocation of a C library has failed in this thread since the flag was last cleared.
inline thread_local bool has_allocation_failed = false;

inline void* noted(void* memory, std::size_t bytes) {
    has_allocation_failed = has_allocation_failed || (memory == nullptr && bytes != 0);
    return memory;
}
inline void* trackedMalloc(std::size_t bytes) { return noted(std::malloc(bytes), bytes); }
inline void* trackedRealloc(void* old, std::size_t bytes) { return noted(std::realloc(old, bytes), bytes); }
inline void* trackedCalloc(std::size_t count, std::size_t bytes) {
    return noted(std::calloc(count, bytes), count * bytes);
}

/// Calls body(), whose result converts to false if a file cannot be read. Throws OutOfMemory if the cause was a failed
/// allocation.
template <class Body>
auto orOutOfMemory(const Body& body) -> decltype(body()) {
    has_allocation_failed = false;
    auto result = body();
    if (!result && has_allocation_failed) throwOutOfMemory();
    return result;
}

}  // namespace tspace
