// SPDX-License-Identifier: MIT
// Properties of a map that its slopes reveal: encoding and channel order, but never whether bumps are dents.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "commands/check/map_slopes.h"
#include "images/images.h"

namespace tspace::test {
namespace {

using Height = std::function<double(double, double)>;

MapAnalysis analyzeImage(const RgbImage& image, std::span<const std::uint8_t> alpha = {}) {
    TexelMask all(image.width, image.height);
    all.fillAll();
    return analyzeMap({image, alpha, all});
}

double roundBumps(double x, double y) {
    double h = 0;
    for (int i = 0; i < 36; ++i) {
        const double u = x - (i % 6 + 0.5 + 0.3 * std::sin(7.0 * i)) / 6;
        const double v = y - (i / 6 + 0.5 + 0.3 * std::cos(5.0 * i)) / 6;
        h += 0.02 * std::exp(-(u * u + v * v) * 400);
    }
    return h;
}

double waves(double x, double y) { return 0.01 * std::sin(40 * x) * std::sin(30 * y); }
double rings(double x, double y) { return 0.004 * std::cos(120 * std::hypot(x - 0.4, y - 0.55)); }

const std::vector<Height> kReliefs = {bumps, roundBumps, waves, rings};

/// Returns the map of a height field after calling change(r, g, b) with each texel's components, from -1 to 1.
template <class Change>
RgbImage stored(const Height& height, const Change& change) {
    RgbImage image = normalMapOf(128, height);
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        double part[3];
        for (std::size_t k = 0; k < 3; ++k) part[k] = image.rgb[i + k] / 127.5 - 1;
        change(part[0], part[1], part[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            image.rgb[i + k] = static_cast<std::uint8_t>(std::lround(127.5 * (std::clamp(part[k], -1.0, 1.0) + 1)));
        }
    }
    return image;
}

void encodeHemiOctahedral(double& x, double& y, double& z) {
    const double sum = std::fabs(x) + std::fabs(y) + std::max(z, 0.0);
    const double a = x / sum, b = y / sum;
    x = a + b;
    y = a - b;
}

TEST(MapSlopes, DistinguishHemiOctahedralMapsFromXAndY) {
    for (const Height& relief : kReliefs) {
        for (const double scale : {1.0, 4.0}) {
            const Height height = [&](double x, double y) { return scale * relief(x, y); };
            for (const double blue : {-1.0, 0.0, 1.0}) {
                const bool is_swapped = blue == 0;
                const RgbImage map = stored(height, [&](double& x, double& y, double& z) {
                    encodeHemiOctahedral(x, y, z);
                    if (is_swapped) std::swap(x, y);
                    z = blue;
                });
                EXPECT_EQ(analyzeImage(map).content, MapContent::hemiOctahedral)
                    << &relief - kReliefs.data() << ' ' << scale << ' ' << blue;
            }
            const MapAnalysis analysis = analyzeImage(stored(height, [&](double&, double&, double& z) { z = -1; }));
            EXPECT_EQ(analysis.content, MapContent::twoChannels) << &relief - kReliefs.data() << ' ' << scale;
            EXPECT_FALSE(analysis.is_doubtful) << &relief - kReliefs.data() << ' ' << scale;
        }
    }
}

void encodeOctahedral(double& x, double& y, double z) {
    const double sum = std::fabs(x) + std::fabs(y) + std::max(z, 0.0);
    x /= sum;
    y /= sum;
}

/// The x and y of octahedral maps also fit a plain encoding well, so both interpretations remain possible.
TEST(MapSlopes, DoubtTwoChannelsThatFitBetterAsOctahedral) {
    for (const Height& relief : kReliefs) {
        for (const double scale : {1.0, 2.0, 4.0}) {
            const Height height = [&](double x, double y) { return scale * relief(x, y); };
            for (const double blue : {-1.0, 0.0, 1.0}) {
                const auto where = [&] {
                    return std::to_string(&relief - kReliefs.data()) + ' ' + std::to_string(scale) + ' ' +
                           std::to_string(blue);
                };
                const MapAnalysis analysis = analyzeImage(stored(height, [&](double& x, double& y, double& z) {
                    encodeOctahedral(x, y, z);
                    z = blue;
                }));
                // Blue 255 is near the z of gentle relief, and gentle waves (kReliefs[2]) fit both encodings equally.
                const bool is_clear = scale > 1 || (blue != 1 && &relief != &kReliefs[2]);
                if (blue != 1) {
                    EXPECT_EQ(analysis.content, MapContent::twoChannels) << where();
                }
                if (is_clear && analysis.content == MapContent::twoChannels) {
                    EXPECT_TRUE(analysis.may_be_octahedral) << where();
                }
                const MapAnalysis plain = analyzeImage(stored(height, [&](double&, double&, double& z) { z = blue; }));
                EXPECT_FALSE(plain.is_doubtful) << where();
            }
        }
    }
}

TEST(MapSlopes, DetectHemiOctahedralMapsInAlphaAndGreen) {
    RgbImage map = stored(bumps, [](double& x, double& y, double& z) { encodeHemiOctahedral(x, y, z); });
    std::vector<std::uint8_t> alpha;
    for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
        alpha.push_back(map.rgb[i]);
        map.rgb[i] = map.rgb[i + 2] = 255;
    }
    const MapAnalysis analysis = analyzeImage(map, alpha);
    EXPECT_EQ(analysis.content, MapContent::hemiOctahedral);
    EXPECT_EQ(analysis.layout.x.channel, MapChannel::alpha);
}

/// Stores each texel as four letters say: x, y, z, or h (half), 0 and 1 as filling; the last letter is alpha.
RgbImage storedAs(const RgbImage& map, const std::string& letters, std::vector<std::uint8_t>& alpha) {
    RgbImage image = map;
    alpha.clear();
    for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
        const auto part = [&](char letter) -> std::uint8_t {
            if (letter >= 'x') return map.rgb[i + static_cast<std::size_t>(letter - 'x')];
            return letter == '1' ? 255 : letter == 'h' ? 128 : 0;
        };
        for (std::size_t k = 0; k < 3; ++k) image.rgb[i + k] = part(letters[k]);
        alpha.push_back(part(letters[3]));
    }
    return image;
}

MapAnalysis analyzeStored(const RgbImage& map, const std::string& letters) {
    std::vector<std::uint8_t> alpha;
    const RgbImage image = storedAs(map, letters, alpha);
    return analyzeImage(image, alpha);
}

std::string lettersOf(const MapLayout& layout) {
    return {"rgba-"[static_cast<std::size_t>(layout.x.channel)], "rgba-"[static_cast<std::size_t>(layout.y.channel)]};
}

TEST(MapSlopes, DetectXOrYInAlphaBesideAnyFilling) {
    const std::string fillings = "yz10h";
    for (const double scale : {0.5, 2.0}) {
        const RgbImage map = normalMapOf(96, [&](double x, double y) { return scale * roundBumps(x, y); });
        for (std::size_t color = 0; color < 3; ++color) {
            for (std::size_t i = 0; i < fillings.size() * fillings.size(); ++i) {
                std::string letters = "yyyx";
                letters[(color + 1) % 3] = fillings[i % fillings.size()];
                letters[(color + 2) % 3] = fillings[i / fillings.size()];
                for (const bool is_x_in_alpha : {true, false}) {
                    if (!is_x_in_alpha) {
                        for (char& letter : letters) letter = letter == 'x' ? 'y' : letter == 'y' ? 'x' : letter;
                    }
                    const MapAnalysis analysis = analyzeStored(map, letters);
                    EXPECT_EQ(analysis.content, MapContent::xInAlpha) << letters << ' ' << scale;
                    EXPECT_EQ(lettersOf(analysis.layout)[is_x_in_alpha ? 0 : 1], 'a') << letters << ' ' << scale;
                    const char other = lettersOf(analysis.layout)[is_x_in_alpha ? 1 : 0];
                    const std::size_t read = std::string("rgba").find(other);
                    EXPECT_EQ(letters[read], is_x_in_alpha ? 'y' : 'x') << letters << ' ' << scale;
                    EXPECT_FALSE(analysis.is_order_open || analysis.is_doubtful) << letters << ' ' << scale;
                }
            }
        }
    }
}

/// Grooves between tiles give no slopes to compare, because x is 0 where y is not.
TEST(MapSlopes, AreNotNeededForCommonFillings) {
    const RgbImage map = normalMapOf(
        128, [](double x, double y) { return 0.02 * (std::pow(std::sin(12 * x), 8) + std::pow(std::sin(12 * y), 8)); });
    for (const std::string letters : {"1yyx", "0yyx", "1y1x", "0y0x", "zyzx", "zyyx", "1yzx", "hyzx"}) {
        const MapAnalysis analysis = analyzeStored(map, letters);
        EXPECT_EQ(analysis.content, MapContent::xInAlpha) << letters;
        EXPECT_EQ(lettersOf(analysis.layout), "ag") << letters;
    }
}

TEST(MapSlopes, NeverFindXOrYInAMaskOrHeightsInAlpha) {
    const RgbImage relief = normalMapOf(128, roundBumps), other = normalMapOf(128, rings);
    const auto ridges = [](double along_x, double along_y) {
        return normalMapOf(128, [=](double x, double y) { return 0.001 * std::sin(60 * (along_x * x + along_y * y)); });
    };
    std::vector<std::uint8_t> alpha(other.rgb.size() / 3);
    for (const bool is_relief : {false, true}) {
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            const double u = (static_cast<double>(i % 128) + 0.5) / 128, v = (static_cast<double>(i / 128) + 0.5) / 128;
            alpha[i] =
                is_relief ? static_cast<std::uint8_t>(std::lround(128 + 2000 * roundBumps(u, v))) : other.rgb[3 * i];
        }
        for (const RgbImage& map : {relief, ridges(1, 0), ridges(0, 1), ridges(1, 1), ridges(1, -1)})
            EXPECT_EQ(analyzeImage(map, alpha).content, MapContent::normals) << is_relief;
    }
}

/// A product of waves curves equally along x and y, so either channel may be x.
TEST(MapSlopes, LeaveTheOrderOfGrayAndAlphaOpenIfBothFit) {
    const RgbImage map =
        normalMapOf(128, [](double x, double y) { return 0.02 * std::sin(30 * x) * std::sin(30 * y); });
    for (const std::string letters : {"yyyx", "xxxy"})
        EXPECT_TRUE(analyzeStored(map, letters).is_order_open) << letters;
    EXPECT_FALSE(analyzeStored(map, "1yyx").is_order_open) << "x is in alpha in DXT5nm";
}

/// Green contains the slopes of another height field than red. Then a single height field explains the map as badly as
/// a map with an unknown encoding.
TEST(MapSlopes, DoubtTwoChannelsThatAreTheSlopesOfNoHeight) {
    const RgbImage other = normalMapOf(256, rings);
    RgbImage map = normalMapOf(256, roundBumps);
    for (std::size_t i = 0; i < map.rgb.size(); i += 3) {
        map.rgb[i + 1] = other.rgb[i + 1];
        map.rgb[i + 2] = 0;
    }
    const MapAnalysis analysis = analyzeImage(map);
    EXPECT_EQ(analysis.content, MapContent::twoChannels);
    EXPECT_TRUE(analysis.is_doubtful);
}

TEST(MapSlopes, DetectImagesRotatedWithoutTheirVectors) {
    for (const bool is_clockwise : {false, true}) {
        const RgbImage map = stored(roundBumps, [&](double& x, double& y, double&) {
            // Only the image is rotated, not its vectors: rotate the vectors of the rotated relief back.
            const double old_x = x;
            x = is_clockwise ? -y : y;
            y = is_clockwise ? old_x : -old_x;
        });
        const MapAnalysis analysis = analyzeImage(map);
        ASSERT_EQ(analysis.content, MapContent::exchanged);
        EXPECT_TRUE(isRotated(analysis, true));
        EXPECT_FALSE(isRotated(analysis, false)) << "exchanged alone";
    }
}

TEST(MapSlopes, AreTheSameForBumpsAndDents) {
    for (const MapLayout& layout : {MapLayout{}, MapLayout{.x = {MapChannel::blue, true}, .z = {MapChannel::red}}}) {
        const MapLayout other = invertedRelief(layout);
        EXPECT_NE(other.x.is_inverted, layout.x.is_inverted);
        EXPECT_NE(other.y.is_inverted, layout.y.is_inverted);
        EXPECT_EQ(other.z, layout.z);
        EXPECT_EQ(invertedRelief(other), layout);
    }
}

}  // namespace
}  // namespace tspace::test
