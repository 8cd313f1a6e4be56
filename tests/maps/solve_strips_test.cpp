// SPDX-License-Identifier: MIT
// Maps that are solved in strips of rows.
#include "maps/bake/solve_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "bake_cases.h"
#include "support/thread_team.h"
#include "tspace/maps.h"

namespace tspace::test {
namespace {

const accuracy::Surface& saddle() {
    for (const accuracy::Surface& surface : accuracy::surfaces()) {
        if (std::strcmp(surface.name, "saddle") == 0) return surface;
    }
    return accuracy::surfaces().front();
}

/// A map of a relief on a saddle, solved in strips of a given number of rows. With `shift` 0.5 the center of the relief
/// is at both ends of the image.
class Relief {
  public:
    static constexpr std::uint32_t kSide = 200;

    Relief(unsigned bits, TextureWrap wrap, float shift)
        : options_{.width = kSide, .height = kSide, .bits = bits, .wrap_v = wrap},
          low_(bench::makeLow(saddle(), bench::Charts::one)), high_(bench::makeHigh(saddle(), 200, true, 4)) {
        for (Vec2& uv : low_.uvs) uv.y += shift;
    }

    std::vector<Vec3> solved(std::uint32_t strip_rows, const Execution& execution = {}) const {
        Parallel parallel(execution);
        const MapWork work{nullptr, parallel, nullptr};
        const auto surfaces = MapSurfaces::make(low_.view(), high_.view(), 0, {}, parallel, nullptr);
        if (!surfaces) return {};
        const auto triangles = findTexelTriangles(uvTriangles(low_.view().uvs, options_), kSide, kSide, 2, parallel);
        TracedTexels traced;
        traceTexels(*surfaces, *triangles, options_, work, traced);
        fillFromNeighbors(traced, triangles->shape);
        const CellSampling sampling = samplingOf(options_);
        const TexelPlan plan =
            planTexels(traced, *triangles, sampling.tolerance, options_.bits == 8, parallel, nullptr);
        solveInStrips(*surfaces, plan, sampling.points, options_, work, traced, strip_rows);
        return {traced.wanted.begin(), traced.wanted.end()};
    }

  private:
    BakeOptions options_;
    bench::LowMesh low_;
    bench::HighMesh high_;
};

/// Mean differences between the texels of two maps: next to the edges of strips, and elsewhere.
struct Apart {
    double at_edges = 0, elsewhere = 0;

    Apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::uint32_t strip_rows) {
        std::size_t edge_count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const std::size_t row = i / Relief::kSide % strip_rows;
            const bool is_edge = row < 2 || row + 2 >= strip_rows;
            edge_count += is_edge ? 1 : 0;
            (is_edge ? at_edges : elsewhere) += static_cast<double>(length(a[i] - b[i]));
        }
        at_edges /= static_cast<double>(edge_count);
        elsewhere /= static_cast<double>(a.size() - edge_count);
    }
};

TEST(SolveStrips, AreAsCloseToAWholeMapAtTheirEdgesAsElsewhere) {
    constexpr std::uint32_t kRows = 32;
    for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp}) {
        for (const float shift : {0.0F, 0.5F}) {
            const Relief relief(16, wrap, shift);
            const std::vector<Vec3> whole = relief.solved(Relief::kSide), strips = relief.solved(kRows);
            if (whole.empty()) GTEST_SKIP() << "no Embree";
            const Apart apart(whole, strips, kRows);
            // The number of iterations depends on the residual of the whole system, so texels far from the edges of
            // strips are not exactly equal either.
            EXPECT_GT(apart.elsewhere, 0);
            EXPECT_LT(apart.elsewhere, 5e-6) << "a sixth of a step of 16 bits";
            EXPECT_LT(apart.at_edges, 5e-6) << "without rows around them 1e-5 and more";
        }
    }
}

TEST(SolveStrips, HaveNoLargerErrorsWithIntegersAtTheirEdges) {
    // On a smooth surface, targets must be the vectors before integers are chosen; with the chosen ones the error near
    // the edges of strips is 5 % larger.
    const bench::LowMesh low = bench::makeLow(saddle(), bench::Charts::one);
    const bench::HighMesh high = bench::makeHigh(saddle(), 200, false, 4);
    const Result<BakedMap> map =
        bakeMap(low.view(), high.view(), {.width = 256, .height = 2 * kStripRows + 200, .bits = 8, .heat = true});
    if (!map) GTEST_SKIP() << map.error().message;
    double sums[2] = {}, counts[2] = {};
    for (std::uint32_t y = 40; y < map->height - 40; ++y) {
        const bool is_edge = y % kStripRows == 0 || y % kStripRows == kStripRows - 1;
        for (std::uint32_t x = 0; x < map->width; ++x) {
            const double degrees = map->error.heat[std::size_t{y} * map->width + x];
            if (degrees < 0) continue;
            sums[is_edge ? 1 : 0] += degrees;
            counts[is_edge ? 1 : 0] += 1;
        }
    }
    EXPECT_LT(sums[1] / counts[1], 1.03 * sums[0] / counts[0]);
}

TEST(SolveStrips, AreTheSameForAnyNumberOfThreads) {
    for (const unsigned bits : {16U, 8U}) {
        const Relief relief(bits, TextureWrap::repeat, 0);
        const std::vector<Vec3> one = relief.solved(32, {.thread_count = 1});
        for (const unsigned threads : {2U, 5U})
            EXPECT_TRUE(one == relief.solved(32, {.executor = threadTeam(threads)}));
    }
}

/// Peak memory of a call that uses this allocator.
struct MemoryMeter {
    std::uint64_t now = 0, most = 0;

    Allocator allocator() {
        return {[](void* user, std::size_t bytes, std::size_t alignment) {
                    auto& meter = *static_cast<MemoryMeter*>(user);
                    meter.most = std::max(meter.most, meter.now += bytes);
                    return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
                },
                [](void* user, void* memory, std::size_t bytes, std::size_t alignment) {
                    static_cast<MemoryMeter*>(user)->now -= bytes;
                    ::operator delete(memory, std::align_val_t(alignment));
                },
                this};
    }
};

TEST(SolveStrips, NeedLessMemoryThanASystemForTheWholeMap) {
    const bench::LowMesh low = bench::makeLow(saddle(), bench::Charts::one);
    const bench::HighMesh high = bench::makeHigh(saddle(), 32, true, 2);
    const auto most = [&](std::uint32_t height, unsigned bits) {
        MemoryMeter meter;
        const Allocator allocator = meter.allocator();
        const BakeOptions options{.width = 32, .height = height, .bits = bits};
        const Result<BakedMap> map = bakeMap(low.view(), high.view(), options, {.allocator = &allocator});
        return map ? meter.most : 0;
    };
    if (most(16, 16) == 0) GTEST_SKIP() << "no Embree";
    constexpr std::uint32_t kTall = 8 * kStripRows, kTaller = 2 * kTall;
    for (const unsigned bits : {16U, 8U}) {
        const double more = static_cast<double>(most(kTaller, bits)) - static_cast<double>(most(kTall, bits));
        EXPECT_LT(more / (32.0 * (kTaller - kTall)), 55) << "bytes a texel; with a system of all 200 and more";
    }
}

TEST(SolveStrips, ReportProgressThatAdvances) {
    const bench::LowMesh low = bench::makeLow(saddle(), bench::Charts::one);
    const bench::HighMesh high = bench::makeHigh(saddle(), 64, true, 2);
    std::uint64_t last = 0, count = 0;
    const Progress progress = [&](const char* what, std::uint64_t done, std::uint64_t total) {
        if (std::strcmp(what, "solving") != 0) return;
        EXPECT_TRUE(count == 0 || done >= last);
        EXPECT_LT(done, total);
        last = done;
        ++count;
    };
    const BakeOptions options{.width = 8, .height = 2 * kStripRows + 200};
    const Result<BakedMap> map = bakeMap(low.view(), high.view(), options, {.thread_count = 1}, progress);
    if (!map) GTEST_SKIP() << map.error().message;
    EXPECT_GT(count, 10U);
}

}  // namespace
}  // namespace tspace::test
