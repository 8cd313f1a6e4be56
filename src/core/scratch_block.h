// SPDX-License-Identifier: MIT
// One block of memory for the many small buffers of a short call. What does not fit comes from the caller's
// allocator.
#pragma once

#include <algorithm>
#include <functional>

#include "core/memory.h"

namespace tspace {

/// An allocator for the duration of one call: gives out a block from its start to its end. Memory is used
/// again when the last buffer that was given out goes first. For the calling thread only, as every allocator.
class ScratchBlock {
  public:
    ScratchBlock(const Allocator* parent, std::size_t bytes) : parent_(parent), block_(parent, bytes) {}
    ScratchBlock(const ScratchBlock&) = delete;
    ScratchBlock& operator=(const ScratchBlock&) = delete;

    [[nodiscard]] const Allocator* allocator() const { return &allocator_; }

  private:
    static std::size_t rounded(std::size_t bytes) {
        return (bytes + kMemoryAlignment - 1) / kMemoryAlignment * kMemoryAlignment;
    }

    static void* allocate(void* user, std::size_t bytes, std::size_t) {
        auto& self = *static_cast<ScratchBlock*>(user);
        if (bytes > self.block_.size() - self.used_) return allocateBytes(self.parent_, bytes);
        void* memory = self.block_.data() + self.used_;
        self.used_ = std::min(self.used_ + rounded(bytes), self.block_.size());
        return memory;
    }

    static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
        auto& self = *static_cast<ScratchBlock*>(user);
        auto* const first = static_cast<std::byte*>(memory);
        const std::byte *begin = self.block_.data(), *end = begin + self.block_.size();
        if (!std::less_equal<>{}(begin, first) || !std::less<>{}(first, end)) {
            releaseBytes(self.parent_, memory, bytes);
            return;
        }
        const auto offset = static_cast<std::size_t>(first - begin);
        if (std::min(offset + rounded(bytes), self.block_.size()) == self.used_) self.used_ = offset;
    }

    const Allocator* parent_;
    Buffer<std::byte> block_;
    std::size_t used_ = 0;
    Allocator allocator_{allocate, release, this};
};

}  // namespace tspace
