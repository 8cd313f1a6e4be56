// SPDX-License-Identifier: MIT
// Baking with normal maps of the high poly, and texels that several triangles share.
#include <gtest/gtest.h>

#include <cmath>

#include "maps/texels/shading.h"
#include "support/filled_memory.h"
#include "tspace/maps.h"

namespace tspace::test {
namespace {

/// A square in the plane z = 0, from 0 to 1, as two triangles.
struct Square {
    std::vector<Vec3> positions = {}, normals = std::vector<Vec3>(6, Vec3{0, 0, 1});
    std::vector<Vec4> tangents = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> corners = {0, 1, 2, 3, 4, 5};

    /// Creates the square. u increases along x, and v against y; with `is_turned`, u increases along y, and v along x.
    explicit Square(bool is_turned = false, float left = 0) {
        for (const Vec2& at : {Vec2{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
            positions.push_back({left + at.x, at.y, 0});
            uvs.push_back(is_turned ? Vec2{at.y, at.x} : Vec2{at.x, 1 - at.y});
            // B points up in the image, against v: along y or, with `is_turned`, against x.
            tangents.push_back(is_turned ? Vec4{0, 1, 0, 1} : Vec4{1, 0, 0, 1});
        }
    }
    [[nodiscard]] LowPoly low() const {
        return {.positions = positions, .normals = normals, .tangents = tangents, .uvs = uvs};
    }
    [[nodiscard]] HighPoly high() const { return {.positions = positions, .normals = normals, .corners = corners}; }
};

/// A normal map whose texels are all the same vector.
struct EvenMap {
    std::vector<Vec3> texels;

    explicit EvenMap(const Vec3& vector)
        : texels(16, {0.5F + vector.x / 2, 0.5F + vector.y / 2, 0.5F + vector.z / 2}) {}
    [[nodiscard]] MapImage image() const { return {.width = 4, .height = 4, .texels = texels}; }
};

class HighMapBake : public testing::Test {
  protected:
    void SetUp() override {
        const Result<BakedMap> map = bakeMap(Square().low(), Square().high(), options());
        if (!map && map.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << map.error().message;
    }
    static BakeOptions options() { return {.width = 16, .height = 16, .reach = 0.1}; }
    static BakedMap baked(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                          const Execution& execution = {}) {
        const Result<BakedMap> map = bakeMap(low, high, options, execution);
        EXPECT_TRUE(map) << map.error().message;
        return map ? *map : BakedMap{};
    }
    static DVec3 vectorIn(const BakedMap& map) {
        DVec3 vector = decodeTexel(map.texels[map.width * (map.height / 2) + map.width / 2], {});
        EXPECT_TRUE(normalize(vector));
        return vector;
    }
};

TEST_F(HighMapBake, AMapOnOtherUvsShowsTheSameNormals) {
    const Square low, high(true);
    const EvenMap map({0.48F, 0.36F, 0.8F});
    const std::vector<HighMap> maps = {{.image = map.image()}};
    const std::vector<std::uint32_t> map_of = {0, 0};
    HighPoly poly = high.high();
    poly.maps = maps;
    poly.map_of = map_of;
    poly.tangents = high.tangents;
    poly.uvs = high.uvs;
    // x of the map points along y of the object, and y of the map against its x.
    const BakedMap result = baked(low.low(), poly, options());
    EXPECT_LT(degreesBetween(vectorIn(result), {-0.36, 0.48, 0.8}), 0.01);
    EXPECT_LT(result.error.max_deg, 0.01) << "the error is measured against the map";
}

TEST_F(HighMapBake, AppliesTheScaleAndGreenOfTheMaterial) {
    const Square low, high;
    const EvenMap map({0.48F, 0.36F, 0.8F});
    const std::vector<HighMap> maps = {{.image = map.image(), .reading = {.green = Green::down, .scale = 0.5F}}};
    const std::vector<std::uint32_t> map_of = {0, 0};
    HighPoly poly = high.high();
    poly.maps = maps;
    poly.map_of = map_of;
    poly.tangents = high.tangents;
    poly.uvs = high.uvs;
    EXPECT_LT(degreesBetween(vectorIn(baked(low.low(), poly, options())), {0.24, -0.18, 0.8}), 0.01);
}

TEST_F(HighMapBake, TrianglesWithoutAMapKeepTheirNormals) {
    const Square low, high;
    const EvenMap map({0.48F, 0.36F, 0.8F});
    const std::vector<HighMap> maps = {{.image = map.image()}};
    const std::vector<std::uint32_t> map_of = {kNoHighMap, kNoHighMap};
    HighPoly poly = high.high();
    poly.maps = maps;
    poly.map_of = map_of;
    poly.tangents = high.tangents;
    poly.uvs = high.uvs;
    EXPECT_LT(degreesBetween(vectorIn(baked(low.low(), poly, options())), {0, 0, 1}), 0.01);
}

TEST_F(HighMapBake, RejectsMapsThatDoNotFitTheMesh) {
    const Square low, high;
    const EvenMap map({0, 0, 1});
    std::vector<HighMap> maps = {{.image = map.image()}};
    std::vector<std::uint32_t> map_of = {0, 1};
    HighPoly poly = high.high();
    poly.maps = maps;
    poly.map_of = map_of;
    EXPECT_EQ(bakeMap(low.low(), poly, options()).error().code, ErrorCode::missingAttribute);
    poly.tangents = high.tangents;
    poly.uvs = high.uvs;
    EXPECT_EQ(bakeMap(low.low(), poly, options()).error().code, ErrorCode::indexOutOfRange);
    map_of = {0};
    poly.map_of = map_of;
    EXPECT_EQ(bakeMap(low.low(), poly, options()).error().code, ErrorCode::countMismatch);
    map_of = {0, 0};
    poly.map_of = map_of;
    maps.front().image.width = 5;
    EXPECT_EQ(bakeMap(low.low(), poly, options()).error().code, ErrorCode::countMismatch);
}

/// Two squares that share one UV map; the second one is larger in space. The high poly is tilted in different
/// directions over the two squares.
class SharedTexels : public HighMapBake {
  protected:
    SharedTexels() {
        const Square first, second(false, 2);
        for (const Square* const square : {&first, &second}) {
            const bool is_second = square == &second;
            for (std::size_t i = 0; i < 6; ++i) {
                Vec3 at = square->positions[i];
                if (is_second) at.y *= 1.5F;
                low_.positions.push_back(at);
                low_.normals.push_back({0, 0, 1});
                low_.tangents.push_back(square->tangents[i]);
                low_.uvs.push_back(square->uvs[i]);
                high_.corners.push_back(static_cast<std::uint32_t>(high_.positions.size()));
                high_.positions.push_back(at);
                high_.normals.push_back(is_second ? toFloat(kSecond) : toFloat(kFirst));
            }
        }
    }
    struct Mesh {
        std::vector<Vec3> positions = {}, normals = {};
        std::vector<Vec4> tangents = {};
        std::vector<Vec2> uvs = {};
        std::vector<std::uint32_t> corners = {};
    };
    static constexpr DVec3 kFirst{0.6, 0, 0.8}, kSecond{0, 0.6, 0.8};

    [[nodiscard]] BakedMap bakedWith(MapOverlap overlap, unsigned bits = 16, const Execution& execution = {}) const {
        BakeOptions how = options();
        how.overlap = overlap;
        how.bits = bits;
        return baked({.positions = low_.positions, .normals = low_.normals, .tangents = low_.tangents, .uvs = low_.uvs},
                     {.positions = high_.positions, .normals = high_.normals, .corners = high_.corners}, how,
                     execution);
    }
    Mesh low_ = {}, high_ = {};
};

TEST_F(SharedTexels, TheFirstTheLargerOrTheMeanCounts) {
    for (const unsigned bits : {8U, 16U}) {
        const double most = bits == 8 ? 0.3 : 0.01;
        EXPECT_LT(degreesBetween(vectorIn(bakedWith(MapOverlap::first, bits)), kFirst), most);
        EXPECT_LT(degreesBetween(vectorIn(bakedWith(MapOverlap::larger, bits)), kSecond), most);
    }
    EXPECT_LT(degreesBetween(vectorIn(bakedWith(MapOverlap::mean)), {0.3, 0.3, 0.8}), 0.01);
}

TEST_F(SharedTexels, TheContentOfFreshMemoryChangesNoTexel) {
    for (const MapOverlap overlap : {MapOverlap::mean, MapOverlap::first, MapOverlap::larger}) {
        const BakedMap expected = bakedWith(overlap);
        for (const unsigned char byte : test::kFillings) {
            const test::FilledMemory memory(byte);
            EXPECT_TRUE(expected.texels == bakedWith(overlap, 16, memory.execution()).texels) << int{byte};
        }
    }
}

TEST_F(SharedTexels, TheAngleBetweenThemIsReported) {
    const double apart = degreesBetween(kFirst, kSecond);
    for (const MapOverlap overlap : {MapOverlap::mean, MapOverlap::first, MapOverlap::larger}) {
        const BakedMap map = bakedWith(overlap);
        // Texels whose centers are on the diagonals are inside no triangle, so they are not counted.
        EXPECT_GE(map.conflict_count, 240U);
        EXPECT_NEAR(map.conflict_mean_deg, apart, 0.01);
        EXPECT_NEAR(map.conflict_max_deg, apart, 0.01);
    }
}

TEST_F(SharedTexels, WithEqualNormalsTheChoiceChangesNoTexel) {
    for (Vec3& normal : high_.normals) normal = toFloat(kFirst);
    const BakedMap mean = bakedWith(MapOverlap::mean);
    EXPECT_EQ(mean.conflict_count, 0U);
    for (const MapOverlap overlap : {MapOverlap::first, MapOverlap::larger})
        EXPECT_LT(degreesBetween(vectorIn(bakedWith(overlap)), vectorIn(mean)), 0.01);
}

}  // namespace
}  // namespace tspace::test
