// SPDX-License-Identifier: MIT
// Packing BC5, and the files around it.
#include "images/pack_bc4.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "images/float_image.h"
#include "images/texel_format.h"
#include "images/write_texture.h"

namespace tspace::test {
namespace {

using Block = std::array<float, 16>;

std::array<Rgba, 16> decoded(const std::array<std::uint8_t, 8>& block, bool is_signed) {
    std::array<Rgba, 16> texels{};
    const TexelFormat format = texelFormat(is_signed ? TexelKind::bc4s : TexelKind::bc4);
    format.decode(format, block.data(), texels.data());
    return texels;
}

double errorOf(const std::array<std::uint8_t, 8>& block, const Block& values, bool is_signed) {
    double sum = 0;
    const std::array<Rgba, 16> texels = decoded(block, is_signed);
    for (std::size_t i = 0; i < 16; ++i) sum += std::pow(double{texels[i][0]} - double{values[i]}, 2);
    return sum;
}

/// The least error over every pair of ends, with the nearest code of each value.
double leastError(const Block& values, bool is_signed) {
    double least = 1e9;
    for (int a = 0; a < 256; ++a) {
        for (int b = 0; b < 256; ++b) {
            std::array<std::uint8_t, 8> block{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
            for (std::uint64_t k = 0; k < 6; ++k) block[2 + k] = static_cast<std::uint8_t>(0xfac688 >> 8 * (k % 3));
            const std::array<Rgba, 16> palette = decoded(block, is_signed);  // codes 0 to 7, twice
            double sum = 0;
            for (const float value : values) {
                double off = 1;
                for (std::size_t k = 0; k < 8; ++k)
                    off = std::min(off, std::pow(double{palette[k][0]} - double{value}, 2));
                sum += off;
            }
            least = std::min(least, sum);
        }
    }
    return least;
}

float noiseAt(std::uint32_t& state) {
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(state >> 8) / 16777216.0F;
}

TEST(PackBc4, IsNearlyAsGoodAsEveryPairOfEnds) {
    std::uint32_t state = 5;
    double packed = 0, least = 0;
    for (int round = 0; round < 24; ++round) {
        const float middle = 0.1F + 0.8F * noiseAt(state),
                    width = std::pow(2.0F, -1.0F - static_cast<float>(round % 8));
        Block values{};
        for (std::size_t i = 0; i < 16; ++i) {
            const float slope = static_cast<float>(i % 4) / 3 - 0.5F;
            values[i] = std::clamp(middle + width * (0.7F * slope + 0.6F * (noiseAt(state) - 0.5F)), 0.0F, 1.0F);
        }
        const bool is_signed = round % 2 != 0;
        const double mine = errorOf(packBc4(values, is_signed), values, is_signed),
                     best = leastError(values, is_signed);
        EXPECT_LE(best, mine * 1.0001 + 1e-12);
        packed += std::sqrt(mine);
        least += std::sqrt(best);
    }
    EXPECT_LT(packed, 1.02 * least) << packed / least;
}

TEST(PackBc4, KeepsWhatABlockCanHold) {
    for (const bool is_signed : {false, true}) {
        for (const float value : {0.0F, 0.25F, 0.5F, 1.0F}) {
            Block values{};
            values.fill(value);
            for (const Rgba& texel : decoded(packBc4(values, is_signed), is_signed))
                EXPECT_NEAR(texel[0], value, 0.5 / 254 / 5 + 1e-6);
        }
        Block ends{};
        for (std::size_t i = 0; i < 16; ++i) ends[i] = i % 3 == 0 ? 1.0F : 0.0F;
        EXPECT_EQ(errorOf(packBc4(ends, is_signed), ends, is_signed), 0);
    }
}

Bc5Texture textureOf(std::uint32_t width, std::uint32_t height, bool is_signed) {
    Bc5Texture texture{.width = width, .height = height, .is_signed = is_signed};
    std::uint8_t next = 0;
    for (std::uint32_t w = width, h = height;; w = std::max(w / 2, 1U), h = std::max(h / 2, 1U)) {
        std::vector<std::uint8_t> level(std::size_t{(w + 3) / 4} * ((h + 3) / 4) * 16);
        for (std::uint8_t& byte : level) byte = next = static_cast<std::uint8_t>(next * 5 + 3);
        texture.levels.push_back(level);
        if (w == 1 && h == 1) return texture;
    }
}

TEST(WriteTexture, WhatIsWrittenIsReadAgain) {
    for (const bool is_signed : {false, true}) {
        const Bc5Texture texture = textureOf(37, 18, is_signed);
        const std::vector<std::uint8_t> dds = writeDds(texture), ktx2 = writeKtx2(texture);
        std::string why;
        const auto from_dds = decodeFloatImage(dds, 1 << 20, why), from_ktx2 = decodeFloatImage(ktx2, 1 << 20, why);
        ASSERT_TRUE(from_dds && from_ktx2) << why;
        EXPECT_EQ(from_dds->width, 37u);
        EXPECT_EQ(from_dds->texels, from_ktx2->texels);
        EXPECT_EQ(from_ktx2->texture.name, is_signed ? "BC5 signed in a KTX2" : "BC5 in a KTX2");
        EXPECT_EQ(from_ktx2->texture.layout.z.channel, MapChannel::none);
        EXPECT_FALSE(from_ktx2->texture.is_srgb);
    }
}

}  // namespace
}  // namespace tspace::test
