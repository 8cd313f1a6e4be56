// SPDX-License-Identifier: MIT
// What a model file may take of memory: a fixed part, and a multiple of the bytes that it really has. A file can claim any
// number of vertices, and name the same bytes many times; what it costs to believe it is asked for here first.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "asset/file_error.h"

namespace tspace {

/// Costs are estimates, rounded up: measured peaks stay below 16 bytes for each byte of the file, and 64 MB. Used by several
/// threads at once.
class MemoryBudget {
  public:
    /// 64 MB, less what the program itself takes and what estimates miss.
    static constexpr std::int64_t kFree = std::int64_t{40} << 20;
    static constexpr std::int64_t kPerByte = 16;

    /// The file, or one that it names, has so many bytes more.
    void allow(std::uint64_t file_bytes) { left_ += kPerByte * limited(file_bytes); }

    /// Memory that stays taken. Fails with tooLarge.
    void take(std::uint64_t bytes, const std::string& place) {
        require(bytes, place);
        left_ -= limited(bytes);
    }

    /// Memory that is taken for a while, and given back.
    void require(std::uint64_t bytes, const std::string& place) const {
        if (!has(bytes)) failFile(ErrorCode::tooLarge, "what the file claims needs far more memory than the file has bytes", place);
    }
    [[nodiscard]] bool has(std::uint64_t bytes) const { return limited(bytes) <= left_; }

  private:
    /// No sum of two can overflow.
    static std::int64_t limited(std::uint64_t bytes) {
        constexpr std::uint64_t kMost = std::uint64_t{1} << 56;
        return static_cast<std::int64_t>(bytes < kMost ? bytes : kMost);
    }
    std::atomic<std::int64_t> left_{kFree};
};

}  // namespace tspace
