// SPDX-License-Identifier: MIT
// One block of memory for the many small buffers of a short call, or for scratch memory that borrows an output.
// Requests that do not fit go to the caller's allocator.
#pragma once

#include <algorithm>
#include <span>

#include "core/base/memory.h"

namespace tspace {

/// An allocator for the duration of one call: gives out a block from its start to its end. Memory is used
/// again when the last buffer that was given out goes first. For the calling thread only, as every allocator.
class ScratchBlock {
  public:
    ScratchBlock(const Allocator* parent, std::size_t bytes)
        : parent_(parent), own_(parent, bytes), block_(own_.data()), size_(bytes) {}
    /// Gives out memory that the caller owns.
    ScratchBlock(const Allocator* parent, std::span<std::byte> memory) : parent_(parent) {
        const std::size_t skip = -reinterpret_cast<std::uintptr_t>(memory.data()) % kMemoryAlignment;
        if (memory.size() <= skip) return;
        block_ = memory.data() + skip;
        size_ = memory.size() - skip;
    }
    ScratchBlock(const ScratchBlock&) = delete;
    ScratchBlock& operator=(const ScratchBlock&) = delete;

    [[nodiscard]] const Allocator* allocator() const { return &allocator_; }
    /// Whether so many bytes would come from the block.
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
        // Compared as numbers: comparing pointers into different arrays is undefined.
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

}  // namespace tspace
