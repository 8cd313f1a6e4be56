// SPDX-License-Identifier: MIT
// What a model file may take of memory: a fixed part, and a multiple of the bytes that it really has, or what
// the user says. A file can claim any number of vertices, and name the same bytes many times; what it costs
// to believe it is asked for here first.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "model/io/file_error.h"

namespace tspace {

/// Costs are estimates, rounded up: without a limit of the user's, measured peaks stay below 16 bytes for
/// each byte of the file, and 64 MB. Used by several threads at once.
class MemoryBudget {
  public:
    /// What the program itself takes, and what estimates miss.
    static constexpr std::int64_t kProgram = std::int64_t{24} << 20;
    static constexpr std::int64_t kAnyFile = std::int64_t{64} << 20;
    static constexpr std::int64_t kPerByte = 16;

    /// `limit_bytes`: as FileOptions::memory_limit_bytes.
    explicit MemoryBudget(std::uint64_t limit_bytes = 0)
        : is_users_(limit_bytes != 0),
          granted_(is_users_ ? limited(limit_bytes) : kAnyFile),
          left_(granted_ - kProgram) {}

    /// The file, or one that it names, has so many bytes more.
    void allow(std::uint64_t file_bytes) {
        if (is_users_) return;
        granted_ += kPerByte * limited(file_bytes);
        left_ += kPerByte * limited(file_bytes);
    }

    /// Memory that stays taken. Fails with tooLarge.
    void take(std::uint64_t bytes, const std::string& place) {
        require(bytes, place);
        left_ -= limited(bytes);
    }

    /// So much of what was taken is free again.
    void release(std::uint64_t bytes) { left_ += limited(bytes); }

    /// What is left now; and all that was taken since is given back.
    [[nodiscard]] std::int64_t left() const { return left_; }
    void giveBack(std::int64_t left_before) {
        if (left_ < left_before) left_ = left_before;
    }

    /// Memory that is taken for a while, and given back.
    void require(std::uint64_t bytes, const std::string& place) const {
        if (!has(bytes)) failFile(ErrorCode::tooLarge, "what the file claims " + whyNot(bytes), place);
    }
    [[nodiscard]] bool has(std::uint64_t bytes) const { return limited(bytes) <= left_; }

    /// How many of `count` things, one at least, may be worked on together. bytesOf(i) is what the work on
    /// one takes.
    template <class BytesOf>
    [[nodiscard]] std::size_t countTogether(std::size_t count, BytesOf&& bytesOf) const {
        std::uint64_t bytes = 0;
        for (std::size_t i = 0; i < count; ++i) {
            bytes += bytesOf(i);
            if (i > 0 && !has(bytes)) return i;
        }
        return count;
    }

    /// Whether the user said how much it is.
    [[nodiscard]] bool isUsers() const { return is_users_; }

    /// What to say where the budget does not have so many bytes: "needs ...".
    [[nodiscard]] std::string whyNot(std::uint64_t bytes) const {
        const std::string needed = "needs about " + megabytes(granted_ - left_ + limited(bytes)) + " of memory, and ";
        return is_users_ ? needed + "--memory-limit allows " + megabytes(granted_)
                         : needed + "a file of its size gets " + megabytes(granted_) + " (--memory-limit allows more)";
    }

  private:
    /// No sum of two can overflow.
    static std::int64_t limited(std::uint64_t bytes) {
        constexpr std::uint64_t kMost = std::uint64_t{1} << 56;
        return static_cast<std::int64_t>(bytes < kMost ? bytes : kMost);
    }
    /// As the option counts them, rounded up.
    static std::string megabytes(std::int64_t bytes) {
        constexpr std::int64_t kMegabyte = std::int64_t{1} << 20;
        return std::to_string((bytes + kMegabyte - 1) / kMegabyte) + " MB";
    }

    bool is_users_;
    std::atomic<std::int64_t> granted_;
    std::atomic<std::int64_t> left_;
};

}  // namespace tspace
