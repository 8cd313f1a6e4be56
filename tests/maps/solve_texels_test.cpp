// SPDX-License-Identifier: MIT
// Choosing texels that are accurate under bilinear filtering.
#include "maps/solve/solve_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/vec_math.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

struct Sample {
    std::uint32_t x = 0, y = 0;
    float fx = 0, fy = 0;
    Vec3 wanted = {};
};

/// Returns samples of waves over an image that repeats, 3 x 3 per texel.
std::vector<Sample> waves(std::uint32_t width, std::uint32_t height) {
    std::vector<Sample> samples;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            for (int i = 0; i < 9; ++i) {
                const float fx = static_cast<float>(i % 3) / 3, fy = static_cast<float>(i / 3) / 3;
                const double u = 6.28318 * (x + static_cast<double>(fx)) / width,
                             v = 6.28318 * (y + static_cast<double>(fy)) / height;
                DVec3 wanted{0.4 * std::sin(3 * u + v), 0.3 * std::cos(2 * v - u), 1};
                normalize(wanted);
                samples.push_back({x, y, fx, fy, toFloat(wanted)});
            }
        }
    }
    return samples;
}

TexelSystem systemOf(const std::vector<Sample>& samples, std::uint32_t width, std::uint32_t height, float along) {
    const std::vector<TexelRole> roles(std::size_t{width} * height, TexelRole::unknown);
    TexelSystem system(nullptr, width, height, roles);
    for (const Sample& sample : samples)
        system.add(sample.x, sample.y, sample.fx, sample.fy, acrossSample(sample.wanted, along, 0.98F));
    return system;
}

/// Returns the mean error at the samples.
double errorOf(const TexelSystem& system, const std::vector<Sample>& samples, const std::vector<Vec3>& texels) {
    double sum = 0;
    for (const Sample& s : samples) {
        const auto at = [&](std::uint32_t x, std::uint32_t y) { return texels[std::size_t{y} * system.width() + x]; };
        const std::uint32_t right = system.right(s.x), below = system.below(s.y);
        const Vec3 filtered = ((1 - s.fx) * (1 - s.fy)) * at(s.x, s.y) + (s.fx * (1 - s.fy)) * at(right, s.y) +
                              ((1 - s.fx) * s.fy) * at(s.x, below) + (s.fx * s.fy) * at(right, below);
        sum += static_cast<double>(length(cross(filtered, s.wanted)) / length(filtered));
    }
    return sum / static_cast<double>(samples.size());
}

std::vector<Vec3> centers(const std::vector<Sample>& samples) {
    std::vector<Vec3> texels;
    for (const Sample& sample : samples) {
        if (sample.fx == 0 && sample.fy == 0) texels.push_back(sample.wanted);
    }
    return texels;
}

TEST(SolveTexels, TheFilteredImageIsMoreAccurateThanThatOfExactTexels) {
    constexpr std::uint32_t kWidth = 22, kHeight = 17;
    const std::vector<Sample> samples = waves(kWidth, kHeight);
    const TexelSystem system = systemOf(samples, kWidth, kHeight, 0.02F);
    std::vector<Vec3> texels = centers(samples);
    const double exact = errorOf(system, samples, texels);
    for (const unsigned threads : {1U, 3U}) {
        std::vector<Vec3> solved = centers(samples);
        Parallel parallel({.executor = threadTeam(threads)});
        solveTexels(system, solved, parallel, nullptr);
        EXPECT_LT(errorOf(system, samples, solved), 0.6 * exact);
        if (threads == 1) texels = solved;
        EXPECT_TRUE(texels == solved) << "threads change nothing";
    }
}

TEST(SolveTexels, IntegersCancelEachOthersErrors) {
    constexpr std::uint32_t kWidth = 40, kHeight = 33;
    const std::vector<Sample> samples = waves(kWidth, kHeight);
    const TexelSystem system = systemOf(samples, kWidth, kHeight, 0);
    std::vector<Vec3> rounded = centers(samples), chosen = rounded;
    for (Vec3& texel : rounded) {
        const auto round = [](float value) { return std::floor((value + 1) * 127.5F + 0.5F) / 127.5F - 1; };
        texel = {round(texel.x), round(texel.y), round(texel.z)};
    }
    Parallel parallel({.thread_count = 1});
    chooseIntegers(system, {}, chosen, 3, parallel, nullptr);
    EXPECT_LT(errorOf(system, samples, chosen), 0.9 * errorOf(system, samples, rounded));
    for (const Vec3& texel : chosen) {
        for (const float value : {texel.x, texel.y, texel.z}) {
            const float integer = (value + 1) * 127.5F;
            EXPECT_NEAR(integer, std::round(integer), 1e-3F);
        }
        EXPECT_GE(length(texel), 0.69F);
        EXPECT_LE(length(texel), 1.1001F);
    }
}

TEST(SolveTexels, NeighboringIntegersAreHardlyBetter) {
    // In every second row, the last texel is chosen after all of its neighbors.
    constexpr std::uint32_t kWidth = 5, kHeight = 400;
    const std::vector<Sample> samples = waves(kWidth, kHeight);
    const TexelSystem system = systemOf(samples, kWidth, kHeight, 0);
    std::vector<Vec3> texels = centers(samples);
    Parallel parallel({.thread_count = 1});
    chooseIntegers(system, {}, texels, 1, parallel, nullptr);
    double chosen_sum = 0, least_sum = 0;
    for (std::uint32_t y = 1; y < kHeight; y += 2) {
        const std::uint32_t x = kWidth - 1;
        const TexelRow& row = system.row(system.rowOf(x, y));
        const Vec3 rest = system.aroundTexel(x, y, [&](std::uint32_t column, std::uint32_t line) {
            return texels[std::size_t{line} * kWidth + column];
        }) - row.side;
        const Vec3 chosen = texels[std::size_t{y} * kWidth + x];
        // Squared error, up to a constant: the minimum over real-valued x and y for this z.
        const auto energyOf = [&](double dx, double dy) {
            const DVec3 q{chosen.x + dx, chosen.y + dy, chosen.z};
            const SymmetricBlock& m = row.blocks[0];
            return q.x * (m[0] * q.x + 2 * (m[1] * q.y + m[2] * q.z + rest.x)) +
                   q.y * (m[3] * q.y + 2 * (m[4] * q.z + rest.y));
        };
        const SymmetricBlock& m = row.blocks[0];
        const double factor = 1 / (static_cast<double>(m[0]) * m[3] - static_cast<double>(m[1]) * m[1]);
        const double side_x = m[2] * chosen.z + rest.x, side_y = m[4] * chosen.z + rest.y;
        const double of_real = energyOf(factor * (m[1] * side_y - m[3] * side_x) - chosen.x,
                                        factor * (m[1] * side_x - m[0] * side_y) - chosen.y);
        double least = INFINITY;
        for (const int dx : {-1, 0, 1}) {
            for (const int dy : {-1, 0, 1}) least = std::fmin(least, energyOf(dx / 127.5, dy / 127.5) - of_real);
        }
        chosen_sum += energyOf(0, 0) - of_real;
        least_sum += least;
    }
    EXPECT_LT(chosen_sum, 1.05 * least_sum);
}

TEST(SolveTexels, FreerLengthsAreNoWorseWhereDetailIsFine) {
    // With only a few texels per wave, no vectors are correct between the texels, and a short vector leaves the
    // remaining error to its neighbors.
    constexpr std::uint32_t kWidth = 22, kHeight = 17;
    const std::vector<Sample> samples = waves(kWidth, kHeight);
    const TexelSystem system = systemOf(samples, kWidth, kHeight, 0);
    Parallel parallel({.thread_count = 1});
    const auto errorWith = [&](float least_length) {
        std::vector<Vec3> texels = centers(samples);
        chooseIntegers(system, {.least_length = least_length}, texels, 3, parallel, nullptr);
        return errorOf(system, samples, texels);
    };
    EXPECT_LT(errorWith(0.5F), errorWith(0.7F));
}

TEST(SolveTexels, TexelsWithoutSamplesAreUnchanged) {
    const std::vector<TexelRole> roles(64, TexelRole::unknown);
    const TexelSystem system(nullptr, 8, 8, roles);
    std::vector<Vec3> texels(64, Vec3{0.6F, 0, 0.8F});
    Parallel parallel({.thread_count = 1});
    solveTexels(system, texels, parallel, nullptr);
    for (const Vec3& texel : texels) EXPECT_LT(length(texel - Vec3{0.6F, 0, 0.8F}), 1e-6F);
    chooseIntegers(system, {}, texels, 2, parallel, nullptr);
    for (const Vec3& texel : texels)
        EXPECT_LT(length(cross(texel, {0.6F, 0, 0.8F})) / length(texel), 0.0055F)
            << "no further than plain rounding may be";
}

}  // namespace
}  // namespace tspace::test
