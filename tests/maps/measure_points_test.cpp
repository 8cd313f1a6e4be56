// SPDX-License-Identifier: MIT
// Sample points in bands of rows.
#include "maps/error/measure_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace tspace::test {
namespace {

float uvCoordinate() { return static_cast<float>(*rc::gen::inRange(-4200, 2900)) / 1000.0F; }

RC_GTEST_PROP(SampleBands, ContainEachCoveredTexelInOneBand, ()) {
    std::vector<Vec2> uvs;
    const int count = *rc::gen::inRange(1, 4);
    for (int i = 0; i < 3 * count; ++i) uvs.push_back({uvCoordinate(), uvCoordinate()});
    const UvTriangles triangles{.uvs = uvs,
                                .wrap_u = static_cast<TextureWrap>(*rc::gen::inRange(0, 3)),
                                .wrap_v = static_cast<TextureWrap>(*rc::gen::inRange(0, 3))};
    const std::uint32_t width = *rc::gen::inRange(1U, 20U), height = *rc::gen::inRange(1U, 90U);
    const std::uint32_t shift = *rc::gen::inRange(0U, 2U);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        PlacedTriangle placed;
        RC_ASSERT(placed.place(triangles[i], {width, height, triangles.wrap_u, triangles.wrap_v}) == UvPlacing::placed);
        RC_PRE(placed.doubleArea() != 0);
    }
    TexelMask mask(width, height);
    std::uint64_t steps = kCoverSteps;
    RC_ASSERT(coverTexels(triangles, mask, steps));

    const SampleBands bands(triangles, width, height, 1, shift);
    std::vector<std::size_t> band_of(std::size_t{width} * height, SIZE_MAX);
    for (std::size_t band = 0; band < bands.bandCount(); ++band) {
        bands.forSamples(band, [&](const BandSample& sample) {
            std::size_t& of = band_of[std::size_t{sample.row} * width + sample.column];
            RC_ASSERT(of == SIZE_MAX || of == band);
            of = band;
        });
    }
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x)
            RC_ASSERT((band_of[std::size_t{y} * width + x] != SIZE_MAX) == mask.has(x, y));
    }
}

}  // namespace
}  // namespace tspace::test
