// SPDX-License-Identifier: MIT
// Which corner of a node the reference keeps as its representative. It depends on the order in which the
// reference's spatial search happens to leave corners, so that order is reproduced where somebody needs to
// know.
#pragma once

#include <cstdint>
#include <span>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// An entry of the corner list, in one cell of the reference's grid.
struct alignas(16) CellElement {
    Vec3 position;
    std::uint32_t entry;  ///< kMark: its node's representative is wanted
};

class GridOrder {
  public:
    /// Nodes must be all finite. All must outlive this object.
    GridOrder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
              Parallel& parallel);

    /// Sets representatives[node] to the corner that the reference keeps, for all nodes that have corners.
    void findAll(std::uint32_t* representatives) const;

    /// The same for some nodes, given by one vertex each. Others in the same cells (of 2048) may be
    /// set too, and then are right. Linear in the vertices and indices, and in the corners of these cells times the
    /// halvings of a float interval.
    void find(std::span<const std::uint32_t> vertices, std::uint32_t* representatives) const;

    /// Does what the reference does with the elements of one cell, which are in the order of the corner list.
    void follow(std::span<CellElement> elements, std::uint32_t* representatives) const;

  private:
    static constexpr std::size_t kCells = 2048;
    struct Entry {
        std::uint32_t vertex, entry;
    };
    template <class EntryAt>
    void followCells(std::size_t count, const EntryAt& entryAt, std::uint32_t* representatives) const;

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    Buffer<std::uint16_t> cells_;  // one per vertex
};

}  // namespace tspace::mikk
