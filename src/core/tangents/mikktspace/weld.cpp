// SPDX-License-Identifier: MIT
// Triangulation of faces by the rule of face_cutter.h, and welding.
#include "core/tangents/mikktspace/weld.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "core/base/mesh_loops.h"
#include "core/base/vec_math.h"
#include "core/base/weld.h"
#include "core/frames/face_cutter.h"
#include "core/tangents/mikktspace/grid_order.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {
namespace {

/// Returns whether faces of a size are triangulated. All other faces are skipped.
bool isUsed(std::uint32_t size, Ngons ngons) {
    return size == 3 || size == 4 || (size > 4 && ngons == Ngons::triangulate);
}

/// Counts of faces and corners. There are fewer than 2^31 corners.
struct FaceCounts {
    std::uint32_t triangles = 0;  // number of triangles after triangulation
    std::uint32_t faces_of_three = 0, skipped_faces = 0, skipped_corners = 0;
};

/// Counts faces from their sizes, by a branchless loop that compilers vectorize: a size that is not used counts as 0.
FaceCounts countFaces(std::span<const std::uint32_t> sizes, Ngons ngons) {
    std::uint32_t corners = 0, used_corners = 0, used_faces = 0, faces_of_three = 0;
    for (const std::uint32_t size : sizes) {
        const std::uint32_t used_size = isUsed(size, ngons) ? size : 0;
        corners += size;
        used_corners += used_size;
        used_faces += used_size != 0 ? 1 : 0;
        faces_of_three += size == 3 ? 1 : 0;
    }
    const auto faces = static_cast<std::uint32_t>(sizes.size());
    return {used_corners - 2 * used_faces, faces_of_three, faces - used_faces, corners - used_corners};
}

/// Counts the faces of a mesh, from the list of their sizes, or from their common size.
FaceCounts countFaces(const MeshView& mesh, Ngons ngons) {
    if (!mesh.face_sizes.empty()) return countFaces(mesh.face_sizes, ngons);
    const std::uint32_t size = mesh.face_size;
    const auto faces = static_cast<std::uint32_t>(mesh.faceCount());
    FaceCounts counts = countFaces(std::span(&size, faces == 0 ? 0 : 1), ngons);
    for (std::uint32_t* count :
         {&counts.triangles, &counts.faces_of_three, &counts.skipped_faces, &counts.skipped_corners})
        *count *= faces;
    return counts;
}

}  // namespace

std::uint64_t countTriangles(const MeshView& mesh, Ngons ngons) { return countFaces(mesh, ngons).triangles; }

TriangleList cutFaces(const MeshView& mesh, Ngons ngons, const Allocator* allocator) {
    const FaceCounts counts = countFaces(mesh, ngons);
    TriangleList list;
    list.count = counts.triangles;
    if (counts.faces_of_three == mesh.faceCount()) return list;
    list.skipped_face_count = counts.skipped_faces;
    list.corners = Buffer<std::uint32_t>(allocator, 3 * list.count);
    list.faces = Buffer<std::uint32_t>(allocator, list.count);
    list.skipped_corners = Buffer<std::uint32_t>(allocator, counts.skipped_corners);
    FaceCutter cutter(mesh);
    std::uint32_t *to = list.corners.data(), *face_of = list.faces.data(), *skipped = list.skipped_corners.data();
    forEachFace(mesh, [&](std::size_t face, std::size_t corner, std::uint32_t size) {
        if (isUsed(size, ngons)) {
            cutter.cut(corner, size, to);
            to += 3 * (size - 2);
            face_of = std::fill_n(face_of, size - 2, static_cast<std::uint32_t>(face));
        } else {
            for (std::uint32_t k = 0; k < size; ++k) *skipped++ = static_cast<std::uint32_t>(corner + k);
        }
    });
    return list;
}

// Welding of vertices. The reference sorts corners into cells of a grid and compares the corners of each cell with each
// other, whereas this code hashes the vertices of the mesh (core/base/weld.h). Both find the same classes;
// grid_order.cpp finds the reference's representatives where they matter.

namespace {

/// Maximum position. The reference adds the bounds of intervals of positions: above this value the sum may overflow,
/// and its welding stops.
constexpr float kHugePosition = 1.6e38f;
constexpr std::size_t kPrefetchAhead = 32;  // number of entries between the prefetch of a root and its comparison

bool equal(const MeshView& mesh, std::size_t a, std::size_t b) {
    return mesh.positions[a] == mesh.positions[b] && mesh.normals[a] == mesh.normals[b] && mesh.uvs[a] == mesh.uvs[b];
}

bool isAllFinite(const MeshView& mesh, std::size_t v) {
    const Vec3& p = mesh.positions[v];
    const bool small =
        std::fabs(p.x) < kHugePosition && std::fabs(p.y) < kHugePosition && std::fabs(p.z) < kHugePosition;
    return small && isFinite(mesh.normals[v]) && std::isfinite(mesh.uvs[v].x) && std::isfinite(mesh.uvs[v].y);
}

std::uint64_t pairAt(const void* at) {
    std::uint64_t pair = 0;
    std::memcpy(&pair, at, sizeof pair);
    return pair;
}

/// Returns whether two vertices have equal bits. Words are read in place: a copy would be stored in small parts and
/// loaded in large ones, which defeats store forwarding.
bool sameBits(const MeshView& mesh, std::size_t a, std::size_t b) {
    const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &m = mesh.normals[a], &n = mesh.normals[b];
    const std::uint64_t xy = (pairAt(&p) ^ pairAt(&q)) | (pairAt(&m) ^ pairAt(&n));
    const std::uint32_t z = (std::bit_cast<std::uint32_t>(p.z) ^ std::bit_cast<std::uint32_t>(q.z)) |
                            (std::bit_cast<std::uint32_t>(m.z) ^ std::bit_cast<std::uint32_t>(n.z));
    return (xy | z | (pairAt(&mesh.uvs[a]) ^ pairAt(&mesh.uvs[b]))) == 0;
}

/// Four floats or words, as compiler vectors, which compile to scalar code if the target has no SIMD.
using Fours = float __attribute__((vector_size(16)));
using Words = std::uint32_t __attribute__((vector_size(16)));
using Pairs = std::uint64_t __attribute__((vector_size(16)));

/// The eight floats of a vertex, reordered. Adding +0 converts -0 to +0, so vertices that compare equal have equal
/// bits.
struct VertexWords {
    Fours a, b;

    VertexWords(const Vec3& p, const Vec3& n, const Vec2& uv)
        : a(std::bit_cast<Fours>(Pairs{pairAt(&p), pairAt(&n)}) + Fours{}),
          b(std::bit_cast<Fours>(Pairs{std::bit_cast<Pairs>(Fours{p.z, n.z, 0, 0})[0], pairAt(&uv)}) + Fours{}) {}

    /// Returns in which lanes the values are finite and not huge. Large normals and UVs count as huge too.
    [[nodiscard]] auto isFinite() const {
        const Fours limit = Fours{} + kHugePosition;
        const Words no_sign = Words{} + 0x7fffffffu;
        return (std::bit_cast<Fours>(std::bit_cast<Words>(a) & no_sign) < limit) &
               (std::bit_cast<Fours>(std::bit_cast<Words>(b) & no_sign) < limit);
    }
    [[nodiscard]] std::uint32_t hash() const {
        // One half is rotated, so that signs that change together (mirrored shapes) do not cancel.
        const Words turned = std::bit_cast<Words>(b) << 13 | std::bit_cast<Words>(b) >> 19;
        const Pairs both = std::bit_cast<Pairs>(std::bit_cast<Words>(a) ^ turned);
        std::uint64_t h = both[0] * 0xbf58476d1ce4e5b9u ^ std::rotl(both[1] * 0x94d049bb133111ebu, 32);
        h = (h ^ h >> 29) * 0x9e3779b97f4a7c15u;
        return static_cast<std::uint32_t>(h >> 32);
    }
    [[nodiscard]] bool operator==(const VertexWords& other) const {
        const Words differences = (std::bit_cast<Words>(a) ^ std::bit_cast<Words>(other.a)) |
                                  (std::bit_cast<Words>(b) ^ std::bit_cast<Words>(other.b));
        const Pairs both = std::bit_cast<Pairs>(differences);
        return (both[0] | both[1]) == 0;
    }
};

/// Hashes the vertices in [begin, end). Returns whether all of them are finite and not huge.
bool hashVertices(const MeshView& mesh, std::size_t begin, std::size_t end, std::uint32_t* hashes) {
    auto finite = Fours{} == Fours{};
    const StridedSpan<const Vec3> positions = mesh.positions, normals = mesh.normals;
    const StridedSpan<const Vec2> uvs = mesh.uvs;
    for (std::size_t v = begin; v < end; ++v) {
        const VertexWords words(positions[v], normals[v], uvs[v]);
        finite &= words.isFinite();
        hashes[v] = words.hash();
    }
    return (finite[0] & finite[1] & finite[2] & finite[3]) != 0;
}

/// Positions, normals and UVs of vertices, which are compared for welding.
class CornerData final : public Weldable {
  public:
    explicit CornerData(const MeshView& mesh) : mesh_(mesh) {}

    /// Returns whether all vertices are finite and not huge; valid after hashing.
    [[nodiscard]] bool allFinite() const { return all_finite_; }
    /// Returns whether any vertex differs from its root in the sign of a zero; valid after the search for roots.
    [[nodiscard]] bool mixed() const { return mixed_; }

    void hash(std::size_t begin, std::size_t end, std::uint32_t* hashes) override {
        if (!hashVertices(mesh_, begin, end, hashes)) all_finite_.store(false, std::memory_order_relaxed);
    }
    bool compare(const std::uint32_t* list, std::size_t begin, std::size_t end, std::uint32_t* roots) override {
        const auto vertexOf = [=](std::size_t i) { return list == nullptr ? static_cast<std::uint32_t>(i) : list[i]; };
        bool mixed = false, different = false;
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t later = i + kPrefetchAhead;
            if (later < end && roots[later] != vertexOf(later)) prefetch(roots[later]);
            const std::uint32_t vertex = vertexOf(i), root = roots[i];
            if (root == vertex) continue;
            if (sameBits(mesh_, vertex, root)) continue;
            if (equal(mesh_, vertex, root)) {
                mixed = true;
            } else {
                roots[i] = kNoRoot;
                different = true;
            }
        }
        if (mixed) mixed_.store(true, std::memory_order_relaxed);
        return different;
    }
    [[nodiscard]] int order(std::uint32_t a, std::uint32_t b) const override {
        const VertexWords here = words(a), there = words(b);
        return std::memcmp(&here, &there, sizeof here);
    }

  private:
    [[nodiscard]] VertexWords words(std::uint32_t v) const {
        return {mesh_.positions[v], mesh_.normals[v], mesh_.uvs[v]};
    }
    void prefetch(std::uint32_t vertex) const {
        __builtin_prefetch(&mesh_.positions[vertex]);
        __builtin_prefetch(&mesh_.normals[vertex]);
        __builtin_prefetch(&mesh_.uvs[vertex]);
    }

    const MeshView& mesh_;
    std::atomic<bool> all_finite_{true}, mixed_{false};
};

/// Numbers the nodes by their first vertices. Branchless, since branches would be unpredictable.
void numberNodes(Buffer<std::uint32_t> root_of, Nodes& nodes) {
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < root_of.size(); ++v) {
        const std::uint32_t root = root_of[v];
        const std::uint32_t node = root_of[root];  // the number of a node already, unless v is the root itself
        const std::uint32_t is_first = root == v ? 1 : 0;
        root_of[v] = node + is_first * (next - node);
        next += is_first;
    }
    if (next == root_of.size()) return;
    nodes.count = next;
    nodes.of_vertex = std::move(root_of);
}

/// Maximum number of vertices of a mesh for weldFew.
constexpr std::size_t kFewVertices = 192;
void weldFew(const MeshView& mesh, const Allocator* allocator, Nodes& nodes) {
    constexpr unsigned kLog2 = 9;
    constexpr std::size_t kPlaces = std::size_t{1} << kLog2;
    static_assert(kFewVertices < 256 && 2 * kFewVertices < kPlaces);
    alignas(VertexWords) std::byte room[kFewVertices * sizeof(VertexWords)];
    auto* const known = reinterpret_cast<VertexWords*>(room);  // data of each node
    std::uint8_t table[kPlaces] = {};                          // numbers of nodes, from 1
    Buffer<std::uint32_t> of_vertex(allocator, mesh.vertexCount()), vertices(allocator, mesh.vertexCount());
    auto finite = Fours{} == Fours{};
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < of_vertex.size(); ++v) {
        const VertexWords words(mesh.positions[v], mesh.normals[v], mesh.uvs[v]);
        finite &= words.isFinite();
        std::size_t place = words.hash() >> (32 - kLog2);
        while (table[place] != 0 && !(known[table[place] - 1] == words)) place = (place + 1) % kPlaces;
        if (table[place] == 0) {
            known[count] = words;
            vertices[count] = v;
            table[place] = static_cast<std::uint8_t>(++count);
        } else {
            nodes.mixed |= !sameBits(mesh, v, vertices[table[place] - 1]);
        }
        of_vertex[v] = table[place] - 1u;
    }
    nodes.all_finite = (finite[0] & finite[1] & finite[2] & finite[3]) != 0;
    if (count == of_vertex.size()) return;
    nodes.count = count;
    nodes.of_vertex = std::move(of_vertex);
    nodes.vertices = std::move(vertices);
}

/// If nodes mix -0 and +0, selects the data of the reference's representative, whose bits matter.
[[gnu::cold]] void resolveMixed(const MeshView& mesh, const TriangleList& triangles, Nodes& nodes,
                                const Allocator* allocator, Parallel& parallel) {
    listVertices(nodes, allocator);
    Growing<std::uint32_t> different(allocator);
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const std::uint32_t first = nodes.vertices[nodes.of_vertex[v]];
        if (!sameBits(mesh, v, first)) different.push(first);
    }
    Buffer<std::uint32_t> corners(allocator, nodes.count, kNone);
    findRepresentatives({mesh, triangles, nodes}, {different.begin(), different.end()}, corners.data(), allocator,
                        parallel);
    for (std::size_t node = 0; node < nodes.count; ++node) {
        if (corners[node] != kNone) nodes.vertices[node] = mesh.indices[corners[node]];
    }
}

[[gnu::cold]] bool usesFiniteVerticesOnly(const MeshView& mesh, const TriangleList& triangles) {
    for (std::size_t i = 0; i < 3 * triangles.count; ++i) {
        if (!isAllFinite(mesh, mesh.indices[triangles.corner(i)])) return false;
    }
    return true;
}

}  // namespace

Nodes weld(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator, Parallel& parallel,
           const Allocator* transient) {
    if (transient == nullptr) transient = allocator;
    const std::size_t count = mesh.vertexCount();
    Nodes nodes;
    nodes.count = count;
    if (count <= kFewVertices) {
        weldFew(mesh, allocator, nodes);
    } else {
        CornerData data(mesh);
        const bool is_indexed = mesh.indices.type != IndexType::none;
        numberNodes(findRoots(data, count, is_indexed, allocator, transient, parallel), nodes);
        nodes.mixed = data.mixed();
        nodes.all_finite = data.allFinite();
    }
    nodes.all_finite = nodes.all_finite || usesFiniteVerticesOnly(mesh, triangles);
    if (nodes.mixed && nodes.all_finite) resolveMixed(mesh, triangles, nodes, allocator, parallel);
    return nodes;
}

void listVertices(Nodes& nodes, const Allocator* allocator) {
    if (nodes.of_vertex.empty() || !nodes.vertices.empty()) return;
    nodes.vertices = Buffer<std::uint32_t>(allocator, nodes.count);
    std::uint32_t next = 0;
    std::uint32_t* const vertices = nodes.vertices.data();
    for (std::size_t v = 0; next < nodes.count; ++v) {
        vertices[next] = static_cast<std::uint32_t>(v);  // overwritten until v is the first vertex of node `next`
        next += nodes.of_vertex[v] == next ? 1u : 0u;
    }
}

}  // namespace tspace::mikk
