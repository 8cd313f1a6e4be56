// SPDX-License-Identifier: MIT
// The decision whether the reference's unsorted last bucket can matter, taken without lists of edges.
#include "tangents/mikktspace/tail_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "tangents/golden_mesh.h"
#include "tangents/mikktspace/weld_order.h"
#include "tangents/mikktspace/words.h"
#include "tangents/shapes.h"

namespace tspace::mikk {
namespace {

using test::Shape;

struct Welded {
    MeshView mesh;
    TriangleList triangles;
    Parallel parallel;
    Nodes nodes;

    explicit Welded(const MeshView& view, unsigned threads = 1)
        : mesh(view),
          triangles(cutFaces(mesh, Ngons::skip, nullptr)),
          parallel(Execution{.thread_count = threads}),
          nodes(weld(mesh, triangles, nullptr, parallel)) {}

    bool tailMayMatter() { return mikk::tailMayMatter(mesh, triangles, nodes, nullptr, parallel); }

    /// The same from a list of all edges and all representatives.
    bool lastBucketMatters() {
        std::vector<std::uint32_t> representatives(nodes.count, kNone);
        WeldOrder(mesh, triangles, nodes, nullptr, parallel).findAll(representatives.data());
        struct Edge {
            std::uint32_t low, high;
            bool ascending;
        };
        std::vector<Edge> edges;
        std::uint32_t last = 0;
        for (std::size_t t = 0; t < triangles.count; ++t) {
            std::uint32_t r[3];
            Vec3 p[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t corner = triangles.corner(3 * t + k);
                r[k] = representatives[nodes.of(mesh, corner)];
                p[k] = mesh.positions[mesh.indices[corner]];
            }
            if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = r[k], b = r[(k + 1) % 3];
                edges.push_back({std::min(a, b), std::max(a, b), a < b});
                last = std::max(last, edges.back().low);
            }
        }
        std::erase_if(edges, [&](const Edge& e) { return e.low != last; });
        if (edges.size() <= 2) return false;
        for (const Edge& a : edges) {
            for (const Edge& b : edges) {
                if (a.high == b.high && a.ascending != b.ascending) return true;
            }
        }
        return false;
    }
};

std::vector<Vec4> tangents(const MeshView& mesh, Pairing pairing) {
    std::vector<Vec4> result(mesh.cornerCount());
    EXPECT_TRUE(generateTangents(mesh, {.pairing = pairing, .ngons = Ngons::skip}, {.tangents = result}));
    return result;
}

/// Sheets, soups of random triangles and quads, books and fans; in natural order and shuffled.
Shape someShape(std::uint32_t seed) {
    std::mt19937 random(seed);
    Shape shape;
    switch (seed % 4) {
        case 0:
            shape = test::grid(1 + random() % 12);
            break;
        case 1:
            shape = test::fan(1 + random() % 40);
            break;
        case 2:
            shape = test::book(1 + random() % 40, true);
            break;
        default: {
            const std::uint32_t vertices = 3 + random() % 12;
            const auto value = [&] { return static_cast<float>(random() % 5); };
            for (std::uint32_t v = 0; v < vertices; ++v)
                shape.vertex({value(), value(), value()}, test::kUp, {value(), value()});
            for (std::uint32_t f = 1 + random() % 60; f-- > 0;) {
                std::vector<std::uint32_t> face(random() % 8 == 0 ? 2 + 2 * (random() % 2) : 3);
                for (std::uint32_t& corner : face) corner = random() % vertices;
                shape.face(face);
            }
        }
    }
    for (Vec2& uv : shape.uvs) uv.x += static_cast<float>(random() % 100) / 300.0f;
    if (shape.face_sizes.empty() && random() % 4 != 0) test::shuffleTriangles(shape, seed);
    return shape;
}

TEST(TailCheck, DecidesAsAListOfAllEdgesDoes) {
    int matters = 0;
    for (std::uint32_t seed = 0; seed < 4000; ++seed) {
        const Shape shape = someShape(seed);
        Welded welded(shape.view());
        ASSERT_EQ(welded.tailMayMatter(), welded.lastBucketMatters()) << seed;
        matters += welded.tailMayMatter() ? 1 : 0;
    }
    EXPECT_GT(matters, 40);
}

/// `tail` after a sheet of so many triangles that the mesh is not a small one.
Shape afterSheet(const Shape& tail) {
    Shape shape = test::grid(30);
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    for (std::size_t v = 0; v < tail.positions.size(); ++v)
        shape.vertex(tail.positions[v], tail.normals[v], tail.uvs[v]);
    if (!tail.face_sizes.empty()) {
        shape.face_sizes.assign(shape.indices.size() / 3, 3);
        shape.face_sizes.insert(shape.face_sizes.end(), tail.face_sizes.begin(), tail.face_sizes.end());
    }
    for (const std::uint32_t v : tail.indices) shape.indices.push_back(first + v);
    return shape;
}

/// Small meshes are looked at in another way than others.
TEST(TailCheck, DecidesAsAListOfAllEdgesDoesWhereTheMeshIsNotSmall) {
    int matters = 0;
    for (std::uint32_t seed = 0; seed < 800; ++seed) {
        const Shape shape = afterSheet(someShape(seed));
        Welded welded(shape.view());
        ASSERT_EQ(welded.tailMayMatter(), welded.lastBucketMatters()) << seed;
        matters += welded.tailMayMatter() ? 1 : 0;
    }
    EXPECT_GT(matters, 8);
}

TEST(TailCheck, NoMeansThatBothPairingsGiveTheSameBits) {
    int different = 0;
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        const Shape shape = someShape(seed);
        const std::vector<Vec4> reference = tangents(shape.view(), Pairing::reference),
                                corrected = tangents(shape.view(), Pairing::corrected);
        const bool same = std::memcmp(reference.data(), corrected.data(), reference.size() * sizeof(Vec4)) == 0;
        if (!Welded(shape.view()).tailMayMatter()) {
            ASSERT_TRUE(same) << seed;
        }
        different += same ? 0 : 1;
    }
    EXPECT_GT(different, 0);
}

TEST(TailCheck, SaysYesRarely) {
    int yes = 0;
    constexpr int kGrids = 1000;
    for (std::uint32_t seed = 0; seed < kGrids; ++seed) {
        Shape shape = test::grid(3 + seed % 20);
        test::shuffleTriangles(shape, seed);
        yes += Welded(shape.view()).tailMayMatter() ? 1 : 0;
    }
    EXPECT_GT(yes, 0);
    EXPECT_LT(yes, kGrids / 10);
}

/// Meshes so large that the end of the list is looked at first, and that threads share the work.
TEST(TailCheck, DecidesTheSameForLargeMeshesAndAllThreads) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        Shape shape = seed < 5 ? test::grid(300) : test::fan(200000);
        if (seed > 0) test::shuffleTriangles(shape, seed);
        const bool want = Welded(shape.view()).lastBucketMatters();
        for (const unsigned threads : {1u, 2u, 3u}) EXPECT_EQ(Welded(shape.view(), threads).tailMayMatter(), want);
    }
}

/// The last triangles' nodes all have their first corners, and with them their representatives, at the
/// beginning.
TEST(TailCheck, LooksFurtherBackWhenTheLastTrianglesOnlyUseOldNodes) {
    Shape shape = test::grid(80);
    for (int repeat = 0; repeat < 6000; ++repeat) shape.triangle(0, 1, 82);
    Welded welded(shape.view());
    EXPECT_EQ(welded.tailMayMatter(), welded.lastBucketMatters());
    Shape twice = test::grid(80);
    const std::vector<std::uint32_t> once = twice.indices;
    twice.indices.insert(twice.indices.end(), once.begin(), once.end());
    Welded doubled(twice.view());
    EXPECT_EQ(doubled.tailMayMatter(), doubled.lastBucketMatters());
}

TEST(TailCheck, HandlesMeshesWithoutAnEdge) {
    const Shape shape = test::collapsed(10000);
    EXPECT_FALSE(Welded(shape.view()).tailMayMatter());
    EXPECT_FALSE(Welded(MeshView{}).tailMayMatter());
}

}  // namespace
}  // namespace tspace::mikk
