// SPDX-License-Identifier: MIT
// Memory that is kept from call to call: from the second call on, no page is taken from the system.
#pragma once

#include <cstddef>

#include "tspace/execution.h"

namespace tspace {

/// Scratch memory for calls that follow each other. Pass allocator() in Execution::allocator; the memory of plans may
/// come from it as well. A call on an arena that another one like it has used takes nothing from the system.
///
/// Memory: the most that was in use at one time, plus the holes between allocations of different sizes (a few percent
/// for calls of this library) and up to 2 MiB. It is kept until trim() or the end of the arena. Large parts use
/// huge pages where the system has them.
///
/// For one call at a time: not thread-safe, as no Allocator is. One arena per thread that makes calls. It must outlive
/// the plans whose memory it holds; it does not move.
class Arena {
  public:
    Arena();
    ~Arena();
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// For Execution::allocator. Valid as long as the arena.
    [[nodiscard]] const Allocator* allocator() const { return &allocator_; }

    /// Bytes of memory that the arena holds now, in use or not. Reserved address space without memory does not count.
    [[nodiscard]] std::size_t heldBytes() const;
    /// Bytes in use now: 0 between calls, except for plans.
    [[nodiscard]] std::size_t usedBytes() const;

    /// Gives back what lies behind the last allocation in use; between calls without plans, that is everything.
    void trim();

  private:
    class Impl;
    Impl* impl_;
    Allocator allocator_;
};

}  // namespace tspace
