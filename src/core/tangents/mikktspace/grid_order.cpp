// SPDX-License-Identifier: MIT
// Reproduces the order of the reference's welding: a grid of 2048 cells along the longest axis of the bounding box,
// then in each cell a repeated in-place partition at the middle of the longest axis, until positions no longer differ.
// The first corner of a node in the resulting order is its representative.
//
// Every partition halves one axis of a float box, so the range of floats bounds the number of levels for any input; the
// stack of ranges stays short because the smaller side is always divided first.
#include "core/tangents/mikktspace/grid_order.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "core/tangents/mikktspace/grid_cells.h"
#include "core/tangents/mikktspace/welded_mesh.h"
#include "core/tangents/mikktspace/words.h"

namespace tspace::mikk {
namespace {

constexpr std::size_t kVertexGrain = 16384;  // vertices per task, a multiple of 4
// Bits of a vertex mark. kNumber: 1-based number of the vertex's cell among the cells that contain requested vertices,
// or 0. kAtLow, kAtHigh: the vertex is at the lower or upper end of the grid.
constexpr std::uint16_t kNumber = 0x0fff, kAtLow = 0x4000, kAtHigh = 0x8000;
constexpr std::uint32_t kWanted = kNone - 1;  // placeholder for a requested representative that was not found yet

struct GridOrder {
    const WeldedMesh& in;
    std::span<const std::uint32_t> wanted;
    std::uint32_t* representatives;
    const Allocator* allocator;
    Parallel& parallel;

    Buffer<std::uint32_t> find() {
        Buffer<std::uint32_t> found;
        if (in.triangles.count == 0) return found;
        for (const std::uint32_t v : wanted) representatives[in.nodes.ofVertex(v)] = kWanted;
        // The reference uses the box of the corner list. The box of all vertices is much faster to compute, and may be
        // used if vertices at both ends of its longest axis are in the list: the list's box is then equally long along
        // that axis and shorter along others.
        if (in.triangles.corner(0) != 0 || !findIn(boxOfVertices(), true, found)) findIn(boxOfList(), false, found);
        for (const std::uint32_t v : wanted) {
            std::uint32_t& representative = representatives[in.nodes.ofVertex(v)];
            if (representative == kWanted) representative = kNone;  // no corner was found for the node
        }
        return found;
    }

    /// Returns the bounding box that the reference computes: of corner 0 of the mesh and of all entries of the corner
    /// list except the first.
    [[nodiscard]] Box boxOfList() const {
        Box box(loadVec3(in.mesh.positions[in.mesh.indices[0]]));
        for (std::size_t i = 1; i < 3 * in.triangles.count; ++i) box.add(loadVec3(in.mesh.positions[in.vertexAt(i)]));
        return box;
    }

    [[nodiscard]] Box boxOfVertices() const {
        const std::size_t count = in.mesh.vertexCount(), parts = (count + kVertexGrain - 1) / kVertexGrain;
        Box whole(loadVec3(in.mesh.positions[in.mesh.indices[0]]));
        Buffer<Box> boxes(allocator, parts, whole);
        parallel.forTasks(parts, [&](std::size_t part) {
            Box box = whole;
            const std::size_t end = std::min((part + 1) * kVertexGrain, count);
            for (std::size_t v = part * kVertexGrain; v < end; ++v) box.add(loadVec3(in.mesh.positions[v]));
            boxes[part] = box;
        });
        for (const Box& box : boxes) whole.add(box);
        return whole;
    }

    /// Finds the representatives. If `if_listed` is set, returns false if vertices at either end of the box are not in
    /// the corner list.
    bool findIn(const Box& box, bool if_listed, Buffer<std::uint32_t>& found) {
        const Grid grid(box);
        std::array<std::uint16_t, Grid::kCells> numbers = {};
        std::uint16_t cell_count = 0;
        for (const std::uint32_t v : wanted) {
            const Mask4 cell = grid.cellsOf(splat(component(in.mesh.positions[v], grid.axis)));
            std::uint16_t& number = numbers[static_cast<std::size_t>(cell[0])];
            if (number == 0) number = ++cell_count;
        }
        Buffer<std::uint16_t> marks(allocator, in.mesh.vertexCount());
        parallel.forRanges(marks.size(), kVertexGrain, [&](std::size_t begin, std::size_t end) {
            const auto markSome = [&, positions = in.mesh.positions](std::size_t v, std::size_t count) {
                const auto at = [&](std::size_t i) {
                    return component(positions[v + std::min(i, count - 1)], grid.axis);
                };
                const Float4 x{at(0), at(1), at(2), at(3)};
                const Mask4 cells = grid.cellsOf(x), ends = ((x == grid.low) & kAtLow) | ((x == grid.high) & kAtHigh);
                for (std::size_t i = 0; i < count; ++i)
                    marks[v + i] = static_cast<std::uint16_t>(numbers[static_cast<std::size_t>(cells[i])] | ends[i]);
            };
            for (; begin + 4 <= end; begin += 4) markSome(begin, 4);
            if (begin < end) markSome(begin, end - begin);
        });
        std::atomic<std::uint32_t> any{0};
        found = collectTriangles(
            in.mesh, in.triangles, [mark = marks.data()](std::uint32_t vertex) { return mark[vertex]; }, kNumber,
            allocator, parallel, &any);
        if (if_listed && ((any & kAtLow) == 0 || (any & kAtHigh) == 0)) return false;
        followCells(found, marks.data(), cell_count);
        return true;
    }

    /// Finds the representatives of each cell. Cells are independent, because each node is in one cell.
    void followCells(const Buffer<std::uint32_t>& found, const std::uint16_t* marks, std::size_t cells) {
        // Counting sort of entries by cell: `begin` contains first the counts, then the start of each cell. Number 0
        // means no cell.
        std::array<std::uint32_t, Grid::kCells + 2> begin;
        std::fill_n(begin.data(), cells + 2, 0u);
        std::uint32_t buffer[3];
        for (const std::uint32_t t : found) {
            const std::uint32_t* vertices = readTriangles(in.mesh, in.triangles, t, 1, buffer);
            for (std::size_t k = 0; k < 3; ++k) ++begin[(marks[vertices[k]] & kNumber) + 1];
        }
        begin[1] = 0;
        for (std::size_t number = 1; number <= cells; ++number) begin[number + 1] += begin[number];
        Buffer<CellElement> elements(allocator, begin[cells + 1]);
        for (const std::uint32_t t : found) {
            const std::uint32_t* vertices = readTriangles(in.mesh, in.triangles, t, 1, buffer);
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t number = marks[vertices[k]] & kNumber, entry = 3 * t + k;
                if (number == 0) continue;
                const bool is_wanted = representatives[in.nodes.ofVertex(vertices[k])] == kWanted;
                elements[begin[number]++] = {in.mesh.positions[vertices[k]], is_wanted ? entry | kTopBit : entry};
            }
        }
        const auto name = [&](std::uint32_t entry) { representatives[in.nodeAt(entry)] = in.triangles.corner(entry); };
        // elements per thread: fewer are processed faster without another thread
        constexpr std::size_t kElements = 4096;
        const std::size_t grain = 1 + cells * kElements / (elements.size() + 1);
        parallel.forRanges(cells, grain, [&](std::size_t first, std::size_t last) {
            for (std::size_t cell = first; cell < last; ++cell) {
                const std::size_t size = begin[cell + 1] - begin[cell];
                if (size != 0) Cell({elements.data() + begin[cell], size}, name).run();
            }
        });
    }
};

}  // namespace

Buffer<std::uint32_t> findRepresentatives(const WeldedMesh& welded, std::span<const std::uint32_t> vertices,
                                          std::uint32_t* representatives, const Allocator* allocator,
                                          Parallel& parallel) {
    return GridOrder{welded, vertices, representatives, allocator, parallel}.find();
}

}  // namespace tspace::mikk
