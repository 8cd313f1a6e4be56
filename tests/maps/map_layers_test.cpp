// SPDX-License-Identifier: MIT
// Maps other than the normal map, compared with values from formulas.
#include "tspace/maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/vec_math.h"
#include "maps/bake/hemisphere.h"
#include "maps/bake/surface_curvature.h"
#include "maps/texels/texture_sample.h"
#include "support/thread_team.h"

namespace tspace::test {
namespace {

struct Mesh {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<std::uint32_t> corners = {};

    [[nodiscard]] HighPoly view() const { return {.positions = positions, .normals = normals, .corners = corners}; }

    /// Adds a grid of cells x cells quads. at(u, v) returns a position for u and v from 0 to 1.
    template <class At>
    void addGrid(int cells, const At& at) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        const auto row = static_cast<std::uint32_t>(cells + 1);
        for (int y = 0; y <= cells; ++y) {
            for (int x = 0; x <= cells; ++x) positions.push_back(toFloat(at(double(x) / cells, double(y) / cells)));
        }
        for (std::uint32_t y = 0; y + 1 < row; ++y) {
            for (std::uint32_t x = 0; x + 1 < row; ++x) {
                const std::uint32_t a = first + y * row + x;
                corners.insert(corners.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
            }
        }
    }
    /// Adds a flat square at the height z that faces up or down. `half`: half of the side.
    void addSquare(double half, double z, int cells = 1, bool faces_up = true) {
        addGrid(cells, [&](double u, double v) {
            return DVec3{half * (2 * u - 1), half * (2 * (faces_up ? v : 1 - v) - 1), z};
        });
    }
    void addBall(const DVec3& center, double radius, int cells) {
        addGrid(cells, [&](double u, double v) {
            const SineCosine turn = sineCosine(2 * kPi * u), up = sineCosine(kPi * (v - 0.5));
            return center + radius * DVec3{up.cosine * turn.cosine, up.cosine * turn.sine, up.sine};
        });
    }
};

/// Tests with a low poly that is the square from -1 to 1 at z = 0. In its UVs, row 0 is at y = -1.
class MapLayers : public testing::Test {
  protected:
    void SetUp() override {
        Mesh high;
        high.addSquare(1, 0);
        const auto made = bakeMap(low(), high.view(), {.width = 4, .height = 4});
        if (!made && made.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << made.error().message;
    }

    [[nodiscard]] LowPoly low() const {
        return {.positions = positions_, .normals = normals_, .tangents = tangents_, .uvs = uvs_};
    }
    static BakeOptions sized(std::uint32_t size) {
        return {.width = size, .height = size, .fit = MapFit::texel, .padding = 0, .reach = 0.4};
    }
    BakedMaps baked(const Mesh& high, LayerOptions layers, const BakeOptions& options,
                    const Execution& execution = {}) const {
        layers.has_normal = false;
        const Result<BakedMaps> maps = bakeMaps(low(), high.view(), options, layers, execution);
        EXPECT_TRUE(maps) << maps.error().message;
        return maps ? *maps : BakedMaps{};
    }
    BakedLayer one(const Mesh& high, MapLayer layer, LayerOptions layers, const BakeOptions& options) const {
        layers.layers = {layer};
        BakedMaps maps = baked(high, std::move(layers), options);
        return maps.layers.empty() ? BakedLayer{} : std::move(maps.layers.front());
    }
    Error errorOf(const LayerOptions& layers, BakeOptions options = sized(8)) const {
        Mesh high;
        high.addSquare(1, 0);
        const Result<BakedMaps> maps = bakeMaps(low(), high.view(), options, layers);
        EXPECT_FALSE(maps);
        return maps ? Error{} : maps.error();
    }

    /// Returns the center of a texel of the square, for maps of `size` x `size` texels.
    static DVec3 middle(std::uint32_t x, std::uint32_t y, std::uint32_t size) {
        return {2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1, 0};
    }

  private:
    std::vector<Vec3> positions_ = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    std::vector<Vec3> normals_ = std::vector<Vec3>(6, Vec3{0, 0, 1});
    std::vector<Vec4> tangents_ = std::vector<Vec4>(6, Vec4{1, 0, 0, 1});
    std::vector<Vec2> uvs_ = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
};

TEST_F(MapLayers, OcclusionByASphereEqualsItsFormFactor) {
    Mesh high;
    high.addSquare(2, 0, 8);
    high.addBall({0, 0, 0.8}, 0.3, 64);
    constexpr std::uint32_t kSize = 32;
    const BakedLayer ao = one(high, MapLayer::ao, {.ray_count = 256}, sized(kSize));
    double sum = 0;
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            const DVec3 at = middle(x, y, kSize);
            const double square = dot(at, at) + 0.64, hidden = 0.09 / square * 0.8 / std::sqrt(square);
            const double error = double{ao.values[y * kSize + x]} - (1 - hidden);
            sum += error * error;
        }
    }
    EXPECT_LT(std::sqrt(sum / kSize / kSize), 0.0065);
}

TEST_F(MapLayers, SurfacesBeyondTheDistanceDoNotOcclude) {
    Mesh high;
    high.addSquare(2, 0, 8);
    high.addBall({0, 0, 0.8}, 0.3, 32);
    for (const float value : one(high, MapLayer::ao, {.sky_distance = 0.45}, sized(16)).values) EXPECT_EQ(value, 1);
}

TEST_F(MapLayers, ACoarseSmoothSphereDoesNotOccludeItself) {
    Mesh high;
    high.addBall({0, 0, -1.9}, 2, 12);
    for (const Vec3& at : high.positions) {
        DVec3 normal = toDouble(at) - DVec3{0, 0, -1.9};
        normalize(normal);
        high.normals.push_back(toFloat(normal));
    }
    BakeOptions options = sized(32);
    options.reach = 2;
    const BakedLayer ao = one(high, MapLayer::ao, {}, options);
    EXPECT_EQ(*std::min_element(ao.values.begin(), ao.values.end()), 1);
}

TEST_F(MapLayers, BentNormalsTiltAwayFromAWall) {
    Mesh high;
    high.addSquare(1, 0);
    high.addGrid(1, [](double u, double v) { return DVec3{-1.001, 80 * (2 * u - 1), 80 * v}; });
    constexpr std::uint32_t kSize = 32;
    const BakedMaps maps = baked(high, {.layers = {MapLayer::bent, MapLayer::ao}, .ray_count = 1024}, sized(kSize));
    // Half of the sky is visible. Its mean over the half disc is 4 / (3 pi) sideways and 2 / 3 upward.
    const std::size_t texel = 16 * kSize;
    const Vec3 bent{2 * maps.layers[0].values[3 * texel] - 1, 2 * maps.layers[0].values[3 * texel + 1] - 1,
                    2 * maps.layers[0].values[3 * texel + 2] - 1};
    const double lean = polarAngle(double{bent.z}, double{bent.x});
    EXPECT_NEAR(lean, polarAngle(2.0 / 3, 4 / (3 * kPi)), 0.03);
    EXPECT_NEAR(maps.layers[1].values[texel], 0.5, 0.02);
}

TEST_F(MapLayers, TheThicknessOfASlabIsItsHeightAndThatOfASphereItsRadius) {
    Mesh slab;
    slab.addSquare(200, 0);
    slab.addSquare(200, -0.25, 1, false);
    const BakedLayer thickness = one(slab, MapLayer::thickness, {.thickness_range = 1}, sized(8));
    for (const float value : thickness.values) EXPECT_NEAR(value, 0.25, 1e-5);
    EXPECT_EQ(thickness.most[0], 1);
    // In a ball of radius r, a ray at an angle to the normal has the length 2 r cos(angle), so the depth is 2 r
    // cos(angle)^2.
    Mesh ball;
    ball.addBall({0, 0, -1.9}, 2, 64);
    BakeOptions options = sized(8);
    options.reach = 2;
    const BakedLayer of_ball = one(ball, MapLayer::thickness, {.ray_count = 256, .thickness_range = 4}, options);
    for (const float value : of_ball.values) EXPECT_NEAR(value, 0.5, 0.01);
}

TEST_F(MapLayers, ThicknessWithoutABackSideIsMaximal) {
    Mesh high;
    high.addSquare(1, 0);
    for (const float value : one(high, MapLayer::thickness, {.thickness_range = 1}, sized(8)).values)
        EXPECT_EQ(value, 1);
}

TEST_F(MapLayers, SurfacesWithoutABackSideDoNotExtendTheThicknessRange) {
    Mesh high;
    high.addSquare(1, 0);
    high.addSquare(0.5, -0.25, 1, false);
    const BakedLayer layer = one(high, MapLayer::thickness, {}, sized(8));
    EXPECT_NEAR(layer.most[0], 0.25, 1e-5);
}

TEST_F(MapLayers, HeightIsTheDistanceFromTheLowPolyAndGrayIsZero) {
    Mesh high;
    high.addGrid(1, [](double u, double v) { return DVec3{2 * u - 1, 2 * v - 1, 0.2 * u}; });
    const BakedLayer fixed = one(high, MapLayer::height, {.height_range = 0.4}, sized(16));
    const BakedLayer found = one(high, MapLayer::height, {}, sized(16));
    EXPECT_NEAR(found.most[0], 0.2 * 15.5 / 16, 1e-6);
    EXPECT_EQ(found.least[0], -found.most[0]);
    for (std::uint32_t x = 0; x < 16; ++x) {
        const double height = 0.2 * (x + 0.5) / 16;
        EXPECT_NEAR(fixed.values[x], 0.5 + 0.5 * height / 0.4, 1e-6);
        EXPECT_NEAR(found.values[x], 0.5 + 0.5 * height / found.most[0], 1e-6);
    }
}

TEST_F(MapLayers, ZeroHeightIsGray) {
    Mesh high;
    high.addSquare(1, 0);
    for (const float value : one(high, MapLayer::height, {}, sized(8)).values) EXPECT_EQ(value, 0.5);
}

TEST_F(MapLayers, PositionsLieInTheReportedBox) {
    Mesh high;
    high.addSquare(1, 0.1);
    high.addSquare(3, -5);
    const BakedLayer position = one(high, MapLayer::position, {}, sized(16));
    EXPECT_EQ(position.least, (std::array<double, 3>{-3, -3, -5}));
    for (std::uint32_t i = 0; i < 256; ++i) {
        const DVec3 wanted = middle(i % 16, i / 16, 16) + DVec3{0, 0, 0.1F};
        const double at[] = {wanted.x, wanted.y, wanted.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double side = position.most[axis] - position.least[axis];
            EXPECT_NEAR(position.least[axis] + side * double{position.values[3 * i + axis]}, at[axis], 1e-6);
        }
    }
}

TEST_F(MapLayers, MissedTexelsAreFilledFromNeighbors) {
    Mesh high;
    high.addGrid(1, [](double u, double v) {
        return DVec3{u - 1, 2 * v - 1, 0.1};
    });  // above the left half of the low poly
    const BakedMaps maps =
        baked(high, {.layers = {MapLayer::height, MapLayer::id}, .ids = std::vector<std::uint32_t>{7, 7}}, sized(16));
    EXPECT_EQ(maps.normal.missed_count, 128U);
    for (const float value : maps.layers[0].values) EXPECT_EQ(value, 1);
    for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(maps.layers[1].values[3 * i], idColor(7).x);
}

TEST_F(MapLayers, IdsAreNotBlendedAcrossEdges) {
    Mesh high;
    high.addSquare(1, 0, 3);
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < 18; ++i) ids.push_back(i % 5);
    std::set<std::array<float, 3>> known;
    for (std::uint32_t i = 0; i < 5; ++i) known.insert({idColor(i).x, idColor(i).y, idColor(i).z});
    BakeOptions options = sized(50);
    options.padding = 4;
    const BakedLayer layer = one(high, MapLayer::id, {.ids = ids}, options);
    for (std::size_t i = 0; i < layer.values.size(); i += 3)
        EXPECT_TRUE(known.contains({layer.values[i], layer.values[i + 1], layer.values[i + 2]})) << i;
}

TEST(IdColor, NumbersDifferInEightBitsAndNoneIsBlack) {
    std::set<std::array<int, 3>> seen{{0, 0, 0}};
    constexpr std::uint32_t kCount = 100000;
    const auto bytes = [](std::uint32_t id) {
        const Vec3 color = idColor(id);
        return std::array<int, 3>{int(std::lround(color.x * 255)), int(std::lround(color.y * 255)),
                                  int(std::lround(color.z * 255))};
    };
    for (std::uint32_t id = 0; id < kCount; ++id) EXPECT_TRUE(seen.insert(bytes(id)).second) << id;
    for (std::uint32_t a = 0; a < 7; ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
            int most = 0;
            for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(bytes(a)[i] - bytes(b)[i]));
            EXPECT_GE(most, 128);
        }
    }
}

/// Returns the RMS error of the curvature at the vertices of a torus, relative to its largest curvature.
double curvatureError(int cells) {
    constexpr double kLarge = 1, kSmall = 0.4;
    Mesh torus;
    const auto angles = [&](double u, double v) { return std::pair{2 * kPi * (u + 0.02 * v * (1 - v)), 2 * kPi * v}; };
    torus.addGrid(cells, [&](double u, double v) {
        const auto [around, across] = angles(u, v);
        const SineCosine a = sineCosine(around), b = sineCosine(across);
        const double radius = kLarge + kSmall * b.cosine;
        torus.normals.push_back(toFloat({b.cosine * a.cosine, b.cosine * a.sine, b.sine}));
        return DVec3{radius * a.cosine, radius * a.sine, kSmall * b.sine};
    });
    Parallel parallel({.thread_count = 1});
    const Buffer<float> curvature = vertexCurvature(torus.view(), 0, parallel, nullptr);
    double sum = 0;
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        const double cosine = double{torus.positions[i].z} / kSmall;
        const double flat = std::hypot(double{torus.positions[i].x}, double{torus.positions[i].y});
        const double side = (flat - kLarge) / kSmall;
        EXPECT_NEAR(cosine * cosine + side * side, 1, 1e-4);
        const double wanted = 0.5 * (1 / kSmall + side / (kLarge + kSmall * side));
        const double part = (double{curvature[i]} - wanted) * kSmall;
        sum += part * part;
    }
    return std::sqrt(sum / static_cast<double>(curvature.size()));
}

TEST(SurfaceCurvature, OfATorusConverges) {
    EXPECT_LT(curvatureError(32), 0.03);
    EXPECT_LT(curvatureError(128), 0.003);
}

TEST(SurfaceCurvature, OfACoarseBallWithoutNormalsIsOneByItsRadius) {
    Mesh ball;
    ball.addBall({1, 2, 3}, 0.5, 64);
    Parallel parallel({.thread_count = 1});
    const Buffer<float> curvature = vertexCurvature(ball.view(), 0, parallel, nullptr);
    for (std::size_t i = 65; i + 65 < curvature.size(); ++i) EXPECT_NEAR(curvature[i], 2, 0.02) << i;
}

TEST(SurfaceCurvature, IgnoresRoundingOfPositions) {
    // A tube whose two ends meet along a line, where each end has vertices of its own.
    constexpr int kCells = 32;
    const auto curvature = [&](float nudge, float weld_distance) {
        Mesh tube;
        tube.addGrid(kCells, [&](double u, double v) {
            const SineCosine a = sineCosine(2 * kPi * (u < 1 ? u : 0));
            return DVec3{a.cosine, a.sine + (u < 1 ? 0 : double{nudge}), 2 * v};
        });
        Parallel parallel({.thread_count = 1});
        return vertexCurvature(tube.view(), weld_distance, parallel, nullptr);
    };
    const Buffer<float> equal = curvature(0, 0), near = curvature(1e-7F, NormalOptions::weld_auto),
                        apart = curvature(1e-7F, 0);
    float most_near = 0, most_apart = 0;
    for (std::size_t i = 0; i < equal.size(); ++i) {
        most_near = std::max(most_near, std::fabs(near[i] - equal[i]));
        most_apart = std::max(most_apart, std::fabs(apart[i] - equal[i]));
    }
    EXPECT_LT(most_near, 1e-4F);
    EXPECT_GT(most_apart, 0.1F);
}

TEST_F(MapLayers, CurvatureIsBrightWhereTheSurfaceIsConvexAndGrayWhereItIsFlat) {
    Mesh high;
    high.addGrid(64, [](double u, double v) {
        const double x = 2 * u - 1;
        return DVec3{x, 2 * v - 1, 0.1 * std::cos(kPi * x)};
    });
    const BakedLayer layer = one(high, MapLayer::curvature, {}, sized(32));
    EXPECT_GT(layer.values[16 * 32 + 16], 0.9);
    EXPECT_LT(layer.values[16 * 32 + 1], 0.2);
    EXPECT_EQ(layer.least[0], -layer.most[0]);
    const BakedLayer fixed = one(high, MapLayer::curvature, {.curvature_range = 2 * layer.most[0]}, sized(32));
    EXPECT_NEAR(fixed.values[16 * 32 + 16] - 0.5F, 0.5F * (layer.values[16 * 32 + 16] - 0.5F), 0.03);
}

/// A map of the square from -1 to 1.
struct Picture {
    std::uint32_t size = 0;
    std::vector<Vec3> texels = {};

    [[nodiscard]] Vec3 at(const DVec3& place) const {
        return sampleBilinear({size, size, TextureWrap::clamp, TextureWrap::clamp}, texels,
                              {static_cast<float>(0.5 * place.x + 0.5), static_cast<float>(0.5 * place.y + 0.5)});
    }
};

MaterialAt showing(const Mesh& high, const Picture& picture) {
    return [&](std::uint32_t triangle, const std::array<double, 3>& weights) {
        DVec3 place{};
        for (std::size_t i = 0; i < 3; ++i)
            place = place + weights[i] * toDouble(high.positions[high.corners[3 * triangle + i]]);
        const Vec3 shown = picture.at(place);
        return ShownMaterial{.color = shown, .roughness = shown.y, .metalness = shown.z, .emission = shown};
    };
}

Picture noise(std::uint32_t size) {
    Picture picture{size};
    for (std::uint32_t i = 0; i < size * size; ++i) {
        const std::uint64_t bits = mixBits(i + 1);
        picture.texels.push_back({static_cast<float>(bits & 255) / 255, static_cast<float>(bits >> 8 & 255) / 255,
                                  static_cast<float>(bits >> 16 & 255) / 255});
    }
    return picture;
}

TEST_F(MapLayers, FittedColorsOfATextureOfTheSameSizeAreItsTexels) {
    Mesh high;
    high.addSquare(1, 0, 3);
    const Picture picture = noise(32);
    BakeOptions options = sized(32);
    options.fit = MapFit::solve;
    options.wrap_u = options.wrap_v = TextureWrap::clamp;
    const BakedMaps maps = baked(
        high, {.layers = {MapLayer::color, MapLayer::orm, MapLayer::emission}, .material = showing(high, picture)},
        options);
    for (std::size_t i = 0; i < picture.texels.size(); ++i) {
        const Vec3& wanted = picture.texels[i];
        const float *const color = &maps.layers[0].values[3 * i], *const orm = &maps.layers[1].values[3 * i];
        EXPECT_NEAR(color[0], wanted.x, 0.004) << i;
        EXPECT_NEAR(color[1], wanted.y, 0.004) << i;
        EXPECT_EQ(orm[0], 1);
        EXPECT_NEAR(orm[1], wanted.y, 0.004) << i;
        EXPECT_NEAR(orm[2], wanted.z, 0.004) << i;
        EXPECT_EQ(maps.layers[2].values[3 * i], color[0]);
    }
}

TEST_F(MapLayers, FittedColorsAreMoreAccurateThanMeans) {
    Mesh high;
    high.addSquare(1, 0, 3);
    const Picture picture = noise(48);
    const auto errorOf = [&](MapFit fit) {
        BakeOptions options = sized(64);
        options.fit = fit;
        options.wrap_u = options.wrap_v = TextureWrap::clamp;
        const BakedLayer layer = one(high, MapLayer::color, {.material = showing(high, picture)}, options);
        Picture made{64};
        for (std::size_t i = 0; i < 64 * 64; ++i)
            made.texels.push_back({layer.values[3 * i], layer.values[3 * i + 1], layer.values[3 * i + 2]});
        double sum = 0;
        for (int i = 0; i < 10000; ++i) {
            const DVec3 place{0.0193 * (i % 100) - 0.95, 0.0191 * (i / 100) - 0.95, 0};
            const Vec3 off = made.at(place) - picture.at(place);
            sum += static_cast<double>(dot(off, off));
        }
        return std::sqrt(sum / 30000);
    };
    EXPECT_LT(errorOf(MapFit::solve), 0.75 * errorOf(MapFit::texel));
}

TEST_F(MapLayers, RedOfOrmIsTheOcclusionMap) {
    Mesh high;
    high.addSquare(2, 0, 8);
    high.addBall({0, 0, 0.8}, 0.3, 32);
    const BakedMaps maps = baked(high,
                                 {.layers = {MapLayer::orm, MapLayer::ao},
                                  .material =
                                      [](std::uint32_t, const std::array<double, 3>&) {
                                          return ShownMaterial{.roughness = 0.25F, .metalness = 0.75F};
                                      }},
                                 sized(16));
    for (std::size_t i = 0; i < 256; ++i) {
        EXPECT_EQ(maps.layers[0].values[3 * i], maps.layers[1].values[i]);
        EXPECT_EQ(maps.layers[0].values[3 * i + 1], 0.25F);
        EXPECT_EQ(maps.layers[0].values[3 * i + 2], 0.75F);
    }
}

TEST_F(MapLayers, AreTheSameForAnyNumberOfThreads) {
    Mesh high;
    high.addSquare(2, 0, 8);
    high.addBall({0, 0, 0.6}, 0.3, 32);
    const Picture picture = noise(16);
    std::vector<std::uint32_t> ids(high.corners.size() / 3);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::uint32_t>(i);
    LayerOptions layers{.ray_count = 16, .ids = ids, .material = showing(high, picture)};
    for (std::uint32_t i = 0; i < kMapLayerCount; ++i) layers.layers.push_back(static_cast<MapLayer>(i));
    BakeOptions options = sized(40);
    options.fit = MapFit::solve;
    options.padding = 4;
    const BakedMaps alone = baked(high, layers, options, {.thread_count = 1});
    for (const unsigned threads : {2U, 3U}) {
        const BakedMaps several = baked(high, layers, options, {.thread_count = threads});
        for (std::size_t i = 0; i < kMapLayerCount; ++i) {
            EXPECT_EQ(several.layers[i].values, alone.layers[i].values) << i;
            EXPECT_EQ(several.layers[i].most, alone.layers[i].most) << i;
        }
    }
}

TEST_F(MapLayers, TheNormalMapIsThatOfBakeMap) {
    Mesh high;
    high.addGrid(20, [](double u, double v) { return DVec3{2 * u - 1, 2 * v - 1, 0.1 * std::sin(6 * u) * v}; });
    BakeOptions options = sized(32);
    options.fit = MapFit::solve;
    const Result<BakedMap> alone = bakeMap(low(), high.view(), options);
    const Result<BakedMaps> with = bakeMaps(low(), high.view(), options, {.layers = {MapLayer::height}});
    ASSERT_TRUE(alone);
    ASSERT_TRUE(with);
    EXPECT_EQ(with->normal.texels, alone->texels);
    EXPECT_EQ(with->normal.error.mean_deg, alone->error.mean_deg);
}

TEST_F(MapLayers, WrongOptionsAreErrors) {
    const MaterialAt plain = [](std::uint32_t, const std::array<double, 3>&) { return ShownMaterial{}; };
    EXPECT_EQ(errorOf({.layers = {}, .has_normal = false}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::ao, MapLayer::ao}}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {static_cast<MapLayer>(99)}}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::ao}, .ray_count = 0}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::ao}, .ray_count = kMostLayerRays + 1}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::ao}, .sky_distance = -1}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::height}, .height_range = std::nan("")}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::color}}).code, ErrorCode::invalidOption);
    EXPECT_EQ(errorOf({.layers = {MapLayer::id}}).code, ErrorCode::countMismatch);
}

TEST_F(MapLayers, ExceedingTheMemoryLimitIsRejectedBeforeAnyWork) {
    BakeOptions options = sized(16384);
    options.memory_limit_bytes = bakeBytes(2, 2, options) + (std::uint64_t{1} << 20);
    EXPECT_EQ(errorOf({.layers = {MapLayer::position}}, options).code, ErrorCode::tooLarge);
}

TEST(ScrambledSobol, EachPartOfTheSquareHasOneOfThePointsOfATexelAndOfABlock) {
    // Returns whether all cells of 2^-i by 2^-(k - i) contain one point, for all i from 0 to k.
    const auto areSpread = [](const std::vector<std::array<double, 2>>& points, int k) {
        for (int i = 0; i <= k; ++i) {
            std::set<std::pair<int, int>> parts;
            for (const auto& at : points)
                parts.insert({static_cast<int>(at[0] * (1 << i)), static_cast<int>(at[1] * (1 << (k - i)))});
            if (parts.size() != points.size()) return false;
        }
        return true;
    };
    for (const std::uint32_t column : {0U, 4U, 1000U}) {
        std::vector<std::array<double, 2>> of_block;
        for (std::uint32_t texel = 0; texel < 16; ++texel) {
            const ScrambledSobol points(16, column + texel % 4, 8 + texel / 4);
            std::vector<std::array<double, 2>> of_texel;
            for (std::uint32_t i = 0; i < 16; ++i) of_texel.push_back(points.at(i));
            EXPECT_TRUE(areSpread(of_texel, 4)) << texel;
            of_block.insert(of_block.end(), of_texel.begin(), of_texel.end());
        }
        EXPECT_TRUE(areSpread(of_block, 8)) << column;
    }
}

TEST(CosineDirection, IsUnitWithMeanHeightTwoThirds) {
    double sum = 0;
    const ScrambledSobol points(1024, 3, 5);
    for (std::uint32_t i = 0; i < 1024; ++i) {
        const DVec3 direction = cosineDirection(points.at(i));
        EXPECT_NEAR(length(direction), 1, 1e-12);
        EXPECT_GE(direction.z, 0);
        sum += direction.z;
    }
    EXPECT_NEAR(sum / 1024, 2.0 / 3, 0.001);
}

}  // namespace
}  // namespace tspace::test
