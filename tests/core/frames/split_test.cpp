// SPDX-License-Identifier: MIT
#include "support/thread_team.h"
#include "tspace/indexed_frames.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace tspace {
namespace {

using Indices = std::vector<std::uint32_t>;

CornerAttribute floats(const std::vector<float>& values, float tolerance = 0.0f, std::uint32_t components = 1) {
    return {values.data(), components * sizeof(float), components, tolerance};
}

SplitResult split(const Indices& indices, std::size_t vertex_count, std::vector<CornerAttribute> attributes,
                  const Execution& execution = {}) {
    Result<SplitResult> result = splitVertices(IndexView(std::span<const std::uint32_t>(indices)), vertex_count,
                                               indices.size(), attributes, execution);
    EXPECT_TRUE(result.ok());
    return *std::move(result);
}

bool sameBits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Implements the definition of splitVertices (indexed_frames.h) literally, in quadratic time.
SplitResult splitSlowly(const Indices& indices, std::size_t vertex_count, std::span<const CornerAttribute> attributes) {
    const auto equal = [&](std::size_t a, std::size_t b) {
        for (const CornerAttribute& attribute : attributes) {
            for (std::uint32_t k = 0; k < attribute.component_count; ++k) {
                const float x = attribute.data[a * attribute.stride_bytes / sizeof(float) + k];
                const float y = attribute.data[b * attribute.stride_bytes / sizeof(float) + k];
                if (sameBits(x, y)) continue;
                if (attribute.tolerance == 0) return false;
                if (!(std::abs(double{x} - double{y}) <= attribute.tolerance)) return false;
            }
        }
        return true;
    };
    SplitResult result;
    result.source_corners.assign(vertex_count, kNoCorner);
    for (std::uint32_t v = 0; v < vertex_count; ++v) result.source_vertices.push_back(v);
    for (std::uint32_t c = 0; c < indices.size(); ++c) {
        const std::uint32_t v = indices[c];
        if (result.source_corners[v] == kNoCorner) result.source_corners[v] = c;
        std::uint32_t found = 0;
        while (found < result.vertexCount() &&
               (result.source_vertices[found] != v || !equal(c, result.source_corners[found]))) {
            ++found;
        }
        if (found == result.vertexCount()) {
            result.source_vertices.push_back(v);
            result.source_corners.push_back(c);
        }
        result.indices.push_back(found);
    }
    return result;
}

bool equalResults(const SplitResult& a, const SplitResult& b) {
    return a.indices == b.indices && a.source_vertices == b.source_vertices && a.source_corners == b.source_corners;
}

TEST(Split, KeepsTheFirstCornerAtTheOldVertexAndAppendsCopies) {
    const SplitResult result = split({0, 1, 1, 0, 1}, 3, {floats({5, 6, 7, 5, 7})});
    EXPECT_EQ(result.indices, (Indices{0, 1, 3, 0, 3}));
    EXPECT_EQ(result.source_vertices, (Indices{0, 1, 2, 1}));
    EXPECT_EQ(result.source_corners, (Indices{0, 1, kNoCorner, 2}));
}

TEST(Split, ChangesNothingWithoutAttributes) {
    const SplitResult result = split({0, 1, 1, 0}, 2, {});
    EXPECT_EQ(result.indices, (Indices{0, 1, 1, 0}));
    EXPECT_EQ(result.vertexCount(), 2u);
}

TEST(Split, TreatsCornersAsVerticesWithoutIndices) {
    const std::vector<float> values{1, 2, 3};
    const std::vector<CornerAttribute> attributes{floats(values)};
    const Result<SplitResult> result = splitVertices(IndexView{}, 4, 3, attributes);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result->indices, (Indices{0, 1, 2}));
    EXPECT_EQ(result->source_corners, (Indices{0, 1, 2, kNoCorner}));
}

TEST(Split, DistinguishesZerosAndNansByTheirBits) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(split({0, 0, 0}, 1, {floats({0.0f, -0.0f, 0.0f})}).indices, (Indices{0, 1, 0}));
    EXPECT_EQ(split({0, 0, 0, 0}, 1, {floats({nan, nan, -nan, nan})}).indices, (Indices{0, 0, 1, 0}));
    EXPECT_EQ(split({0, 0, 0, 0}, 1, {floats({nan, nan, 1, nan}, 0.5f)}).indices, (Indices{0, 0, 1, 0}));
}

TEST(Split, MergesNoiseWithinTheToleranceOnly) {
    const std::vector<float> values{1.0f, 1.0f + 1e-6f, 1.0f - 1e-6f, 1.001f, -0.0f, 0.0f, 1.0005f};
    EXPECT_EQ(split({0, 0, 0, 0, 0, 0, 0}, 1, {floats(values, 1e-5f)}).indices, (Indices{0, 0, 0, 1, 2, 2, 3}));
}

TEST(Split, ComparesWithTheFirstCornerSoThatTolerancesDoNotAccumulate) {
    EXPECT_EQ(split({0, 0, 0, 0}, 1, {floats({0.0f, 0.75f, 1.5f, 0.8f}, 1.0f)}).indices, (Indices{0, 0, 1, 0}));
}

TEST(Split, SplitsWhereAnyOfSeveralAttributesDisagrees) {
    EXPECT_EQ(split({0, 0, 0}, 1, {floats({1, 1, 2}), floats({5, 6, 5})}).indices, (Indices{0, 1, 2}));
}

TEST(Split, RejectsInvalidArguments) {
    const Indices indices{0, 1, 2};
    const std::vector<float> values{1, 2, 3};
    const auto code = [&](std::size_t vertices, std::size_t corners, CornerAttribute attribute) {
        const std::vector<CornerAttribute> attributes{attribute};
        const auto result =
            splitVertices(IndexView(std::span<const std::uint32_t>(indices)), vertices, corners, attributes);
        return result.ok() ? ErrorCode::ok : result.error().code;
    };
    EXPECT_EQ(code(3, 3, floats(values)), ErrorCode::ok);
    EXPECT_EQ(code(2, 3, floats(values)), ErrorCode::indexOutOfRange);
    EXPECT_EQ(code(3, 2, floats(values)), ErrorCode::countMismatch);
    EXPECT_EQ(code(3, 3, {nullptr, 4, 1, 0}), ErrorCode::nullData);
    EXPECT_EQ(code(3, 3, {values.data(), 4, 2, 0}), ErrorCode::strideTooSmall);
    EXPECT_EQ(code(3, 3, {values.data(), 4, 0, 0}), ErrorCode::invalidOption);
    EXPECT_EQ(code(3, 3, {values.data(), 4, 17, 0}), ErrorCode::invalidOption);
    EXPECT_EQ(code(3, 3, {values.data(), 4, 1, -1}), ErrorCode::invalidOption);
    EXPECT_EQ(code(3, 3, {values.data(), 4, 1, std::nanf("")}), ErrorCode::invalidOption);
    EXPECT_EQ(code(kMaxCorners + 1, 3, floats(values)), ErrorCode::tooLarge);
    EXPECT_EQ(splitVertices(IndexView{}, 2, 3, {}).error().code, ErrorCode::indexOutOfRange);
}

TEST(Split, FindsTheEarliestOfManyVariantsFarFromZeroToo) {
    const float tolerance = 1e-3f;
    std::vector<float> values;
    for (int k = 0; k < 40; ++k) values.push_back((k % 2 == 0 ? 1.0f : -1.0f) * std::ldexp(1.0f, k));
    for (int k = 0; k < 40; ++k) values.push_back(values[static_cast<std::size_t>(k)] * (k < 10 ? 1.0f + 1e-7f : 1.0f));
    const Indices indices(80, 0);
    const SplitResult result = split(indices, 1, {floats(values, tolerance)});
    EXPECT_EQ(result.vertexCount(), 40u);
    for (std::size_t k = 0; k < 40; ++k) EXPECT_EQ(result.indices[k], result.indices[k + 40]);
}

struct RandomCorners {
    Indices indices;
    std::size_t vertex_count;
    std::vector<std::vector<float>> values;
    std::vector<CornerAttribute> attributes;
};

/// Returns corners with few vertices and few values, so that vertices have between one and many variants.
RandomCorners anyCorners() {
    RandomCorners r;
    r.vertex_count = *rc::gen::inRange<std::size_t>(1, 6);
    const auto corners = *rc::gen::inRange<std::size_t>(0, 200);
    const auto last = static_cast<std::uint32_t>(r.vertex_count);
    r.indices = *rc::gen::container<Indices>(corners, rc::gen::inRange<std::uint32_t>(0, last));
    using Layout = std::vector<std::size_t>;
    const auto any_layout =
        *rc::gen::container<Layout>(*rc::gen::inRange<std::size_t>(0, 4), rc::gen::inRange<std::size_t>(1, 6));
    // Some layouts are common, and have specialized code if all attributes are exact.
    const auto layout = *rc::gen::element(any_layout, any_layout, Layout{3}, Layout{4}, Layout{3, 4});
    const bool all_exact = *rc::gen::arbitrary<bool>();
    for (const std::size_t components : layout) {
        const int steps = *rc::gen::inRange(1, 12);
        r.values.push_back(*rc::gen::container<std::vector<float>>(
            components * corners, rc::gen::map(rc::gen::inRange(-steps, steps + 1), [](int k) {
                return k == 11 ? std::nanf("") : (k == -11 ? HUGE_VALF : 0.1f * static_cast<float>(k));
            })));
        const float tolerance = all_exact ? 0.0f : *rc::gen::element(0.0f, 1e-3f, 0.1f, 0.15f, 0.31f);
        r.attributes.push_back(floats(r.values.back(), tolerance, static_cast<std::uint32_t>(components)));
        if (corners == 0) r.attributes.back().data = nullptr;
    }
    return r;
}

RC_GTEST_PROP(Split, FollowsItsDefinition, ()) {
    const RandomCorners r = anyCorners();
    const SplitResult result = split(r.indices, r.vertex_count, r.attributes);
    RC_ASSERT(equalResults(result, splitSlowly(r.indices, r.vertex_count, r.attributes)));
}

RC_GTEST_PROP(Split, RestoresTheCornersBitForBit, ()) {
    RandomCorners r = anyCorners();
    for (CornerAttribute& attribute : r.attributes) attribute.tolerance = 0;
    const SplitResult result = split(r.indices, r.vertex_count, r.attributes);
    for (std::size_t v = 0; v < r.vertex_count; ++v) RC_ASSERT(result.source_vertices[v] == v);
    for (std::size_t c = 0; c < r.indices.size(); ++c) {
        const std::uint32_t vertex = result.indices[c];
        RC_ASSERT(result.source_vertices[vertex] == r.indices[c]);
        for (const CornerAttribute& attribute : r.attributes) {
            const std::size_t n = attribute.component_count;
            RC_ASSERT(std::memcmp(attribute.data + n * c, attribute.data + n * result.source_corners[vertex],
                                  n * sizeof(float)) == 0);
        }
    }
}

RC_GTEST_PROP(Split, FindsNothingLeftToSplitInItsResult, ()) {
    RandomCorners r = anyCorners();
    for (CornerAttribute& attribute : r.attributes) attribute.tolerance = 0;
    const SplitResult once = split(r.indices, r.vertex_count, r.attributes);
    const SplitResult twice = split(once.indices, once.vertexCount(), r.attributes);
    RC_ASSERT(twice.indices == once.indices);
    RC_ASSERT(twice.vertexCount() == once.vertexCount());
}

RC_GTEST_PROP(Split, GivesTheSameResultForAnyThreadCount, ()) {
    const std::size_t vertex_count = 60000, corner_count = 300000;
    std::uint32_t state = *rc::gen::arbitrary<std::uint32_t>();
    const auto next = [&state](std::uint32_t limit) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::uint32_t>(std::uint64_t{state} * limit >> 32);
    };
    const std::uint32_t kinds = *rc::gen::element(1u, 2u, 20u);
    Indices indices(corner_count);
    std::vector<float> values(4 * corner_count, 0.5f);
    for (std::size_t c = 0; c < corner_count; ++c) {
        indices[c] = next(static_cast<std::uint32_t>(vertex_count));
        if (next(10) == 0) values[4 * c + next(4)] = static_cast<float>(next(kinds));
    }
    const std::vector<CornerAttribute> attributes{floats(values, *rc::gen::element(0.0f, 1e-3f), 4)};
    const SplitResult serial = split(indices, vertex_count, attributes, {.thread_count = 1});
    for (const unsigned threads : {2u, 5u}) {
        RC_ASSERT(
            equalResults(serial, split(indices, vertex_count, attributes, {.executor = test::threadTeam(threads)})));
    }
}

TEST(Split, StartsNoThreadForASmallMesh) {
    int runs = 0;
    const Executor executor{.run =
                                [](void* user, std::size_t count, void (*task)(void*, std::size_t), void* context) {
                                    ++*static_cast<int*>(user);
                                    for (std::size_t i = 0; i < count; ++i) task(context, i);
                                },
                            .user = &runs,
                            .concurrency = 8};
    std::vector<float> values(3 * 5000);
    Indices indices(values.size());
    for (std::size_t c = 0; c < values.size(); ++c) {
        indices[c] = static_cast<std::uint32_t>(c % 2500);
        values[c] = static_cast<float>(c % 2);
    }
    split(indices, 2500, {floats(values)}, {.executor = &executor});
    EXPECT_EQ(runs, 0);
}

/// An algorithm that takes quadratic time would need minutes and exceed the test's time limit.
TEST(SplitTime, StaysLinearWhenOneVertexHasManyVariants) {
    const std::size_t count = 400000;
    const Indices indices(count, 0);
    std::vector<float> frames(7 * count, 0.0f);
    for (std::size_t c = 0; c < count; ++c) {
        const double a = 0.61803398875 * static_cast<double>(c);
        const double z = 2 * (static_cast<double>(c) + 0.5) / static_cast<double>(count) - 1;
        const double r = std::sqrt(1 - z * z);
        frames[7 * c] = static_cast<float>(r * std::cos(6.2831853 * a));
        frames[7 * c + 1] = static_cast<float>(r * std::sin(6.2831853 * a));
        frames[7 * c + 2] = static_cast<float>(z);
        frames[7 * c + 3] = 1;
        frames[7 * c + 6] = static_cast<float>(c);
    }
    for (const float tolerance : {0.0f, 1e-5f, 1e-2f}) {
        const std::vector<CornerAttribute> all{{frames.data(), 28, 4, tolerance},
                                               {frames.data() + 4, 28, 3, tolerance}};
        EXPECT_EQ(split(indices, 1, all).vertexCount(), count);
    }
    // Compare only directions. The variants are as dense as the tolerance allows.
    const std::vector<CornerAttribute> directions{{frames.data(), 28, 4, 1e-2f}};
    const SplitResult merged = split(indices, 1, directions);
    EXPECT_GT(merged.vertexCount(), 10000u);
    EXPECT_LT(merged.vertexCount(), 150000u);
}

}  // namespace
}  // namespace tspace
