// SPDX-License-Identifier: MIT
// Writing of large files so that signals take effect immediately.
#pragma once

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

namespace tspace {

/// Starts to flush a range of a file to the disk. Does nothing on failure or if the system has no such function.
void startFlush(std::FILE* file, std::size_t begin, std::size_t byte_count) noexcept;
/// Waits until a range that startFlush() was called for is flushed.
void finishFlush(std::FILE* file, std::size_t begin, std::size_t byte_count) noexcept;

/// Writes all bytes. Returns 0 or errno.
inline int writeTo(std::FILE* file, std::span<const std::uint8_t> bytes) {
    errno = 0;
    return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() ? 0 : errno != 0 ? errno : EIO;
}

/// Writes a file in steps, each of which is flushed while the next is written. A process does not end while it waits
/// for the disk, so flushing a large file at once would delay the effect of a signal by seconds.
class SteppedWriter {
  public:
    SteppedWriter(std::FILE* file, bool flushes) : file_(file), flushes_(flushes) {}

    /// Writes the next bytes of the file. Returns 0 or errno.
    int write(std::span<const std::uint8_t> bytes) {
        while (!bytes.empty()) {
            const auto part = bytes.first(std::min(bytes.size(), kStep - step_bytes_));
            if (const int failure = writeTo(file_, part); failure != 0) return failure;
            bytes = bytes.subspan(part.size());
            step_bytes_ += part.size();
            if (step_bytes_ == kStep) finishStep();
        }
        return 0;
    }

  private:
    static constexpr std::size_t kStep = std::size_t{4} << 20;

    void finishStep() {
        if (flushes_) {
            startFlush(file_, begin_, kStep);
            if (begin_ != 0) finishFlush(file_, begin_ - kStep, kStep);
        }
        begin_ += kStep;
        step_bytes_ = 0;
    }

    std::FILE* file_;
    bool flushes_;
    std::size_t begin_ = 0, step_bytes_ = 0;  ///< the current step
};

}  // namespace tspace
