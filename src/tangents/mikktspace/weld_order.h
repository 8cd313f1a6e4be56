// SPDX-License-Identifier: MIT
// Which corner of a node the reference keeps as its representative. It depends on the order in which the
// reference's spatial search happens to leave corners, so that order is reproduced where somebody needs to
// know.
#pragma once

#include <array>
#include <span>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/faces.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld.h"

namespace tspace::mikk {

/// Cells of the reference's grid.
inline constexpr std::size_t kWeldCells = 2048;

struct CellElement;

class WeldOrder {
  public:
    /// All must outlive this object.
    WeldOrder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes, const Allocator* allocator,
              Parallel& parallel);

    /// Sets representatives[node] to the corner that the reference keeps, for all nodes that have corners.
    /// `not_welded` may be null; else it has one zero byte per corner of the mesh, which becomes 1 where the
    /// reference gives up welding (positions that are not finite, or so large that a sum of two overflows).
    void findAll(std::uint32_t* representatives, std::uint8_t* not_welded = nullptr) const;

    /// The same for some nodes of tame ones, given by one vertex each. Other elements may be set too, and
    /// then are right. Linear in the vertices and indices, and in the corners of those cells (of 2048) that
    /// hold the nodes, times the halvings of a float interval. `shared`, if not null, gets the triangles that
    /// have two corners or more at these nodes, ascending.
    void findSome(std::span<const std::uint32_t> vertices, std::uint32_t* representatives,
                  Growing<std::uint32_t>* shared = nullptr) const;

    using CellNumbers = std::array<std::uint8_t, kWeldCells>;

  private:
    using Marks = Buffer<std::uint8_t>;

    void findOne(std::uint32_t vertex, std::uint32_t* representatives) const;
    [[nodiscard]] std::size_t cellOf(std::uint32_t vertex) const;
    [[nodiscard]] Marks verticesInCells(const CellNumbers& numbers, const Marks& wanted) const;
    [[nodiscard]] CellElement elementOf(std::uint32_t entry, const Marks& wanted) const;
    template <class Places>
    void followLong(std::uint8_t cell, const Places& places, const Marks& in_cells, const Marks& used,
                    std::span<const std::uint32_t> vertices, std::uint32_t* representatives) const;
    void follow(CellElement* elements, std::size_t count, std::uint32_t* representatives,
                std::uint8_t* not_welded) const;
    void find(const Buffer<std::uint32_t>& entries, const Marks& wanted, std::uint32_t* representatives,
              std::uint8_t* not_welded) const;
    void findInFew(const Buffer<std::uint32_t>& entries, const Marks& wanted, std::uint32_t* representatives,
                   std::uint8_t* not_welded) const;

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    int axis_ = 0;
    float low_ = 0, high_ = 0;  // of the grid's cells, on its axis
};

}  // namespace tspace::mikk
