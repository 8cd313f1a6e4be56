// SPDX-License-Identifier: MIT
// Which corner of a node the reference keeps as its representative. It depends on the order in which the
// reference's spatial search happens to leave corners, so that order is reproduced where somebody needs to
// know.
#pragma once

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

class WeldOrder {
  public:
    /// All must outlive this object.
    WeldOrder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
              Parallel& parallel);

    /// Sets representatives[node] to the corner that the reference keeps, for each node with wanted[node] != 0 that has
    /// corners (all nodes when `wanted` is null; which must be so when nodes are not tame). Other elements may be set
    /// too, and then are right. `not_welded` may be null; else it has one zero byte per corner of the mesh, which becomes
    /// 1 where the reference gives up welding (positions that are not finite, or so large that a sum of two overflows).
    /// Linear in the corners of those cells (of 2048) that hold wanted nodes, times the halvings of a float interval.
    void find(const std::uint8_t* wanted, std::uint32_t* representatives, std::uint8_t* not_welded = nullptr) const;

  private:
    [[nodiscard]] std::size_t cellOf(std::uint32_t vertex) const;
    [[nodiscard]] Buffer<std::uint32_t> entriesOfWantedCells(const std::uint8_t* wanted) const;

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    int axis_ = 0;
    float low_ = 0, high_ = 0;  // of the grid's cells, on its axis
};

}  // namespace tspace::mikk
