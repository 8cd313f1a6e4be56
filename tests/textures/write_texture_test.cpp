// SPDX-License-Identifier: MIT
// Writing texture files from mip levels.
#include <gtest/gtest.h>

#include <algorithm>

#include "images/float_image.h"
#include "images/textures/texture_file.h"
#include "textures/write_texture.h"

namespace tspace::test {
namespace {

Texture textureOf(std::uint32_t width, std::uint32_t height, TexelKind kind) {
    Texture texture{.width = width, .height = height, .kind = kind, .levels = {}};
    std::uint8_t next = 0;
    for (std::uint32_t w = width, h = height;; w = std::max(w / 2, 1U), h = std::max(h / 2, 1U)) {
        std::vector<std::uint8_t> level(static_cast<std::size_t>(texelFormat(kind).bytesOf(w, h)));
        for (std::uint8_t& byte : level) byte = next = static_cast<std::uint8_t>(next * 5 + 3);
        texture.levels.push_back(level);
        if (w == 1 && h == 1) return texture;
    }
}

TEST(WriteTexture, WrittenTexturesRoundTrip) {
    for (const TexelKind kind : {TexelKind::bc5, TexelKind::bc5s, TexelKind::eacRg, TexelKind::eacRgs, TexelKind::rg8,
                                 TexelKind::rg8s, TexelKind::rgba8}) {
        const Texture texture = textureOf(37, 18, kind);
        const auto ktx2 = writeKtx2(texture);
        ASSERT_TRUE(ktx2);
        std::string why;
        const auto from_ktx2 = decodeFloatImage(*ktx2, 1 << 20, why);
        ASSERT_TRUE(from_ktx2) << why;
        EXPECT_EQ(from_ktx2->width, 37u);
        EXPECT_EQ(from_ktx2->texture.name, std::string(texelFormat(kind).name) + " in a KTX2");
        EXPECT_EQ(from_ktx2->texture.layout.z.channel == MapChannel::none, kind != TexelKind::rgba8);
        EXPECT_FALSE(from_ktx2->texture.is_srgb);
        const auto head = readTextureHeader(*ktx2);
        ASSERT_TRUE(head);
        ASSERT_EQ(head->levels.size(), texture.levels.size());
        for (std::size_t i = 0; i < texture.levels.size(); ++i)
            EXPECT_TRUE(std::equal(texture.levels[i].begin(), texture.levels[i].end(),
                                   ktx2->begin() + static_cast<std::ptrdiff_t>(head->levels[i].at)));
        if (whyNotDds(kind) != nullptr) continue;
        const auto from_dds = decodeFloatImage(writeDds(texture), 1 << 20, why);
        ASSERT_TRUE(from_dds) << why;
        EXPECT_EQ(from_dds->texels, from_ktx2->texels);
        for (const char* four_cc : {"ATI2", "BC5U"}) {
            const std::vector<std::uint8_t> file = writeDds(texture, four_cc);
            EXPECT_EQ(file.size() + 20, writeDds(texture).size());
            if (kind == TexelKind::bc5 || kind == TexelKind::bc5s) {
                EXPECT_EQ(std::string(file.begin() + 84, file.begin() + 88), kind == TexelKind::bc5 ? four_cc : "BC5S");
            }
            const auto from_old = decodeFloatImage(file, 1 << 20, why);
            ASSERT_TRUE(from_old) << why;
            EXPECT_EQ(from_old->texels, from_ktx2->texels);
            EXPECT_EQ(from_old->texture.layout, from_ktx2->texture.layout);
            EXPECT_EQ(readTextureHeader(file)->levels.size(), texture.levels.size());
        }
    }
}

TEST(WriteTexture, SupercompressedLevelsAreUnchanged) {
    if (whyNotZstd() != nullptr) GTEST_SKIP() << whyNotZstd();
    const Texture texture = textureOf(64, 64, TexelKind::bc5);
    const auto plain = writeKtx2(texture), packed = writeKtx2(texture, 19);
    ASSERT_TRUE(plain && packed);
    EXPECT_LT(packed->size(), plain->size());
    std::string why;
    const auto from_plain = decodeFloatImage(*plain, 1 << 20, why),
               from_packed = decodeFloatImage(*packed, 1 << 20, why);
    ASSERT_TRUE(from_plain && from_packed) << why;
    EXPECT_EQ(from_plain->texels, from_packed->texels);
}

}  // namespace
}  // namespace tspace::test
