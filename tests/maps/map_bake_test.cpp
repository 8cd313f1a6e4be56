// SPDX-License-Identifier: MIT
// Tests of baked maps: accuracy, and handling of invalid input.
#include "tspace/maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include "bake_cases.h"
#include "core/base/vec_math.h"
#include "maps/rays/map_surfaces.h"
#include "support/thread_team.h"

#ifdef TSPACE_HAS_TBB
#include <tbb/global_control.h>
#endif

namespace tspace::test {
namespace {

using bench::Charts;
using bench::HighMesh;
using bench::LowMesh;

const accuracy::Surface& surfaceNamed(const char* name) {
    for (const accuracy::Surface& surface : accuracy::surfaces()) {
        if (std::strcmp(surface.name, name) == 0) return surface;
    }
    return accuracy::surfaces().front();
}

const std::vector<Vec3> kFlat = {{0.5F, 0.5F, 1}};

class MapBake : public testing::Test {
  protected:
    void SetUp() override {
        const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
        const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 8, false);
        const Result<BakedMap> map = bakeMap(low.view(), high.view(), {.width = 4, .height = 4});
        if (!map && map.error().code == ErrorCode::unsupportedFile) GTEST_SKIP() << map.error().message;
    }

    static BakedMap baked(const LowPoly& low, const HighPoly& high, const BakeOptions& options,
                          const Execution& execution = {}) {
        const Result<BakedMap> map = bakeMap(low, high, options, execution);
        EXPECT_TRUE(map) << map.error().message;
        return map ? *map : BakedMap{};
    }
    static BakeOptions sized(std::uint32_t size, unsigned bits = 16, MapFit fit = MapFit::solve) {
        return {.width = size, .height = size, .bits = bits, .fit = fit};
    }
};

TEST_F(MapBake, SolvingHalvesTheErrorOfAReliefWith16Bits) {
    for (const Charts charts : {Charts::one, Charts::four}) {
        const LowMesh low = bench::makeLow(surfaceNamed("saddle"), charts);
        const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 192, true);
        const MapError exact = baked(low.view(), high.view(), sized(192, 16, MapFit::texel)).error;
        const MapError solved = baked(low.view(), high.view(), sized(192)).error;
        EXPECT_LT(solved.mean_deg, 0.57 * exact.mean_deg);
        EXPECT_LT(solved.p99_deg, 0.7 * exact.p99_deg);
        EXPECT_LT(solved.seam_mean_deg, 1.2 * exact.inside_mean_deg);
    }
}

TEST_F(MapBake, TheRimOfAnOpenSurfaceIsAsAccurateAsItsInside) {
    // Rays beyond the rim of the surface hit nothing, but filtering reads the texels there.
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 512, true);
    const MapError solved = baked(low.view(), high.view(), sized(512)).error;
    EXPECT_LT(solved.seam_mean_deg, 1.2 * solved.inside_mean_deg);
}

TEST_F(MapBake, FewerRaysInLargeMapsHardlyIncreaseTheError) {
    // Above 1024 x 1024 texels, four rays per texel and one at its center must be as accurate as the nine rays of
    // smaller maps.
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 400, true);
    const auto errorOf = [&](std::uint32_t height, unsigned bits) {
        BakeOptions options = sized(1024, bits);
        options.height = height;
        return baked(low.view(), high.view(), options).error.mean_deg;
    };
    EXPECT_LT(errorOf(1028, 8), 1.01 * errorOf(1024, 8));
}

TEST_F(MapBake, SolvedIntegersBeatPlainRoundingWith8Bits) {
    for (const bool relief : {false, true}) {
        const LowMesh low = bench::makeLow(surfaceNamed("torus"), Charts::one);
        const HighMesh high = bench::makeHigh(surfaceNamed("torus"), 128, relief);
        BakedMap exact = baked(low.view(), high.view(), sized(160, 16, MapFit::texel));
        for (Vec3& texel : exact.texels) {
            texel = {std::floor(texel.x * 255 + 0.5F) / 255, std::floor(texel.y * 255 + 0.5F) / 255,
                     std::floor(texel.z * 255 + 0.5F) / 255};
        }
        const Result<MapError> plain = measureMap({160, 160, exact.texels}, low.view(), high.view());
        ASSERT_TRUE(plain);
        const MapError solved = baked(low.view(), high.view(), sized(160, 8)).error;
        EXPECT_LT(solved.mean_deg, 0.7 * plain->mean_deg) << (relief ? "relief" : "smooth");
        EXPECT_LT(solved.p99_deg, plain->p99_deg);
    }
}

TEST_F(MapBake, GivesTheSameTexelsForAnyNumberOfThreads) {
    const LowMesh low = bench::makeLow(surfaceNamed("bumpy"), Charts::four);
    const HighMesh high = bench::makeHigh(surfaceNamed("bumpy"), 64, true);
    for (const unsigned bits : {8U, 16U}) {
        // The size is odd, so that not all rows are in pairs.
        BakeOptions options = sized(61, bits);
        options.heat = true;
        const BakedMap one = baked(low.view(), high.view(), options);
        for (const unsigned threads : {2U, 5U}) {
            const BakedMap more = baked(low.view(), high.view(), options, {.executor = threadTeam(threads)});
            EXPECT_TRUE(one.texels == more.texels);
            EXPECT_TRUE(one.origins == more.origins);
            EXPECT_EQ(one.error.mean_deg, more.error.mean_deg);
            EXPECT_EQ(one.error.heat, more.error.heat);
        }
    }
}

TEST_F(MapBake, MirroredHalvesOnSharedTexelsAreAsAccurateAsOneHalf) {
    const LowMesh low = bench::makeLow(surfaceNamed("cube-sphere"), Charts::mirrored);
    const HighMesh high = bench::makeHigh(surfaceNamed("cube-sphere"), 128, false);
    const BakedMap map = baked(low.view(), high.view(), sized(128));
    EXPECT_GT(map.overlap_count, 1000U);
    EXPECT_EQ(map.conflict_count, 0U);
    const LowMesh apart = bench::makeLow(surfaceNamed("cube-sphere"), Charts::one);
    EXPECT_LT(map.error.mean_deg, 1.3 * baked(apart.view(), high.view(), sized(128)).error.mean_deg);
}

TEST_F(MapBake, CountsHalvesThatNeedDifferentNormals) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::mirrored);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 64, true);
    const BakedMap map = baked(low.view(), high.view(), sized(64));
    EXPECT_GT(map.conflict_count, map.overlap_count / 2);
}

TEST_F(MapBake, MissesAreCountedAndFilledFromNeighbors) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 64, false);
    // Cut a hole into the middle of the high poly.
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < high.corners.size(); i += 3) {
        const Vec3& at = high.positions[high.corners[i]];
        if (at.x * at.x + at.y * at.y < 0.04F) continue;
        kept.insert(kept.end(), high.corners.begin() + static_cast<std::ptrdiff_t>(i),
                    high.corners.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    high.corners = kept;
    for (const unsigned bits : {8U, 16U}) {
        const BakedMap map = baked(low.view(), high.view(), sized(64, bits));
        EXPECT_GT(map.missed_count, 50U);
        EXPECT_GT(map.error.missed_count, 100U);
        for (std::size_t i = 0; i < map.texels.size(); ++i) {
            if (map.origins[i] != TexelOrigin::missed) continue;
            EXPECT_GT(map.texels[i].z, 0.8F) << "black, or on its side";
        }
    }
}

TEST_F(MapBake, ReachLimitsTheRays) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 32, false);
    for (Vec3& position : high.positions) position.z += 0.05F;
    BakeOptions options = sized(32);
    EXPECT_EQ(baked(low.view(), high.view(), options).missed_count, 0U);
    options.reach = 0.01;
    const Result<BakedMap> near = bakeMap(low.view(), high.view(), options);
    ASSERT_FALSE(near);
    EXPECT_EQ(near.error().code, ErrorCode::missingAttribute);
}

TEST_F(MapBake, ACageDefinesTheOriginsOfRays) {
    LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 32, false);
    // Add a layer that is farther out than the default cage and than the nearest hit.
    const std::size_t count = high.positions.size(), corner_count = high.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        high.positions.push_back(high.positions[i] + Vec3{0, 0, 0.2F});
        high.normals.push_back({1, 0, 0});
    }
    for (std::size_t i = 0; i < corner_count; ++i)
        high.corners.push_back(high.corners[i] + static_cast<std::uint32_t>(count));
    std::vector<Vec3> cage = low.positions;
    for (Vec3& position : cage) position.z += 0.3F;
    BakeOptions options = sized(32);
    options.space = MapSpace::object;
    options.rays.target = RayTarget::nearest;
    EXPECT_LT(baked(low.view(), high.view(), options).own_error.mean_deg, 1);
    LowPoly caged = low.view();
    caged.cage = cage;
    const BakedMap map = baked(caged, high.view(), options);
    for (std::size_t i = 0; i < map.texels.size(); ++i) {
        if (map.origins[i] == TexelOrigin::hit) {
            EXPECT_GT(map.texels[i].x, 0.95F);
        }
    }
}

TEST_F(MapBake, GroupsHitOnlyTheirOwnTriangles) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 32, false);
    const std::vector<std::uint32_t> ones(low.positions.size() / 3, 1);
    std::vector<std::uint32_t> numbers(high.corners.size() / 3, 1);
    LowPoly low_view = low.view();
    HighPoly high_view = high.view();
    low_view.groups = ones;
    high_view.groups = numbers;
    EXPECT_EQ(baked(low_view, high_view, sized(16)).missed_count, 0U);
    numbers.assign(numbers.size(), 2);
    EXPECT_FALSE(bakeMap(low_view, high_view, sized(16)));
    high_view.groups = {};
    EXPECT_EQ(bakeMap(low_view, high_view, sized(16)).error().code, ErrorCode::countMismatch);
}

/// Returns the mean angle between the mean vectors of blocks of `side` x `side` texels of two maps, over blocks without
/// background.
double levelError(const BakedMap& map, const BakedMap& truth, std::uint32_t side) {
    double sum = 0;
    std::size_t count = 0;
    for (std::uint32_t y = 0; y + side <= map.height; y += side) {
        for (std::uint32_t x = 0; x + side <= map.width; x += side) {
            DVec3 mean, wanted;
            bool is_whole = true;
            for (std::uint32_t i = 0; i < side * side; ++i) {
                const std::size_t at = std::size_t{y + i / side} * map.width + x + i % side;
                const auto vectorOf = [at](const BakedMap& of) {
                    const DVec3 texel = toDouble(of.texels[at]);
                    return DVec3{2 * texel.x - 1, 2 * texel.y - 1, 2 * texel.z - 1};
                };
                is_whole = is_whole && map.origins[at] == TexelOrigin::hit;
                DVec3 unit_wanted = vectorOf(truth);
                normalize(unit_wanted);
                mean = mean + vectorOf(map);
                wanted = wanted + unit_wanted;
            }
            if (!is_whole) continue;
            normalize(mean);
            normalize(wanted);
            sum += std::acos(std::min(1.0, dot(mean, wanted)));
            ++count;
        }
    }
    return sum / static_cast<double>(count) * 180 / kPi;
}

TEST_F(MapBake, EvenLengthsSuitMipLevelsAndFreeLengthsTheFirstLevel) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 256, true);
    const BakedMap truth = baked(low.view(), high.view(), sized(256, 16, MapFit::texel));
    for (const MapFit fit : {MapFit::solve, MapFit::texel}) {
        BakeOptions options = sized(256, 8, fit);
        const BakedMap even = baked(low.view(), high.view(), options);
        options.lengths = TexelLengths::free;
        const BakedMap free = baked(low.view(), high.view(), options);
        EXPECT_LT(free.error.mean_deg, even.error.mean_deg);
        EXPECT_LT(levelError(even, truth, 4), levelError(free, truth, 4));
        EXPECT_LT(levelError(even, truth, 8), 0.75 * levelError(free, truth, 8));
        for (std::size_t i = 0; i < even.texels.size(); ++i) {
            if (even.origins[i] != TexelOrigin::hit) continue;
            const Vec3 texel = even.texels[i];
            const auto size = static_cast<double>(length(Vec3{2 * texel.x - 1, 2 * texel.y - 1, 2 * texel.z - 1}));
            EXPECT_GT(size, 0.89);
            EXPECT_LT(size, 1.01);
        }
    }
}

TEST_F(MapBake, TwoChannelMapsHaveUnitTexels) {
    const LowMesh low = bench::makeLow(surfaceNamed("torus"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("torus"), 96, true);
    const MapReading unity = *findMapReading("unity");
    for (const unsigned bits : {8U, 16U}) {
        BakeOptions options = sized(96, bits);
        options.reading = unity;
        const BakedMap solved = baked(low.view(), high.view(), options);
        for (const Vec3& texel : solved.texels) {
            const Vec3 vector{2 * texel.x - 1, 2 * texel.y - 1, 2 * texel.z - 1};
            EXPECT_NEAR(static_cast<double>(length(vector)), 1, bits == 8 ? 0.02 : 1e-4);
        }
        options.fit = MapFit::texel;
        EXPECT_LT(solved.error.mean_deg, baked(low.view(), high.view(), options).error.mean_deg);
    }
}

TEST_F(MapBake, TheReadingOfTheBakeHasTheSmallestError) {
    const LowMesh low = bench::makeLow(surfaceNamed("torus"), Charts::four);
    const HighMesh high = bench::makeHigh(surfaceNamed("torus"), 96, true);
    std::vector<MapCandidate> candidates;
    for (const char* name : {"gltf", "directx", "three"}) candidates.push_back({.reading = *findMapReading(name)});
    for (std::size_t made = 0; made < candidates.size(); ++made) {
        BakeOptions options = sized(256);
        options.reading = candidates[made].reading;
        const BakedMap map = baked(low.view(), high.view(), options);
        const Result<std::vector<MapError>> errors =
            measureReadings({256, 256, map.texels}, low.view(), high.view(), candidates);
        ASSERT_TRUE(errors);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (i == made) {
                EXPECT_EQ((*errors)[i].mean_deg, map.error.mean_deg) << "a bake says the error that is measured";
            } else {
                EXPECT_GT((*errors)[i].mean_deg, 1.3 * map.error.mean_deg) << made << ' ' << i;
            }
        }
    }
}

TEST_F(MapBake, ObjectSpaceNeedsNoTangents) {
    const LowMesh low = bench::makeLow(surfaceNamed("torus"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("torus"), 96, false);
    LowPoly view = low.view();
    view.tangents = {};
    EXPECT_EQ(bakeMap(view, high.view(), sized(32)).error().code, ErrorCode::missingAttribute);
    BakeOptions options = sized(96);
    options.space = MapSpace::object;
    EXPECT_LT(baked(view, high.view(), options).error.mean_deg, 0.1);
}

TEST_F(MapBake, InvalidTrianglesCauseNoNan) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
    LowMesh low = bench::makeLow(surfaceNamed("bumpy"), Charts::one);
    HighMesh high = bench::makeHigh(surfaceNamed("bumpy"), 48, true);
    low.positions[30] = {kNan, 0, 0};
    low.normals[63] = {0, 0, 0};
    low.normals[90] = {kInfinity, 0, 0};
    low.tangents[120] = {kNan, 0, 0, 1};
    low.tangents[150] = low.tangents[151] = low.tangents[152] = {};
    low.uvs[183] = {kNan, 0};
    low.uvs[210] = low.uvs[211] = low.uvs[212];
    high.positions[100] = {kNan, kNan, kNan};
    high.positions[200] = {kInfinity, 0, 0};
    high.normals[300] = {kNan, 0, 0};
    high.normals[400] = {};
    for (const unsigned bits : {8U, 16U}) {
        for (const MapFit fit : {MapFit::solve, MapFit::texel}) {
            const BakedMap map = baked(low.view(), high.view(), sized(64, bits, fit));
            EXPECT_GE(map.degenerate_uv_count, 2U);
            for (const Vec3& texel : map.texels) {
                ASSERT_TRUE(isFinite(texel));
                ASSERT_GE(std::min({texel.x, texel.y, texel.z}), 0.0F);
                ASSERT_LE(std::max({texel.x, texel.y, texel.z}), 1.0F);
            }
            EXPECT_TRUE(std::isfinite(map.error.mean_deg));
        }
    }
}

/// Returns a low poly whose UVs reach all edges of the image.
LowMesh stretchedLow(const char* surface) {
    LowMesh low = bench::makeLow(surfaceNamed(surface), Charts::one);
    Vec2 least = low.uvs.front(), most = least;
    for (const Vec2& uv : low.uvs) {
        least = {std::min(least.x, uv.x), std::min(least.y, uv.y)};
        most = {std::max(most.x, uv.x), std::max(most.y, uv.y)};
    }
    for (Vec2& uv : low.uvs) uv = {(uv.x - least.x) / (most.x - least.x), (uv.y - least.y) / (most.y - least.y)};
    return low;
}

TEST_F(MapBake, AClampedImageIsAsAccurateAtItsEdges) {
    const LowMesh low = stretchedLow("saddle");
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 256, true);
    for (const unsigned bits : {8U, 16U}) {
        BakeOptions options = sized(192, bits);
        const MapError repeated = baked(low.view(), high.view(), options).error;
        options.wrap_u = options.wrap_v = TextureWrap::clamp;
        const BakedMap clamped = baked(low.view(), high.view(), options);
        EXPECT_LT(clamped.error.seam_mean_deg, 0.5 * repeated.seam_mean_deg) << "the other edge shows beside each";
        // Up to half a texel from the edge, clamped filtering reads only the texel at the edge.
        options.fit = MapFit::texel;
        const MapError exact = baked(low.view(), high.view(), options).error;
        EXPECT_LT(clamped.error.seam_mean_deg, 0.9 * exact.seam_mean_deg);
        EXPECT_LT(clamped.error.mean_deg, 0.85 * exact.mean_deg);
        options.fit = MapFit::solve;
        options.wrap_u = options.wrap_v = TextureWrap::mirror;
        EXPECT_TRUE(baked(low.view(), high.view(), options).texels == clamped.texels) << "both show the edge itself";
    }
}

TEST_F(MapBake, OddTilesOfAMirroredImageAreReversed) {
    LowMesh low = stretchedLow("saddle");
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 64, true);
    for (const unsigned bits : {8U, 16U}) {
        BakeOptions options = sized(64, bits);
        options.heat = true;
        options.wrap_u = options.wrap_v = TextureWrap::mirror;
        const LowMesh start = low;
        const BakedMap first = baked(low.view(), high.view(), options);
        for (Vec2& uv : low.uvs) uv = {2 - uv.x, uv.y - 4};
        const BakedMap second = baked(low.view(), high.view(), options);
        for (Vec2& uv : low.uvs) uv = {uv.x, -uv.y - 4};
        const BakedMap third = baked(low.view(), high.view(), options);
        low = start;
        for (const BakedMap& other : {second, third}) {
            // UVs far from 0 are rounded, so results differ slightly.
            EXPECT_NEAR(other.error.mean_deg, first.error.mean_deg, 0.01 * first.error.mean_deg);
            EXPECT_EQ(other.origins, first.origins);
            double off = 0;
            for (std::size_t i = 0; i < first.texels.size(); ++i)
                off += static_cast<double>(length(first.texels[i] - other.texels[i]));
            EXPECT_LT(off / static_cast<double>(first.texels.size()), bits == 8 ? 2e-3 : 1e-4);
            for (std::size_t i = 0; i < first.error.heat.size(); ++i)
                EXPECT_EQ(first.error.heat[i] < 0, other.error.heat[i] < 0);
        }
    }
}

TEST_F(MapBake, NothingIsSampledBeyondAClampedImage) {
    LowMesh low = stretchedLow("saddle");
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 64, true);
    BakeOptions options = sized(64);
    options.wrap_u = options.wrap_v = TextureWrap::clamp;
    // Move half of the surface out of the 0-1 UV range.
    for (Vec2& uv : low.uvs) uv = {2 * uv.x, uv.y};
    const BakedMap map = baked(low.view(), high.view(), options);
    EXPECT_EQ(map.overlap_count, 0U);
    EXPECT_EQ(map.conflict_count, 0U);
    EXPECT_EQ(map.hit_count, 64U * 64U);
    for (Vec2& uv : low.uvs) uv.x += 3;
    EXPECT_EQ(bakeMap(low.view(), high.view(), options).error().code, ErrorCode::missingAttribute);
}

TEST_F(MapBake, SmallImagesWork) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 16, false);
    for (const std::uint32_t width : {1U, 2U, 3U, 4U, 5U, 17U}) {
        for (const std::uint32_t height : {1U, 4U, 33U}) {
            for (const unsigned bits : {8U, 16U}) {
                for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror}) {
                    const BakedMap map =
                        baked(low.view(), high.view(),
                              {.width = width, .height = height, .bits = bits, .wrap_u = wrap, .wrap_v = wrap});
                    EXPECT_EQ(map.texels.size(), std::size_t{width} * height);
                    EXPECT_LT(map.error.mean_deg, 60);
                }
            }
        }
    }
}

TEST_F(MapBake, ReportsErrorsOfOptionsAndMeshes) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 8, false);
    const auto codeOf = [&](const BakeOptions& options) {
        const Result<BakedMap> map = bakeMap(low.view(), high.view(), options);
        return map ? ErrorCode::ok : map.error().code;
    };
    EXPECT_EQ(codeOf({.width = 0}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.width = 65536, .height = 65536}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.bits = 12}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.padding = 257}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.reach = -1}), ErrorCode::invalidOption);
    EXPECT_EQ(codeOf({.width = 4096, .height = 4096, .memory_limit_bytes = 1 << 26}), ErrorCode::tooLarge);
    const auto cancel = [](const char*, std::uint64_t, std::uint64_t) { throw Cancelled{}; };
    EXPECT_EQ(bakeMap(low.view(), high.view(), {}, {}, cancel).error().code, ErrorCode::cancelled);
    LowPoly without_uvs = low.view();
    without_uvs.uvs = {};
    EXPECT_EQ(bakeMap(without_uvs, high.view(), sized(8)).error().code, ErrorCode::missingAttribute);
    HighMesh far = high;
    for (Vec3& position : far.positions) position.x += 100;
    EXPECT_EQ(bakeMap(low.view(), far.view(), sized(8)).error().code, ErrorCode::missingAttribute);
    HighMesh broken = high;
    broken.corners[5] = static_cast<std::uint32_t>(broken.positions.size());
    EXPECT_EQ(bakeMap(low.view(), broken.view(), sized(8)).error().code, ErrorCode::indexOutOfRange);
    LowMesh one_point = low;
    for (Vec2& uv : one_point.uvs) uv = {0.5F, 0.5F};
    EXPECT_EQ(bakeMap(one_point.view(), high.view(), sized(8)).error().code, ErrorCode::missingAttribute);
}

TEST_F(MapBake, ReportsWhyMeshesDoNotOverlap) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const PositionBox box(low.view().positions);
    const auto said = [&](const auto& change) {
        LowMesh other = low;
        for (Vec3& at : other.positions) at = change(at);
        return misplacement(box, PositionBox(other.view().positions));
    };
    EXPECT_EQ(said([](const Vec3& at) { return at; }), "");
    EXPECT_EQ(said([](const Vec3& at) { return 3.0F * at; }), "") << "a part may be baked from a whole";
    EXPECT_EQ(said([](const Vec3& at) { return Vec3{at.x + 9, at.y, at.z}; }), "");
    EXPECT_EQ(said([](const Vec3& at) { return 100.0F * at; }),
              "the high poly is 100 times as large as the low poly: scale the high poly by 0.01 to align it with the "
              "low poly");
    EXPECT_EQ(said([](const Vec3& at) { return (1 / 39.37F) * at; }),
              "the low poly is 39.4 times as large as the high poly: scale the high poly by 39.4 to align it with the "
              "low poly");
    EXPECT_EQ(said([](const Vec3& at) {
                  return Vec3{100 * at.x + 90, 100 * at.y, 100 * at.z};
              }),
              "the high poly is 100 times as large as the low poly: check that both use the same unit");
    EXPECT_EQ(said([](const Vec3& at) {
                  return Vec3{at.x, -at.z, at.y};
              }),
              "the up axis of the high poly differs: rotate it by -90 degrees about x to align it with the low poly");
    EXPECT_EQ(said([](const Vec3& at) { return Vec3{std::nanf(""), at.y, at.z}; }), "");
}

TEST_F(MapBake, HeatIsTheErrorOfEachTexel) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::four);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 64, true);
    BakeOptions options = sized(64, 8);
    options.heat = true;
    const BakedMap map = baked(low.view(), high.view(), options);
    ASSERT_EQ(map.error.heat.size(), map.texels.size());
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < map.texels.size(); ++i) {
        if (map.origins[i] == TexelOrigin::background) {
            EXPECT_EQ(map.error.heat[i], -1);
        }
        if (map.error.heat[i] < 0) continue;
        sum += static_cast<double>(map.error.heat[i]);
        ++count;
    }
    EXPECT_NEAR(sum / static_cast<double>(count), map.error.mean_deg, 0.3 * map.error.mean_deg);
}

#ifdef TSPACE_HAS_TBB
TEST_F(MapBake, KeepsTheTbbLimitsOfAHost) {
    // Embree uses TBB, whose thread limit applies to the whole process.
    const auto limit = [] { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); };
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    const HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 64, false);
    for (const std::size_t of_host : {std::size_t{0}, std::size_t{3}, std::size_t{7}}) {
        std::optional<tbb::global_control> control;
        if (of_host != 0) control.emplace(tbb::global_control::max_allowed_parallelism, of_host);
        const std::size_t before = limit();
        for (const std::uint32_t threads : {1U, 2U, 5U}) {
            std::set<std::size_t> seen;
            const auto look = [&](const char*, std::uint64_t, std::uint64_t) { seen.insert(limit()); };
            ASSERT_TRUE(bakeMap(low.view(), high.view(), sized(32), {.thread_count = threads}, look));
            EXPECT_EQ(seen, (std::set<std::size_t>{before})) << threads;
            EXPECT_EQ(limit(), before) << threads;
        }
    }
}
#endif

TEST_F(MapBake, ReachAndPositionsMayHaveAnySize) {
    const LowMesh low = bench::makeLow(surfaceNamed("saddle"), Charts::one);
    HighMesh high = bench::makeHigh(surfaceNamed("saddle"), 8, false);
    const MapImage map{1, 1, kFlat};
    for (const double reach : {1e18, 1.9e18, 1e19, 1e38, 1e300}) {
        BakeOptions options = sized(16);
        options.reach = reach;
        EXPECT_GT(baked(low.view(), high.view(), options).hit_count, 0U) << reach;
        EXPECT_TRUE(measureMap(map, low.view(), high.view(), {.reach = reach})) << reach;
    }
    // If the high poly is far away, the call is an error, at any distance.
    for (const float distance : {10.0F, 1e10F, 1.84e18F, 1.9e18F, 1e30F, 3e38F}) {
        HighMesh far = high;
        for (Vec3& position : far.positions) position.x += distance;
        BakeOptions options = sized(16);
        options.reach = 1;
        const Result<BakedMap> missed = bakeMap(low.view(), far.view(), options);
        ASSERT_FALSE(missed) << distance;
        EXPECT_EQ(missed.error().code, ErrorCode::missingAttribute) << distance;
    }
}

}  // namespace
}  // namespace tspace::test
