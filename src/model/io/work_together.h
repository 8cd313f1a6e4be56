// SPDX-License-Identifier: MIT
// Loops over the parts of a file with all threads, and no more memory than the file may take.
#pragma once

#include <cstddef>
#include <exception>
#include <vector>

#include "core/base/parallel.h"
#include "model/io/memory_budget.h"

namespace tspace {

/// Calls work(i) for each i in [0, count), as many at a time as the budget has room for; bytesOf(i) is what one takes.
/// `budget` may be null: no limit. Throws what the first one that failed threw, after all were tried.
template <class BytesOf, class Work>
void workTogether(const MemoryBudget* budget, std::size_t count, Parallel& parallel, const BytesOf& bytesOf,
                  const Work& work) {
    std::vector<std::exception_ptr> failures(count);
    for (std::size_t begin = 0; begin < count;) {
        const std::size_t left = count - begin;
        const std::size_t together =
            budget == nullptr ? left : budget->countTogether(left, [&](std::size_t i) { return bytesOf(begin + i); });
        parallel.forTasks(together, [&](std::size_t task) noexcept {
            try {
                work(begin + task);
            } catch (...) {
                failures[begin + task] = std::current_exception();
            }
        });
        begin += together;
    }
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

}  // namespace tspace
