// SPDX-License-Identifier: MIT
// The effect of the reference's unsorted last edge bucket: the library determines it without a list of all edges.
#include "core/tangents/mikktspace/last_bucket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <numeric>
#include <random>

#include "core/tangents/golden_mesh.h"
#include "core/tangents/mikktspace/grid_order.h"
#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/mikktspace/words.h"
#include "core/tangents/shapes.h"

namespace tspace::mikk {
namespace {

using test::SimpleMesh;
using Links = std::map<std::uint32_t, std::uint32_t>;  // half-edge -> its neighbor, or kNone

struct Welded {
    MeshView mesh;
    TriangleList triangles;
    Parallel parallel;
    Nodes nodes;

    explicit Welded(const MeshView& view, unsigned threads = 1)
        : mesh(view), triangles(cutFaces(mesh, Ngons::skip, nullptr)), parallel(Execution{.thread_count = threads}),
          nodes(weld(mesh, triangles, nullptr, parallel)) {}

    Links changes() {
        const LastBucket bucket = findLastBucket({mesh, triangles, nodes}, nullptr, nullptr, parallel);
        EXPECT_FALSE(bucket.abandoned);
        Links links;
        for (const auto& [half_edge, partner] : bucket.links) {
            EXPECT_TRUE(links.empty() || links.rbegin()->first < half_edge);
            links[half_edge] = partner;
            const std::uint32_t first = half_edge / 3 * 3;
            for (const std::uint32_t end : {half_edge, first + (half_edge + 1 - first) % 3}) {
                const std::uint32_t node = nodes.ofVertex(mesh.indices[triangles.corner(end)]);
                EXPECT_TRUE(std::binary_search(bucket.nodes.begin(), bucket.nodes.end(), node));
            }
        }
        return links;
    }
};

/// Finds the same links sequentially by the reference's rules, from a list of all edges.
class AllEdges {
  public:
    explicit AllEdges(Welded& welded) {
        const MeshView& mesh = welded.mesh;
        std::vector<std::uint32_t> representatives(welded.nodes.count, kNone);
        std::vector<std::uint32_t> vertices(mesh.vertexCount());
        std::iota(vertices.begin(), vertices.end(), 0u);
        findRepresentatives({mesh, welded.triangles, welded.nodes}, vertices, representatives.data(), nullptr,
                            welded.parallel);
        for (std::uint32_t t = 0; t < welded.triangles.count; ++t) {
            std::uint32_t r[3];
            Vec3 p[3];
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t corner = welded.triangles.corner(3 * t + k);
                r[k] = representatives[welded.nodes.ofVertex(mesh.indices[corner])];
                p[k] = mesh.positions[mesh.indices[corner]];
            }
            if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t a = r[k], b = r[(k + 1) % 3];
                edges_.push_back({std::min(a, b), std::max(a, b), 3 * t + k, a < b});
            }
        }
    }

    Links changes() {
        if (edges_.empty()) return {};
        std::uint32_t largest = 0;
        for (const Edge& e : edges_) largest = std::max(largest, e.low);
        const auto isLast = [&](const Edge& e) { return e.low == largest; };
        std::vector<Edge> sorted;
        std::copy_if(edges_.begin(), edges_.end(), std::back_inserter(sorted), isLast);
        std::stable_sort(sorted.begin(), sorted.end(), [](const Edge& a, const Edge& b) { return a.high < b.high; });
        const Links usual = pair(sorted);
        sort(0, static_cast<int>(edges_.size()) - 1, 39871946);
        std::vector<Edge> last(std::find_if(edges_.begin(), edges_.end(), isLast), edges_.end());
        for (auto begin = last.begin(); begin != last.end();) {
            const auto end = std::find_if(begin, last.end(), [&](const Edge& e) { return e.high != begin->high; });
            if (end != last.end())
                std::sort(begin, end, [](const Edge& a, const Edge& b) { return a.half_edge < b.half_edge; });
            begin = end;
        }
        Links links = pair(last);
        std::erase_if(links, [&](const auto& link) { return usual.at(link.first) == link.second; });
        return links;
    }

  private:
    struct Edge {
        std::uint32_t low, high, half_edge;
        bool ascending;
    };

    void sort(int left, int right, std::uint32_t seed) {
        const int size = right - left + 1;
        if (size < 2) return;
        if (size == 2) {
            if (edges_[left].low > edges_[right].low) std::swap(edges_[left], edges_[right]);
            return;
        }
        seed += std::rotl(seed, static_cast<int>(seed & 31)) + 3;
        const std::uint32_t pivot = edges_[left + static_cast<int>(seed % static_cast<unsigned>(size))].low;
        int i = left, j = right;
        do {
            while (edges_[i].low < pivot) ++i;
            while (edges_[j].low > pivot) --j;
            if (i <= j) std::swap(edges_[i++], edges_[j--]);
        } while (i <= j);
        sort(left, j, seed);
        sort(i, right, seed);
    }

    static Links pair(const std::vector<Edge>& edges) {
        Links links;
        for (const Edge& e : edges) links[e.half_edge] = kNone;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (links[edges[i].half_edge] != kNone) continue;
            for (std::size_t j = i + 1; j < edges.size() && edges[j].high == edges[i].high; ++j) {
                if (edges[j].ascending == edges[i].ascending || links[edges[j].half_edge] != kNone) continue;
                links[edges[i].half_edge] = edges[j].half_edge;
                links[edges[j].half_edge] = edges[i].half_edge;
                break;
            }
        }
        return links;
    }

    std::vector<Edge> edges_;
};

std::vector<Vec4> tangents(const MeshView& mesh, Pairing pairing) {
    std::vector<Vec4> result(mesh.cornerCount());
    EXPECT_TRUE(generateTangents(mesh, {.convention = conventions::opengl, .ngons = Ngons::skip, .pairing = pairing},
                                 {.tangents = result}, {.thread_count = 1}));
    return result;
}

/// Returns one of several meshes, in natural order or shuffled: sheets, random triangles and quads, triangles around
/// one edge, or fans.
SimpleMesh someShape(std::uint32_t seed) {
    std::mt19937 random(seed);
    SimpleMesh shape;
    switch (seed % 4) {
        case 0: shape = test::grid(1 + random() % 12); break;
        case 1: shape = test::fan(1 + random() % 40); break;
        case 2: shape = test::book(1 + random() % 40, true); break;
        default: {
            const std::uint32_t vertices = 3 + random() % 12;
            const auto value = [&] { return static_cast<float>(random() % 5); };
            for (std::uint32_t v = 0; v < vertices; ++v)
                shape.addVertex({value(), value(), value()}, test::kUp, {value(), value()});
            for (std::uint32_t f = 1 + random() % 60; f-- > 0;) {
                std::vector<std::uint32_t> face(random() % 8 == 0 ? 2 + 2 * (random() % 2) : 3);
                for (std::uint32_t& corner : face) corner = random() % vertices;
                shape.addFace(face);
            }
        }
    }
    for (Vec2& uv : shape.uvs) uv.x += static_cast<float>(random() % 100) / 300.0f;
    if (shape.face_sizes.empty() && random() % 4 != 0) test::shuffleTriangles(shape, seed);
    return shape;
}

TEST(LastBucket, ChangesTheLinksThatAListOfAllEdgesChanges) {
    int changed = 0;
    for (std::uint32_t seed = 0; seed < 8000; ++seed) {
        const SimpleMesh shape = someShape(seed);
        Welded welded(shape.view());
        const Links wanted = AllEdges(welded).changes();
        ASSERT_EQ(welded.changes(), wanted) << seed;
        changed += wanted.empty() ? 0 : 1;
    }
    EXPECT_GT(changed, 40);
}

/// Returns a sheet followed by `tail`. The sheet has so many triangles that only the end of the mesh is examined.
SimpleMesh afterSheet(const SimpleMesh& tail) {
    SimpleMesh shape = test::grid(30);
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    for (std::size_t v = 0; v < tail.positions.size(); ++v)
        shape.addVertex(tail.positions[v], tail.normals[v], tail.uvs[v]);
    if (!tail.face_sizes.empty()) {
        shape.face_sizes.assign(shape.indices.size() / 3, 3);
        shape.face_sizes.insert(shape.face_sizes.end(), tail.face_sizes.begin(), tail.face_sizes.end());
    }
    for (const std::uint32_t v : tail.indices) shape.indices.push_back(first + v);
    return shape;
}

TEST(LastBucket, ChangesTheSameLinksAtTheEndOfALargerMesh) {
    int changed = 0;
    for (std::uint32_t seed = 0; seed < 1600; ++seed) {
        const SimpleMesh shape = afterSheet(someShape(seed));
        Welded welded(shape.view());
        const Links wanted = AllEdges(welded).changes();
        ASSERT_EQ(welded.changes(), wanted) << seed;
        changed += wanted.empty() ? 0 : 1;
    }
    EXPECT_GT(changed, 8);
}

TEST(LastBucket, WithoutAChangeBothPairingsGiveTheSameBits) {
    int different = 0;
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        const SimpleMesh shape = someShape(seed);
        const std::vector<Vec4> reference = tangents(shape.view(), Pairing::reference),
                                corrected = tangents(shape.view(), Pairing::corrected);
        const bool same = std::memcmp(reference.data(), corrected.data(), reference.size() * sizeof(Vec4)) == 0;
        if (Welded(shape.view()).changes().empty()) {
            ASSERT_TRUE(same) << seed;
        }
        different += same ? 0 : 1;
    }
    EXPECT_GT(different, 0);
}

TEST(LastBucket, RarelyChangesAnything) {
    int changed = 0;
    constexpr int kGrids = 1000;
    for (std::uint32_t seed = 0; seed < kGrids; ++seed) {
        SimpleMesh shape = test::grid(3 + seed % 20);
        test::shuffleTriangles(shape, seed);
        changed += Welded(shape.view()).changes().empty() ? 0 : 1;
    }
    EXPECT_GT(changed, 0);
    EXPECT_LT(changed, kGrids / 10);
}

/// The meshes are so large that several threads share the work.
TEST(LastBucket, IsTheSameForLargeMeshesAndAllThreads) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        SimpleMesh shape = seed < 5 ? test::grid(300) : test::fan(100000);
        if (seed > 0) test::shuffleTriangles(shape, seed);
        Welded welded(shape.view());
        const Links wanted = AllEdges(welded).changes();
        for (const unsigned threads : {1u, 2u, 3u}) EXPECT_EQ(Welded(shape.view(), threads).changes(), wanted);
    }
}

/// The first corners of the last triangles' nodes, and therefore their representatives, are all at the start of the
/// mesh.
TEST(LastBucket, IsFoundIfTheLastTrianglesUseOnlyEarlierNodes) {
    SimpleMesh shape = test::grid(80);
    for (int repeat = 0; repeat < 6000; ++repeat) shape.addTriangle(0, 1, 82);
    Welded welded(shape.view());
    EXPECT_EQ(welded.changes(), AllEdges(welded).changes());
    SimpleMesh twice = test::grid(80);
    const std::vector<std::uint32_t> once = twice.indices;
    twice.indices.insert(twice.indices.end(), once.begin(), once.end());
    Welded doubled(twice.view());
    EXPECT_EQ(doubled.changes(), AllEdges(doubled).changes());
}

TEST(LastBucket, IsEmptyWithoutAnEdge) {
    const SimpleMesh shape = test::collapsed(10000);
    EXPECT_TRUE(Welded(shape.view()).changes().empty());
    EXPECT_TRUE(Welded(MeshView{}).changes().empty());
}

TEST(LastBucket, ChangesTheLinksOfToriThatAListOfAllEdgesChanges) {
    int changed = 0;
    for (std::uint32_t columns = 4; columns <= 60; ++columns) {
        for (std::uint32_t rows = 4 + columns % 3; rows <= 60; rows += 3) {
            const SimpleMesh shape = test::torus(columns, rows, rows % 2 != 0);
            Welded welded(shape.view());
            const Links wanted = AllEdges(welded).changes();
            ASSERT_EQ(welded.changes(), wanted) << columns << " " << rows;
            changed += wanted.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(changed, 10);
}

/// Compares with results of tspace 0.x, which processed such meshes differently and was compared with the reference.
TEST(LastBucket, ToriKeepTheirBits) {
    std::uint64_t hash = 0;
    int different = 0;
    for (std::uint32_t columns = 4; columns <= 60; ++columns) {
        for (std::uint32_t rows = 4; rows <= 60; ++rows) {
            const SimpleMesh shape = test::torus(columns, rows, (columns + rows) % 2 != 0);
            const std::vector<Vec4> got = tangents(shape.view(), Pairing::reference);
            for (const Vec4& t : got) {
                for (const float f : {t.x, t.y, t.z, t.w})
                    hash = (hash ^ std::bit_cast<std::uint32_t>(f)) * 0x100000001b3u;
            }
            const std::vector<Vec4> corrected = tangents(shape.view(), Pairing::corrected);
            different += std::memcmp(got.data(), corrected.data(), got.size() * sizeof(Vec4)) != 0 ? 1 : 0;
        }
    }
    EXPECT_EQ(hash, 0x017c21a5ce1f1692u);
    EXPECT_GT(different, 10);
}

}  // namespace
}  // namespace tspace::mikk
