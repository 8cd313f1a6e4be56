// SPDX-License-Identifier: MIT
// Fresh memory with known content, which must not affect the result of a call.
#pragma once

#include <cstring>
#include <new>

#include "tspace/execution.h"

namespace tspace::test {

/// Allocator whose memory initially contains `byte` in every byte.
class FilledMemory {
  public:
    explicit FilledMemory(unsigned char byte) : byte_(byte) {}
    FilledMemory(const FilledMemory&) = delete;
    FilledMemory& operator=(const FilledMemory&) = delete;

    [[nodiscard]] Execution execution(std::uint32_t threads = 1) const {
        return {.thread_count = threads, .allocator = &allocator_};
    }

  private:
    unsigned char byte_;
    Allocator allocator_ = {[](void* user, std::size_t bytes, std::size_t alignment) {
                                void* memory = ::operator new(bytes, std::align_val_t(alignment));
                                return std::memset(memory, static_cast<FilledMemory*>(user)->byte_, bytes);
                            },
                            [](void*, void* memory, std::size_t, std::size_t alignment) {
                                ::operator delete(memory, std::align_val_t(alignment));
                            },
                            this};
};

/// Bytes with which memory is filled. As floats they are 0, a small number, and NaN.
inline constexpr unsigned char kFillings[] = {0x00, 0x3c, 0xff};

}  // namespace tspace::test
