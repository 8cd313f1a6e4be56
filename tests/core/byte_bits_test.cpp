// SPDX-License-Identifier: MIT
#include "core/byte_bits.h"

#include <gtest/gtest.h>

#include <random>

namespace tspace {
namespace {

TEST(ByteBits, SayWhichBytesAreBelowALimit) {
    std::mt19937 random(1);
    for (unsigned limit = 0; limit < 256; ++limit) {
        std::uint8_t bytes[64];
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? limit : random());
        const std::uint64_t bits = bytesBelow(bytes, static_cast<std::uint8_t>(limit));
        for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ((bits >> i & 1) != 0, bytes[i] < limit) << i;
    }
}

}  // namespace
}  // namespace tspace
