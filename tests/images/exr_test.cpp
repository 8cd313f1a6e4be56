// SPDX-License-Identifier: MIT
// Reading EXR files: round trips, interpretation of their values, and rejection of corrupt files.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/vec_math.h"
#include "images/codecs.h"
#include "images/float_image.h"
#include "images/image.h"
#include "images/images.h"

namespace tspace::test {
namespace {

class Exr : public ::testing::Test {
  protected:
    void SetUp() override {
        if (const char* why = whyNotRead(ImageFormat::exr)) GTEST_SKIP() << why;
    }
};

FloatImage waves(std::uint32_t width, std::uint32_t height) {
    FloatImage image{width, height, 32, {}, {}};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const auto at = static_cast<float>(i);
        image.texels.push_back({0.5F + 0.5F * std::sin(at), 0.5F + 0.4F * std::cos(0.37F * at), 1 / (1 + at)});
    }
    return image;
}

std::optional<FloatImage> decodedExr(const std::vector<std::uint8_t>& bytes, std::string* reason = nullptr) {
    std::string why;
    auto image = decodeFloatImage(bytes, 1 << 22, why);
    if (reason != nullptr) *reason = why;
    return image;
}

TEST_F(Exr, FloatsRoundTripExactly) {
    for (const auto& [width, height] : {std::pair{1U, 1U}, {17U, 33U}, {64U, 16U}, {3U, 200U}}) {
        FloatImage image = waves(width, height);
        const auto file = encodeExr(image, 32);
        ASSERT_TRUE(file);
        EXPECT_EQ(imageFormat(*file), ImageFormat::exr);
        EXPECT_EQ(claimedSize(*file).pixels(), std::uint64_t{width} * height);
        const auto decoded = decodedExr(*file);
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->bits, 32U);
        EXPECT_TRUE(decoded->texels == image.texels);
        EXPECT_TRUE(decoded->alpha.empty());
        for (const Vec3& texel : image.texels) image.alpha.push_back(texel.y);
        EXPECT_TRUE(decodedExr(*encodeExr(image, 32))->alpha == image.alpha);
    }
}

TEST_F(Exr, HalvesRoundTripRounded) {
    const FloatImage image = waves(40, 40);
    const auto decoded = decodedExr(*encodeExr(image, 16));
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->bits, 16U);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        EXPECT_NEAR(decoded->texels[i].x, image.texels[i].x, 0.0005);
        EXPECT_NEAR(decoded->texels[i].y, image.texels[i].y, 0.0005);
    }
    EXPECT_EQ(encodeExr(*decoded, 16), encodeExr(image, 16));
}

TEST_F(Exr, ValuesThatAreNotFiniteAreFilledFromTheirNeighbors) {
    const float infinity = std::numeric_limits<float>::infinity();
    const FloatImage ramp = [] {
        FloatImage image{8, 8, 32, {}, {}};
        for (int i = 0; i < 64; ++i) {
            const auto x = static_cast<float>(i % 8), y = static_cast<float>(i / 8);
            image.texels.push_back({0.1F + 0.1F * x, 0.1F + 0.1F * y, 0.9F});
        }
        return image;
    }();
    FloatImage image = ramp;
    for (const std::size_t i : {18, 19, 26, 27, 34}) image.texels[i].y = i % 2 == 0 ? std::nanf("") : infinity;
    for (const unsigned bits : {16U, 32U}) {
        const auto decoded = decodedExr(*encodeExr(image, bits));
        ASSERT_TRUE(decoded);
        EXPECT_EQ(decoded->not_finite, 5U);
        for (std::size_t i = 0; i < ramp.texels.size(); ++i) {
            EXPECT_NEAR(decoded->texels[i].x, ramp.texels[i].x, 0.1) << i;
            EXPECT_NEAR(decoded->texels[i].y, ramp.texels[i].y, 0.1) << i;
            EXPECT_NEAR(decoded->texels[i].z, ramp.texels[i].z, 1e-3) << i;
        }
    }
    // Heights of any size stay plausible, and an image without finite texels gets one value.
    FloatImage heights{5, 5, 32, std::vector<Vec3>(25, Vec3{300, 300, 300}), {}};
    for (const std::size_t i : {6, 7, 8, 11, 12, 13, 16, 17, 18}) heights.texels[i] = {infinity, infinity, infinity};
    std::string why;
    const auto filled = decodeFloatImage(*encodeExr(heights, 32), 1 << 10, why, ImageUse::numbers);
    ASSERT_TRUE(filled) << why;
    EXPECT_EQ(filled->not_finite, 9U);
    for (const Vec3& texel : filled->texels) EXPECT_EQ(texel, (Vec3{300, 300, 300}));
    for (Vec3& texel : heights.texels) texel.x = std::nanf("");
    EXPECT_EQ(decodedExr(*encodeExr(heights, 32))->texels[12], (Vec3{0.5F, 0.5F, 1}));
}

/// Returns the file with one changed number of its data window. `corner`: 0 to 3 for the first x, the first y, the last
/// x and the last y.
std::vector<std::uint8_t> withCorner(std::vector<std::uint8_t> file, std::size_t corner, std::int32_t value) {
    const std::string name("dataWindow\0box2i\0", 17);
    const auto found = std::search(file.begin(), file.end(), name.begin(), name.end());
    std::memcpy(&*found + name.size() + 4 + 4 * corner, &value, sizeof value);
    return file;
}

TEST_F(Exr, RejectsCorruptAndTooLargeFiles) {
    const std::vector<std::uint8_t> file = *encodeExr(waves(20, 20), 32);
    for (std::size_t size = 0; size < file.size(); size += 1 + size / 16)
        EXPECT_FALSE(decodedExr({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)})) << size;
    std::string why;
    EXPECT_FALSE(decodedExr(withCorner(file, 2, 65535), &why));
    EXPECT_FALSE(decodedExr(withCorner(withCorner(file, 2, 65535), 3, 65535), &why));
    EXPECT_EQ(why, "the image has more pixels than tspace supports");
    EXPECT_GT(imageWorkBytes(withCorner(withCorner(file, 2, 65535), 3, 65535)), std::uint64_t{16} << 32);
    EXPECT_FALSE(decodedExr(withCorner(file, 2, -1), &why));
    EXPECT_FALSE(decodedExr(withCorner(file, 2, std::numeric_limits<std::int32_t>::max())));
    EXPECT_FALSE(decodedExr(withCorner(file, 0, std::numeric_limits<std::int32_t>::min())));
    EXPECT_FALSE(decodedExr(withCorner(file, 3, 18), &why));
}

TEST_F(Exr, RoundsToEightBitsOnRequest) {
    std::string why;
    const auto image = decodeImage(*encodeExr(waves(9, 9), 32), 1 << 20, why);
    ASSERT_TRUE(image) << why;
    EXPECT_EQ(image->rgb[0], 128);
    EXPECT_EQ(image->rgb.size(), 3U * 81);
}

/// Channels of a normal map: vectors as stored, or mapped to 0 to 1.
struct Vectors {
    std::vector<float> x = {}, y = {}, z = {};

    explicit Vectors(const RgbImage& map, bool is_moved = false) {
        for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
            DVec3 v{map.rgb[i] / 127.5 - 1, map.rgb[i + 1] / 127.5 - 1, map.rgb[i + 2] / 127.5 - 1};
            normalize(v);
            const auto stored = [&](double part) { return static_cast<float>(is_moved ? 0.5 * part + 0.5 : part); };
            x.push_back(stored(v.x));
            y.push_back(stored(v.y));
            z.push_back(stored(v.z));
        }
    }
};

constexpr std::uint32_t kSide = 32;

std::string mapExr(const Vectors& v, const std::string& a = "R", const std::string& b = "G",
                   const std::string& c = "B") {
    return exrFile(kSide, kSide, {{a, v.x}, {b, v.y}, {c, v.z}});
}

std::optional<FloatImage> read(const std::string& file, std::string* reason = nullptr,
                               ImageUse use = ImageUse::vectors) {
    std::string why;
    auto image = decodeFloatImage(bytesOf(file), 1 << 22, why, use);
    if (reason != nullptr) *reason = why;
    return image;
}

void expectSame(const std::optional<FloatImage>& image, const Vectors& wanted, const std::string& what) {
    ASSERT_TRUE(image) << what;
    for (std::size_t i = 0; i < wanted.x.size(); ++i) {
        ASSERT_NEAR(image->texels[i].x, wanted.x[i], 1e-6) << what;
        ASSERT_NEAR(image->texels[i].y, wanted.y[i], 1e-6) << what;
        ASSERT_NEAR(image->texels[i].z, wanted.z[i], 1e-6) << what;
    }
}

TEST_F(Exr, VectorsFromMinusOneToOneAreMoved) {
    const RgbImage map = normalMapOf(kSide, bumps);
    const Vectors as_they_are(map), moved(map, true);
    const auto image = read(mapExr(as_they_are));
    expectSame(image, moved, "tangent space");
    EXPECT_NE(image->range_text.find("read as vectors from -1 to 1"), std::string::npos) << image->range_text;
    expectSame(read(mapExr(as_they_are), nullptr, ImageUse::numbers), as_they_are, "numbers");
    // An object-space map contains all directions.
    RgbImage around{kSide, kSide, {}};
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const double a = 0.37 * i, h = 1 - 2 * (i + 0.5) / (kSide * kSide), r = std::sqrt(1 - h * h);
        for (const double part : {r * std::cos(a), h, r * std::sin(a)})
            around.rgb.push_back(static_cast<std::uint8_t>(127.5 * part + 128));
    }
    expectSame(read(mapExr(Vectors(around), "X", "Y", "Z")), Vectors(around, true), "object space");
    // In a flat map, no value is below 0.
    const RgbImage flat = normalMapOf(kSide, [](double, double) { return 0.0; });
    Vectors up(flat);
    for (std::size_t i = 0; i < up.x.size(); ++i) up.x[i] = up.y[i] = 0, up.z[i] = 1;
    const auto flat_read = read(mapExr(up));
    ASSERT_TRUE(flat_read);
    EXPECT_EQ(flat_read->texels[5], (Vec3{0.5F, 0.5F, 1}));
    std::string why;
    const auto rounded = decodeImage(bytesOf(mapExr(as_they_are)), 1 << 20, why);
    ASSERT_TRUE(rounded) << why;
    for (std::size_t i = 0; i < map.rgb.size(); ++i) ASSERT_NEAR(rounded->rgb[i], map.rgb[i], 2);
}

TEST_F(Exr, NumbersFromZeroToOneStay) {
    Vectors stored(normalMapOf(kSide, bumps), true);
    expectSame(read(mapExr(stored)), stored, "0 to 1");
    // A sharpening filter makes some values slightly negative.
    stored.x[7] = -0.06F;
    stored.y[90] = -0.04F;
    const auto image = read(mapExr(stored));
    expectSame(image, stored, "overshoot");
    EXPECT_EQ(image->range_text, "");
    // Values that are colors, not vectors.
    Vectors colors(stored);
    for (std::size_t i = 0; i < colors.x.size(); ++i) colors.x[i] = 0.1F, colors.y[i] = 0.3F, colors.z[i] = 0.9F;
    expectSame(read(mapExr(colors)), colors, "colors");
}

TEST_F(Exr, ReportsAmbiguousRanges) {
    Vectors odd(normalMapOf(kSide, bumps));
    for (std::size_t i = 0; i < odd.x.size(); ++i) odd.z[i] *= 2;
    const auto image = read(mapExr(odd));
    ASSERT_TRUE(image);
    EXPECT_NE(image->range_text.find("check that the image is a normal map"), std::string::npos) << image->range_text;
}

TEST_F(Exr, ChannelsHaveManyNames) {
    const RgbImage map = normalMapOf(kSide, bumps);
    const Vectors v(map), moved(map, true);
    expectSame(read(mapExr(v, "X", "Y", "Z")), moved, "X Y Z");
    expectSame(read(mapExr(v, "x", "y", "z")), moved, "x y z");
    expectSame(read(mapExr(v, "normal.R", "normal.G", "normal.B")), moved, "layer.R");
    expectSame(read(mapExr(v, "ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z")), moved, "two dots");
    const std::vector<float> gray(v.x.size(), 0.25F);
    const std::vector<ExrChannel> layers{{"Combined.R", gray}, {"Combined.G", gray}, {"Combined.B", gray},
                                         {"Normal.X", v.x},    {"Normal.Y", v.y},    {"Normal.Z", v.z},
                                         {"Depth.Z", gray}};
    expectSame(read(exrFile(kSide, kSide, layers)), moved, "layers");
    std::string why;
    std::vector<ExrChannel> unclear = layers;
    for (ExrChannel& channel : unclear) channel.name = channel.name.replace(0, 6, channel.name.substr(0, 5));
    EXPECT_FALSE(read(exrFile(kSide, kSide, unclear), &why));
    EXPECT_NE(why.find("several layers of the EXR"), std::string::npos) << why;
    // A map of x and y only, like textures with two channels.
    const auto two = read(exrFile(kSide, kSide, {{"R", v.x}, {"G", v.y}}));
    ASSERT_TRUE(two);
    EXPECT_EQ(two->texture.layout.z.channel, MapChannel::none);
    EXPECT_NEAR(two->texels[9].x, moved.x[9], 1e-6);
}

TEST_F(Exr, ALayerOfNormalsPrecedesTheChannelsWithoutALayer) {
    const RgbImage map = normalMapOf(kSide, bumps);
    const Vectors v(map), moved(map, true);
    Vectors beauty(map, true);
    for (std::size_t i = 0; i < beauty.x.size(); ++i) beauty.x[i] = beauty.y[i] = beauty.z[i] = 0.25F;
    const auto file = [&](const std::vector<std::string>& layers) {
        std::vector<ExrChannel> channels{{"R", beauty.x}, {"G", beauty.y}, {"B", beauty.z}};
        for (const std::string& layer : layers) {
            channels.push_back({layer + ".X", v.x});
            channels.push_back({layer + ".Y", v.y});
            channels.push_back({layer + ".Z", v.z});
        }
        return exrFile(kSide, kSide, channels);
    };
    for (const std::string name : {"normal", "Normals", "N", "nrm", "ViewLayer.Normal"}) {
        const auto image = read(file({name}));
        expectSame(image, moved, name);
        EXPECT_NE(image->layer_text.find(name + ".X, " + name + ".Y and " + name + ".Z were read"), std::string::npos)
            << image->layer_text;
        EXPECT_NE(image->layer_text.find("(R, G and B)"), std::string::npos) << image->layer_text;
        const auto numbers = read(file({name}), nullptr, ImageUse::numbers);
        expectSame(numbers, beauty, name);
        EXPECT_NE(numbers->layer_text.find("R, G and B were read"), std::string::npos) << numbers->layer_text;
    }
    for (const std::vector<std::string>& layers : {std::vector<std::string>{"position"}, {"normal", "N"}}) {
        const auto image = read(file(layers));
        expectSame(image, beauty, layers[0]);
        EXPECT_NE(image->layer_text.find("R, G and B were read"), std::string::npos) << image->layer_text;
    }
    EXPECT_EQ(read(file({}))->layer_text, "");
    EXPECT_EQ(read(mapExr(v, "normal.R", "normal.G", "normal.B"))->layer_text, "");
}

TEST_F(Exr, OneChannelIsHeights) {
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) heights.push_back(std::sin(0.05F * static_cast<float>(i)));
    for (const std::string name : {"Y", "R", "height.Z", "displacement"}) {
        for (const ImageUse use : {ImageUse::vectors, ImageUse::numbers}) {
            const auto image = read(exrFile(kSide, kSide, {{name, heights}}), nullptr, use);
            ASSERT_TRUE(image) << name;
            EXPECT_EQ(image->texels[40], (Vec3{heights[40], heights[40], heights[40]})) << name;
        }
    }
    std::vector<float> whole;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) whole.push_back(static_cast<float>(60 * i));
    const auto image = read(exrFile(kSide, kSide, {{"Y", whole, true}}));
    ASSERT_TRUE(image);
    EXPECT_EQ(image->bits, 16U);
    EXPECT_FLOAT_EQ(image->texels[3].x, 180.0F / 65535);
    std::string why;
    EXPECT_FALSE(read(exrFile(kSide, kSide, {{"Y", heights}, {"RY", heights}, {"BY", heights}}), &why));
    EXPECT_NE(why.find("BY, RY, Y"), std::string::npos) << why;
}

}  // namespace
}  // namespace tspace::test
