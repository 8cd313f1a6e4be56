// SPDX-License-Identifier: MIT
// Compares the corner that the reference keeps for a node with a simple simulation of its search.
#include "core/tangents/mikktspace/grid_order.h"
#include "core/tangents/mikktspace/last_bucket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/mikktspace/words.h"
#include "core/tangents/shapes.h"

namespace tspace::mikk {
namespace {

using test::SimpleMesh;

constexpr int kCells = 2048;

/// Implements the reference's search literally, one element at a time.
class Replay {
  public:
    explicit Replay(const MeshView& mesh) : mesh_(mesh) {}

    /// Returns the corners in the order in which the search outputs them.
    std::vector<std::uint32_t> run() {
        for (std::uint32_t c = 0; c < mesh_.cornerCount(); ++c) order_.push_back(c);
        const std::vector<float> d = extent(0, order_.size());
        const int axis = longest(d);
        std::vector<std::vector<std::uint32_t>> cells(kCells);
        for (const std::uint32_t c : order_) {
            const float q = static_cast<float>(kCells) * ((at(c, axis) - low_[axis]) / (high_[axis] - low_[axis]));
            cells[static_cast<std::size_t>(std::clamp(static_cast<int>(q), 0, kCells - 1))].push_back(c);
        }
        order_.clear();
        for (const auto& cell : cells) {
            const std::size_t begin = order_.size();
            order_.insert(order_.end(), cell.begin(), cell.end());
            if (cell.size() > 1) divide(begin, order_.size());
        }
        return order_;
    }

  private:
    [[nodiscard]] float at(std::uint32_t corner, int axis) const {
        const Vec3& p = mesh_.positions[mesh_.indices[corner]];
        return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }

    static int longest(const std::vector<float>& d) {
        if (d[1] > d[0] && d[1] > d[2]) return 1;
        return d[2] > d[0] ? 2 : 0;
    }

    std::vector<float> extent(std::size_t begin, std::size_t end) {
        std::vector<float> d;
        for (int axis = 0; axis < 3; ++axis) {
            low_[axis] = high_[axis] = at(order_[begin], axis);
            for (std::size_t i = begin; i < end; ++i) {
                low_[axis] = std::min(low_[axis], at(order_[i], axis));
                high_[axis] = std::max(high_[axis], at(order_[i], axis));
            }
            d.push_back(high_[axis] - low_[axis]);
        }
        return d;
    }

    void divide(std::size_t begin, std::size_t end) {
        const int axis = longest(extent(begin, end));
        const float middle = 0.5f * (high_[axis] + low_[axis]);
        if (middle >= high_[axis] || middle <= low_[axis]) return;
        std::size_t i = begin, j = end - 1;
        while (i < j) {
            while (i < j && at(order_[i], axis) < middle) ++i;
            while (i < j && !(at(order_[j], axis) < middle)) --j;
            if (i < j) std::swap(order_[i++], order_[j--]);
        }
        const std::size_t cut = i == j && at(order_[i], axis) < middle ? i + 1 : i;
        if (cut - begin > 1) divide(begin, cut);
        if (end - cut > 1) divide(cut, end);
    }

    const MeshView& mesh_;
    std::vector<std::uint32_t> order_;
    float low_[3] = {}, high_[3] = {};
};

/// Returns random triangles over `count` positions, with vertices in any order, and one vertex at distance `far`, so
/// that all others are in few cells.
SimpleMesh soup(std::uint32_t count, float far, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto value = [&] { return static_cast<float>(random() % 4096) / 64; };
    SimpleMesh shape;
    for (std::uint32_t v = 0; v < count; ++v) shape.addVertex({value(), value(), value()}, {0, 0, 1}, {0, 0});
    shape.addVertex({far, 0, 0}, {0, 0, 1}, {0, 0});
    for (std::uint32_t t = 0; t < 2 * count; ++t) {
        const auto any = [&] { return static_cast<std::uint32_t>(random() % count); };
        shape.addTriangle(any(), any(), t == count ? count : any());
    }
    return shape;
}

struct Found {
    std::vector<std::uint32_t> wanted, all, some;
};

/// Computes representatives of all nodes by the simulation and by the library, and of the first `asked` nodes by the
/// library.
Found representatives(const MeshView& mesh, std::size_t asked, unsigned threads) {
    Parallel parallel(Execution{.thread_count = threads});
    const TriangleList triangles = cutFaces(mesh, Ngons::skip, nullptr);
    const Nodes nodes = weld(mesh, triangles, nullptr, parallel);
    Found found;
    for (auto* list : {&found.wanted, &found.all, &found.some}) list->assign(nodes.count, kNone);
    const std::vector<std::uint32_t> replayed = Replay(mesh).run();
    for (std::size_t i = replayed.size(); i-- > 0;)
        found.wanted[nodes.ofVertex(mesh.indices[replayed[i]])] = replayed[i];
    std::vector<std::uint32_t> vertices(mesh.vertexCount());
    std::iota(vertices.begin(), vertices.end(), 0u);
    findRepresentatives({mesh, triangles, nodes}, vertices, found.all.data(), nullptr, parallel);
    vertices.resize(asked);
    findRepresentatives({mesh, triangles, nodes}, vertices, found.some.data(), nullptr, parallel);
    return found;
}

TEST(GridOrder, IsTheReferencesInCellsOfManyCorners) {
    for (const float far : {64.0f, 100000.0f, 30000000.0f}) {  // the larger, the fewer cells contain the other vertices
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
            const SimpleMesh shape = soup(3000, far, seed);
            const Found found = representatives(shape.view(), 20, 1 + seed % 2);
            EXPECT_EQ(found.all, found.wanted);
            for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(found.some[n], found.wanted[n]) << far;
        }
    }
}

TEST(GridOrder, IsTheReferencesForNodesInManyCells) {
    const SimpleMesh shape = soup(5000, 64.0f, 4);
    const Found found = representatives(shape.view(), 1000, 2);
    for (std::size_t n = 0; n < 1000; ++n) EXPECT_EQ(found.some[n], found.wanted[n]);
}

TEST(GridOrder, IsTheReferencesForAFewNodesOfALongCell) {
    for (const std::uint32_t seed : {6u, 7u, 8u}) {
        SimpleMesh shape = soup(10000, 30000000.0f, seed);  // 60,000 corners, nearly all in one cell
        shape.addVertex({0, -500, 0}, {0, 0, 1}, {0, 0});   // no triangle uses it, so it is in no bounding box
        for (const unsigned threads : {1u, 3u}) {
            const Found found = representatives(shape.view(), 20, threads);
            for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(found.some[n], found.wanted[n]);
        }
    }
}

TEST(GridOrder, IsTheReferencesForManyUnbalancedSplits) {
    std::mt19937 random(9);
    SimpleMesh shape;
    const auto power = [&] { return std::ldexp(1.0f, -static_cast<int>(random() % 120)); };
    for (int v = 0; v < 12000; ++v) shape.addVertex({power(), power(), power()}, {0, 0, 1}, {0, 0});
    shape.addVertex({3000, 0, 0}, {0, 0, 1}, {0, 0});
    for (std::uint32_t t = 0; t < 12000; ++t)
        shape.addTriangle(t, static_cast<std::uint32_t>(random() % 12000), t == 0 ? 12000u : (t * 7) % 12000);
    const Found found = representatives(shape.view(), 200, 2);
    for (std::size_t n = 0; n < 200; ++n) EXPECT_EQ(found.some[n], found.wanted[n]);
}

TEST(GridOrder, IgnoresUnusedVertices) {
    for (const bool along : {false, true}) {  // on the longest axis, or on another one
        SimpleMesh shape = soup(3000, 1000.0f, 5);
        const auto nobodys = static_cast<std::uint32_t>(shape.positions.size());
        shape.addVertex(along ? Vec3{-5000, 0, 0} : Vec3{0, 900, 0}, {0, 0, 1}, {0, 0});
        ASSERT_EQ(std::count(shape.indices.begin(), shape.indices.end(), nobodys), 0);
        const Found found = representatives(shape.view(), 20, 1);
        EXPECT_EQ(found.all, found.wanted);
        for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(found.some[n], found.wanted[n]);
    }
}

}  // namespace
}  // namespace tspace::mikk
