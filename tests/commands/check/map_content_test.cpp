// SPDX-License-Identifier: MIT
// Content of an image that is used as a normal map: each kind is detected, and valid maps are not misclassified.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "commands/check/map_content.h"
#include "core/base/vec_math.h"
#include "images/image.h"
#include "images/images.h"

namespace tspace::test {
namespace {

MapAnalysis analyze(const RgbImage& image, std::span<const std::uint8_t> alpha = {},
                    std::span<const TexelOnSurface> surface = {}) {
    TexelMask all(image.width, image.height);
    all.fillAll();
    return analyzeTexels(sampleTexels(image, alpha, all), !alpha.empty(), surface);
}

/// Returns the image after calling change(texel) with the three bytes of each texel.
template <class Change>
RgbImage changed(RgbImage image, const Change& change) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) change(image.rgb.data() + i);
    return image;
}

const RgbImage& sound() {
    static const RgbImage map = normalMapOf(128, [](double x, double y) { return 2 * bumps(x, y); });
    return map;
}

std::uint8_t byteOf(double part) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0))); }
std::uint8_t withSrgb(std::uint8_t c) {
    const double part = c / 255.0;
    return byteOf(part <= 0.0031308 ? 12.92 * part : 1.055 * std::pow(part, 1 / 2.4) - 0.055);
}
std::uint8_t withoutSrgb(std::uint8_t c) {
    const double part = c / 255.0;
    return byteOf(part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
}

TEST(MapContent, IsNormalsForValidMaps) {
    const auto flat = [](double, double) { return 0.0; };
    const auto stripes = [](double x, double) { return 0.02 * std::sin(40 * x); };
    const auto steep = [](double x, double y) { return 10 * bumps(x, y); };
    for (const RgbImage& map : {sound(), normalMapOf(1, flat), normalMapOf(4, flat), normalMapOf(64, flat),
                                normalMapOf(64, stripes), normalMapOf(64, steep), normalMapOf(128, bumps, true)}) {
        EXPECT_EQ(analyze(map).content, MapContent::normals) << map.width;
        std::string why;
        for (const int quality : {50, 90}) {
            const std::string file = jpegFile(map, quality);
            EXPECT_EQ(analyze(*decodeImage(bytesOf(file), 1 << 20, why)).content, MapContent::normals) << quality;
        }
    }
}

TEST(MapContent, IsNormalsForLengthsThatFilteringShortened) {
    for (const double shortest : {0.7, 0.9}) {
        const RgbImage map = changed(sound(), [&](std::uint8_t* texel) {
            const double lean = (255 - texel[2]) / 40.0, size = 1 - (1 - shortest) * std::min(1.0, lean);
            for (int k = 0; k < 3; ++k) texel[k] = byteOf(0.5 + size * (texel[k] / 255.0 - 0.5));
        });
        EXPECT_EQ(analyze(map).content, MapContent::normals) << shortest;
    }
}

TEST(MapContent, IsNormalsForVectorsOfOneLengthBelowOne) {
    for (const double relief : {0.5, 1.0, 2.0, 6.0}) {
        const RgbImage unit = normalMapOf(128, [&](double x, double y) { return relief * bumps(x, y); });
        for (const double size : {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
            const RgbImage map = changed(unit, [&](std::uint8_t* texel) {
                for (int k = 0; k < 3; ++k) texel[k] = byteOf(0.5 + size * (texel[k] / 255.0 - 0.5));
            });
            EXPECT_EQ(analyze(map).content, MapContent::normals) << size << ' ' << relief;
            for (const std::uint8_t blue : {0, 60, 128, 153, 180, 204, 230, 255}) {
                const RgbImage two = changed(unit, [&](std::uint8_t* texel) { texel[2] = blue; });
                const MapContent wanted = blue > 245 && relief < 2 ? analyze(two).content : MapContent::twoChannels;
                EXPECT_EQ(analyze(two).content, wanted) << int(blue) << ' ' << relief;
            }
        }
    }
}

/// A map that is flat except for a few texels, so blue is constant nearly everywhere.
TEST(MapContent, IsNormalsForMapsThatAreFlatNearlyEverywhere) {
    const auto rivet = [](double x, double y) {
        return 0.02 * std::exp(-900 * ((x - .5) * (x - .5) + (y - .5) * (y - .5)));
    };
    EXPECT_EQ(analyze(normalMapOf(256, rivet)).content, MapContent::normals);
}

TEST(MapContent, DetectsTwoChannels) {
    for (const int blue : {0, 127, 255}) {
        const MapAnalysis analysis =
            analyze(changed(sound(), [&](std::uint8_t* texel) { texel[2] = static_cast<std::uint8_t>(blue); }));
        EXPECT_EQ(analysis.content, MapContent::twoChannels) << blue;
        EXPECT_EQ(analysis.layout.z.channel, MapChannel::none);
    }
    const RgbImage flat{8, 8, std::vector<std::uint8_t>(192, 128)};
    EXPECT_EQ(analyze(changed(flat, [](std::uint8_t* texel) { texel[2] = 0; })).content, MapContent::twoChannels);
}

TEST(MapContent, DetectsZFromZeroToOne) {
    const RgbImage map = changed(sound(), [](std::uint8_t* texel) { texel[2] = byteOf(texel[2] / 127.5 - 1); });
    EXPECT_EQ(analyze(map).content, MapContent::unsignedZ);
}

TEST(MapContent, DetectsZFromZeroToOneInJpeg) {
    const RgbImage map = changed(sound(), [](std::uint8_t* texel) { texel[2] = byteOf(texel[2] / 127.5 - 1); });
    for (const int quality : {70, 85, 95}) {
        std::string why;
        const std::string file = jpegFile(map, quality);
        EXPECT_EQ(analyze(*decodeImage(bytesOf(file), 1 << 20, why)).content, MapContent::unsignedZ) << quality;
    }
}

TEST(MapContent, DetectsTwoChannelsThatTiltToOneSide) {
    const RgbImage leaning = normalMapOf(128, [](double x, double y) { return 2 * bumps(x, y) + 0.4 * x; });
    EXPECT_EQ(analyze(leaning).content, MapContent::normals);
    for (const int blue : {0, 128, 255}) {
        const RgbImage map = changed(leaning, [&](std::uint8_t* texel) { texel[2] = static_cast<std::uint8_t>(blue); });
        EXPECT_EQ(analyze(map).content, MapContent::twoChannels) << blue;
    }
}

TEST(MapContent, DistinguishesXInAlphaFromHeightsWithAMask) {
    std::vector<std::uint8_t> alpha;
    for (std::size_t i = 0; i < sound().rgb.size(); i += 3) alpha.push_back(sound().rgb[i]);
    for (const int other : {0, 255, -1}) {
        const RgbImage map = changed(sound(), [&](std::uint8_t* texel) {
            texel[0] = texel[2] = other < 0 ? texel[1] : static_cast<std::uint8_t>(other);
        });
        const MapAnalysis analysis = analyze(map, alpha);
        EXPECT_EQ(analysis.content, MapContent::xInAlpha) << other;
        EXPECT_EQ(analysis.layout.x.channel, MapChannel::alpha);
    }
    const RgbImage heights = changed(sound(), [](std::uint8_t* texel) { texel[0] = texel[2] = texel[1]; });
    EXPECT_EQ(analyze(heights).content, MapContent::height);
    std::vector<std::uint8_t> mask(alpha.size(), 255);
    std::fill(mask.begin(), mask.begin() + 1000, 0);
    EXPECT_EQ(analyze(heights, mask).content, MapContent::height);
}

TEST(MapContent, DetectsExchangedAndInvertedChannels) {
    struct Case {
        int order[3];
        bool is_inverted;
    };
    for (const Case& one :
         {Case{{2, 1, 0}, false}, Case{{0, 2, 1}, false}, Case{{0, 1, 2}, true}, Case{{2, 1, 0}, true}}) {
        const RgbImage map = changed(sound(), [&](std::uint8_t* texel) {
            if (one.is_inverted) texel[2] ^= 0xff;
            const std::uint8_t old[3] = {texel[0], texel[1], texel[2]};
            for (int k = 0; k < 3; ++k) texel[k] = old[one.order[k]];
        });
        const MapAnalysis analysis = analyze(map);
        ASSERT_EQ(analysis.content, MapContent::exchanged) << one.order[0] << one.order[1] << one.order[2];
        RgbImage read = map;
        readByLayout(read, {}, analysis.layout);
        EXPECT_EQ(read.rgb, sound().rgb);
    }
}

TEST(MapContent, DetectsColors) {
    const auto encode = [](const auto& curve) {
        return [&curve](std::uint8_t* texel) {
            for (int k = 0; k < 3; ++k) texel[k] = curve(texel[k]);
        };
    };
    const MapAnalysis on = analyze(changed(sound(), encode(withSrgb))),
                      off = analyze(changed(sound(), encode(withoutSrgb)));
    EXPECT_EQ(on.content, MapContent::encoded);
    EXPECT_EQ(on.layout.curve, MapCurve::srgb);
    EXPECT_EQ(off.content, MapContent::encoded);
    EXPECT_EQ(off.layout.curve, MapCurve::linearized);
}

/// A map of the normals of a sphere, unchanged and with different axes.
TEST(MapContent, DetectsObjectSpaceByTheMesh) {
    constexpr std::uint32_t kSize = 64;
    for (const bool is_z_up : {false, true}) {
        RgbImage map{kSize, kSize, {}};
        std::vector<TexelOnSurface> surface;
        for (std::uint32_t row = 0; row < kSize; ++row) {
            for (std::uint32_t column = 0; column < kSize; ++column) {
                const double u = 6.2831853 * (column + .5) / kSize, v = 3.1415926 * (row + .5) / kSize;
                const double n[3] = {std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u)};
                const double stored[3] = {n[0], is_z_up ? -n[2] : n[1], is_z_up ? n[1] : n[2]};
                TexelBytes texel{0, 0, 0, 255};
                for (std::size_t k = 0; k < 3; ++k) {
                    texel[k] = byteOf(0.5 + 0.5 * stored[k]);
                    map.rgb.push_back(texel[k]);
                }
                surface.push_back({{float(n[0]), float(n[1]), float(n[2])}, texel, std::sin(v)});
            }
        }
        const MapAnalysis analysis = analyze(map, {}, surface);
        ASSERT_EQ(analysis.content, MapContent::objectSpace);
        EXPECT_TRUE(analysis.follows_mesh);
        EXPECT_EQ(analysis.layout == MapLayout{}, !is_z_up);
        const MapAnalysis elsewhere = analyze(map);
        EXPECT_EQ(elsewhere.content, MapContent::objectSpace) << "the vectors point all around";
        EXPECT_FALSE(elsewhere.follows_mesh);
        for (TexelOnSurface& point : surface) point.texel = {128, 128, 255, 255};
        EXPECT_EQ(analyze(sound(), {}, surface).content, MapContent::normals);
    }
}

/// A surface over u and v, both from -1 to 1, and an image that is to be identified.
struct Shown {
    RgbImage map{64, 64, {}};
    std::vector<TexelOnSurface> surface;
};

template <class NormalOf, class TexelOf>
Shown shownBy(const NormalOf& normalOf, const TexelOf& texelOf) {
    Shown shown;
    for (int row = 0; row < 64; ++row) {
        for (int column = 0; column < 64; ++column) {
            const double u = (column - 31.5) / 32, v = (row - 31.5) / 32;
            const DVec3 n = normalOf(u, v), t = texelOf(u, v);
            const TexelBytes texel{byteOf(0.5 + 0.5 * t.x), byteOf(0.5 + 0.5 * t.y), byteOf(0.5 + 0.5 * t.z), 255};
            shown.map.rgb.insert(shown.map.rgb.end(), texel.begin(), texel.begin() + 3);
            shown.surface.push_back({{float(n.x), float(n.y), float(n.z)}, texel, 1, {float(u), float(v)}});
        }
    }
    return shown;
}

MapAnalysis analyze(const Shown& shown) { return analyze(shown.map, {}, shown.surface); }

/// Relief that has the shape of the mesh correlates with its normals, but the map is in tangent space nevertheless.
TEST(MapContent, IsNormalsForABulgeOnABulge) {
    const auto bulge = [](double half) {
        return [half](double u, double) { return DVec3{std::sin(half * u), 0, std::cos(half * u)}; };
    };
    const auto faces_y = [](double u, double) { return DVec3{std::sin(u), std::cos(u), 0}; };
    for (const double relief : {0.17, 0.5, 0.9}) {
        for (const double mesh : {0.17, 0.5, 0.9, 1.2})
            EXPECT_EQ(analyze(shownBy(bulge(mesh), bulge(relief))).content, MapContent::normals) << relief << mesh;
        EXPECT_EQ(analyze(shownBy(faces_y, bulge(relief))).content, MapContent::normals) << relief;
    }
}

/// Returns the normal of hilly terrain with slopes of up to 40 degrees.
DVec3 hills(double u, double v) {
    const double x = 0.5 * std::cos(5 * u + 1) * std::cos(4 * v), y = 0.5 * std::cos(7 * v + u);
    const double size = std::sqrt(x * x + y * y + 1);
    return {x / size, y / size, 1 / size};
}

TEST(MapContent, IsInObjectSpaceOnlyWhereItFollowsTheMesh) {
    const auto turned = [](double u, double v) {
        const DVec3 n = hills(u, v);
        return DVec3{n.x, n.z, -n.y};
    };
    for (const MapAnalysis& analysis :
         {analyze(shownBy(hills, hills)), analyze(shownBy(turned, hills)), analyze(shownBy(turned, turned))}) {
        EXPECT_EQ(analysis.content, MapContent::objectSpace);
        EXPECT_TRUE(analysis.follows_mesh);
    }
    // The map has green and blue exchanged, and is on hills that face y like its vectors.
    const auto weak = [](double u, double v) { return DVec3{0.07 * std::sin(40 * u), 0.995, 0.07 * std::sin(37 * v)}; };
    EXPECT_EQ(analyze(shownBy(turned, weak)).content, MapContent::exchanged);
}

/// Terrain with slopes of at most 20 degrees, and relief of over 40 degrees, which dominates the single texels.
TEST(MapContent, IsInObjectSpaceUnderStrongReliefToo) {
    const auto leaning = [](double x, double y) {
        const double size = std::sqrt(x * x + y * y + 1);
        return DVec3{x / size, y / size, 1 / size};
    };
    const auto mesh = [](double u, double v) {
        return std::pair{0.3 * std::cos(2.5 * u + 1), 0.3 * std::cos(3 * v + u)};
    };
    const auto relief = [](double u, double v) {
        return std::pair{0.9 * std::cos(41 * u + 9 * v), 0.9 * std::sin(37 * v - 7 * u)};
    };
    const auto of_mesh = [&](double u, double v) {
        const auto [x, y] = mesh(u, v);
        return leaning(x, y);
    };
    const auto on_mesh = [&](double u, double v) {
        const auto [x, y] = mesh(u, v);
        const auto [a, b] = relief(u, v);
        return leaning(x + a, y + b);
    };
    const auto in_tangent_space = [&](double u, double v) {
        const auto [a, b] = relief(u, v);
        return leaning(a, b);
    };
    const auto turned = [](const auto& of) {
        return [of](double u, double v) {
            const DVec3 n = of(u, v);
            return DVec3{n.x, n.z, -n.y};
        };
    };
    EXPECT_EQ(analyze(shownBy(of_mesh, on_mesh)).content, MapContent::objectSpace) << "faces z";
    EXPECT_EQ(analyze(shownBy(turned(of_mesh), turned(on_mesh))).content, MapContent::objectSpace) << "faces y";
    EXPECT_EQ(analyze(shownBy(of_mesh, in_tangent_space)).content, MapContent::normals);
    EXPECT_EQ(analyze(shownBy(turned(of_mesh), in_tangent_space)).content, MapContent::normals);
    EXPECT_EQ(analyze(shownBy(turned(of_mesh), turned(in_tangent_space))).content, MapContent::exchanged);
}

/// Returns an image whose texels are colorOf(u, v, random): red, green and blue from 0 to 1.
template <class ColorOf>
RgbImage painted(const ColorOf& colorOf) {
    RgbImage image{64, 64, {}};
    std::mt19937 random(7);
    for (int i = 0; i < 64 * 64; ++i) {
        const DVec3 color = colorOf(i % 64 / 64.0, i / 64 / 64.0, random);
        for (const double part : {color.x, color.y, color.z}) image.rgb.push_back(byteOf(part));
    }
    return image;
}

double lightAt(double u, double v) { return 0.5 + 0.4 * std::sin(13 * u) * std::cos(10 * v); }

RgbImage tinted(const DVec3& tint, double least = 0, double most = 1) {
    return painted([&](double u, double v, std::mt19937&) { return (least + (most - least) * lightAt(u, v)) * tint; });
}

void isPicture(const RgbImage& image, const char* what) {
    EXPECT_EQ(static_cast<int>(analyze(image).content), static_cast<int>(MapContent::picture)) << what;
    std::string why;
    const std::string file = jpegFile(image, 85);
    const RgbImage jpeg = *decodeImage(bytesOf(file), 1 << 20, why);
    EXPECT_EQ(static_cast<int>(analyze(jpeg).content), static_cast<int>(MapContent::picture)) << what << " as JPEG";
}

TEST(MapContent, DetectsPictures) {
    isPicture(tinted({1, 0.8, 0.6}), "wood");
    isPicture(tinted({1, 0.6, 0.3}), "orange");
    isPicture(tinted({0.3, 0.8, 0.4}), "leaves");
    isPicture(tinted({0.35, 0.5, 1}), "sky");
    isPicture(tinted({1, 0.9, 0.75}, 0.74, 0.98), "plaster, whose texels are unit vectors");
    isPicture(tinted({1, 0.85, 0.7}, 0.16, 0.3), "dark earth, whose texels are unit vectors");
    const auto noise = [](double, double, std::mt19937& random) {
        std::uniform_real_distribution<double> part;
        return DVec3{part(random), part(random), part(random)};
    };
    isPicture(painted(noise), "noise");
    isPicture(painted([&](double u, double v, std::mt19937& random) {
                  return DVec3{0.35, 0.35, 0.35} + 0.3 * noise(u, v, random);
              }),
              "weak noise");
    isPicture(painted([](double u, double v, std::mt19937&) {
                  return DVec3{1 - 0.3 * lightAt(u, v), 0.4 + 0.5 * lightAt(v, u), u + v > 1 ? 1.0 : 0.0};
              }),
              "occlusion, roughness, metal");
    isPicture(painted([](double u, double v, std::mt19937&) {
                  return DVec3{1, 0.5 + 0.4 * lightAt(u, v), 0};
              }),
              "roughness alone");
    isPicture(painted([&](double u, double v, std::mt19937&) {
                  const int tile = static_cast<int>(4 * u) + 4 * static_cast<int>(4 * v);
                  return DVec3{tile % 3 / 2.0, tile % 5 / 4.0, tile % 7 / 6.0};
              }),
              "tiles");
}

TEST(MapContent, DetectsTintedHeights) {
    for (const double tint : {0.99, 0.96, 0.92}) {
        const RgbImage map = tinted({1, (1 + tint) / 2, tint});
        EXPECT_EQ(analyze(map).content, MapContent::height) << tint;
        std::string why;
        const std::string file = jpegFile(map, 85);
        EXPECT_EQ(analyze(*decodeImage(bytesOf(file), 1 << 20, why)).content, MapContent::height) << tint;
    }
}

/// Colors of valid maps, and of maps for which there are other findings.
TEST(MapContent, IsNotAPictureIfItMayBeVectors) {
    for (const TexelBytes& color :
         {TexelBytes{0, 0, 255, 255}, TexelBytes{128, 128, 255, 255}, TexelBytes{200, 90, 10, 255}}) {
        const RgbImage one{1, 1, {color[0], color[1], color[2]}};
        EXPECT_EQ(analyze(one).content, MapContent::normals) << "an image of one color says nothing";
    }
    int n = 0;
    const RgbImage half_black = changed(sound(), [&n](std::uint8_t* texel) {
        if (n++ % 4 != 0) texel[0] = texel[1] = texel[2] = 0;
    });
    EXPECT_EQ(analyze(half_black).content, MapContent::normals) << "most was never baked";
    for (const double size : {0.3, 0.6}) {
        const RgbImage map = changed(sound(), [&](std::uint8_t* texel) {
            for (int k = 0; k < 3; ++k) texel[k] = byteOf(0.5 + size * (texel[k] / 255.0 - 0.5));
        });
        EXPECT_EQ(analyze(map).content, MapContent::normals) << "vectors that are short, by " << size;
    }
    const RgbImage strong = changed(sound(), [](std::uint8_t* texel) {
        for (int k = 0; k < 2; ++k) texel[k] = byteOf(0.5 + 3 * (texel[k] / 255.0 - 0.5));
    });
    EXPECT_EQ(analyze(strong).content, MapContent::normals) << "x and y are strengthened, and z is not";
}

TEST(MapContent, IsInWorldSpaceWhereANodeTurnsTheNormals) {
    for (const double angle : {0.26, 0.8}) {
        const double c = std::cos(angle), s = std::sin(angle);
        const auto in_mesh = [](double u, double v) {
            const DVec3 n = hills(u, v);
            return DVec3{n.x, n.z, -n.y};
        };
        const auto in_world = [&](double u, double v) {
            const DVec3 n = in_mesh(u, v);
            return DVec3{c * n.x + s * n.z, n.y, c * n.z - s * n.x};
        };
        const Shown shown = shownBy(in_mesh, in_world), baked = shownBy(in_mesh, in_mesh);
        const std::vector<TexelOnSurface> turned = shownBy(in_world, in_world).surface;
        TexelMask all(64, 64);
        all.fillAll();
        const MapAnalysis analysis = analyzeTexels(sampleTexels(shown.map, {}, all), false, shown.surface, turned);
        EXPECT_EQ(analysis.content, MapContent::objectSpace);
        EXPECT_TRUE(analysis.follows_mesh && analysis.is_in_world) << angle;
        std::vector<TexelOnSurface> of_mesh = turned;
        for (std::size_t i = 0; i < of_mesh.size(); ++i) of_mesh[i].texel = baked.surface[i].texel;
        const MapAnalysis other = analyzeTexels(sampleTexels(baked.map, {}, all), false, baked.surface, of_mesh);
        EXPECT_TRUE(other.follows_mesh && !other.is_in_world) << angle;
    }
}

TEST(MapContent, OfAnyReliefIsDistinguishedFromAllOtherKinds) {
    EXPECT_TRUE(rc::check([] {
        const double a = *rc::gen::inRange(5, 40), b = *rc::gen::inRange(5, 40), c = *rc::gen::inRange(-20, 20);
        const auto height = [&](double x, double y) {
            return 1.0 / (a + b + std::abs(c)) * std::sin(a * x + c * y) * std::cos(b * y);
        };
        const RgbImage map = normalMapOf(64, height);
        RC_ASSERT(analyze(map).content == MapContent::normals);
        RC_ASSERT(analyze(changed(map, [](std::uint8_t* t) { t[2] = 0; })).content == MapContent::twoChannels);
        RC_ASSERT(analyze(changed(map, [](std::uint8_t* t) { std::swap(t[0], t[2]); })).content ==
                  MapContent::exchanged);
        RC_ASSERT(analyze(changed(map, [](std::uint8_t* t) {
                      for (int k = 0; k < 3; ++k) t[k] = withSrgb(t[k]);
                  })).content == MapContent::encoded);
    }));
}

}  // namespace
}  // namespace tspace::test
