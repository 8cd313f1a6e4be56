// SPDX-License-Identifier: MIT
// Reader of values from the input of a fuzz target.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

/// Aborts if `holds` is false, which reports a finding.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: this does not hold: %s\n", what);
    std::abort();
}

/// Reads values from the input; zeros after its end.
class ByteReader {
  public:
    ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
    /// Returns a float with arbitrary bits.
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
