// SPDX-License-Identifier: MIT
// Counting in parallel.
#pragma once

#include <atomic>
#include <cstdint>

#include "core/parallel.h"

namespace tspace {

/// The sum of body(begin, end) over the ranges of Parallel::forRanges. Whole numbers only, so their order
/// cannot change the result.
template <class Body>
std::uint64_t sumRanges(Parallel& parallel, std::size_t count, std::size_t grain, Body&& body) {
    std::atomic<std::uint64_t> total{0};
    parallel.forRanges(count, grain, [&](std::size_t begin, std::size_t end) {
        total.fetch_add(body(begin, end), std::memory_order_relaxed);
    });
    return total;
}

}  // namespace tspace
