// SPDX-License-Identifier: MIT
// Tests that diff matches the surfaces of two models, however they are stored.
#include "tspace/inspect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/scene_file.h"

namespace tspace::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

FrameDiff diffOf(const std::vector<ModelData>& a, const std::vector<ModelData>& b, const DiffOptions& options = {}) {
    const TempFolder folder;
    const Result<FrameDiff> diff = diffFiles(writeModel(folder, "a.glb", a), writeModel(folder, "b.glb", b), options);
    EXPECT_TRUE(diff.ok()) << (diff ? "" : diff.error().message);
    return diff ? *diff : FrameDiff{};
}

/// Returns T rotated about N.
Vec4 turned(const Vec4& t, const Vec3& n, double degrees) {
    const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
    const Vec3 b = {n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x};
    return {static_cast<float>(c * t.x + s * b.x), static_cast<float>(c * t.y + s * b.y),
            static_cast<float>(c * t.z + s * b.z), t.w};
}

ModelData sheet() { return withTangents(bentSheet(6), Method::mikktspace); }

/// Returns the triangles in a different order, each starting at a different corner, with shuffled vertices.
ModelData shuffled(const ModelData& data, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> new_place(data.positions.size());
    std::iota(new_place.begin(), new_place.end(), 0U);
    std::shuffle(new_place.begin(), new_place.end(), random);
    ModelData result = data;
    for (std::size_t i = 0; i < new_place.size(); ++i) {
        result.positions[new_place[i]] = data.positions[i];
        result.normals[new_place[i]] = data.normals[i];
        result.uvs[new_place[i]] = data.uvs[i];
        result.tangents[new_place[i]] = data.tangents[i];
    }
    std::vector<std::uint32_t> order(data.indices.size() / 3);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    for (std::size_t t = 0; t < order.size(); ++t) {
        const std::size_t turn = random() % 3;
        for (std::size_t k = 0; k < 3; ++k)
            result.indices[3 * t + k] = new_place[data.indices[3 * order[t] + (k + turn) % 3]];
    }
    return result;
}

TEST(Diff, AModelEqualsItself) {
    const FrameDiff diff = diffOf({sheet()}, {sheet()});
    EXPECT_TRUE(diff.isWithin(0));
    EXPECT_EQ(diff.corner_count, 6U * 6 * 6);
    EXPECT_EQ(diff.tangents.count, diff.corner_count);
    EXPECT_EQ(diff.tangents.histogram[0], diff.corner_count);
    EXPECT_TRUE(diff.worst.empty());
    EXPECT_EQ(diff.primitives[0].paired_by, "geometry");
}

TEST(Diff, OrderAndSplitsDoNotMatter) {
    ModelData welded = bentSheet(6);
    welded.tangents.assign(welded.positions.size(), {1, 0, 0, -1});
    for (unsigned seed = 1; seed < 5; ++seed) {
        EXPECT_TRUE(diffOf({welded}, {shuffled(unwelded(welded), seed)}).isWithin(0));
        EXPECT_TRUE(diffOf({shuffled(unwelded(welded), seed)}, {shuffled(welded, seed + 9)}).isWithin(0));
    }
}

TEST(Diff, ATurnByAKnownAngleIsMeasured) {
    ModelData other = sheet();
    for (std::size_t i = 0; i < other.tangents.size(); ++i)
        other.tangents[i] = turned(other.tangents[i], other.normals[i], 7);
    const FrameDiff diff = diffOf({sheet()}, {shuffled(other, 3)});
    for (const AngleStatistics& angles : {diff.tangents, diff.bitangents}) {
        EXPECT_NEAR(angles.median_deg, 7, 1e-3);
        EXPECT_NEAR(angles.p95_deg, 7, 1e-3);
        EXPECT_NEAR(angles.max_deg, 7, 1e-3);
        EXPECT_NEAR(angles.mean_deg, 7, 1e-3);
        EXPECT_EQ(angles.histogram[5], diff.corner_count) << "5 to 10 degrees";
    }
    EXPECT_LT(diff.normals.max_deg, 1e-3);
    EXPECT_EQ(diff.sign_change_count, 0U);
    EXPECT_TRUE(diff.isWithin(7.01));
    EXPECT_FALSE(diff.isWithin(6.99));
}

TEST(Diff, PercentilesAreThoseOfTheCorners) {
    ModelData other = unwelded(bentSheet(10));  // 600 corners
    other.tangents.assign(other.positions.size(), {1, 0, 0, 1});
    other.normals.assign(other.positions.size(), {0, 0, 1});
    ModelData turned_by_rank = other;
    for (std::size_t i = 0; i < 600; ++i)
        turned_by_rank.tangents[i] = turned(other.tangents[i], {0, 0, 1}, (static_cast<double>(i) + 0.5) / 10);
    const FrameDiff diff = diffOf({other}, {turned_by_rank});
    EXPECT_NEAR(diff.tangents.median_deg, 29.95, 1e-3);
    EXPECT_NEAR(diff.tangents.p95_deg, 56.95, 1e-3);
    EXPECT_NEAR(diff.tangents.max_deg, 59.95, 1e-3);
    EXPECT_NEAR(diff.tangents.mean_deg, 30, 1e-3);
    EXPECT_EQ(diff.tangents.histogram, (decltype(diff.tangents.histogram){0, 0, 1, 9, 40, 50, 200, 300, 0}));
}

TEST(Diff, SignsThatDifferAreCountedAndTurnTheBitangent) {
    ModelData other = sheet();
    for (std::size_t i = 0; i < 9; ++i) other.tangents[i].w = -other.tangents[i].w;
    const FrameDiff diff = diffOf({sheet()}, {other});
    EXPECT_EQ(diff.sign_change_count, 9U);
    EXPECT_EQ(diff.tangents.max_deg, 0);
    EXPECT_NEAR(diff.bitangents.max_deg, 180, 1e-3);
    EXPECT_FALSE(diff.isWithin(180));
    ASSERT_FALSE(diff.worst.empty());
    EXPECT_TRUE(diff.worst[0].sign_differs);
}

TEST(Diff, InvalidSignsDifferFromSignsButNotFromThemselves) {
    ModelData other = sheet();
    other.tangents[0].w = 0;
    other.tangents[1].w = std::nanf("");
    other.tangents[2].w *= 1e-30f;
    EXPECT_EQ(diffOf({other}, {other}).sign_change_count, 0U);
    const FrameDiff diff = diffOf({sheet()}, {other});
    const auto& corners = other.indices;
    EXPECT_EQ(diff.sign_change_count, std::uint64_t(std::count(corners.begin(), corners.end(), 0U) +
                                                    std::count(corners.begin(), corners.end(), 1U)));
}

TEST(Diff, ListsTheLargestDifferences) {
    ModelData other = sheet();
    for (const std::size_t i : {5U, 50U, 100U})
        other.tangents[i] = turned(other.tangents[i], other.normals[i], static_cast<double>(i) / 2);
    const FrameDiff diff = diffOf({sheet()}, {other}, {.worst_count = 2});
    ASSERT_EQ(diff.worst.size(), 2U);
    EXPECT_EQ(diff.worst[0].vertex_a, 100U);
    EXPECT_EQ(diff.worst[1].vertex_a, 50U);
    EXPECT_NEAR(diff.worst[0].tangent_deg, 50, 0.01);
}

TEST(Diff, QuantizedAndRescaledPositionsAreStillPaired) {
    ModelData other = shuffled(sheet(), 4);
    for (Vec3& p : other.positions) {
        const auto snap = [](float x) { return std::round(x * 4000) / 4000 * 3 + 17; };
        p = {snap(p.x), snap(p.y), snap(p.z)};
    }
    const FrameDiff diff = diffOf({sheet()}, {other});
    EXPECT_EQ(diff.unpaired_triangle_count, 0U);
    EXPECT_EQ(diff.primitives[0].paired_by, "name");
    EXPECT_TRUE(diff.isWithin(1e-3));
}

TEST(Diff, PrimitivesArePairedByGeometryThoughNamesAndOrderChanged) {
    ModelData small = withTangents(bentSheet(3), Method::mikktspace), large = sheet();
    small.name = "small";
    large.name = "large";
    ModelData renamed = large;
    renamed.name = "small";
    const FrameDiff diff = diffOf({small, large}, {renamed, small});
    ASSERT_EQ(diff.primitives.size(), 2U);
    EXPECT_EQ(diff.primitives[0].mesh_b, 1U);
    EXPECT_EQ(diff.primitives[1].mesh_b, 0U);
    EXPECT_TRUE(diff.isWithin(0));
}

TEST(Diff, CountsTrianglesWithoutAMatch) {
    ModelData small = withTangents(bentSheet(3), Method::mikktspace);
    small.name = "small";
    const FrameDiff diff = diffOf({sheet(), small}, {sheet()});
    EXPECT_EQ(diff.unpaired_triangle_count, 18U);
    ASSERT_EQ(diff.primitives.size(), 2U);
    EXPECT_EQ(diff.primitives[1].paired_by, "none");
    EXPECT_FALSE(diff.isWithin(180));
    ModelData cut = sheet();
    cut.indices.resize(cut.indices.size() - 3);
    EXPECT_EQ(diffOf({sheet()}, {cut}).unpaired_triangle_count, 1U);
}

TEST(Diff, TangentsInOnlyOneFileAreADifference) {
    ModelData without = sheet();
    without.tangents.clear();
    const FrameDiff diff = diffOf({sheet()}, {without});
    EXPECT_EQ(diff.missing_count, 1U);
    EXPECT_EQ(diff.tangents.count, 0U);
    EXPECT_FALSE(diff.isWithin(180));
}

TEST(Diff, InvalidDirectionsAreCountedSeparately) {
    ModelData other = sheet();
    other.tangents[0] = {0, 0, 0, 1};
    other.tangents[1] = {std::nanf(""), 0, 0, -1};
    const FrameDiff diff = diffOf({sheet()}, {other});
    EXPECT_EQ(diff.tangents.unusable_count, 2U);
    EXPECT_EQ(diff.tangents.max_deg, 0);
    EXPECT_FALSE(diff.isWithin(180));
}

TEST(Diff, AnErrorSaysWhichFile) {
    const TempFolder folder;
    const std::string good = writeModel(folder, "a.glb", {sheet()});
    const std::string bad = folder.write("b.glb", "no glTF");
    EXPECT_EQ(diffFiles(bad, good).error().element, 0U);
    EXPECT_EQ(diffFiles(good, bad).error().element, 1U);
    EXPECT_EQ(diffFiles(good, folder.path("none.glb").string()).error().code, ErrorCode::cannotRead);
}

TEST(Diff, ManyTrianglesAtOnePositionTakeLinearTime) {
    ModelData heap = unwelded(bentSheet(1));
    heap.tangents.assign(heap.positions.size(), {1, 0, 0, 1});
    const std::vector<std::uint32_t> indices = heap.indices;
    for (int i = 0; i < 50'000; ++i) heap.indices.insert(heap.indices.end(), indices.begin(), indices.end());
    EXPECT_TRUE(diffOf({heap}, {shuffled(heap, 1)}).isWithin(0));
    ModelData moved = heap;
    moved.positions[0].x += 1e-5f;
    EXPECT_TRUE(diffOf({heap}, {moved}).isWithin(0));
}

}  // namespace
}  // namespace tspace::test
