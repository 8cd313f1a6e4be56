// SPDX-License-Identifier: MIT
// Welding: which vertices become one node, how nodes are numbered, and which vertex's data represents a node.
#include "core/tangents/mikktspace/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "core/base/memory.h"
#include "core/tangents/mikktspace/words.h"
#include "core/tangents/shapes.h"

namespace tspace::mikk {
namespace {

using test::SimpleMesh;

constexpr std::size_t kMany = 100000;  // enough vertices to keep all threads busy

Nodes weldWith(const MeshView& mesh, unsigned threads, const Allocator* transient = nullptr) {
    Parallel parallel(Execution{.thread_count = threads});
    const TriangleList triangles = cutFaces(mesh, Ngons::skip, nullptr);
    return weld(mesh, triangles, nullptr, parallel, transient);
}

/// Returns the node of each vertex, found with a search tree. Nodes are numbered in the order of their first vertices.
std::vector<std::uint32_t> wantedNodes(const MeshView& mesh) {
    std::map<std::array<float, 8>, std::uint32_t> found;
    std::vector<std::uint32_t> nodes;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const Vec3 &p = mesh.positions[v], &n = mesh.normals[v];
        const Vec2& uv = mesh.uvs[v];
        const auto next = static_cast<std::uint32_t>(found.size());
        nodes.push_back(found.insert({{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}, next}).first->second);
    }
    return nodes;
}

void expectWanted(const MeshView& mesh) {
    const std::vector<std::uint32_t> want = wantedNodes(mesh);
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        const Nodes nodes = weldWith(mesh, threads);
        ASSERT_TRUE(nodes.all_finite);
        EXPECT_EQ(nodes.count, *std::max_element(want.begin(), want.end()) + std::size_t{1});
        std::size_t different = 0;
        for (std::uint32_t v = 0; v < want.size(); ++v) different += nodes.ofVertex(v) != want[v] ? 1u : 0u;
        EXPECT_EQ(different, 0u) << threads << " threads";
    }
}

/// Checks that the nodes keep no data in the transient memory, whether it is large enough for all transient data or
/// only for a part.
void expectTheSameWithTransientMemory(const MeshView& mesh) {
    const Nodes want = weldWith(mesh, 2);
    for (const std::size_t bytes_per_vertex : {1u, 5u, 64u}) {
        std::vector<std::byte> memory(bytes_per_vertex * mesh.vertexCount() + 4096);
        ScratchBlock transient(nullptr, std::span<std::byte>(memory));
        const Nodes nodes = weldWith(mesh, 2, transient.allocator());
        std::fill(memory.begin(), memory.end(), std::byte{0xff});
        EXPECT_EQ(nodes.count, want.count);
        EXPECT_TRUE(std::ranges::equal(nodes.of_vertex, want.of_vertex)) << bytes_per_vertex;
        EXPECT_TRUE(std::ranges::equal(nodes.vertices, want.vertices)) << bytes_per_vertex;
    }
}

/// Returns random vertices, each of which is a copy of an earlier one with probability 1 / `rarity`. Triangles use all
/// vertices.
SimpleMesh randomVertices(std::size_t count, unsigned rarity) {
    std::mt19937 random(7);
    SimpleMesh shape;
    const auto value = [&] { return static_cast<float>(random() % 64) - 32.0f; };
    for (std::size_t v = 0; v < count; ++v) {
        const std::size_t other = v == 0 ? 0 : random() % v;
        if (v > 0 && random() % rarity == 0) {
            shape.addVertex(shape.positions[other], shape.normals[other], shape.uvs[other]);
        } else {
            shape.addVertex({value(), value(), value()}, {value(), value(), value()}, {value(), value()});
        }
        shape.indices.push_back(static_cast<std::uint32_t>(v));
    }
    return shape;
}

TEST(Weld, FindsTheFewEqualVerticesOfAnIndexedMesh) { expectWanted(randomVertices(kMany, 100).view()); }

TEST(Weld, FindsEqualVerticesWhereMostAreEqual) {
    SimpleMesh shape = randomVertices(kMany, 100);
    for (std::size_t v = kMany; v-- > 0;) {  // makes each vertex one of 1000
        const std::size_t other = v * 7919 % 1000;
        shape.positions[v] = shape.positions[other];
        shape.normals[v] = shape.normals[other];
        shape.uvs[v] = shape.uvs[other];
    }
    expectWanted(shape.view());
    MeshView unindexed = shape.view();
    unindexed.indices = {};
    unindexed.positions.count = unindexed.normals.count = unindexed.uvs.count = kMany - kMany % 3;
    expectWanted(unindexed);
}

TEST(Weld, PutsNoPermanentDataIntoTransientMemory) {
    const SimpleMesh few = randomVertices(kMany, 100);
    expectTheSameWithTransientMemory(few.view());
    const SimpleMesh many = randomVertices(kMany - kMany % 3, 2);
    MeshView unindexed = many.view();
    unindexed.indices = {};
    expectTheSameWithTransientMemory(unindexed);
    SimpleMesh zeros = few;
    zeros.positions[1] = {0, 0, 0};
    zeros.positions[2] = {0, -0.0f, 0};
    zeros.normals[2] = zeros.normals[1];
    zeros.uvs[2] = zeros.uvs[1];
    ASSERT_TRUE(weldWith(zeros.view(), 1).mixed);
    expectTheSameWithTransientMemory(zeros.view());
    SimpleMesh wild = few;
    wild.normals[5].x = std::numeric_limits<float>::quiet_NaN();
    ASSERT_FALSE(weldWith(wild.view(), 1).all_finite);
    expectTheSameWithTransientMemory(wild.view());
}

TEST(Weld, MakesOneNodeOfOneVertexRepeated) {
    SimpleMesh shape;
    for (std::size_t v = 0; v < kMany; ++v) {
        shape.addVertex({1, 2, 3}, {0, 0, 1}, {0.5f, 0.5f});
        shape.indices.push_back(static_cast<std::uint32_t>(v));
    }
    expectWanted(shape.view());
}

TEST(Weld, KeepsVerticesThatDifferInOneValue) {
    for (int changed = 0; changed < 8; ++changed) {
        SimpleMesh shape;
        for (std::size_t v = 0; v < 3000; ++v) {
            std::array<float, 8> x = {1, 2, 3, 4, 5, 6, 7, 8};
            x[static_cast<std::size_t>(changed)] = static_cast<float>(v);
            shape.addVertex({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7]});
            shape.indices.push_back(static_cast<std::uint32_t>(v));
        }
        EXPECT_EQ(weldWith(shape.view(), 1).count, 3000u);
    }
}

TEST(Weld, UsesNoExtraMemoryWithoutEqualVertices) {
    const SimpleMesh shape = test::grid(100);
    const Nodes nodes = weldWith(shape.view(), 1);
    EXPECT_EQ(nodes.count, shape.positions.size());
    EXPECT_TRUE(nodes.of_vertex.empty() && nodes.vertices.empty());
}

TEST(Weld, ReadsStridesAndIndicesOfOtherWidths) {
    struct Packed {
        float before;
        Vec3 normal;
        Vec2 uv;
        Vec3 position;
    };
    const SimpleMesh shape = randomVertices(60000, 20);
    std::vector<Packed> packed;
    for (std::size_t v = 0; v < shape.positions.size(); ++v)
        packed.push_back({1, shape.normals[v], shape.uvs[v], shape.positions[v]});
    const std::vector<std::uint16_t> narrow(shape.indices.begin(), shape.indices.end());
    MeshView mesh;
    mesh.positions = {&packed[0].position, packed.size(), sizeof(Packed)};
    mesh.normals = {&packed[0].normal, packed.size(), sizeof(Packed)};
    mesh.uvs = {&packed[0].uv, packed.size(), sizeof(Packed)};
    mesh.indices = IndexView(std::span<const std::uint16_t>(narrow));
    EXPECT_EQ(wantedNodes(mesh), wantedNodes(shape.view()));
    expectWanted(mesh);
}

TEST(Weld, TreatsZerosOfBothSignsAsEqual) {
    SimpleMesh shape;
    for (const float zero : {0.0f, -0.0f, 0.0f}) shape.addVertex({zero, 0, 0}, {0, 0, 1}, {0, -zero});
    shape.addVertex({1, 0, 0}, {0, 0, 1}, {1, 0});
    shape.addVertex({0, 1, 0}, {0, 0, 1}, {0, 1});
    shape.addTriangle(1, 3, 4);  // 1 is the only used vertex of its node, so it represents the node
    const Nodes nodes = weldWith(shape.view(), 1);
    EXPECT_EQ(nodes.count, 3u);
    EXPECT_TRUE(nodes.mixed);
    EXPECT_EQ(nodes.vertex(nodes.ofVertex(1)), 1u);
}

TEST(Weld, IgnoresExtremeUnusedVertices) {
    SimpleMesh shape = test::grid(10);
    const std::size_t count = shape.positions.size();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (int i = 0; i < 3; ++i) shape.addVertex({nan, 0, 0}, {0, 0, 1}, {0, 0});
    shape.addVertex({3e38f, 0, 0}, {0, 0, 1}, {0, std::numeric_limits<float>::infinity()});
    const Nodes nodes = weldWith(shape.view(), 1);
    EXPECT_TRUE(nodes.all_finite);
    EXPECT_EQ(nodes.count, count + 2);
}

TEST(Weld, GivesVerticesWithTheSameNaNOneNode) {
    SimpleMesh shape = test::grid(10);
    const std::size_t count = shape.positions.size();
    for (int i = 0; i < 2; ++i) {
        shape.addVertex(shape.positions[60], shape.normals[60], {std::numeric_limits<float>::quiet_NaN(), 0});
        shape.indices[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(count) + static_cast<std::uint32_t>(i);
    }
    const Nodes nodes = weldWith(shape.view(), 1);
    EXPECT_FALSE(nodes.all_finite);
    EXPECT_EQ(nodes.count, count + 1);
}

}  // namespace
}  // namespace tspace::mikk
