// SPDX-License-Identifier: MIT
// A converted map gives the same shading with the new frames as the original map with the old frames.
#include "tspace/maps.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "maps/layout/texel_triangles.h"
#include "maps/texels/quantize.h"
#include "maps/texels/shading.h"

namespace tspace::test {
namespace {

/// One side of a conversion, with the corners that it refers to.
struct Corners {
    std::vector<Vec2> uvs = {};
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec4> tangents = {};
    MapReading reading = {};

    [[nodiscard]] MapSide side() const {
        return {.reading = reading, .uvs = uvs, .normals = normals, .tangents = tangents, .positions = positions};
    }
};

Vec3 unit(DVec3 v) {
    normalize(v);
    return toFloat(v);
}

/// A bent patch of `cells` x `cells` quads over UVs from `begin` to `end`. `twist`: rotation of its tangents about the
/// normal. `lean`: tilt of its normals. Both vary smoothly over the patch.
struct Patch {
    int cells = 4;
    float begin = 0.1f, end = 0.9f;
    double twist = 0, lean = 0;
    bool other_diagonal = false;
    float sign = 1;
    float x_offset = 0;
};

void addCorner(const Patch& patch, int column, int row, Corners& to) {
    const double a = static_cast<double>(column) / patch.cells, b = static_cast<double>(row) / patch.cells;
    const float size = patch.end - patch.begin;
    to.uvs.push_back({patch.begin + size * static_cast<float>(a), patch.begin + size * static_cast<float>(b)});
    to.positions.push_back({patch.x_offset + patch.sign * static_cast<float>(a), static_cast<float>(b),
                            static_cast<float>(0.2 * std::sin(3 * a) * std::cos(2 * b))});
    const DVec3 normal{patch.sign * (0.3 * std::cos(3 * a) + patch.lean * b), 0.2 * std::sin(2 * b) - patch.lean * a,
                       1};
    const Vec3 n = unit(normal);
    const double turn = patch.twist * (1 + a - b);
    DVec3 tangent{patch.sign * std::cos(turn), std::sin(turn), 0};
    tangent = tangent - dot(toDouble(n), tangent) * toDouble(n);
    const Vec3 t = unit(tangent);
    to.normals.push_back(n);
    to.tangents.push_back({t.x, t.y, t.z, patch.sign});
}

Corners cornersOf(const Patch& patch) {
    Corners corners;
    for (int row = 0; row < patch.cells; ++row) {
        for (int column = 0; column < patch.cells; ++column) {
            const int right = column + 1, below = row + 1;
            const std::vector<std::pair<int, int>> first = {{column, row}, {right, row}, {right, below}};
            const std::vector<std::pair<int, int>> second = {{column, row}, {right, below}, {column, below}};
            const std::vector<std::pair<int, int>> third = {{column, row}, {right, row}, {column, below}};
            const std::vector<std::pair<int, int>> fourth = {{right, row}, {right, below}, {column, below}};
            for (const auto& [x, y] : patch.other_diagonal ? third : first) addCorner(patch, x, y, corners);
            for (const auto& [x, y] : patch.other_diagonal ? fourth : second) addCorner(patch, x, y, corners);
        }
    }
    return corners;
}

/// Returns texels as integers of `bits`: vectors tilted by up to 30 degrees with slightly different lengths.
std::vector<Vec3> randomTexels(std::size_t count, unsigned bits, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> lean(-0.5, 0.5), size(0.85, 1.0);
    std::vector<Vec3> texels(count);
    const double most = bits == 32 ? 0 : (1U << bits) - 1;
    for (Vec3& texel : texels) {
        const Vec3 v = unit({lean(random), lean(random), 1});
        const double length = size(random);
        const auto channel = [&](float c) {
            const double part = 0.5 * (length * c + 1);
            if (bits == 32) return static_cast<float>(part);
            return static_cast<float>(std::floor(part * most + 0.5)) / static_cast<float>(most);
        };
        texel = {channel(v.x), channel(v.y), channel(v.z)};
    }
    return texels;
}

constexpr std::uint32_t kSize = 32;

MapImage imageOf(const std::vector<Vec3>& texels, std::uint32_t size = kSize) { return {size, size, texels}; }

std::vector<Vec3> converted(const std::vector<Vec3>& texels, const MapSide& from, const MapSide& to,
                            const ConvertMapOptions& options = {}, ConvertMapReport* report = nullptr,
                            const Execution& execution = {}) {
    std::vector<Vec3> out(texels.size());
    const auto size = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(texels.size()))));
    const Result<ConvertMapReport> done = convertMap(imageOf(texels, size), from, to, options, out, execution);
    EXPECT_TRUE(done.ok()) << (done ? "" : done.error().message);
    if (done && report != nullptr) *report = *done;
    return out;
}

/// Returns the shading direction at each texel's center, or zero if no triangle covers it.
std::vector<DVec3> shown(const std::vector<Vec3>& texels, const Corners& side) {
    Parallel parallel(Execution{});
    const UvTriangles triangles{.uvs = side.uvs};
    const auto size = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(texels.size()))));
    const auto places = findTexelTriangles(triangles, size, size, 0, parallel);
    std::vector<DVec3> directions(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (places->kinds[i] != TexelCoverage::inside) continue;
        const TexelPlace& place = places->places[i];
        CornerFrames frames;
        for (std::size_t c = 0; c < 3; ++c) {
            frames.normals[c] = side.normals[3 * place.triangle + c];
            frames.tangents[c] = side.tangents[3 * place.triangle + c];
        }
        const auto weights = weightsAt(triangles, places->shape, place);
        directions[i] = shadedNormal(shadingFrame(frames, weights, side.reading), decodeTexel(texels[i], side.reading));
    }
    return directions;
}

double mostApart(const std::vector<DVec3>& a, const std::vector<DVec3>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, degreesBetween(a[i], b[i]));
    return most;
}

double meanApart(const std::vector<DVec3>& a, const std::vector<DVec3>& b) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (dot(a[i], a[i]) == 0) continue;
        sum += degreesBetween(a[i], b[i]);
        ++count;
    }
    return sum / count;
}

TEST(ConvertMap, RendersEqualOnTheNewFrames) {
    const Corners from = cornersOf({}), to = cornersOf({.twist = 0.3, .lean = 0.2});
    for (const unsigned bits : {16U, 32U}) {
        const auto texels = randomTexels(kSize * kSize, bits, 1);
        ConvertMapReport report;
        const auto out = converted(texels, from.side(), to.side(), {.bits = bits}, &report);
        const auto wanted = shown(texels, from);
        EXPECT_LT(mostApart(wanted, shown(out, to)), bits == 16 ? 0.002 : 2e-5);
        EXPECT_GT(meanApart(wanted, shown(texels, to)), 9) << "the frames are others";
        EXPECT_NEAR(report.mean_change_deg, meanApart(wanted, shown(texels, to)), 2);
        EXPECT_FALSE(report.is_below_half_step);
        EXPECT_EQ(report.converted + report.background, kSize * kSize);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto size = [&](const Vec3& texel) { return length(decodeTexel(texel, {})); };
            EXPECT_NEAR(size(out[i]), std::min(size(texels[i]), 1.0), 0.0001) << "lengths are kept";
        }
        const auto back = converted(out, to.side(), from.side(), {.bits = bits});
        EXPECT_LT(mostApart(wanted, shown(back, from)), bits == 16 ? 0.004 : 2e-5);
    }
}

RC_GTEST_PROP(ConvertMap, ChangesNothingWhereBothSidesAreTheSame, ()) {
    const auto bits = *rc::gen::element(8U, 16U, 32U);
    Corners side = cornersOf({.twist = *rc::gen::inRange(0, 100) / 50.0, .lean = *rc::gen::inRange(0, 100) / 100.0});
    side.reading.bitangent = *rc::gen::element(BitangentPlace::perPixel, BitangentPlace::perVertex);
    side.reading.two_channels = *rc::gen::arbitrary<bool>();
    side.reading.unit_vectors = *rc::gen::arbitrary<bool>();
    auto texels = randomTexels(kSize * kSize, bits, *rc::gen::inRange(0U, 1000U));
    texels[40] = {0.9f, 0.1f, 0.2f};
    if (bits != 32) texels[40] = {1, 0, 1};
    const auto out = converted(texels, side.side(), side.side(), {.bits = bits});
    RC_ASSERT(out == texels);
    Corners other_order = side;
    std::rotate(other_order.uvs.begin(), other_order.uvs.begin() + 6, other_order.uvs.end());
    std::rotate(other_order.positions.begin(), other_order.positions.begin() + 6, other_order.positions.end());
    std::rotate(other_order.normals.begin(), other_order.normals.begin() + 6, other_order.normals.end());
    std::rotate(other_order.tangents.begin(), other_order.tangents.begin() + 6, other_order.tangents.end());
    RC_ASSERT(converted(texels, side.side(), other_order.side(), {.bits = bits}) == texels);
}

TEST(ConvertMap, InvertsGreenExactly) {
    for (const unsigned bits : {8U, 16U}) {
        const auto most = static_cast<float>((1U << bits) - 1);
        std::vector<Vec3> texels(kSize * kSize);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const auto n = static_cast<float>(i * 61 % static_cast<std::size_t>(most + 1));
            texels[i] = {n / most, n / most, 0.8f};
            texels[i].z = std::floor(0.8f * most) / most;
        }
        Corners down;
        down.reading.green = Green::down;
        const Corners mesh = cornersOf({.begin = -0.5f, .end = 1.5f});
        Corners mesh_down = mesh;
        mesh_down.reading.green = Green::down;
        for (const bool with_mesh : {false, true}) {
            const auto out = with_mesh ? converted(texels, mesh.side(), mesh_down.side(), {.bits = bits})
                                       : converted(texels, Corners{}.side(), down.side(), {.bits = bits});
            for (std::size_t i = 0; i < texels.size(); ++i) {
                EXPECT_EQ(std::lround(out[i].y * most), std::lround(most) - std::lround(texels[i].y * most));
                EXPECT_EQ(out[i].x, texels[i].x);
                EXPECT_EQ(out[i].z, texels[i].z);
            }
        }
    }
}

TEST(ConvertMap, LeavesTheBackgroundAlone) {
    const Corners from = cornersOf({.cells = 3, .begin = 0.3f, .end = 0.6f}),
                  to = cornersOf({.cells = 3, .begin = 0.3f, .end = 0.6f, .twist = 1});
    const auto texels = randomTexels(64 * 64, 32, 3);
    ConvertMapReport report;
    const auto out = converted(texels, from.side(), to.side(), {}, &report);
    const auto in_object = converted(texels, from.side(), {.space = MapSpace::object});
    // Filtering at u and v from 0.3 to 0.6 (of 64 texels) reads columns 18 (whose center is 0.7 texels outside) to 38,
    // and the same rows.
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const std::size_t x = i % 64, y = i / 64;
        const bool is_read = x >= 18 && x <= 38 && y >= 18 && y <= 38;
        EXPECT_EQ(out[i] != texels[i], is_read) << x << " " << y;
        EXPECT_EQ(in_object[i] != texels[i], is_read) << x << " " << y;
    }
    EXPECT_EQ(report.converted, 21u * 21u);
    EXPECT_EQ(report.background, 64u * 64u - 21u * 21u);
    converted(texels, from.side(), to.side(), {.padding = 4}, &report);
    EXPECT_GT(report.converted, 26u * 26u);
}

TEST(ConvertMap, FindsTrianglesInAnyOrderAlsoOnMirroredHalves) {
    const Patch left{.twist = 0.2}, right{.twist = 0.2, .sign = -1, .x_offset = 5};
    const auto both = [](Patch first, Patch second, double twist) {
        first.twist = second.twist = twist;
        Corners corners = cornersOf(first);
        const Corners more = cornersOf(second);
        corners.uvs.insert(corners.uvs.end(), more.uvs.begin(), more.uvs.end());
        corners.positions.insert(corners.positions.end(), more.positions.begin(), more.positions.end());
        corners.normals.insert(corners.normals.end(), more.normals.begin(), more.normals.end());
        corners.tangents.insert(corners.tangents.end(), more.tangents.begin(), more.tangents.end());
        return corners;
    };
    const auto texels = randomTexels(kSize * kSize, 16, 5);
    const Corners from = both(left, right, 0), to = both(left, right, 0.4), swapped = both(right, left, 0.4);
    ConvertMapReport report;
    const auto out = converted(texels, from.side(), to.side(), {}, &report);
    EXPECT_GT(report.overlapping, 500u);
    EXPECT_EQ(converted(texels, from.side(), swapped.side()), out);
    Patch cut_left = left, cut_right = right;
    cut_left.other_diagonal = cut_right.other_diagonal = true;
    const auto cut = converted(texels, from.side(), both(cut_right, cut_left, 0.4).side());
    EXPECT_LT(mostApart(shown(texels, from), shown(cut, both(cut_left, cut_right, 0.4))), 0.01)
        << "quads cut the other way: the same half";
}

TEST(ConvertMap, ConvertsToObjectSpaceAndBack) {
    const Corners mesh = cornersOf({.twist = 0.3, .lean = 0.2});
    const auto texels = randomTexels(kSize * kSize, 16, 6);
    const MapSide object{.space = MapSpace::object};
    const auto in_object = converted(texels, mesh.side(), object);
    const auto wanted = shown(texels, mesh);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (dot(wanted[i], wanted[i]) == 0) continue;
        EXPECT_LT(degreesBetween(decodeTexel(in_object[i], {}), wanted[i]), 0.002);
    }
    EXPECT_LT(mostApart(shown(converted(in_object, object, mesh.side()), mesh), wanted), 0.004);

    // The object is rotated: x of the map points along y of the mesh.
    const std::vector<MapAxes> axes(mesh.uvs.size() / 3, MapAxes{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}});
    MapSide turned = object;
    turned.axes = axes;
    std::vector<Vec3> none(texels.size());
    EXPECT_FALSE(convertMap(imageOf(in_object), object, turned, {}, none).ok()) << "no mesh says where the axes count";
    MapSide with_mesh = turned;
    with_mesh.uvs = mesh.uvs;
    const auto out = converted(in_object, object, with_mesh);
    const std::size_t middle = kSize * kSize / 2 + kSize / 2;
    EXPECT_NEAR(decodeTexel(out[middle], {}).x, decodeTexel(in_object[middle], {}).y, 1e-4);
    EXPECT_NEAR(decodeTexel(out[middle], {}).y, -decodeTexel(in_object[middle], {}).x, 1e-4);
}

// Functions on texels. Filtering mixes neighbors, so they compensate for each other's rounding errors. No length
// changes by more than rounding.
double lengthOf(const Vec3& texel) { return length(2.0 * toDouble(texel) - DVec3{1, 1, 1}); }

DVec3 directionOf(const Vec3& texel) { return (1 / lengthOf(texel)) * (2.0 * toDouble(texel) - DVec3{1, 1, 1}); }

TEST(ConvertMap, RoundsChannelsOfObjectSpaceMapsTogether) {
    const Corners mesh = cornersOf({.twist = 0.3, .lean = 0.2});
    const auto texels = randomTexels(kSize * kSize, 32, 6);
    const MapSide object{.space = MapSpace::object};
    const auto exact = converted(texels, object, mesh.side(), {.bits = 32}),
               out = converted(texels, object, mesh.side());
    const auto rounded = [](float part) { return std::floor(part * 65535 + 0.5f) / 65535; };
    double plain_sum = 0, sum = 0;
    for (std::uint32_t y = 4; y < kSize - 5; ++y) {
        for (std::uint32_t x = 4; x < kSize - 5; ++x) {
            DVec3 plain_off{}, off{};
            for (const std::size_t i :
                 {y * kSize + x, y * kSize + x + 1, (y + 1) * kSize + x, (y + 1) * kSize + x + 1}) {
                const DVec3 wanted = directionOf(exact[i]);
                plain_off =
                    plain_off + directionOf({rounded(exact[i].x), rounded(exact[i].y), rounded(exact[i].z)}) - wanted;
                off = off + directionOf(out[i]) - wanted;
                for (const float part : {out[i].x, out[i].y, out[i].z}) EXPECT_EQ(part, rounded(part));
                EXPECT_NEAR(lengthOf(out[i]), lengthOf(exact[i]), 0.01)
                    << "a little longer or shorter, to point better";
            }
            plain_sum += dot(plain_off, plain_off);
            sum += dot(off, off);
        }
    }
    EXPECT_LT(sum, 0.15 * plain_sum);
}

/// Returns texels with length 1, tilted by up to 20 degrees, whose neighbors are nearly equal.
std::vector<Vec3> gentleTexels() {
    std::vector<Vec3> texels;
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const double x = i % kSize, y = i / kSize;
        const Vec3 v = unit({0.3 * std::sin(0.05 * x), 0.2 * std::cos(0.04 * y + 0.02 * x), 1});
        texels.push_back({0.5f * (v.x + 1), 0.5f * (v.y + 1), 0.5f * (v.z + 1)});
    }
    return texels;
}

/// Returns the map converted without rounding and then rounded to 8 bits, each channel independently.
std::vector<Vec3> roundedPlainly(const std::vector<Vec3>& texels, const Corners& from, const Corners& to) {
    auto rounded = converted(texels, from.side(), to.side(), {.bits = 32});
    const auto round = [](float part) { return std::floor(part * 255 + 0.5f) / 255; };
    for (Vec3& texel : rounded) texel = {round(texel.x), round(texel.y), round(texel.z)};
    return rounded;
}

TEST(ConvertMap, ChoosesTheBestLengthsWithEightBits) {
    const Corners from = cornersOf({}), to = cornersOf({.twist = 0.3, .lean = 0.2});
    const auto texels = gentleTexels();
    const auto wanted = shown(texels, from);
    const auto best = converted(texels, from.side(), to.side(), {.bits = 8});
    EXPECT_LT(meanApart(wanted, shown(best, to)), 0.5 * meanApart(wanted, shown(roundedPlainly(texels, from, to), to)));
    for (const Vec3& texel : best) EXPECT_GE(length(decodeTexel(texel, {})), 0.69);
}

/// Returns the mean angle between the mean vectors of n x n texels of two maps, over blocks in the part that the mesh
/// covers.
double meansApart(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::uint32_t n) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t y = 4; y + n <= kSize - 4; y += n) {
        for (std::uint32_t x = 4; x + n <= kSize - 4; x += n) {
            DVec3 of_a{}, of_b{};
            for (std::uint32_t i = 0; i < n * n; ++i) {
                const std::size_t texel = std::size_t{y + i / n} * kSize + x + i % n;
                of_a = of_a + decodeTexel(a[texel], {});
                of_b = of_b + decodeTexel(b[texel], {});
            }
            sum += degreesBetween(of_a, of_b);
            ++count;
        }
    }
    return sum / count;
}

// As in baked maps, `even` lengths give 8-bit maps smaller direction errors in mip levels than `free` lengths.
TEST(ConvertMap, EvenLengthsHaveSmallerErrorsInMipLevels) {
    const Corners from = cornersOf({}), to = cornersOf({.twist = 0.3, .lean = 0.2});
    const auto texels = gentleTexels(), exact = converted(texels, from.side(), to.side(), {.bits = 32});
    const auto even = converted(texels, from.side(), to.side(), {.bits = 8}),
               free = converted(texels, from.side(), to.side(), {.bits = 8, .lengths = TexelLengths::free});
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (even[i] == texels[i]) continue;
        EXPECT_TRUE(lengthOf(even[i]) > 0.8999 && lengthOf(even[i]) < 1.0001) << lengthOf(even[i]);
        EXPECT_TRUE(lengthOf(free[i]) > 0.6999 && lengthOf(free[i]) < 1.1001) << lengthOf(free[i]);
    }
    EXPECT_LT(meansApart(exact, even, 4), 0.8 * meansApart(exact, free, 4));
    EXPECT_LT(meansApart(exact, free, 1), 0.8 * meansApart(exact, even, 1));
}

// Neighbors compensate for each other's rounding errors under filtering, whichever axis the vectors are near.
TEST(ConvertMap, ChoosesIntegersOfEightBitsTogether) {
    const MapAxes turns[] = {
        {}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
    const Corners mesh = cornersOf({.twist = 0.3, .lean = 0.2});
    const auto texels = gentleTexels();
    for (const MapAxes& turn : turns) {
        const std::vector<MapAxes> axes(mesh.uvs.size() / 3, turn);
        const MapSide object{.space = MapSpace::object, .axes = axes};
        const auto exact = converted(texels, mesh.side(), object, {.bits = 32}),
                   out = converted(texels, mesh.side(), object, {.bits = 8, .lengths = TexelLengths::free});
        std::vector<Vec3> alone = exact;
        for (Vec3& texel : alone) {
            DVec3 direction = decodeTexel(texel, {});
            normalize(direction);
            texel = toFloat(0.5 * (nearestIntegers({}, direction) + DVec3{1, 1, 1}));
        }
        EXPECT_LT(meansApart(exact, out, 2), 0.75 * meansApart(exact, alone, 2));
    }
}

// Filtering weights texels by their lengths. If neighbors differ in direction, a changed length causes an error between
// them.
TEST(ConvertMap, KeepsLengthsWithEightBitsWhereNeighborsPointElsewhere) {
    const Corners from = cornersOf({}), to = cornersOf({.twist = 0.3, .lean = 0.2});
    const auto texels = randomTexels(kSize * kSize, 16, 7);
    const auto wanted = shown(texels, from);
    const auto best = converted(texels, from.side(), to.side(), {.bits = 8});
    EXPECT_LT(meanApart(wanted, shown(best, to)), meanApart(wanted, shown(roundedPlainly(texels, from, to), to)));
    for (std::size_t i = 0; i < best.size(); ++i) {
        EXPECT_NEAR(length(decodeTexel(best[i], {})), length(decodeTexel(texels[i], {})), 0.05);
    }
}

TEST(ConvertMap, GivesTwoChannelsUnitVectors) {
    Corners from = cornersOf({}), to = cornersOf({.twist = 0.3, .lean = 0.2});
    to.reading.two_channels = true;
    const auto texels = randomTexels(kSize * kSize, 16, 8);
    for (const unsigned bits : {8U, 16U}) {
        const auto out = converted(texels, from.side(), to.side(), {.bits = bits});
        EXPECT_LT(mostApart(shown(texels, from), shown(out, to)), bits == 16 ? 0.01 : 2.0);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (out[i] == texels[i]) continue;
            EXPECT_NEAR(length(decodeTexel(out[i], {})), 1, bits == 16 ? 1e-4 : 0.02);
        }
    }
    MapReading down;
    const auto below = converted(std::vector<Vec3>(16, Vec3{0.9f, 0.5f, 0.2f}), {}, {.reading = to.reading});
    EXPECT_NEAR(below[0].x, 1, 1e-4) << "what looks down gets the horizon";
}

TEST(ConvertMap, NeverMakesNan) {
    Corners from = cornersOf({}), to = cornersOf({.twist = 0.3});
    for (std::size_t i = 0; i < 12; ++i) to.tangents[i] = {to.normals[i].x, to.normals[i].y, to.normals[i].z, 1};
    for (std::size_t i = 12; i < 24; ++i) to.normals[i].x = NAN;
    for (std::size_t i = 24; i < 36; ++i) from.tangents[i] = {};
    for (std::size_t i = 36; i < 42; ++i) from.uvs[i] = {0.5f, 0.5f};
    for (std::size_t i = 42; i < 45; ++i) from.uvs[i].x = INFINITY;
    auto texels = randomTexels(kSize * kSize, 32, 9);
    texels[kSize * 20 + 9] = {0.5f, 0.5f, 0.5f};
    ConvertMapReport report;
    const auto out = converted(texels, from.side(), to.side(), {}, &report);
    for (const Vec3& texel : out) EXPECT_TRUE(isFinite(texel));
    EXPECT_GT(report.without_frame, 50u);
    EXPECT_GE(report.degenerate_uv_count, 1u);
    EXPECT_EQ(report.bad_uv_count, 1u);
}

TEST(ConvertMap, ReportsWhenRoundingCancelsTheChange) {
    const Corners from = cornersOf({}), to = cornersOf({.twist = 0.001});
    ConvertMapReport report;
    converted(randomTexels(kSize * kSize, 16, 10), from.side(), to.side(), {.bits = 8}, &report);
    EXPECT_TRUE(report.is_below_half_step);
    EXPECT_NEAR(report.half_step_deg, 0.2247, 0.0001);
    converted(randomTexels(kSize * kSize, 16, 10), from.side(), to.side(), {.bits = 16}, &report);
    EXPECT_FALSE(report.is_below_half_step);
}

TEST(ConvertMap, GivesTheSameTexelsForAnyNumberOfThreads) {
    const Corners from = cornersOf({}), to = cornersOf({.twist = 0.3, .other_diagonal = true});
    const auto texels = randomTexels(200 * 200, 16, 11);
    ConvertMapReport one, four;
    const auto a = converted(texels, from.side(), to.side(), {.padding = 9}, &one);
    const auto b = converted(texels, from.side(), to.side(), {.padding = 9}, &four, {.thread_count = 4});
    EXPECT_EQ(a, b);
    EXPECT_EQ(one.mean_change_deg, four.mean_change_deg);
    const MapSide object{.space = MapSpace::object};
    EXPECT_EQ(converted(texels, object, to.side()),
              converted(texels, object, to.side(), {}, nullptr, {.thread_count = 4}));
}

TEST(ConvertMap, StopsWhenAskedTo) {
    const auto texels = randomTexels(16, 16, 12);
    std::vector<Vec3> out(16);
    const auto cancel = [](const char*, std::uint64_t, std::uint64_t) { throw Cancelled{}; };
    const auto stopped = convertMap({4, 4, texels}, {}, {}, {}, out, {}, cancel);
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(ConvertMap, RejectsInvalidArguments) {
    const auto texels = randomTexels(16, 16, 12);
    std::vector<Vec3> out(16);
    const auto codeOf = [&](const MapSide& from, const MapSide& to, const ConvertMapOptions& options = {}) {
        const auto done = convertMap({4, 4, texels}, from, to, options, out);
        return done ? ErrorCode::ok : done.error().code;
    };
    const Corners mesh = cornersOf({});
    EXPECT_EQ(codeOf({}, {}), ErrorCode::ok);
    EXPECT_EQ(codeOf({}, {}, {.bits = 12}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({}, {.space = MapSpace::object}), ErrorCode::missingAttribute);
    EXPECT_EQ(codeOf({.space = MapSpace::object}, {}), ErrorCode::missingAttribute);
    EXPECT_EQ(codeOf({}, {.reading = *findMapReading("three")}), ErrorCode::missingAttribute);
    EXPECT_EQ(codeOf(mesh.side(), {.reading = *findMapReading("three")}), ErrorCode::ok);
    EXPECT_EQ(codeOf({.reading = {.scale = 0}}, {}), ErrorCode::invalidOption);
    MapSide side = mesh.side();
    side.tangents = {};
    EXPECT_EQ(codeOf(side, mesh.side()), ErrorCode::missingAttribute);
    side = mesh.side();
    side.normals.count -= 1;
    EXPECT_EQ(codeOf(mesh.side(), side), ErrorCode::countMismatch);
    EXPECT_FALSE(convertMap({4, 5, texels}, {}, {}, {}, out).ok());
    EXPECT_FALSE(convertMap({0, 5, {}}, {}, {}, {}, {}).ok());
}

RC_GTEST_PROP(NearestIntegers, AreAsAccurateAsAnyOfSufficientLength, ()) {
    const auto part = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    DVec3 direction{part(), part(), part()};
    RC_PRE(normalize(direction));
    const unsigned most = 15;
    const DVec3 found = nearestIntegers({.most = most}, direction);
    double least = INFINITY;
    for (unsigned i = 0; i < 16 * 16 * 16; ++i) {
        const auto value = [&](unsigned n) { return 2.0 * n / most - 1; };
        const DVec3 candidate{value(i % 16), value(i / 16 % 16), value(i / 256)};
        const double size = length(candidate);
        if (size >= 0.7 && size <= 1) least = std::min(least, degreesBetween(candidate, direction));
    }
    RC_ASSERT(length(found) >= 0.7 && length(found) <= 1.0000001);
    RC_ASSERT(degreesBetween(found, direction) <= least + 1e-6);
}

}  // namespace
}  // namespace tspace::test
