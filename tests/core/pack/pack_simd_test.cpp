// SPDX-License-Identifier: MIT
// The SIMD target must not change any bit, for any number of frames.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/pack/formats.h"
#include "core/pack/frame_list.h"

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

struct PackedFrames {
    std::vector<std::byte> bytes;
    PackReport report;
};

PackedFrames packedOn(const pack::Format& format, SimdTarget target, const FrameList& frames) {
    PackedFrames packed{std::vector<std::byte>(frames.size() * format.bytes), {}};
    packed.report = pack::pack(format, target, {frames.normals.data(), frames.size()},
                               {frames.tangents.data(), frames.size()}, packed.bytes.data());
    return packed;
}

/// Checks that all targets give the same result as the scalar code, and returns it.
PackedFrames expectSamePacked(const pack::Format& format, const FrameList& frames) {
    const PackedFrames wanted = packedOn(format, SimdTarget::scalar, frames);
    for (const SimdTarget target : kTargets) {
        const PackedFrames packed = packedOn(format, target, frames);
        EXPECT_TRUE(packed.bytes == wanted.bytes);
        EXPECT_EQ(std::memcmp(&packed.report, &wanted.report, sizeof(PackReport)), 0);
    }
    return wanted;
}

TEST_P(PackSimd, PacksFramesToTheSameBytes) {
    RandomBits random(13);
    FrameList frames = randomFrames(random, 50'000);
    const double values[] = {0, 0.41421356237309503, 1, -0.41421356237309503, -1};
    for (int index = 1; index < 625; ++index) {  // rotations of axes to axes, half turns, and borders of charts
        for (const double by : {0.0, 1e-7}) {
            const double q[4] = {values[index % 5], values[index / 5 % 5], values[index / 25 % 5], values[index / 125]};
            frames.add({q[0] + by, q[1] - by, q[2] + by, q[3] + by}, 1);
        }
    }
    EXPECT_EQ(expectSamePacked(format(), frames).report.mendedCount(), 0);
}

TEST_P(PackSimd, PacksUnpackedFramesToTheSameBytes) {
    RandomBits random(14);
    std::vector<std::byte> bytes(20'000 * format().bytes);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.next());
    expectSamePacked(format(), unpackedOn(format(), SimdTarget::best, bytes));
}

TEST_P(PackSimd, PacksAnyNumberOfFramesToTheSameBytes) {
    RandomBits random(15);
    for (std::size_t count = 0; count < 150; ++count) expectSamePacked(format(), randomFrames(random, count));
}

TEST_P(PackSimd, RepairsToTheSameBytes) {
    RandomBits random(16);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const float values[] = {0, -0.0f, 1, -1, 0.6f, -0.8f, 1e-30f, 3e38f, kInfinity, std::nanf("")};
    const auto any = [&] { return values[random.next() % std::size(values)]; };
    FrameList frames;
    for (int i = 0; i < 5'000; ++i) frames.add(Vec3{any(), any(), any()}, Vec4{any(), any(), any(), any()});
    EXPECT_GT(expectSamePacked(format(), frames).report.mendedCount(), 4'000);
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
