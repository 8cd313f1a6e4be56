// SPDX-License-Identifier: MIT
// The error bounds that pack.h states, and exact restoration of unpacked frames. TSPACE_FRAMES=100000000 tests that
// many random frames of each format. Their errors are printed in any case.
#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "core/pack/frame_list.h"

namespace tspace::test {
namespace {

constexpr std::size_t kBatch = 4096;

class PackBounds : public testing::TestWithParam<FrameFormat> {};
class PackExact : public testing::TestWithParam<FrameFormat> {};

const auto kName = [](const testing::TestParamInfo<FrameFormat>& info) { return nameOf(info.param); };
INSTANTIATE_TEST_SUITE_P(Formats, PackBounds, testing::ValuesIn(kAllFormats), kName);
INSTANTIATE_TEST_SUITE_P(Formats, PackExact, testing::ValuesIn(kExactFormats), kName);

TEST_P(PackBounds, HoldForRandomFrames) {
    const long count = frameCount(1'000'000);
    RandomBits random(1);
    PackErrors errors;
    long done = 0;
    for (; done < count; done += kBatch) {
        const FrameList frames = randomFrames(random, kBatch);
        errors.add(frames, unpacked(GetParam(), packed(GetParam(), frames)));
    }
    expectWithinBounds(GetParam(), errors);
    const auto frames = static_cast<double>(done);
    std::printf("%-12s worst N %.6f T %.6f, mean N %.6f T %.6f degrees, %ld frames\n", nameOf(GetParam()).c_str(),
                errors.normal_deg, errors.tangent_deg, errors.normal_sum / frames, errors.tangent_sum / frames, done);
}

/// Returns rotations at which encoders switch between cases, and rotations near them: rotations of axes to axes, and by
/// 45, 120 and 180 degrees, with deviations from 1e-11 to a quantization step.
FrameList specialFrames() {
    const double offsets[] = {0, 1e-11, 1e-7, 1e-5, 1e-3, 2e-3};
    const double values[] = {0, 0.41421356237309503, 1, -0.41421356237309503, -1};
    RandomBits random(2);
    FrameList frames;
    for (int index = 1; index < 625; ++index) {
        const Quaternion q{values[index % 5], values[index / 5 % 5], values[index / 25 % 5], values[index / 125]};
        for (const double by : offsets) {
            for (int turn = 0; turn < 8; ++turn) {
                frames.add({q.x + by * random.number(), q.y + by * random.number(), q.z + by * random.number(),
                            q.w + by * random.number()},
                           turn % 2 == 0 ? 1.0f : -1.0f);
            }
        }
    }
    return frames;
}

/// The sign of qtangent64 is stored as the sign of w, which therefore cannot be 0.
TEST_P(PackBounds, HoldForHalfTurns) {
    RandomBits random(10);
    PackErrors errors;
    for (int batch = 0; batch < 50; ++batch) {
        FrameList frames;
        for (std::size_t i = 0; i < kBatch; ++i) {
            Quaternion q = randomRotation(random);
            q.w = i % 4 == 0 ? 0 : 2e-5 * random.number();
            frames.add(q, i % 2 == 0 ? 1.0f : -1.0f);
        }
        errors.add(frames, unpacked(GetParam(), packed(GetParam(), frames)));
    }
    expectWithinBounds(GetParam(), errors);
}

TEST_P(PackBounds, HoldAtAxesAndBetweenThem) { expectWithinBounds(GetParam(), errorsOf(GetParam(), specialFrames())); }

/// Starts from the worst of some frames and maximizes the error by smaller and smaller rotations. This ends in corners
/// of quantization cells.
TEST_P(PackBounds, HoldInCornersOfCells) {
    constexpr std::size_t kClimbers = 512;
    const FrameErrorBound bound = frameErrorBound(GetParam());
    const auto badness = [&](const FrameList& before, const FrameList& after, std::size_t i, int goal) {
        const double n = angleDeg(before.normals[i], after.normals[i]) / bound.normal_deg;
        const double t = angleDeg(xyz(before.tangents[i]), xyz(after.tangents[i])) / bound.tangent_deg;
        return goal == 0 ? n : (goal == 1 ? t : std::max(n, t));
    };
    RandomBits random(3);
    for (const int goal : {0, 1, 2}) {
        std::vector<Quaternion> climbers;
        for (std::size_t i = 0; i < kClimbers; ++i) climbers.push_back(unit(randomRotation(random)));
        std::vector<double> height(kClimbers, -1);
        double reach = bound.normal_deg / 57;
        for (int step = 0; step < 400; ++step, reach *= 0.985) {
            FrameList frames;
            std::vector<Quaternion> tried = climbers;
            for (Quaternion& q : tried) {
                if (step > 0) {
                    q = unit({q.x + reach * random.number(), q.y + reach * random.number(),
                              q.z + reach * random.number(), q.w + reach * random.number()});
                }
                frames.add(q, 1);
            }
            const FrameList after = unpacked(GetParam(), packed(GetParam(), frames));
            for (std::size_t i = 0; i < kClimbers; ++i) {
                const double here = badness(frames, after, i, goal);
                if (here <= height[i]) continue;
                height[i] = here;
                climbers[i] = tried[i];
            }
        }
        const double worst = *std::max_element(height.begin(), height.end());
        EXPECT_LE(worst, 1) << nameOf(GetParam());
        EXPECT_GT(worst, 0.6) << "the climb finds nothing, or the bound is too wide";
    }
}

/// Checks that frames unpacked from `bytes` are orthonormal, and that packing them gives words that unpack to the same
/// frames.
void expectFoundAgain(FrameFormat format, const std::vector<std::byte>& bytes) {
    const FrameList frames = unpacked(format, bytes);
    double worst = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Vec3 n = frames.normals[i], t = xyz(frames.tangents[i]);
        const auto dot = [](const Vec3& a, const Vec3& b) {
            return double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
        };
        const double off =
            std::max({std::fabs(std::sqrt(dot(n, n)) - 1), std::fabs(std::sqrt(dot(t, t)) - 1), std::fabs(dot(n, t))});
        worst = off <= worst ? worst : off;  // worst also becomes NaN if off is NaN
    }
    EXPECT_LE(worst, 5e-7) << nameOf(format);
    const FrameList again = unpacked(format, packed(format, frames));
    EXPECT_TRUE(frames.normals == again.normals) << nameOf(format);
    EXPECT_TRUE(frames.tangents == again.tangents) << nameOf(format);
}

TEST_P(PackExact, RestoresAnyWord) {
    const long count = frameCount(500'000);
    const std::size_t each = frameBytes(GetParam());
    RandomBits random(4);
    for (long done = 0; done < count && !HasFailure(); done += kBatch) {
        std::vector<std::byte> bytes(kBatch * each);
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.next());
        expectFoundAgain(GetParam(), bytes);
    }
}

TEST_P(PackExact, RestoresTheFirstAndLastWords) {
    const std::size_t each = frameBytes(GetParam());
    std::vector<std::byte> bytes;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        for (const std::uint64_t word : {i, ~i}) {
            for (std::size_t b = 0; b < each; ++b) bytes.push_back(static_cast<std::byte>(word >> 8 * b & 0xff));
        }
    }
    expectFoundAgain(GetParam(), bytes);
}

/// Tests words that are evenly distributed over all 4-byte words. TSPACE_FRAMES=4294967296 tests all words.
TEST(PackWords, OfFourBytesAreRestored) {
    const std::uint64_t count = std::uint64_t{1} << 32, step = count / static_cast<std::uint64_t>(frameCount(500'000));
    for (const FrameFormat format : {FrameFormat::frame32, FrameFormat::oct32}) {
        std::vector<std::byte> bytes;
        for (std::uint64_t word = 0; word < count && !HasFailure(); word += step) {
            for (int b = 0; b < 4; ++b) bytes.push_back(static_cast<std::byte>(word >> 8 * b & 0xff));
            if (bytes.size() < 4 * kBatch && word + step < count) continue;
            expectFoundAgain(format, bytes);
            bytes.clear();
        }
    }
}

/// Tests words at corners, edges and centers of the cubes of all charts of frame32.
TEST(Frame32, RestoresWordsAtTheBordersOfCharts) {
    std::vector<std::byte> bytes;
    for (std::uint32_t g = 0; g < 24; ++g) {
        for (const std::uint32_t x : {0, 1, 2, 113, 225, 226, 227, 450, 451, 452}) {
            for (const std::uint32_t y : {0, 1, 2, 109, 217, 218, 219, 433, 434, 435}) {
                for (const std::uint32_t z : {0, 1, 2, 113, 225, 226, 227, 450, 451, 452}) {
                    const std::uint32_t word = 2 * (((g * 453 + x) * 436 + y) * 453 + z);
                    for (int b = 0; b < 4; ++b) bytes.push_back(static_cast<std::byte>(word >> 8 * b & 0xff));
                }
            }
        }
    }
    expectFoundAgain(FrameFormat::frame32, bytes);
}

TEST(Frame32, FillsTheFacesOfCharts) {
    // All of these rotations are at the border of a chart, where random rotations rarely are.
    RandomBits random(5);
    FrameList frames;
    for (int i = 0; i < 200'000; ++i) {
        double p[3] = {0.4142135 * random.number(), 0.4142135 * random.number(), 0.4142135 * random.number()};
        p[i % 3] = (i & 8) != 0 ? 0.41421356 : -0.41421356;
        frames.add({p[0], p[1], p[2], 1}, 1);
    }
    expectWithinBounds(FrameFormat::frame32, errorsOf(FrameFormat::frame32, frames));
}

TEST_P(PackExact, KeepsTheBitsOfFramesAlongAxes) {
    FrameList frames;
    const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    for (const Vec3& n : axes) {
        for (const Vec3& t : axes) {
            if (n.x * t.x + n.y * t.y + n.z * t.z != 0) continue;
            for (const float sign : {1.0f, -1.0f}) frames.add(n, {t.x, t.y, t.z, sign});
        }
    }
    ASSERT_EQ(frames.size(), 48);
    const FrameList after = unpacked(GetParam(), packed(GetParam(), frames));
    EXPECT_TRUE(after.normals == frames.normals);
    EXPECT_TRUE(after.tangents == frames.tangents);
}

TEST(PackBounds, AreExceededByCoarserCodes) {
    // N and T with 8 bits per component exceed the bound of frame32, which shows that the error measure detects errors.
    RandomBits random(6);
    const PackErrors errors = errorsOf(FrameFormat::snorm8Pair, randomFrames(random, 10'000));
    EXPECT_GT(errors.normal_deg, frameErrorBound(FrameFormat::frame32).normal_deg);
    EXPECT_GT(errors.tangent_deg, frameErrorBound(FrameFormat::frame32).tangent_deg);
}

}  // namespace
}  // namespace tspace::test
