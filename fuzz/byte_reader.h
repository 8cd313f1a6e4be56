// SPDX-License-Identifier: MIT
// Reads values from the input of a fuzz target.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

/// Aborts where `what` does not hold: that is the finding.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: this does not hold: %s\n", what);
    std::abort();
}

/// Reads values off the input; zeros once it is used up.
class ByteReader {
  public:
    ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
    /// A value of arbitrary bits.
    float any() {
        std::uint8_t bytes[4] = {byte(), byte(), byte(), byte()};
        float value = 0;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }

  private:
    const std::uint8_t* data_;
    std::size_t size_, at_ = 0;
};
