// SPDX-License-Identifier: MIT
// Allocator that counts the library's allocations.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "tspace/execution.h"

namespace tspace::bench {

class CountingAllocator {
  public:
    CountingAllocator() = default;
    CountingAllocator(const CountingAllocator&) = delete;
    CountingAllocator& operator=(const CountingAllocator&) = delete;

    [[nodiscard]] const Allocator* hook() const { return &hook_; }
    [[nodiscard]] std::size_t peakBytes() const { return peak_; }

  private:
    static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
        auto& self = *static_cast<CountingAllocator*>(user);
        self.held_ += bytes;
        self.peak_ = std::max(self.peak_, self.held_);
        return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    }
    static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
        static_cast<CountingAllocator*>(user)->held_ -= bytes;
        std::free(memory);
    }

    std::size_t held_ = 0, peak_ = 0;
    Allocator hook_{allocate, release, this};
};

}  // namespace tspace::bench
