// SPDX-License-Identifier: MIT
// The sums of all nodes, filled by one pass over the triangles in their order.
#pragma once

#include <cstring>
#include <functional>

#include "core/parallel.h"
#include "core/scratch_block.h"
#include "tangents/mikktspace/corner_terms.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/fan.h"
#include "tangents/mikktspace/weld.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

/// What is known of a node: half a cache line.
struct alignas(32) NodeSum {
    float s[4] = {0, 0, 0, 0};  ///< sum of weighted tangents, and of weights
    Fan fan;
};

/// The same without a fan, for sums from buckets.
struct alignas(16) NodeRow {
    float s[4];
};

/// The rest, when more than tangents is asked for.
struct alignas(16) NodeRest {
    float t[4] = {0, 0, 0, 0};  ///< sum of weighted bitangents, and of weighted |dP/du|
};

struct NodeSums {
    Buffer<NodeSum> nodes;        ///< empty when sums are from buckets; then the marks tell all about fans
    Buffer<NodeRow> rows;         ///< empty when they are not
    Buffer<std::uint16_t> marks;  ///< one per node: those that all its corners have (corner_terms.h); 0: left
                                  ///< aside, as all nodes of degenerate triangles are
    Buffer<NodeRest> rest;        ///< empty when tangents_only
    Buffer<float> lengths_t;      ///< sums of weighted |dP/dv|; empty when tangents_only
    /// Triangles without usable UV area. They add nothing, and mark nothing, but link what lies on both
    /// sides.
    Buffer<std::uint8_t> flat;  ///< one per triangle: 1 for those; brief
    bool scattered = false;     ///< consecutive triangles lie far apart in memory
    std::uint64_t degenerate_count = 0, no_uv_area_count = 0, mirrored_count = 0;

    void makeNodes(const Allocator* allocator, std::size_t count) {
        nodes = Buffer<NodeSum>(allocator, count);
        first_row_ = reinterpret_cast<float*>(nodes.data());
        row_floats_ = sizeof(NodeSum) / sizeof(float);
    }
    void makeRows(const Allocator* allocator, std::size_t count) {
        rows = Buffer<NodeRow>(allocator, count);
        first_row_ = reinterpret_cast<float*>(rows.data());
        row_floats_ = sizeof(NodeRow) / sizeof(float);
    }
    /// The sum of a node.
    [[nodiscard]] float* row(std::size_t node) const { return first_row_ + row_floats_ * node; }
    [[nodiscard]] std::size_t rowBytes() const { return row_floats_ * sizeof(float); }

    /// When all results are written, rows may hold numbers.
    [[nodiscard]] std::uint32_t number(std::size_t node) const {
        std::uint32_t number = 0;
        std::memcpy(&number, row(node), sizeof number);
        return number;
    }
    void setNumber(std::size_t node, std::uint32_t number) { std::memcpy(row(node), &number, sizeof number); }

    /// Whether no triangle adds to the node: there are none, or all are flat.
    [[nodiscard]] bool isEmpty(std::size_t node) const {
        return (marks[node] & (kFacesUp | kFacesDown)) == (kFacesUp | kFacesDown);
    }
    /// Whether all corners of the node are one group. `may_split`: the reference's angular test applies to
    /// it.
    [[nodiscard]] bool isOneGroup(std::size_t node, const Vec3& normal, bool may_split) const;

  private:
    float* first_row_ = nullptr;
    std::size_t row_floats_ = 0;
};

/// Whether a sum of several tangents and their weights (corner_terms.h), and the marks that they have in
/// common, show that the angular test separates none of them.
bool sumCannotSplit(const float* sum, std::uint32_t marks, const Vec3& normal);

/// finish(first, end): the sums of these nodes are complete. `first` is a multiple of 64. Called by all threads.
using FinishNodes = std::function<void(std::size_t, std::size_t)>;

/// For all nodes.
void finishInRanges(std::size_t count, const FinishNodes& finish, Parallel& parallel);

/// Fills `sums`, and finishes all nodes: those of buckets while the caches hold them. `nodes` must be tame, and
/// nodes.vertex() valid. `brief`: for what is not needed any more when tangents are written; with 32 bytes per node in
/// it, triangles in random order are read faster.
void sumNodes(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const CornerSource& source,
              CornerTermsFunction terms, ScratchBlock& brief, const Allocator* allocator, Parallel& parallel,
              NodeSums& sums, const FinishNodes& finish);

}  // namespace tspace::mikk
