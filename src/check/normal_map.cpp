// SPDX-License-Identifier: MIT
// The integrability test.
#include "check/normal_map.h"

#include <algorithm>
#include <cmath>

namespace tspace {

namespace {

constexpr std::uint32_t kBlock = 16;
/// Steeper normals are borders of islands, or no normals at all.
constexpr float kLeastUp = 0.25f;
/// Larger derivatives are jumps between islands.
constexpr float kMostDerivative = 0.25f;
/// Mean square of a derivative in a block below which it is rounding to 8 bits (2.6e-6) and what compression adds.
constexpr double kLeastRelief = 4e-5;
constexpr double kLeastCorrelation = 0.1;
constexpr std::uint64_t kLeastBlocks = 16;
constexpr double kLeastAgreement = 0.65;

struct Sums {
    double ab = 0, aa = 0, bb = 0;
    std::uint64_t count = 0;
};

/// Slopes p and q of a pixel; false where it holds no normal that stands up.
bool slopes(const std::uint8_t* pixel, float& p, float& q) {
    const float nz = static_cast<float>(pixel[2]) / 127.5f - 1;
    if (nz < kLeastUp) return false;
    p = -(static_cast<float>(pixel[0]) / 127.5f - 1) / nz;
    q = -(static_cast<float>(pixel[1]) / 127.5f - 1) / nz;
    return true;
}

/// dq/dx and dp/drow at a pixel that is not on the border.
void addPixel(const RgbImage& image, std::size_t x, std::size_t y, Sums& sums) {
    const std::size_t row = std::size_t{3} * image.width;
    const std::uint8_t* centre = image.rgb.data() + y * row + 3 * x;
    float p_left, q_left, p_right, q_right, p_above, q_above, p_below, q_below;
    if (!slopes(centre - 3, p_left, q_left) || !slopes(centre + 3, p_right, q_right) ||
        !slopes(centre - row, p_above, q_above) || !slopes(centre + row, p_below, q_below)) {
        return;
    }
    const double a = std::clamp(0.5f * (q_right - q_left), -kMostDerivative, kMostDerivative);
    const double b = std::clamp(0.5f * (p_below - p_above), -kMostDerivative, kMostDerivative);
    sums.ab += a * b;
    sums.aa += a * a;
    sums.bb += b * b;
    ++sums.count;
}

}  // namespace

double GreenTest::confidence() const {
    if (verdict == GreenVerdict::unknown || block_count == 0) return 0;
    const double down = static_cast<double>(down_block_count) / static_cast<double>(block_count);
    return std::fabs(2 * down - 1);
}

GreenTest testGreen(const RgbImage& image) {
    GreenTest test;
    Sums all;
    for (std::uint32_t top = 1; top + kBlock < image.height; top += kBlock) {
        for (std::uint32_t left = 1; left + kBlock < image.width; left += kBlock) {
            Sums block;
            for (std::size_t y = top; y < top + kBlock; ++y) {
                for (std::size_t x = left; x < left + kBlock; ++x) addPixel(image, x, y, block);
            }
            const auto count = static_cast<double>(block.count);
            if (block.count < kBlock * kBlock / 2 || std::min(block.aa, block.bb) < kLeastRelief * count) continue;
            ++test.block_count;
            test.down_block_count += block.ab > 0;
            all.ab += block.ab;
            all.aa += block.aa;
            all.bb += block.bb;
        }
    }
    if (test.block_count < kLeastBlocks) return test;
    test.correlation = all.ab / std::sqrt(all.aa * all.bb);
    const double down = static_cast<double>(test.down_block_count) / static_cast<double>(test.block_count);
    if (test.correlation > kLeastCorrelation && down >= kLeastAgreement) test.verdict = GreenVerdict::down;
    if (test.correlation < -kLeastCorrelation && 1 - down >= kLeastAgreement) test.verdict = GreenVerdict::up;
    return test;
}

}  // namespace tspace
