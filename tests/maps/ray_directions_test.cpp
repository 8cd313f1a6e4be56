// SPDX-License-Identifier: MIT
// Directions of rays: hard edges, shells on flat faces, painted skew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake_cases.h"
#include "core/base/vec_math.h"
#include "tspace/maps.h"

namespace tspace::test {
namespace {

using bench::HighMesh;
using bench::LowMesh;

/// Returns a point on a face of the box from -1 to 1. s and t, from 0 to 1, run to the right and upward, seen from
/// outside.
Vec3 onSide(int side, float s, float t) {
    const float a = 2 * s - 1, b = 2 * t - 1;
    const Vec3 at[6] = {{1, a, b}, {-1, -a, b}, {-a, 1, b}, {a, -1, b}, {a, b, 1}, {-a, b, -1}};
    return at[side];
}

constexpr Vec3 kSides[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

/// Returns a box with hard edges and one chart per face.
LowMesh box() {
    LowMesh low;
    for (int side = 0; side < 6; ++side) {
        constexpr float kCorners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
        for (const auto& [s, t] : kCorners) {
            low.positions.push_back(onSide(side, s, t));
            low.normals.push_back(kSides[side]);
            low.uvs.push_back({(static_cast<float>(side % 3) + 0.1F + 0.8F * s) / 3,
                               (static_cast<float>(side / 3) + 0.9F - 0.8F * t) / 2});
        }
    }
    low.tangents.resize(low.positions.size());
    const MeshView mesh{.positions = low.view().positions, .normals = low.view().normals, .uvs = low.view().uvs};
    EXPECT_TRUE(generateTangents(mesh, {.convention = conventions::gltf}, {.tangents = low.tangents}));
    return low;
}

/// Adds a box with rounded edges.
void addRound(HighMesh& high, const Vec3& center, const Vec3& half, float radius, std::uint32_t cells) {
    for (int side = 0; side < 6; ++side) {
        const auto first = static_cast<std::uint32_t>(high.positions.size());
        for (std::uint32_t y = 0; y <= cells; ++y) {
            for (std::uint32_t x = 0; x <= cells; ++x) {
                // Points are denser toward the edges, where the surface bends.
                const auto spread = [&](std::uint32_t i) {
                    const float part = static_cast<float>(i) / static_cast<float>(cells);
                    return part * part * (3 - 2 * part);
                };
                const Vec3 unit = onSide(side, spread(x), spread(y));
                const Vec3 at{unit.x * half.x, unit.y * half.y, unit.z * half.z};
                const auto inner = [&](float value, float most) {
                    return std::clamp(value, radius - most, most - radius);
                };
                const Vec3 core{inner(at.x, half.x), inner(at.y, half.y), inner(at.z, half.z)};
                DVec3 out = toDouble(at - core);
                normalize(out);
                high.positions.push_back(center + core + radius * toFloat(out));
                high.normals.push_back(toFloat(out));
            }
        }
        for (std::uint32_t y = 0; y < cells; ++y) {
            for (std::uint32_t x = 0; x < cells; ++x) {
                const std::uint32_t a = first + y * (cells + 1) + x, b = a + cells + 1;
                for (const std::uint32_t vertex : {a, a + 1, b + 1, a, b + 1, b}) high.corners.push_back(vertex);
            }
        }
    }
}

constexpr float kStudHeight = 0.12F;

/// Returns the box with rounded edges, optionally with a stud on its top as a separate shell.
HighMesh roundedBox(bool has_stud, float stud_at = 0) {
    HighMesh high;
    addRound(high, {}, {1, 1, 1}, 0.2F, 40);
    if (has_stud) addRound(high, {stud_at, 0, 1}, {0.4F, 0.4F, kStudHeight}, kStudHeight, 24);
    return high;
}

class RayDirectionsTest : public testing::Test {
  protected:
    void SetUp() override {
        const Result<BakedMap> map = bakeMap(box().view(), roundedBox(false).view(), options({}));
        if (!map && map.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << map.error().message;
    }
    static BakeOptions options(const RayOptions& rays) {
        return {.width = 192, .height = 128, .fit = MapFit::texel, .reach = 0.2, .rays = rays};
    }
    static BakedMap baked(const LowPoly& low, const HighPoly& high, const BakeOptions& options) {
        Result<BakedMap> map = bakeMap(low, high, options);
        EXPECT_TRUE(map) << map.error().message;
        return map ? std::move(*map) : BakedMap{};
    }
    static BakedMap baked(const HighMesh& high, const RayOptions& rays) {
        return baked(box().view(), high.view(), options(rays));
    }
    /// Returns the number of texels inside charts whose normals are tilted by more than 30 degrees.
    static int leaningTexels(const BakedMap& map) {
        int count = 0;
        for (std::size_t i = 0; i < map.texels.size(); ++i)
            count += map.origins[i] == TexelOrigin::hit && map.texels[i].z < 0.93F ? 1 : 0;
        return count;
    }
};

/// If positions at the corner of the box differ only by rounding, its faces still use the same rays there.
TEST_F(RayDirectionsTest, PositionsThatDifferOnlyByRoundingAreWelded) {
    const HighMesh high = roundedBox(false);
    LowMesh nudged = box();
    for (std::size_t i = 6; i < 12; ++i) nudged.positions[i].x = std::nextafter(nudged.positions[i].x, 2.0F);
    for (const RayDirections directions : {RayDirections::automatic, RayDirections::averaged}) {
        const BakedMap equal = baked(high, {.directions = directions});
        const BakedMap near = baked(nudged.view(), high.view(), options({.directions = directions}));
        EXPECT_EQ(near.missed_count, equal.missed_count);
        ASSERT_EQ(near.texels.size(), equal.texels.size());
        for (std::size_t i = 0; i < near.texels.size(); ++i) {
            const Vec3 apart = near.texels[i] - equal.texels[i];
            ASSERT_LT(std::max({std::fabs(apart.x), std::fabs(apart.y), std::fabs(apart.z)}), 1e-3F) << i;
        }
        const RayOptions exact{.directions = directions, .weld_distance = 0};
        EXPECT_GT(baked(nudged.view(), high.view(), options(exact)).missed_count, equal.missed_count);
    }
    BakeOptions wrong = options({.weld_distance = -2});
    EXPECT_EQ(bakeMap(box().view(), high.view(), wrong).error().code, ErrorCode::invalidOption);
}

TEST_F(RayDirectionsTest, NothingIsMissedAtHardEdges) {
    const HighMesh high = roundedBox(false);
    EXPECT_GT(baked(high, {.directions = RayDirections::normals}).missed_count, 0U);
    for (const RayDirections directions : {RayDirections::automatic, RayDirections::averaged}) {
        BakeOptions solved = options({.directions = directions});
        solved.width = 384;
        solved.height = 256;
        solved.fit = MapFit::solve;
        const BakedMap map = baked(box().view(), high.view(), solved);
        EXPECT_EQ(map.missed_count, 0U);
        EXPECT_EQ(map.error.missed_count, 0U);
        EXPECT_LT(map.error.seam_mean_deg, 0.05);
    }
}

TEST_F(RayDirectionsTest, ShellsOnAFaceAreSeenFromOutside) {
    const HighMesh high = roundedBox(true);
    const BakedMap plain = baked(roundedBox(false), {}), outermost = baked(high, {});
    const BakedMap nearest = baked(high, {.target = RayTarget::nearest});
    EXPECT_GT(leaningTexels(outermost), leaningTexels(plain) + 30) << "the sides of the stud";
    // With the nearest hits, the rays find the base below the stud, although another surface is visible.
    EXPECT_GT(nearest.error.mean_deg, 2 * nearest.own_error.mean_deg);
    EXPECT_LT(outermost.error.mean_deg, 0.8 * nearest.error.mean_deg);
    EXPECT_GT(nearest.own_error.hidden_count, 500U);
    EXPECT_EQ(outermost.error.hidden_count, 0U);
    EXPECT_EQ(outermost.own_error.point_count, 0U) << "only where it differs";
}

TEST_F(RayDirectionsTest, BeyondTheCageTheNearestFrontFaceIsUsed) {
    const HighMesh high = roundedBox(true);
    const BakedMap whole = baked(high, {}), low = baked(high, {.cage_offset = 0.02});
    EXPECT_LT(leaningTexels(low), leaningTexels(whole)) << "the cage lies inside of the stud";
    EXPECT_GT(low.error.hidden_count, 500U);
    EXPECT_NEAR(low.error.cage_offset, 0.02, 1e-12);
    EXPECT_NEAR(whole.error.cage_offset, 0.2, 1e-12) << "as the reach";
    // The high poly is larger than the cage, so no surface is inside the cage.
    HighMesh larger = roundedBox(false);
    for (Vec3& at : larger.positions) at = 1.1F * at;
    EXPECT_EQ(baked(larger, {.cage_offset = 0.02}).missed_count, 0U);
}

TEST_F(RayDirectionsTest, DetailOnFlatFacesIsNotSkewed) {
    // Far from the center of the box, averaged rays are tilted by 30 degrees, so they hit only one side of the stud.
    const HighMesh high = roundedBox(true, 0.5F);
    const int automatic = leaningTexels(baked(high, {})),
              averaged = leaningTexels(baked(high, {.directions = RayDirections::averaged})),
              base = leaningTexels(baked(roundedBox(false), {})),
              averaged_base = leaningTexels(baked(roundedBox(false), {.directions = RayDirections::averaged}));
    EXPECT_LT(automatic - base, (averaged - averaged_base) / 2);
}

TEST_F(RayDirectionsTest, ASkewMapBlendsAveragedAndStraightRays) {
    const HighMesh high = roundedBox(true, 0.5F);
    const std::vector<Vec3> black(4), white(4, Vec3{1, 1, 1});
    const BakedMap averaged = baked(high, {.directions = RayDirections::averaged}),
                   normals = baked(high, {.directions = RayDirections::normals});
    EXPECT_TRUE(baked(high, {.skew = {2, 2, black}}).texels == averaged.texels);
    // On flat faces the stored normals equal those of the triangles.
    EXPECT_TRUE(baked(high, {.skew = {2, 2, white}}).texels == normals.texels);
    const Result<BakedMap> broken = bakeMap(box().view(), high.view(), options({.skew = {3, 2, black}}));
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ErrorCode::countMismatch);
}

TEST_F(RayDirectionsTest, AMeshInPartsIsBakedAsTheWhole) {
    const LowMesh low = box();
    const HighMesh high = roundedBox(true);
    const BakedMap whole = baked(high, {});
    const std::size_t cut = 3 * 4;  // corners of two faces, which are baked separately
    for (const bool has_rest : {true, false}) {
        LowMesh part = low, rest = low;
        const auto split = [&](auto& shown, auto& hidden) {
            shown.erase(shown.begin() + static_cast<std::ptrdiff_t>(cut), shown.end());
            hidden.erase(hidden.begin(), hidden.begin() + static_cast<std::ptrdiff_t>(cut));
        };
        split(part.positions, rest.positions);
        split(part.normals, rest.normals);
        split(part.tangents, rest.tangents);
        split(part.uvs, rest.uvs);
        LowPoly view = part.view();
        if (has_rest) {
            view.rest_positions = rest.positions;
            view.rest_normals = rest.normals;
        }
        BakeOptions these = options({});
        these.padding = 0;
        const BakedMap map = baked(view, high.view(), these);
        std::size_t different = 0;
        for (std::size_t i = 0; i < map.texels.size(); ++i) {
            if (map.origins[i] == TexelOrigin::hit) different += map.texels[i] == whole.texels[i] ? 0 : 1;
        }
        if (has_rest) {
            EXPECT_EQ(different, 0U);
        } else {
            EXPECT_GT(different, 0U) << "the edge to the rest";
        }
    }
}

TEST_F(RayDirectionsTest, BothSidesOfALeafKeepTheirOwn) {
    // The mean of opposite normals is zero, so it has no direction.
    LowMesh leaf;
    for (const float side : {1.0F, -1.0F}) {
        const Vec3 at[3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
        for (const int i : {0, 1, 2}) {
            leaf.positions.push_back(at[side > 0 ? i : 2 - i]);
            leaf.normals.push_back({0, 0, side});
            leaf.uvs.push_back(
                {0.25F - 0.2F * side * (leaf.positions.back().x), 0.5F + 0.4F * leaf.positions.back().y});
        }
    }
    HighMesh high;
    addRound(high, {}, {1, 1, 0.02F}, 0.01F, 12);
    BakeOptions these = options({.directions = RayDirections::averaged});
    these.space = MapSpace::object;
    EXPECT_EQ(baked(leaf.view(), high.view(), these).missed_count, 0U);
}

TEST_F(RayDirectionsTest, PointsThatMissCountAsARightAngle) {
    HighMesh high = roundedBox(false);
    // Remove the flat part of the top.
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < high.corners.size(); i += 3) {
        const bool is_top = high.normals[high.corners[i]].z > 0.99F;
        if (!is_top) kept.insert(kept.end(), &high.corners[i], &high.corners[i] + 3);
    }
    high.corners = kept;
    const MapError error = baked(high, {}).error;
    const auto missed = static_cast<double>(error.missed_count), met = static_cast<double>(error.point_count);
    EXPECT_NEAR(missed / (missed + met), 0.8 * 0.8 / 6, 0.01);
    EXPECT_NEAR(error.mean_deg, (kMissedDeg * missed + error.met_mean_deg * met) / (missed + met), 1e-6);
    EXPECT_EQ(error.p99_deg, kMissedDeg);
    EXPECT_LT(error.met_mean_deg, 1);
}

TEST_F(RayDirectionsTest, BacksArePassedThroughAndCounted) {
    const HighMesh plain = roundedBox(false);
    EXPECT_EQ(baked(plain, {}).error.back_count, 0U);
    HighMesh turned = plain;
    for (std::size_t i = 0; i < turned.corners.size(); i += 3) std::swap(turned.corners[i], turned.corners[i + 1]);
    const Result<MapError> error =
        measureMap(MapImage{1, 1, std::span<const Vec3>(kSides, 1)}, box().view(), turned.view(), {.reach = 0.2});
    ASSERT_TRUE(error);
    EXPECT_EQ(error->point_count, 0U);
    EXPECT_EQ(error->back_count, error->missed_count);
    EXPECT_EQ(error->mean_deg, kMissedDeg);
}

TEST_F(RayDirectionsTest, RejectsInvalidLengths) {
    for (const double wrong : {-1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        const Result<BakedMap> map = bakeMap(box().view(), roundedBox(false).view(), options({.cage_offset = wrong}));
        ASSERT_FALSE(map);
        EXPECT_EQ(map.error().code, ErrorCode::invalidOption);
    }
}

}  // namespace
}  // namespace tspace::test
