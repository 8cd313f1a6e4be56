// SPDX-License-Identifier: MIT
// heightToNormal compared with formulas, without a mesh and on meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/vec_math.h"
#include "maps/texels/shading.h"
#include "tspace/maps.h"

namespace tspace::test {
namespace {

constexpr std::uint32_t kSize = 64;

struct Made {
    std::vector<Vec3> texels = std::vector<Vec3>(std::size_t{kSize} * kSize);
    HeightToNormalReport report = {};

    [[nodiscard]] DVec3 at(std::uint32_t column, std::uint32_t row) const {
        return decodeTexel(texels[row * kSize + column], {});
    }
};

template <class Height>
Made make(const Height& height, const MapSide& mesh, HeightToNormalOptions options,
          TextureWrap wrap = TextureWrap::repeat, const Execution& execution = {}) {
    std::vector<float> heights;
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column)
            heights.push_back(static_cast<float>(height((column + .5) / kSize, (row + .5) / kSize)));
    }
    Made made;
    const auto report = heightToNormal({kSize, kSize, heights, wrap, wrap}, mesh, options, made.texels, execution);
    EXPECT_TRUE(report) << report.error().message;
    if (report) made.report = *report;
    return made;
}

/// Returns the height of waves, from 0 to 1, that repeat at the borders of the image.
double waves(double u, double v) {
    return .5 + .25 * std::sin(2 * std::numbers::pi * (2 * u + v)) + .25 * std::cos(2 * std::numbers::pi * (3 * v - u));
}
double wavesU(double u, double v) {
    return .5 * std::numbers::pi *
           (2 * std::cos(2 * std::numbers::pi * (2 * u + v)) + std::sin(2 * std::numbers::pi * (3 * v - u)));
}
double wavesV(double u, double v) {
    return .5 * std::numbers::pi *
           (std::cos(2 * std::numbers::pi * (2 * u + v)) - 3 * std::sin(2 * std::numbers::pi * (3 * v - u)));
}

TEST(HeightToNormal, IsExactForPlanesAndParabolasUpToTheBordersOfAClampedImage) {
    // The slopes per texel are 1 to the right and 0.5 downward; the second surface also has a curvature of 1.5.
    for (const double curved : {0.0, 1.5}) {
        const auto height = [&](double u, double v) { return .5 * u + .25 * v + curved * (u * u - v * v + u * v); };
        const Made made = make(height, {}, {.strength = 128, .bits = 32}, TextureWrap::clamp);
        for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
            const double u = (i % kSize + .5) / kSize, v = (i / kSize + .5) / kSize;
            const double du = .5 + curved * (2 * u + v), dv = .25 + curved * (u - 2 * v);
            EXPECT_LT(degreesBetween(made.at(i % kSize, i / kSize), {-128 * du / kSize, 128 * dv / kSize, 1}), 2e-2)
                << i % kSize << ' ' << i / kSize;
        }
    }
}

/// At the border of a clamped tile, slopes are close to those of the whole image from which the tile was cut. Mirrored
/// and repeated borders are unchanged.
TEST(HeightToNormal, GivesTheSlopesOfWavesAtClampedBorders) {
    const Made made = make(waves, {}, {.strength = 10, .bits = 32}, TextureWrap::clamp);
    for (std::uint32_t i = 0; i < kSize; ++i) {
        for (const auto& [column, row] : {std::pair{0U, i}, {kSize - 1, i}, {i, 0U}, {i, kSize - 1}}) {
            const double u = (column + .5) / kSize, v = (row + .5) / kSize;
            const DVec3 wanted{-10 * wavesU(u, v) / kSize, 10 * wavesV(u, v) / kSize, 1};
            EXPECT_LT(degreesBetween(made.at(column, row), wanted), 1.2) << column << ' ' << row;
        }
    }
}

TEST(HeightToNormal, AcceptsImagesOfOneOrTwoTexels) {
    const std::vector<float> heights{0, 1, 2, 3};
    const auto slopes = [&](std::uint32_t width, std::uint32_t height, TextureWrap wrap) {
        std::vector<Vec3> out(std::size_t{width} * height);
        const std::span<const float> used = std::span(heights).first(out.size());
        EXPECT_TRUE(heightToNormal({width, height, used, wrap, wrap}, {}, {.bits = 32}, out));
        DVec3 n = decodeTexel(out.front(), {});
        return std::pair{-n.x / n.z, n.y / n.z};
    };
    const auto expectSlopes = [](std::pair<double, double> made, double across, double down) {
        EXPECT_NEAR(made.first, across, 1e-6);
        EXPECT_NEAR(made.second, down, 1e-6);
    };
    expectSlopes(slopes(1, 1, TextureWrap::clamp), 0, 0);
    expectSlopes(slopes(4, 1, TextureWrap::clamp), 1, 0);
    expectSlopes(slopes(1, 4, TextureWrap::clamp), 0, 1);
    expectSlopes(slopes(2, 1, TextureWrap::clamp), 1, 0);
    expectSlopes(slopes(2, 2, TextureWrap::clamp), 1, 2);
    expectSlopes(slopes(2, 2, TextureWrap::repeat), 0, 0);
}

TEST(HeightToNormal, GivesTheSlopesOfWavesAcrossTheBorders) {
    for (const unsigned bits : {8U, 16U, 32U}) {
        const Made made = make(waves, {}, {.strength = 10, .bits = bits});
        for (std::uint32_t i = 0; i < kSize; ++i) {
            const std::uint32_t column = (i * 7) % kSize;
            const double u = (column + .5) / kSize, v = (i + .5) / kSize;
            const DVec3 wanted{-10 * wavesU(u, v) / kSize, 10 * wavesV(u, v) / kSize, 1};
            EXPECT_LT(degreesBetween(made.at(column, i), wanted), bits == 8 ? 1.2 : 0.9) << column << ' ' << i;
        }
        EXPECT_GT(made.report.max_lean_deg, made.report.mean_lean_deg);
    }
}

TEST(HeightToNormal, InvertsGreenAndHeights) {
    const Made up = make(waves, {}, {.strength = 4, .bits = 32});
    const Made down = make(waves, {}, {.strength = 4, .green = Green::down, .bits = 32});
    const Made deep = make(waves, {}, {.strength = -4, .bits = 32});
    for (std::size_t i = 0; i < up.texels.size(); i += 13) {
        EXPECT_NEAR(down.texels[i].y, 1 - up.texels[i].y, 1e-6);
        EXPECT_NEAR(deep.texels[i].x, 1 - up.texels[i].x, 1e-6);
        EXPECT_NEAR(deep.texels[i].y, 1 - up.texels[i].y, 1e-6);
    }
}

/// A parallelogram in space whose UVs cover the whole image, with exact frames. `mirror`: u points in the opposite
/// direction.
struct Sheet {
    DVec3 along_u{3, 0, 0}, along_v{1, -2, 0};  // v runs down
    std::vector<Vec2> uvs = {};
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec4> tangents = {};

    explicit Sheet(bool mirror) {
        if (mirror) along_u = -1 * along_u;
        for (const Vec2 uv : {Vec2{0, 0}, Vec2{0, 1}, Vec2{1, 1}, Vec2{0, 0}, Vec2{1, 1}, Vec2{1, 0}}) {
            uvs.push_back(uv);
            const DVec3 place = static_cast<double>(uv.x) * along_u + static_cast<double>(uv.y) * along_v;
            positions.push_back(toFloat(place));
            normals.push_back({0, 0, 1});
            tangents.push_back({mirror ? -1.0F : 1.0F, 0, 0, mirror ? -1.0F : 1.0F});
        }
    }
    [[nodiscard]] MapSide side() const {
        return {.uvs = uvs, .normals = normals, .tangents = tangents, .positions = positions};
    }
};

/// The strength is in units of the mesh, also for skewed and mirrored UVs: the normal is that of the surface displaced
/// by the heights.
TEST(HeightToNormal, GivesTheNormalsOfTheRaisedSurface) {
    for (const bool mirror : {false, true}) {
        const Sheet sheet(mirror);
        const double strength = .3;
        const Made made = make(waves, sheet.side(), {.strength = strength, .bits = 16});
        EXPECT_EQ(made.report.on_mesh, std::uint64_t{kSize} * kSize);
        EXPECT_NEAR(made.report.texel_size, std::sqrt(6.0) / kSize, 1e-4);
        for (std::uint32_t i = 0; i < kSize; ++i) {
            const std::uint32_t column = (i * 11) % kSize;
            const double u = (column + .5) / kSize, v = (i + .5) / kSize;
            DVec3 wanted = cross(sheet.along_u + DVec3{0, 0, strength * wavesU(u, v)},
                                 sheet.along_v + DVec3{0, 0, strength * wavesV(u, v)});
            if (wanted.z < 0) wanted = -1 * wanted;
            const Vec4 t = sheet.tangents[0];
            const DVec3 tangent{t.x, t.y, t.z}, normal{0, 0, 1};
            const ShadingFrame frame{tangent, static_cast<double>(t.w) * cross(normal, tangent), normal};
            EXPECT_LT(degreesBetween(shadedNormal(frame, made.at(column, i)), wanted), 0.7)
                << mirror << column << ' ' << i;
        }
    }
}

TEST(HeightToNormal, GivesTheSameBitsForAnyNumberOfThreads) {
    const Sheet sheet(false);
    const Made one = make(waves, sheet.side(), {.strength = .3});
    const Made four = make(waves, sheet.side(), {.strength = .3}, TextureWrap::repeat, {.thread_count = 4});
    EXPECT_EQ(four.texels, one.texels);
}

TEST(HeightToNormal, RejectsInvalidArguments) {
    const std::vector<float> heights(16);
    std::vector<Vec3> out(16);
    EXPECT_EQ(heightToNormal({4, 5, heights}, {}, {}, out).error().code, ErrorCode::countMismatch);
    EXPECT_EQ(heightToNormal({0, 0, {}}, {}, {}, {}).error().code, ErrorCode::tooLarge);
    EXPECT_EQ(heightToNormal({4, 4, heights}, {}, {.bits = 12}, out).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(heightToNormal({4, 4, heights}, {}, {.strength = std::nan("")}, out).error().code,
              ErrorCode::invalidOption);
    const std::vector<Vec2> uvs(3);
    EXPECT_EQ(heightToNormal({4, 4, heights}, {.uvs = uvs}, {}, out).error().code, ErrorCode::missingAttribute);
}

}  // namespace
}  // namespace tspace::test
