// SPDX-License-Identifier: MIT
// Cells in which the directions between texels follow from those at the texels' centers, so that fewer rays are needed.
#include "maps/bake/texel_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/vec_math.h"
#include "maps/solve/solve_texels.h"

namespace tspace::test {
namespace {

constexpr std::uint32_t kFieldSide = 40;

/// A field of directions over texels that are covered by a triangle, except at the rim, where texels are only read.
struct Field {
    TracedTexels traced = {};
    TexelTriangles triangles = {};

    template <class Of>
    explicit Field(const Of& of) {
        const std::size_t count = std::size_t{kFieldSide} * kFieldSide;
        triangles.shape = {kFieldSide, kFieldSide};
        triangles.kinds = Buffer<TexelCoverage>(nullptr, count, TexelCoverage::inside);
        triangles.is_read = Buffer<bool>(nullptr, count, false);
        triangles.overlaps = Buffer<bool>(nullptr, count, false);
        traced.wanted = Buffer<Vec3>(nullptr, count, Vec3{});
        traced.origins = Buffer<TexelOrigin>(nullptr, count, TexelOrigin::hit);
        for (std::uint32_t y = 0; y < kFieldSide; ++y) {
            for (std::uint32_t x = 0; x < kFieldSide; ++x) {
                traced.wanted[y * kFieldSide + x] = toFloat(of(x, y));
                if (x > 0 && y > 0 && x + 1 < kFieldSide && y + 1 < kFieldSide) continue;
                triangles.kinds[y * kFieldSide + x] = TexelCoverage::adjacent;
                triangles.is_read[y * kFieldSide + x] = true;
                traced.origins[y * kFieldSide + x] = TexelOrigin::padding;
            }
        }
    }
    [[nodiscard]] TexelPlan plan(float tolerance = 1e-3F) const {
        Parallel parallel({.thread_count = 1});
        return planTexels(traced, triangles, tolerance, false, parallel, nullptr);
    }
};

DVec3 waveAt(double x, double y) {
    DVec3 wave{0.3 * std::sin(x / 4), 0.2 * std::cos(y / 5 + x / 9), 1};
    normalize(wave);
    return wave;
}

TEST(TexelPlan, SmoothFieldsAreSampledOnlyAtTheRim) {
    const TexelPlan plan = Field(waveAt).plan(0.1F);
    for (std::uint32_t y = 0; y < kFieldSide; ++y) {
        for (std::uint32_t x = 0; x < kFieldSide; ++x) {
            const bool is_inner = std::min(x, y) >= 5 && std::max(x, y) < kFieldSide - 6;
            if (!is_inner) continue;
            EXPECT_EQ(plan.cells[y * kFieldSide + x], TexelCell::smooth) << x << ' ' << y;
            EXPECT_EQ(plan.roles[y * kFieldSide + x], TexelRole::excluded);
        }
    }
    EXPECT_EQ(plan.cells[1 * kFieldSide + 20], TexelCell::rough);
    EXPECT_EQ(plan.cells[0 * kFieldSide + 20], TexelCell::rough)
        << "the cell at the edge shows half a texel of the triangle";
}

TEST(TexelPlan, CellsAtACreaseAreRough) {
    const TexelPlan plan = Field([](double x, double) {
                               DVec3 roof{x < 20.4 ? 0.3 : 0.3 - 0.02 * (x - 20.4), 0, 1};
                               normalize(roof);
                               return roof;
                           }).plan();
    EXPECT_EQ(plan.cells[15 * kFieldSide + 20], TexelCell::rough) << "the crease lies in this cell";
    EXPECT_EQ(plan.roles[15 * kFieldSide + 20], TexelRole::unknown);
    EXPECT_EQ(plan.roles[15 * kFieldSide + 21], TexelRole::unknown);
    EXPECT_EQ(plan.cells[15 * kFieldSide + 10], TexelCell::smooth);
    EXPECT_EQ(plan.cells[15 * kFieldSide + 30], TexelCell::smooth);
}

TEST(TexelPlan, OverlappingTexelsAreSampled) {
    Field field(waveAt);
    field.triangles.overlaps[20 * kFieldSide + 20] = true;
    EXPECT_EQ(field.plan(0.1F).cells[20 * kFieldSide + 20], TexelCell::rough);
}

/// Returns the mean angle between filtered texels and a field of waves, away from the rim.
double waveErrorOf(std::span<const Vec3> texels) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t y = 6; y < kFieldSide - 7; ++y) {
        for (std::uint32_t x = 6; x < kFieldSide - 7; ++x) {
            for (int i = 0; i < 25; ++i) {
                const float fx = static_cast<float>(i % 5) * 0.2F + 0.1F, fy = static_cast<float>(i / 5) * 0.2F + 0.1F;
                const Vec3* at = texels.data() + y * kFieldSide + x;
                const Vec3 mixed = ((1 - fx) * (1 - fy)) * at[0] + (fx * (1 - fy)) * at[1] +
                                   ((1 - fx) * fy) * at[kFieldSide] + (fx * fy) * at[kFieldSide + 1];
                DVec3 unit = toDouble(mixed);
                normalize(unit);
                sum += length(cross(unit, waveAt(x + static_cast<double>(fx), y + static_cast<double>(fy))));
                ++count;
            }
        }
    }
    return sum / count;
}

TEST(TexelPlan, SharpenedTexelsHalveTheErrorOfTheFilter) {
    Field field(waveAt);
    const TexelPlan plan = field.plan(0.1F);
    const std::vector<Vec3> wanted(field.traced.wanted.begin(), field.traced.wanted.end());
    Parallel parallel({.thread_count = 1});
    const Buffer<Vec3> texels = sharpenedTexels(plan, wanted, parallel, nullptr);
    EXPECT_LT(waveErrorOf({texels.begin(), texels.end()}), 0.5 * waveErrorOf(wanted));
}

TEST(SolveTexels, RoundedTexelsCancelEachOthersErrors) {
    const Field field([](double x, double y) { return waveAt(x / 20, y / 20); });
    std::vector<Vec3> wanted(field.traced.wanted.begin(), field.traced.wanted.end()), plain = wanted, together = wanted,
                                                                                      of_any_length = wanted;
    const auto round = [](float value) { return std::floor((value + 1) * 2000 + 0.5F) / 2000 - 1; };
    for (Vec3& texel : plain) texel = {round(texel.x), round(texel.y), round(texel.z)};
    Parallel parallel({.thread_count = 1});
    roundTexels(together, kFieldSide, {.most = 4000, .keeps_lengths = true}, parallel, nullptr);
    roundTexels(of_any_length, kFieldSide, {.most = 4000}, parallel, nullptr);
    double plain_sum = 0, together_sum = 0, any_length_sum = 0;
    // Compare the filtered values between each four texels.
    for (std::size_t i = 0; i + kFieldSide + 1 < wanted.size(); ++i) {
        const auto mixed = [&](const std::vector<Vec3>& texels) {
            return 0.25F * ((texels[i] + texels[i + 1]) + (texels[i + kFieldSide] + texels[i + kFieldSide + 1]));
        };
        const auto across = [&](const std::vector<Vec3>& texels) {
            const Vec3 shown = mixed(texels);
            return static_cast<double>(length(cross(shown, mixed(wanted))) / length(shown));
        };
        plain_sum += across(plain);
        together_sum += across(together);
        any_length_sum += across(of_any_length);
    }
    EXPECT_LT(together_sum, 0.75 * plain_sum);
    EXPECT_LT(any_length_sum, 0.5 * together_sum);
    for (const auto* texels : {&together, &of_any_length}) {
        for (const Vec3& texel : *texels) {
            for (const float value : {texel.x, texel.y, texel.z})
                EXPECT_NEAR((value + 1) * 2000, std::round((value + 1) * 2000), 1e-2F);
            EXPECT_LE(texel.z, 1.0001F);
        }
    }
}

}  // namespace
}  // namespace tspace::test
