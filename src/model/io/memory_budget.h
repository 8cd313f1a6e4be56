// SPDX-License-Identifier: MIT
// Memory that reading a model may take: a fixed part plus a multiple of the file's size, or the user's limit. A file
// can declare any number of vertices, and refer to the same bytes many times, so costs are charged here before memory
// is allocated.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "model/io/file_error.h"

namespace tspace {

/// Budget in bytes. Charged costs are estimates, rounded up: with the default limit, measured peaks stay below 64 MB +
/// 16 bytes per byte of the file. Thread-safe.
class MemoryBudget {
  public:
    /// Memory of the program itself, and a margin for the estimates.
    static constexpr std::int64_t kProgram = std::int64_t{24} << 20;
    static constexpr std::int64_t kAnyFile = std::int64_t{64} << 20;
    static constexpr std::int64_t kPerByte = 16;

    /// `limit_bytes`: see FileOptions::memory_limit_bytes.
    explicit MemoryBudget(std::uint64_t limit_bytes = 0)
        : is_from_user_(limit_bytes != 0), granted_(is_from_user_ ? limited(limit_bytes) : kAnyFile),
          left_(granted_ - kProgram) {}

    /// Raises the limit by the size of the file, or of a file that it references.
    void allow(std::uint64_t file_bytes) {
        if (is_from_user_) return;
        granted_ += kPerByte * limited(file_bytes);
        left_ += kPerByte * limited(file_bytes);
    }

    /// Charges permanently allocated memory. Fails with tooLarge.
    void take(std::uint64_t bytes, const std::string& place) {
        require(bytes, place);
        left_ -= limited(bytes);
    }

    /// Returns bytes to the budget.
    void release(std::uint64_t bytes) { left_ += limited(bytes); }

    /// Returns the remaining bytes. Passing the result to restore() later returns everything that was charged since.
    [[nodiscard]] std::int64_t left() const { return left_; }
    void restore(std::int64_t earlier_left) {
        if (left_ < earlier_left) left_ = earlier_left;
    }

    /// Checks a temporary allocation without charging it. Fails with tooLarge.
    void require(std::uint64_t bytes, const std::string& place) const {
        if (!has(bytes)) failFile(ErrorCode::tooLarge, "the data that the file declares " + whyNot(bytes), place);
    }
    [[nodiscard]] bool has(std::uint64_t bytes) const { return limited(bytes) <= left_; }

    /// Returns how many of the `count` tasks, at least one, fit the budget together. bytesOf(i) is the memory of task
    /// i.
    template <class BytesOf>
    [[nodiscard]] std::size_t countTogether(std::size_t count, BytesOf&& bytesOf) const {
        std::uint64_t bytes = 0;
        for (std::size_t i = 0; i < count; ++i) {
            bytes += bytesOf(i);
            if (i > 0 && !has(bytes)) return i;
        }
        return count;
    }

    /// Returns whether the user set the limit, instead of the default.
    [[nodiscard]] bool isFromUser() const { return is_from_user_; }

    /// Returns the message of a failure: "needs ...".
    [[nodiscard]] std::string whyNot(std::uint64_t bytes) const {
        const std::string needed = "needs about " + megabytes(granted_ - left_ + limited(bytes)) + " of memory, but ";
        return is_from_user_ ? needed + "--memory-limit is " + megabytes(granted_)
                             : needed + "the limit for a file of its size is " + megabytes(granted_) +
                                   "; use --memory-limit to raise it";
    }

  private:
    /// Clamps a size, so that no sum of two sizes can overflow.
    static std::int64_t limited(std::uint64_t bytes) {
        constexpr std::uint64_t kMax = std::uint64_t{1} << 56;
        return static_cast<std::int64_t>(bytes < kMax ? bytes : kMax);
    }
    /// Formats a size in the unit of the option, rounded up.
    static std::string megabytes(std::int64_t bytes) {
        constexpr std::int64_t kMegabyte = std::int64_t{1} << 20;
        return std::to_string((bytes + kMegabyte - 1) / kMegabyte) + " MB";
    }

    bool is_from_user_;
    std::atomic<std::int64_t> granted_;
    std::atomic<std::int64_t> left_;
};

// Loops over the parts of a file with all threads, within the memory budget.

/// Calls work(i) for each i in [0, count), as many in parallel as the budget allows; bytesOf(i) is the memory of one
/// call. `budget` may be null: no limit. After all calls, rethrows the exception of the first one that failed.
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
