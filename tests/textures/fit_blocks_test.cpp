// SPDX-License-Identifier: MIT
#include "textures/blocks/fit_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "images/textures/texel_format.h"
#include "textures/blocks/block_formats.h"
#include "textures/blocks/filtered_error.h"

namespace tspace {
namespace {

class Noise {
  public:
    explicit Noise(std::uint32_t seed) : state_(seed) {}
    float operator()() {
        state_ = state_ * 1664525U + 1013904223U;
        return static_cast<float>(state_ >> 8) / 16777216.0F;
    }

  private:
    std::uint32_t state_;
};

/// Returns the normals of hills with grooves that are a few texels wide.
NormalLevel reliefLevel(std::uint32_t width, std::uint32_t height, double steep = 1) {
    NormalLevel level{width, height, {}, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const double u = 6.283185307179586 * x / width, v = 6.283185307179586 * y / height;
            const double groove = std::sin(9 * u + 3 * v), hill = std::cos(2 * u) * std::sin(v);
            const DVec3 normal{steep * (0.5 * hill + 0.4 * groove * groove * groove), steep * 0.6 * std::sin(7 * v - u),
                               1};
            level.normals.push_back(toFloat((1 / length(normal)) * normal));
        }
    }
    return level;
}

/// Returns facets of 16 x 16 texels, tilted by up to about 40 degrees, with edges one texel wide.
NormalLevel facetLevel(std::uint32_t size) {
    NormalLevel level{size, size, {}, {}};
    Noise noise(3);
    std::array<DVec3, 64> facets{};
    for (DVec3& facet : facets) facet = {noise() - 0.5, noise() - 0.5, 1};
    const auto facetAt = [&](std::uint32_t x, std::uint32_t y) {
        const DVec3& facet = facets[(y + 2) / 48 % (size / 16) * 8 + (x + 2) / 48 % (size / 16)];
        return (1 / length(facet)) * facet;
    };
    for (std::uint32_t i = 0; i < size * size; ++i) {
        DVec3 sum{};
        for (std::uint32_t k = 0; k < 9; ++k) sum = sum + facetAt(i % size * 3 + k % 3, i / size * 3 + k / 3);
        level.normals.push_back(toFloat((1 / length(sum)) * sum));
    }
    return level;
}

Parallel& oneThread() {
    static Parallel parallel(Execution{.thread_count = 1});
    return parallel;
}

std::vector<Vec3> withoutZ(const std::vector<Vec2>& texels) {
    std::vector<Vec3> three;
    for (const Vec2& texel : texels) three.push_back({texel.x, texel.y, 0});
    return three;
}

double meanError(const NormalLevel& level, const BlockOptions& options) {
    const FittedLevel fitted = fitBlocks(level, options, oneThread());
    return measureFiltered(level, withoutZ(fitted.texels), true, oneThread()).mean_deg;
}

/// Returns x and y of all texels, decoded by the decoder that reads files.
std::vector<Vec2> decodedTexels(const FittedLevel& fitted, const NormalLevel& level, const BlockOptions& options) {
    const bool is_bc5 = options.format == TextureFormat::bc5;
    const TexelFormat format = texelFormat(is_bc5 ? (options.is_signed ? TexelKind::bc5s : TexelKind::bc5)
                                                  : (options.is_signed ? TexelKind::eacRgs : TexelKind::eacRg));
    std::vector<Vec2> texels(level.normals.size());
    std::array<Rgba, 16> block{};
    const std::size_t across = (level.width + 3) / 4;
    for (std::size_t i = 0; i < fitted.blocks.size() / 16; ++i) {
        format.decode(format, &fitted.blocks[16 * i], block.data());
        for (std::size_t k = 0; k < 16; ++k) {
            const std::size_t x = i % across * 4 + k % 4, y = i / across * 4 + k / 4;
            if (x < level.width && y < level.height)
                texels[y * level.width + x] = {2 * block[k][0] - 1, 2 * block[k][1] - 1};
        }
    }
    return texels;
}

std::vector<BlockOptions> allWays() {
    std::vector<BlockOptions> ways;
    for (const TextureFormat format : {TextureFormat::bc5, TextureFormat::eacRg11}) {
        for (const bool is_signed : {false, true}) {
            for (const TextureQuality quality : {TextureQuality::quick, TextureQuality::fast, TextureQuality::best})
                ways.push_back({format, is_signed, quality});
        }
    }
    return ways;
}

TEST(FitBlocks, TheTexelsItNamesAreThoseThatItsBlocksDecodeTo) {
    for (const auto& [width, height] : {std::pair(32U, 16U), {33U, 18U}, {7U, 1U}, {2U, 9U}, {1U, 1U}}) {
        const NormalLevel level = reliefLevel(width, height, 2);
        for (const BlockOptions& way : allWays()) {
            const FittedLevel fitted = fitBlocks(level, way, oneThread());
            ASSERT_EQ(fitted.blocks.size(), std::size_t{16} * ((width + 3) / 4) * ((height + 3) / 4));
            const std::vector<Vec2> decoded = decodedTexels(fitted, level, way);
            for (std::size_t i = 0; i < decoded.size(); ++i) {
                ASSERT_NEAR(fitted.texels[i].x, decoded[i].x, 1e-6) << i;
                ASSERT_NEAR(fitted.texels[i].y, decoded[i].y, 1e-6) << i;
            }
        }
    }
}

TEST(FitBlocks, EveryQualityIsBetterThanTheOneBelow) {
    for (const NormalLevel& level : {reliefLevel(96, 64), facetLevel(64)}) {
        for (const TextureFormat format : {TextureFormat::bc5, TextureFormat::eacRg11}) {
            const double quick = meanError(level, {format, false, TextureQuality::quick});
            const double fast = meanError(level, {format, false, TextureQuality::fast});
            const double best = meanError(level, {format, false, TextureQuality::best});
            EXPECT_LT(fast, 0.97 * quick);
            EXPECT_LT(best, fast);
        }
    }
}

/// Returns texels with the least sum of squares per block and channel, over all pairs of end points and both palette
/// types, compared with the unquantized values.
std::vector<Vec3> leastSquares(const NormalLevel& level) {
    std::vector<Vec3> texels(level.normals.size());
    for (std::size_t i = 0; i < level.normals.size() / 16 * 2; ++i) {
        const std::size_t block = i / 2, across = level.width / 4;
        std::array<float, 16> values{}, best{};
        const auto placeOf = [&](std::size_t k) {
            return (block / across * 4 + k / 4) * level.width + block % across * 4 + k % 4;
        };
        for (std::size_t k = 0; k < 16; ++k) {
            const Vec3& normal = level.normals[placeOf(k)];
            values[k] = 127.5F * (i % 2 == 0 ? normal.x : normal.y) + 127.5F;
        }
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const float aside = 4 + 0.15F * (*high - *low);
        float least = 1e30F;
        for (int a = std::max(0, static_cast<int>(*low - aside)); a <= static_cast<int>(*low + aside); ++a) {
            for (int b = std::max(a, static_cast<int>(*high - aside)); b <= std::min(255.0F, *high + aside); ++b) {
                for (const float parts : {5.0F, 7.0F}) {
                    const auto first = static_cast<float>(a), step = static_cast<float>(b - a) / parts;
                    std::array<float, 16> chosen{};
                    float sum = 0;
                    for (std::size_t k = 0; k < 16; ++k) {
                        const float place = step > 0 ? std::clamp((values[k] - first) / step, 0.0F, parts) : 0;
                        chosen[k] = first + step * static_cast<float>(static_cast<int>(place + 0.5F));
                        sum += (chosen[k] - values[k]) * (chosen[k] - values[k]);
                    }
                    if (sum < least) {
                        least = sum;
                        best = chosen;
                    }
                }
            }
        }
        for (std::size_t k = 0; k < 16; ++k) {
            Vec3& texel = texels[placeOf(k)];
            (i % 2 == 0 ? texel.x : texel.y) = best[k] / 127.5F - 1;
        }
    }
    return texels;
}

TEST(FitBlocks, IsMoreAccurateUnderFilteringThanLeastSquares) {
    for (const NormalLevel& level : {reliefLevel(64, 64), reliefLevel(64, 64, 0.2)}) {
        const double squares = measureFiltered(level, leastSquares(level), true, oneThread()).mean_deg;
        EXPECT_LT(meanError(level, {.quality = TextureQuality::fast}), 0.95 * squares);
        EXPECT_LT(meanError(level, {.quality = TextureQuality::best}), 0.94 * squares);
        EXPECT_LT(meanError(level, {.quality = TextureQuality::quick}), 1.1 * squares);
    }
}

TEST(FitBlocks, SpreadsLittleErrorFromHardEdges) {
    const NormalLevel level = facetLevel(64);
    const auto errorOf = [&](const std::vector<Vec3>& texels) {
        return measureFiltered(level, texels, true, oneThread());
    };
    const FilteredError squares = errorOf(leastSquares(level));
    const FilteredError fast = errorOf(withoutZ(fitBlocks(level, {}, oneThread()).texels));
    // There is an edge at every sixteenth texel. Flat areas lose a little accuracy, and edges gain more.
    EXPECT_LT(fast.mean_deg, 1.06 * squares.mean_deg);
    EXPECT_LT(fast.p99_deg, squares.p99_deg);
}

TEST(FitBlocks, RepresentsFlatMapsWithinAQuantizationStep) {
    NormalLevel flat{16, 16, std::vector<Vec3>(256, Vec3{0, 0, 1}), {}};
    // In unsigned formats, 0 would be stored as 127.5 of 255, which is not an integer. Signed formats represent 0
    // exactly.
    EXPECT_LT(meanError(flat, {}), 0.045);
    EXPECT_EQ(meanError(flat, {.is_signed = true}), 0);
    EXPECT_EQ(meanError(flat, {.format = TextureFormat::eacRg11, .is_signed = true}), 0);
}

TEST(FitBlocks, WritesTheSameBytesForAnyNumberOfThreads) {
    const NormalLevel level = reliefLevel(60, 50);
    for (const BlockOptions& way : allWays()) {
        const FittedLevel one = fitBlocks(level, way, oneThread());
        for (const unsigned threads : {2U, 5U}) {
            Parallel parallel(Execution{.thread_count = threads});
            EXPECT_EQ(fitBlocks(level, way, parallel).blocks, one.blocks);
        }
    }
}

TEST(BlockSearch, IsNearlyAsGoodAsTryingEveryPairOfEndpoints) {
    const Bc4Format format(false);
    Noise noise(5);
    double packed = 0, least = 0;
    for (int round = 0; round < 24; ++round) {
        const float middle = 0.25F + 0.5F * noise(), width = std::pow(2.0F, -2.0F - static_cast<float>(round % 7));
        ChannelBlock block;
        for (std::size_t i = 0; i < 16; ++i) {
            const float slope = static_cast<float>(i % 4) / 3 - 0.5F;
            block.is_used[i] = true;
            block.targets[i] = 255 * (middle + width * (0.7F * slope + 0.6F * (noise() - 0.5F)));
        }
        const FittedChannel fitted = BlockSearch(format, block).bestIndependent({.start_fits = 2, .near_range = 12});
        double mine = 0, best = 1e9;
        for (const float error : fitted.errors) mine += static_cast<double>(error) * static_cast<double>(error);
        for (int a = 0; a < 256; ++a) {
            for (int b = 0; b < 256; ++b) {
                const double parts = a > b ? 7 : 5;
                double sum = 0;
                for (const float target : block.targets) {
                    double off = 255;
                    for (int k = 0; k <= parts; ++k)
                        off = std::min(off, std::fabs(a + (b - a) * k / parts - static_cast<double>(target)));
                    sum += off * off;
                }
                best = std::min(best, sum);
            }
        }
        EXPECT_LE(best, mine * 1.0001 + 1e-9);
        packed += std::sqrt(mine);
        least += std::sqrt(best);
    }
    EXPECT_LT(packed, 1.02 * least) << packed / least;
}

}  // namespace
}  // namespace tspace
