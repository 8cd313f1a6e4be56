// SPDX-License-Identifier: MIT
// Sums of all nodes in one pass over the triangles, and detection of nodes whose triangles form a single fan.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/range_lists.h"
#include "core/base/vec_math.h"
#include "core/tangents/mikktspace/evaluate.h"
#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

// Detection of fans: determines whether the triangles around a node form one connected fan, while they are visited in
// ascending order.
//
// The rule of groups.h links a triangle's outgoing half-edge (to the next node) with the oldest incoming half-edge from
// that node that is not linked yet, and vice versa. As long as no two half-edges of one direction wait for the same
// neighbor, links are unambiguous and form paths, each of which is described by its two waiting ends (`leaves`: an
// outgoing half-edge, `arrives`: an incoming one). A Fan stores two paths.
// More may start before they meet, if triangles are in random order or the second triangles of all quads follow the
// first ones: such a fan uses a ManyPaths of four paths until two are left. A fifth path, an ambiguous link, or a ring
// in addition to other paths makes the fan complex, and its node is handled by the vertex path.

/// The paths of a fan that has more than two.
struct ManyPaths {
    static constexpr std::uint32_t kMost = 4;
    struct Path {
        std::uint32_t leaves, arrives;
    } paths[kMost];
};

/// Pool of ManyPaths, numbered from 1. Its size is one entry for each fan of three triangles or more.
class FanPool {
  public:
    explicit FanPool(ManyPaths* places) : places_(places) {}

    ManyPaths& operator[](std::uint32_t place) { return places_[place - 1]; }
    std::uint32_t take() {
        if (free_ == 0) return ++used_;
        const std::uint32_t place = free_;
        free_ = (*this)[place].paths[0].leaves;
        return place;
    }
    void giveBack(std::uint32_t place) {
        (*this)[place].paths[0].leaves = free_;
        free_ = place;
    }

  private:
    ManyPaths* places_;
    std::uint32_t used_ = 0;  // number of entries that were ever used
    std::uint32_t free_ = 0;  // first entry of the free list, which is linked through paths[0].leaves
};

class Fan {
  public:
    [[nodiscard]] bool isOne() const { return ends_[0] != 0 && ends_[2] == 0; }
    /// Returns a value that is not 0 if the fan has more than one path.
    [[nodiscard]] std::uint32_t secondPath() const { return ends_[2]; }

    /// Adds a triangle. Its corner at this node is followed by the node `next` and preceded by `previous`. Branchless,
    /// because branches would be unpredictable for unordered meshes.
    void add(std::uint32_t next, std::uint32_t previous, FanPool& room) {
        const Four own = Four{next, previous, next, previous} | kTopBit;
        const Four extended = std::bit_cast<Four>(ends_ == __builtin_shufflevector(own, own, 1, 0, 3, 2));
        const Four kept = __builtin_shufflevector(extended, extended, 1, 0, 3, 2);  // other ends of the extended paths
        const Four other = ends_ & ~(extended | kept);
        const bool is_complex = laneBits(std::bit_cast<Mask4>(ends_ == own)) != 0;
        if (is_complex || (laneBits(std::bit_cast<Mask4>(other == 0)) & 5) == 0) [[unlikely]]
            return addToMany({own[0], own[1]}, room);
        // A triangle that extends a path replaces the end of the path that it touches by its other end. The stored ends
        // of a closed ring are stale, but match no triangle.
        const Four changes = ((ends_ ^ own) | extended) & kept;
        const Four grown = own ^ changes ^ turned(changes);
        ends_ = __builtin_shufflevector(grown, other | turned(other), 0, 1, 4, 5);
    }

  private:
    using Four = std::uint32_t __attribute__((vector_size(16)));
    static constexpr Four kComplex{1, 0, 1, 0};
    static Four turned(Four v) { return __builtin_shufflevector(v, v, 2, 3, 0, 1); }

    [[gnu::noinline]] void addToMany(ManyPaths::Path grown, FanPool& room) {
        const bool begins = ends_[1] != 0;
        if (!begins && ends_[3] == 0) return;
        const std::uint32_t place = begins ? room.take() : ends_[2];
        ManyPaths& many = room[place];
        if (begins) many = {{{ends_[0], ends_[1]}, {ends_[2], ends_[3]}}};
        const std::uint32_t kept = join(many, begins ? 2 : ends_[3], grown);
        if (kept > 2) {
            ends_ = Four{1, 0, place, kept};
            return;
        }
        const ManyPaths::Path* path = many.paths;
        ends_ = kept == 0 ? kComplex : Four{path[0].leaves, path[0].arrives, path[1].leaves, path[1].arrives};
        room.giveBack(place);
    }

    /// Adds the path `grown`, joined with the paths that it meets. Returns the number of paths, or 0 if the fan becomes
    /// complex.
    static std::uint32_t join(ManyPaths& many, std::uint32_t count, ManyPaths::Path grown) {
        const auto [next, previous] = grown;
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const ManyPaths::Path path = many.paths[i];
            const bool meets_end = path.leaves == previous, meets_start = path.arrives == next;
            if (meets_end && meets_start) return 0;  // the path closes a ring in addition to other paths
            if (path.leaves == next || path.arrives == previous) return 0;
            if (meets_end) grown.arrives = path.arrives;
            if (meets_start) grown.leaves = path.leaves;
            if (!meets_end && !meets_start) many.paths[kept++] = path;
        }
        if (kept == ManyPaths::kMost) return 0;
        many.paths[kept++] = grown;
        return kept;
    }

    /// Ends of the paths. Path i leaves toward node ends_[2 * i], where a triangle may follow, and arrives from ends_[2
    /// * i + 1]. Nodes are combined with kTopBit, and 0 means no path. A fan with ManyPaths is stored as {1, 0, its
    /// number, count of paths}, and a complex one as kComplex.
    Four ends_{};
};

// Computation of the sums of all nodes, in one pass over the triangles.

/// Weighted sum of a node, and its fan; takes half a cache line.
struct alignas(32) NodeSum {
    float s[4] = {0, 0, 0, 0};  ///< sum of the weighted tangents, followed by the sum of weights
    Fan fan;
};

/// Flags of a triangle in NodeSums::kinds, from the marks of corner_terms.h.
enum TriangleKind : std::uint8_t {
    /// the triangle adds nothing and clears no marks, but links its neighbors in the fan
    kDegenerateUv = kNoUvArea >> kFlagShift,
    kDegenerateTriangle = kDegenerateMark >> kFlagShift,
    kMirrored = kMirroredMark >> kFlagShift,
};

struct NodeSums {
    Buffer<NodeSum> nodes;
    /// Marks that all corners of a node have in common (corner_terms.h). 0 for nodes of degenerate triangles; these
    /// nodes are complex (words.h).
    Buffer<std::uint16_t> marks;
    Buffer<GroupRest>
        rest;  ///< one per node: bitangents and lengths; their weight is in `nodes`. Empty when tangents_only
    Buffer<TriangleKind> kinds;  ///< one per triangle; valid only during the call
    bool scattered = false;      ///< true: the nodes of consecutive triangles are far apart in memory
    TangentReport report;        ///< counts of triangles

    /// Returns the sum of a node.
    [[nodiscard]] float* row(std::size_t node) { return nodes[node].s; }
    [[nodiscard]] const float* row(std::size_t node) const { return nodes[node].s; }

    /// Returns whether no triangle contributes to the node, because it has none or all have degenerate UVs. Such a node
    /// has both facing marks, which no triangle has.
    [[nodiscard]] bool isEmpty(std::size_t node) const {
        return (marks[node] & (kFacesUp | kFacesDown)) == (kFacesUp | kFacesDown);
    }
};

/// Triangles of the mesh for range lists and estimators, where each node is a group. `kinds`: null, or NodeSums::kinds;
/// with kinds, triangles without UV area contribute nothing.
class MeshTriangles final : public TriangleGroups {
  public:
    MeshTriangles(const WeldedMesh& welded, const TriangleKind* kinds)
        : TriangleGroups(welded.triangles.count), in_(welded), kinds_(kinds) {}
    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* groups) const override;
    void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                  std::uint32_t* groups) const override;
    [[nodiscard]] InPlace inPlace(std::size_t first, std::size_t size) const override;

  private:
    /// Fills `vertices` and `groups` from the vertices of the triangles.
    template <class NumberOf>
    void finish(const std::uint32_t* found, std::size_t size, const NumberOf& numberOf, std::uint32_t* vertices,
                std::uint32_t* groups) const;

    const WeldedMesh& in_;
    const TriangleKind* kinds_;
};

/// Callback finish(first, end), which is called when the sums of these nodes are complete. `first` is a multiple of 64.
/// Called by all threads.
using FinishNodes = std::function<void(std::size_t, std::size_t)>;

/// Calls `finish` for all nodes, in ranges.
void finishInRanges(std::size_t count, const FinishNodes& finish, Parallel& parallel);

/// Computes `sums`, and finishes all nodes, range by range. Requires that nodes.vertex() is valid. `transient`: scratch
/// memory that is not read after tangents are written. `range_shift`: log2 of the number of nodes per range; 0: chosen
/// for the mesh.
void sumNodes(const WeldedMesh& welded, const CornerSource& source, CornerTermsFunction terms, ScratchBlock& transient,
              const Allocator* allocator, Parallel& parallel, NodeSums& sums, const FinishNodes& finish,
              unsigned range_shift = 0);

}  // namespace tspace::mikk
