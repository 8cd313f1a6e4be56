// SPDX-License-Identifier: MIT
// The sums of all nodes, by one sweep over the triangles.
#pragma once

#include <functional>

#include "core/base/float4.h"
#include "core/base/parallel.h"
#include "core/base/range_lists.h"
#include "core/base/scratch_block.h"
#include "core/tangents/mikktspace/fan.h"
#include "core/tangents/mikktspace/results.h"
#include "core/tangents/mikktspace/weld.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {

/// The weighted sum of a node and its fan: half a cache line.
struct alignas(32) NodeSum {
    float s[4] = {0, 0, 0, 0};  ///< sum of weighted tangents, and of weights
    Fan fan;
};

/// Flags of a triangle in NodeSums::kinds, from the marks of corner_terms.h.
enum TriangleKind : std::uint8_t {
    kDegenerateUv = kNoUvArea >> kFlagShift,  ///< adds nothing and clears no marks, but links its neighbours in the fan
    kDegenerateTriangle = kDegenerateMark >> kFlagShift,
    kMirrored = kMirroredMark >> kFlagShift,
};

struct NodeSums {
    Buffer<NodeSum> nodes;
    Buffer<std::uint16_t> marks;  ///< one per node: marks that all its corners have (corner_terms.h); 0 at nodes of
                                  ///< degenerate triangles, which are complex
    Buffer<GroupRest>
        rest;  ///< one per node: bitangents and lengths; their weight is in `nodes`. Empty when tangents_only
    Buffer<TriangleKind> kinds;  ///< one per triangle, transient
    bool scattered = false;      ///< the nodes of consecutive triangles lie far apart in memory
    TangentReport report;        ///< counts of triangles

    /// The sum of a node.
    [[nodiscard]] float* row(std::size_t node) { return nodes[node].s; }
    [[nodiscard]] const float* row(std::size_t node) const { return nodes[node].s; }

    /// Whether no triangle adds to the node, because it has none or all have degenerate UVs. No triangle faces both ways.
    [[nodiscard]] bool isEmpty(std::size_t node) const {
        return (marks[node] & (kFacesUp | kFacesDown)) == (kFacesUp | kFacesDown);
    }
};

/// The mesh's triangles, as range lists and estimators read them: each node is a group. `kinds`: null, or NodeSums::kinds;
/// then triangles without UV area add nothing.
class MeshTriangles final : public TriangleGroups {
  public:
    MeshTriangles(const WeldedMesh& welded, const TriangleKind* kinds)
        : TriangleGroups(welded.triangles.count), in_(welded), kinds_(kinds) {}
    void read(std::size_t first, std::size_t size, std::uint32_t* vertices, std::uint32_t* groups) const override;
    void readSome(const std::uint32_t* numbers, std::size_t size, std::uint32_t* vertices,
                  std::uint32_t* groups) const override;
    [[nodiscard]] const std::uint32_t* inPlace(std::size_t first, std::size_t size) const override;

  private:
    /// Fills `vertices` and `groups` from the triangles' vertices.
    template <class NumberOf>
    void finish(const std::uint32_t* found, std::size_t size, const NumberOf& numberOf, std::uint32_t* vertices,
                std::uint32_t* groups) const;

    const WeldedMesh& in_;
    const TriangleKind* kinds_;
};

/// finish(first, end): the sums of these nodes are complete. `first` is a multiple of 64. Called by all threads.
using FinishNodes = std::function<void(std::size_t, std::size_t)>;

/// Calls `finish` for all nodes.
void finishInRanges(std::size_t count, const FinishNodes& finish, Parallel& parallel);

/// Fills `sums`, and finishes all nodes, range by range. nodes.vertex() must be valid. `transient`: scratch memory that is not
/// read any more when tangents are written. `range_shift`: log2 of the nodes of a range; 0: chosen for the mesh.
void sumNodes(const WeldedMesh& welded, const CornerSource& source, CornerTermsFunction terms, ScratchBlock& transient,
              const Allocator* allocator, Parallel& parallel, NodeSums& sums, const FinishNodes& finish,
              unsigned range_shift = 0);

}  // namespace tspace::mikk
