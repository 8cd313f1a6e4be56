// SPDX-License-Identifier: MIT
// The instructions may change no bit, whatever the number of frames.
#include <gtest/gtest.h>

#include <cstring>

#include "pack/formats.h"
#include "pack/frame_list.h"

namespace tspace::test {
namespace {

constexpr SimdTarget kTargets[] = {SimdTarget::sse2, SimdTarget::avx2, SimdTarget::avx512, SimdTarget::neon,
                                   SimdTarget::best};

class PackSimd : public testing::TestWithParam<FrameFormat> {
  protected:
    [[nodiscard]] const pack::Format& format() const { return *pack::formatOf(GetParam()); }
};

const auto kFormatName = [](const testing::TestParamInfo<FrameFormat>& format) { return nameOf(format.param); };
INSTANTIATE_TEST_SUITE_P(Formats, PackSimd, testing::ValuesIn(kAllFormats), kFormatName);

FrameList unpackedOn(const pack::Format& format, SimdTarget target, const std::vector<std::byte>& bytes) {
    FrameList frames;
    frames.resize(bytes.size() / format.bytes);
    pack::unpack(format, target, bytes.data(), frames.normals, frames.tangents);
    return frames;
}

void expectSameBits(const FrameList& a, const FrameList& b) {
    ASSERT_EQ(a.size(), b.size());
    if (a.size() == 0) return;
    EXPECT_EQ(std::memcmp(a.normals.data(), b.normals.data(), a.size() * sizeof(Vec3)), 0);
    EXPECT_EQ(std::memcmp(a.tangents.data(), b.tangents.data(), a.size() * sizeof(Vec4)), 0);
}

TEST_P(PackSimd, UnpacksAnyBytesToTheSameBits) {
    RandomBits random(11);
    std::vector<std::byte> bytes(100'000 * format().bytes);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.next());
    constexpr std::byte kSpecial[] = {std::byte{0}, std::byte{0x80}, std::byte{0xff}};
    for (std::size_t i = 0; i < 20'000 * format().bytes; ++i) {
        if (random.next() % 4 != 0) bytes[i] = kSpecial[random.next() % 3];
    }
    const FrameList wanted = unpackedOn(format(), SimdTarget::scalar, bytes);
    for (const SimdTarget target : kTargets) expectSameBits(unpackedOn(format(), target, bytes), wanted);
}

TEST_P(PackSimd, UnpacksAnyNumberOfFramesToTheSameBits) {
    RandomBits random(12);
    for (std::size_t count = 0; count < 150; ++count) {
        std::vector<std::byte> bytes(count * format().bytes);
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.next());
        const FrameList wanted = unpackedOn(format(), SimdTarget::scalar, bytes);
        for (const SimdTarget target : kTargets) expectSameBits(unpackedOn(format(), target, bytes), wanted);
    }
}

}  // namespace
}  // namespace tspace::test
