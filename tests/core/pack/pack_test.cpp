// SPDX-License-Identifier: MIT
#include "tspace/pack.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/pack/frame_list.h"
#include "support/random_values.h"

namespace tspace::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr auto kNoFormat = static_cast<FrameFormat>(9);

PackReport reportOf(const Vec3& normal, const Vec4& tangent, FrameFormat format = FrameFormat::frame64) {
    std::vector<std::byte> bytes(frameBytes(format));
    const Result<PackReport> report = packFrames({&normal, 1}, {&tangent, 1}, format, bytes);
    EXPECT_TRUE(report);
    return report ? *report : PackReport{};
}

FrameList through(FrameFormat format, const Vec3& normal, const Vec4& tangent) {
    FrameList frames;
    frames.add(normal, tangent);
    return unpacked(format, packed(format, frames));
}

std::vector<int> bytesOf(FrameFormat format, const Vec3& normal, const Vec4& tangent) {
    FrameList frames;
    frames.add(normal, tangent);
    std::vector<int> numbers;
    for (const std::byte b : packed(format, frames)) numbers.push_back(std::to_integer<int>(b));
    return numbers;
}

TEST(FrameBytes, IsTheSizeOfEachFormat) {
    const std::size_t bytes[] = {4, 6, 8, 4, 8, 8, 16, 7, 14};
    for (std::size_t i = 0; i < std::size(kAllFormats); ++i) EXPECT_EQ(frameBytes(kAllFormats[i]), bytes[i]);
    EXPECT_EQ(frameBytes(kNoFormat), 0);
    EXPECT_EQ(frameErrorBound(kNoFormat).normal_deg, 0);
}

TEST(PackFrames, StoresTheDocumentedLayout) {
    const Vec3 z{0, 0, 1};
    const Vec4 x{1, 0, 0, 1}, x_mirrored{1, 0, 0, -1};
    // N is at the center of the octahedral grid, the angle is 0, and the sign is in the lowest bit.
    EXPECT_EQ(bytesOf(FrameFormat::oct32, z, x), (std::vector{0x00, 0xf0, 0xdf, 0x7f}));  // 511 << 22 | 511 << 12
    EXPECT_EQ(bytesOf(FrameFormat::oct32, z, x_mirrored)[0], 0x01);
    EXPECT_EQ(bytesOf(FrameFormat::frame64, z, x), (std::vector{0x00, 0x00, 0xc0, 0xff, 0xff, 0xfb, 0xff, 0x7f}));
    // The center of the first chart: 2 (((0 * 453 + 226) * 436 + 218) * 453 + 226) = 0x05553a58.
    EXPECT_EQ(bytesOf(FrameFormat::frame32, z, x), (std::vector{0x58, 0x3a, 0x55, 0x05}));
    EXPECT_EQ(bytesOf(FrameFormat::frame32, z, x_mirrored)[0], 0x59);
    EXPECT_EQ(bytesOf(FrameFormat::qtangent64, z, x), (std::vector{0, 0, 0, 0, 0, 0, 0xff, 0x7f}));
    EXPECT_EQ(bytesOf(FrameFormat::qtangent64, z, x_mirrored), (std::vector{0, 0, 0, 0, 0, 0, 0x01, 0x80}));
    EXPECT_EQ(bytesOf(FrameFormat::snorm8Pair, z, x_mirrored), (std::vector{127, 0, 0, 127, 0, 0, 127, 0x81}));
    EXPECT_EQ(bytesOf(FrameFormat::gltfSnorm8, z, x_mirrored), (std::vector{127, 0, 0, 0x81, 0, 0, 127}));
    EXPECT_EQ(bytesOf(FrameFormat::gltfSnorm16, z, x),
              (std::vector{0xff, 0x7f, 0, 0, 0, 0, 0xff, 0x7f, 0, 0, 0, 0, 0xff, 0x7f}));
}

TEST(PackFrames, CountsEachFrameByTheFirstCause) {
    const Vec3 n{0, 0, 1};
    EXPECT_EQ(reportOf(n, {1, 0, 0, 1}).mendedCount(), 0);
    EXPECT_EQ(reportOf({0, 0, 1.0004f}, {1, 0, 0.0004f, -1}).mendedCount(), 0);
    EXPECT_EQ(reportOf({0, 0, 0}, {kNan, 0, 0, 0}).bad_normal_count, 1);
    EXPECT_EQ(reportOf({0, kInfinity, 0}, {1, 0, 0, 1}).bad_normal_count, 1);
    EXPECT_EQ(reportOf(n, {kNan, 0, 0, 0}).not_finite_count, 1);
    EXPECT_EQ(reportOf(n, {0, 0, 0, 0}).zero_count, 1);
    EXPECT_EQ(reportOf(n, {0.01f, 0, -1, 0}).parallel_count, 1);
    EXPECT_EQ(reportOf(n, {2, 0, 0, 0}).not_unit_count, 1);
    EXPECT_EQ(reportOf({0, 0, 3}, {1, 0, 1, 0}).not_unit_count, 1);
    EXPECT_EQ(reportOf(n, {0.8f, 0, 0.6f, 0}).not_orthogonal_count, 1);
    EXPECT_EQ(reportOf(n, {1, 0, 0, 0.5f}).bad_sign_count, 1);
    EXPECT_EQ(reportOf({0, 0, 0}, {kNan, 0, 0, 0}).mendedCount(), 1);
}

TEST(PackFrames, RepairsWithTheFramesOwnDirections) {
    const FrameList frame = through(FrameFormat::frame64, {0, 0, 1e-30f}, {3, 0, 4, -0.5f});
    EXPECT_EQ(frame.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(frame.tangents[0], (Vec4{1, 0, 0, -1}));
    EXPECT_EQ(through(FrameFormat::frame32, {3e38f, 0, 0}, {0, -3e38f, 0, 1}).tangents[0], (Vec4{0, -1, 0, 1}));
}

TEST(PackFrames, UsesTheSignOfAnInvalidSign) {
    for (const FrameFormat format : kAllFormats) {
        for (const float w : {0.0f, -0.0f, kNan, kInfinity, 0.25f, 1.0f}) {
            EXPECT_EQ(through(format, {0, 0, 1}, {1, 0, 0, w}).tangents[0].w, 1);
        }
        for (const float w : {-kInfinity, -0.25f, -1.0f, -1e-40f}) {
            EXPECT_EQ(through(format, {0, 0, 1}, {1, 0, 0, w}).tangents[0].w, -1);
        }
    }
}

TEST(PackFrames, PacksAnythingIntoAValidFrame) {
    EXPECT_TRUE(rc::check("any floats", [] {
        const Vec3 n = randomGarbageVec3(), t = randomGarbageVec3();
        for (const FrameFormat format : kAllFormats) {
            const FrameList frame = through(format, n, {t.x, t.y, t.z, randomGarbage()});
            const Vec3 tangent = xyz(frame.tangents[0]);
            RC_ASSERT(isUnit(frame.normals[0]) && isUnit(tangent));
            RC_ASSERT(std::fabs(dot(frame.normals[0], tangent)) < 0.02);
        }
    }));
}

TEST(UnpackFrames, DecodesAnyBytesToAFrame) {
    RandomBits random(7);
    for (const FrameFormat format : kAllFormats) {
        for (const int fill : {0x00, 0x80, 0xff, 0x7f, -1}) {
            std::vector<std::byte> bytes(frameBytes(format) * 1000);
            for (std::byte& b : bytes) b = static_cast<std::byte>(fill < 0 ? random.next() : std::uint64_t(fill));
            const FrameList frames = unpacked(format, bytes);
            for (std::size_t i = 0; i < frames.size(); ++i) {
                ASSERT_TRUE(isUnit(frames.normals[i], 5e-7) && isUnit(xyz(frames.tangents[i]), 5e-7)) << nameOf(format);
                ASSERT_EQ(std::fabs(frames.tangents[i].w), 1) << nameOf(format);
            }
        }
    }
}

TEST(PackFrames, ReadsAndWritesWithStrides) {
    struct Vertex {
        Vec3 normal;
        float other = 7;
        Vec4 tangent;
    };
    RandomBits random(8);
    const FrameList frames = randomFrames(random, 100);
    std::vector<Vertex> vertices(100);
    for (std::size_t i = 0; i < 100; ++i) vertices[i] = {frames.normals[i], 7, frames.tangents[i]};
    for (const FrameFormat format : kAllFormats) {
        std::vector<std::byte> bytes(100 * frameBytes(format));
        ASSERT_TRUE(packFrames(StridedSpan<const Vec3>{&vertices[0].normal, 100, sizeof(Vertex)},
                               StridedSpan<const Vec4>{&vertices[0].tangent, 100, sizeof(Vertex)}, format, bytes));
        EXPECT_TRUE(bytes == packed(format, frames));
        std::vector<Vertex> out(100);
        ASSERT_TRUE(unpackFrames(bytes, format, StridedSpan<Vec3>{&out[0].normal, 100, sizeof(Vertex)},
                                 StridedSpan<Vec4>{&out[0].tangent, 100, sizeof(Vertex)}));
        const FrameList want = unpacked(format, bytes);
        for (std::size_t i = 0; i < 100; ++i) {
            EXPECT_EQ(out[i].normal, want.normals[i]);
            EXPECT_EQ(out[i].tangent, want.tangents[i]);
            EXPECT_EQ(out[i].other, 7);
        }
    }
}

TEST(PackFrames, RejectsMismatchingArrays) {
    std::array<Vec3, 2> normals{{{0, 0, 1}, {0, 0, 1}}};
    std::array<Vec4, 2> tangents{{{1, 0, 0, 1}, {1, 0, 0, 1}}};
    std::array<std::byte, 16> bytes{};
    const auto code = [&](FrameFormat format, StridedSpan<Vec3> n, StridedSpan<Vec4> t, std::span<std::byte> b) {
        const Result<PackReport> packed = packFrames(n, t, format, b);
        const Result<Done> unpacked = unpackFrames(b, format, n, t);
        const ErrorCode c = packed ? ErrorCode::ok : packed.error().code;
        EXPECT_EQ(unpacked ? ErrorCode::ok : unpacked.error().code, c);
        return c;
    };
    const std::span<std::byte> eight = std::span(bytes).first(8);
    EXPECT_EQ(code(FrameFormat::frame32, normals, tangents, eight), ErrorCode::ok);
    EXPECT_EQ(code(FrameFormat::frame32, {}, {}, {}), ErrorCode::ok);
    EXPECT_EQ(code(kNoFormat, normals, tangents, eight), ErrorCode::invalidOption);
    EXPECT_EQ(code(FrameFormat::frame32, normals, {tangents.data(), 1}, eight), ErrorCode::countMismatch);
    EXPECT_EQ(code(FrameFormat::frame32, normals, tangents, std::span(bytes).first(7)), ErrorCode::countMismatch);
    EXPECT_EQ(code(FrameFormat::frame32, normals, tangents, std::span(bytes).first(9)), ErrorCode::countMismatch);
    EXPECT_EQ(code(FrameFormat::frame32, normals, tangents, bytes), ErrorCode::countMismatch);
    EXPECT_EQ(code(FrameFormat::frame32, {nullptr, 2}, tangents, eight), ErrorCode::nullData);
    EXPECT_EQ(code(FrameFormat::frame32, normals, {tangents.data(), 2, 12}, eight), ErrorCode::strideTooSmall);
}

TEST(PackFrames, AcceptsUnalignedBytes) {
    RandomBits random(9);
    const FrameList frames = randomFrames(random, 10);
    for (const FrameFormat format : kAllFormats) {
        std::vector<std::byte> bytes(10 * frameBytes(format) + 1);
        const std::span<std::byte> odd = std::span(bytes).subspan(1);
        ASSERT_TRUE(packFrames(frames.normals, frames.tangents, format, odd));
        EXPECT_TRUE(std::equal(odd.begin(), odd.end(), packed(format, frames).begin()));
    }
}

}  // namespace
}  // namespace tspace::test
