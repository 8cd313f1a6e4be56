// SPDX-License-Identifier: MIT
// Reproduces the order of the reference's welding: a grid of 2048 cells along the longest axis of the
// bounding box, then in each cell a repeated partition in place at the middle of the longest axis, until
// positions no longer differ there. The first corner of a node in the order that results is its
// representative.
//
// Every partition halves one axis of a float box, so the number of levels is bounded by the range of floats
// whatever the input; the work list below stays short because the larger side is always put off.
#include "tangents/mikktspace/weld_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/float4.h"
#include "core/vec_math.h"
#include "tangents/mikktspace/cell_places.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/long_cell.h"
#include "tangents/mikktspace/weld_cell.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kCells = kWeldCells;
constexpr std::size_t kFewVertices = 512;          // so few are looked at without NearCells
constexpr std::size_t kFewCorners = 4096;          // of the corner list: one node of theirs is found without lists
constexpr std::size_t kElementsForThreads = 4096;  // of cells: fewer are done sooner than threads are started
// A cell is long from so many corners on, if it also has one in kLongPart of all: each costs a pass over the mesh.
constexpr std::size_t kLongCell = 16384, kLongPart = 16;
constexpr std::size_t kFewNodes = 1024;  // wanted; with more of them most parts of a long cell are

/// The float-to-int conversion of x86: what does not fit becomes the smallest int, which lands in cell 0.
std::size_t cellOf(float low, float high, float x) {
    const float q = static_cast<float>(kCells) * ((x - low) / (high - low));
    if (!(q > 0.0f) || q >= 2147483648.0f) return 0;
    return q < static_cast<float>(kCells) ? static_cast<std::size_t>(q) : kCells - 1;
}

CellElement makeElement(const Vec3& position, std::uint32_t entry, bool is_wanted) {
    return {position, entry | (is_wanted ? kMark : 0)};
}

/// What the reference computes: the box of the corner list but for its first entry, starting from corner 0 of
/// the mesh.
Box listedBox(const MeshView& mesh, const TriangleList& triangles) {
    Box box(mesh.positions[mesh.indices[0]]);
    for (std::size_t i = 1; i < 3 * triangles.count; ++i) box.add(mesh.positions[mesh.indices[triangles.corner(i)]]);
    return box;
}

/// A box and the vertices [begin, end), four components at a time: x, y, y and z.
Box boxOfVertices(const Box& start, const StridedSpan<const Vec3>& positions, std::size_t begin, std::size_t end) {
    const auto components = [](const Vec3& p) { return joinPairs(&p.x, &p.y); };
    Float4 low = components(start.low), high = components(start.high);
    for (std::size_t v = begin; v < end; ++v) {
        const Float4 here = components(positions[v]);
        low = min4(here, low);  // the bound where a NaN is met, as in Box
        high = max4(here, high);
    }
    return {{low[0], low[1], low[3]}, {high[0], high[1], high[3]}};
}

/// Whether a vertex is in the corner list. Looks first where it is when vertices are numbered as triangles
/// use them.
bool isListed(std::uint32_t vertex, const MeshView& mesh, const TriangleList& triangles) {
    constexpr std::size_t kStep = 1024;  // entries between looks at what was found
    const std::size_t steps = 3 * triangles.count / kStep + 1;
    const std::size_t guess = std::size_t{vertex} * steps / mesh.vertexCount();
    return withListedVertices(mesh, triangles, [&](auto vertexOf) {
        for (std::size_t n = 0; n < steps; ++n) {
            const std::size_t step = (guess + n) % steps;
            const std::size_t end = std::min((step + 1) * kStep, 3 * triangles.count);
            std::uint32_t found = 0;
            for (std::size_t i = step * kStep; i < end; ++i) found |= vertexOf(i) == vertex ? 1u : 0u;
            if (found != 0) return true;
        }
        return false;
    });
}

/// Whether the vertex of the first entry, which the reference leaves out of its box, is in a later one. That
/// is so of most polygons; looked for where it would be then.
bool isFirstListedAgain(const MeshView& mesh, const TriangleList& triangles) {
    constexpr std::size_t kNear = 256;  // entries
    for (std::size_t i = 1; i < std::min(kNear, 3 * triangles.count); ++i) {
        if (mesh.indices[triangles.corner(i)] == mesh.indices[triangles.corner(0)]) return true;
    }
    return false;
}

/// A box with the same longest axis, and the same ends on it. Reading vertices in order is much faster than
/// reading those of the list; nearly always they make the same box. It does for us when vertices on both ends
/// of its longest axis are in the list: the box of the list may be shorter on other axes only, and so has the
/// same longest one. Not for a NaN in the list.
Box boundingBox(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kBoxed = 512;  // vertices
    constexpr std::size_t kGrain = 64;   // boxes
    if (triangles.corner(0) != 0 && !isFirstListedAgain(mesh, triangles)) return listedBox(mesh, triangles);
    const Box start(mesh.positions[mesh.indices[0]]);
    const std::size_t count = mesh.vertexCount(), box_count = (count + kBoxed - 1) / kBoxed;
    Buffer<Box> boxes(allocator, box_count);
    parallel.forRanges(box_count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            boxes[b] = boxOfVertices(start, mesh.positions, b * kBoxed, std::min((b + 1) * kBoxed, count));
    });
    Box whole = start;
    for (const Box& box : boxes) {
        whole.add(box.low);
        whole.add(box.high);
    }
    const int axis = whole.longestAxis();
    for (const bool upper : {false, true}) {
        const auto side = [&](const Box& box) { return component(upper ? box.high : box.low, axis); };
        if (component(start.low, axis) == side(whole)) continue;  // in the list for sure
        std::size_t v = 0;
        while (side(boxes[v / kBoxed]) != side(whole)) v += kBoxed;
        while (component(mesh.positions[v], axis) != side(whole)) ++v;
        if (!isListed(static_cast<std::uint32_t>(v), mesh, triangles)) return listedBox(mesh, triangles);
    }
    return whole;
}

/// For a quick look at most vertices: cells by a multiplication in place of a division. The two differ by one
/// at most (their relative difference is a few 2^-24, at values up to 2^11), so cells beside a wanted one are
/// near.
class NearCells {
  public:
    NearCells(float low, float high, const WeldOrder::CellNumbers& wanted)
        : low_(low), scale_(static_cast<float>(kCells) / (high - low)) {
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            if (wanted[cell] == 0) continue;
            for (std::size_t near = cell; near < cell + 3; ++near) near_[near] = 1;  // near_[0] is for cell -1
        }
        if (!(scale_ <= std::numeric_limits<float>::max())) near_.fill(1);  // no extent, or nearly none
        if (!std::isfinite(low) || !std::isfinite(high - low)) near_.fill(1);
    }
    /// marks[i] becomes 0 for vertices [begin, end) that are in no wanted cell. Returns whether any may be in
    /// one.
    bool mark(const StridedSpan<const Vec3>& positions, int axis, std::size_t begin, std::size_t end,
              std::uint8_t* marks) const {
        constexpr float kLast = static_cast<float>(kCells - 1);
        std::array<std::int32_t, kBlock> cells;
        for (std::size_t v = begin; v < end; ++v) {
            const float q = (component(positions[v], axis) - low_) * scale_;
            const float inside = q > 0.0f ? q : 0.0f;  // outside are only vertices that no triangle uses
            cells[v - begin] = static_cast<std::int32_t>(inside < kLast ? inside : kLast);
        }
        unsigned any = 0;
        for (std::size_t v = begin; v < end; ++v) {
            marks[v] = near_[static_cast<std::size_t>(cells[v - begin]) + 1];
            any |= marks[v];
        }
        return any != 0;
    }
    static constexpr std::size_t kBlock = 256;

  private:
    float low_, scale_;
    std::array<std::uint8_t, kCells + 2> near_ = {};
};

}  // namespace

WeldOrder::WeldOrder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                     const Allocator* allocator, Parallel& parallel)
    : mesh_(mesh), triangles_(triangles), nodes_(nodes), allocator_(allocator), parallel_(parallel) {
    if (triangles.count == 0) return;
    const Box box = nodes.all_finite ? boundingBox(mesh, triangles, allocator, parallel) : listedBox(mesh, triangles);
    axis_ = box.longestAxis();
    low_ = component(box.low, axis_);
    high_ = component(box.high, axis_);
}

std::size_t WeldOrder::cellOf(std::uint32_t vertex) const {
    return mikk::cellOf(low_, high_, component(mesh_.positions[vertex], axis_));
}

/// `numbers`: of cells; 0: not wanted. `wanted`: the nodes that are.
Buffer<std::uint8_t> WeldOrder::verticesInCells(const CellNumbers& numbers, const Marks& wanted) const {
    const std::size_t vertex_count = mesh_.vertexCount();
    Marks in_cells(allocator_, vertex_count);
    const auto markOf = [&](std::size_t v) -> std::uint8_t {
        const auto vertex = static_cast<std::uint32_t>(v);
        const std::uint8_t number = numbers[cellOf(vertex)];
        if (number == 0) return 0;
        return wanted[nodes_.ofVertex(vertex)] != 0 ? number | kAtNode : number;
    };
    if (vertex_count <= kFewVertices) {
        for (std::size_t v = 0; v < vertex_count; ++v) in_cells[v] = markOf(v);
        return in_cells;
    }
    const NearCells near(low_, high_, numbers);
    constexpr std::size_t kBlock = NearCells::kBlock, kGrain = 64;  // vertices; blocks
    const auto markBlock = [&](std::size_t block) {
        const std::size_t begin = block * kBlock, end = std::min(begin + kBlock, vertex_count);
        if (!near.mark(mesh_.positions, axis_, begin, end, in_cells.data())) return;
        for (std::size_t v = begin; v < end; ++v) {
            if (in_cells[v] != 0) in_cells[v] = markOf(v);
        }
    };
    parallel_.forRanges((vertex_count + kBlock - 1) / kBlock, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block) markBlock(block);
    });
    return in_cells;
}

void WeldOrder::findSome(std::span<const std::uint32_t> vertices, std::uint32_t* representatives,
                         Growing<std::uint32_t>* shared) const {
    if (triangles_.count == 0) return;
    if (vertices.size() == 1 && shared == nullptr && 3 * triangles_.count <= kFewCorners) {
        findOne(vertices[0], representatives);
        return;
    }
    Marks wanted = noMarks(allocator_, nodes_.count);
    CellNumbers numbers = {};
    std::uint8_t cell_count = 0;
    for (const std::uint32_t vertex : vertices) {
        wanted[nodes_.ofVertex(vertex)] = 1;
        std::uint8_t& number = numbers[cellOf(vertex)];
        if (number == 0) number = cell_count + 1u < kCellNumber ? ++cell_count : kCellNumber;
    }
    const Marks in_cells = verticesInCells(numbers, wanted);
    const Buffer<std::uint32_t> found =
        collectTriangles(mesh_, triangles_, nodes_, in_cells, {}, allocator_, parallel_);
    withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
        const std::size_t long_part = 3 * triangles_.count / kLongPart;
        Marks used;
        if (3 * found.size() >= std::max(kLongCell, long_part) && vertices.size() <= kFewNodes)
            used = noMarks(allocator_, mesh_.vertexCount());
        const CellPlaces places(found, vertexOf, in_cells, shared, used, allocator_, parallel_);
        std::array<std::uint32_t, kCellNumber + 1> begin = {};       // where the elements of a cell begin
        std::array<CellElement*, kCellNumber + 1> elements_of = {};  // null: not wanted, or done
        for (std::uint8_t cell = 1; cell < kCellNumber; ++cell) {
            const bool is_long = !used.empty() && places.count(cell) >= std::max(kLongCell, long_part);
            if (is_long) followLong(cell, places, in_cells, used, vertices, representatives);
            begin[cell + 1] = begin[cell] + (is_long ? 0 : places.count(cell));
        }
        Buffer<CellElement> elements(allocator_, begin[kCellNumber]);
        Buffer<std::uint32_t> others(allocator_, places.count(kCellNumber));
        if (elements.empty() && others.empty()) return;
        for (std::size_t cell = 1; cell < kCellNumber; ++cell) {
            if (begin[cell] < begin[cell + 1]) elements_of[cell] = elements.data() + begin[cell];
        }
        places.forAll([&](std::uint8_t cell, std::uint32_t place, std::uint32_t entry, std::uint32_t vertex) {
            if (CellElement* const to = elements_of[cell]) {
                to[place] = makeElement(mesh_.positions[vertex], entry, in_cells[vertex] >= kAtNode);
            } else if (cell == kCellNumber) {
                others[place] = entry;
            }
        });
        const std::size_t grain = elements.size() < kElementsForThreads ? cell_count : 1;
        parallel_.forRanges(cell_count, grain, [&](std::size_t first, std::size_t end) {
            for (std::size_t cell = first + 1; cell < end + 1; ++cell) {
                if (begin[cell] < begin[cell + 1])
                    follow(elements.data() + begin[cell], begin[cell + 1] - begin[cell], representatives, nullptr);
            }
        });
        if (!others.empty()) find(others, wanted, representatives, nullptr);
    });
}

/// A cell with many corners. `vertices`: one of each wanted node.
template <class Places>
void WeldOrder::followLong(std::uint8_t cell, const Places& places, const Marks& in_cells, const Marks& used,
                           std::span<const std::uint32_t> vertices, std::uint32_t* representatives) const {
    const std::size_t vertex_count = mesh_.vertexCount();
    Growing<Vec3> wanted(allocator_);
    for (const std::uint32_t vertex : vertices) {
        if ((in_cells[vertex] & kCellNumber) == cell) wanted.push(mesh_.positions[vertex]);
    }
    const auto isInCell = [&](std::size_t v) { return used[v] != 0 && (in_cells[v] & kCellNumber) == cell; };
    const auto bitsOf = [&](std::size_t block) {
        std::uint64_t bits = 0;
        for (std::size_t v = kCollectBlock * block; v < std::min(vertex_count, kCollectBlock * (block + 1)); ++v)
            bits |= std::uint64_t{isInCell(v) ? 1u : 0u} << (v % kCollectBlock);
        return bits;
    };
    const std::size_t block_count = (vertex_count + kCollectBlock - 1) / kCollectBlock;
    const LongCell long_cell(mesh_.positions, collectBits(block_count, bitsOf, allocator_, parallel_),
                             {wanted.begin(), wanted.size()}, vertex_count, allocator_, parallel_);
    NumberedCorners corners(places.count(cell), allocator_);
    places.forCell(cell, [&](std::uint32_t place, std::uint32_t entry, std::uint32_t vertex) {
        const std::uint8_t part = long_cell.partOf(vertex);
        if (part == LongCell::kOutside) return false;
        corners.entries[place] = entry;
        corners.parts[place] = part;
        return true;
    });
    long_cell.order(corners, [&](std::size_t begin, std::size_t end) {
        Buffer<CellElement> elements(allocator_, end - begin);
        for (std::size_t n = begin; n < end; ++n) {
            const std::uint32_t entry = corners.entries[n];
            const std::uint32_t vertex = mesh_.indices[triangles_.corner(entry)];
            elements[n - begin] = makeElement(mesh_.positions[vertex], entry, in_cells[vertex] >= kAtNode);
        }
        follow(elements.data(), elements.size(), representatives, nullptr);
    });
}

/// The same for one node of a small mesh: looks at all entries in turn.
void WeldOrder::findOne(std::uint32_t vertex, std::uint32_t* representatives) const {
    const std::uint32_t node = nodes_.ofVertex(vertex);
    const std::size_t cell = cellOf(vertex), vertex_count = mesh_.vertexCount();
    Marks in_cell(allocator_, vertex_count);  // 1; at the node 2
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const auto other = static_cast<std::uint32_t>(v);
        in_cell[v] = mikk::cellOf(low_, high_, component(mesh_.positions[v], axis_)) != cell ? 0
                     : nodes_.ofVertex(other) != node                                        ? 1
                                                                                             : 2;
    }
    Buffer<CellElement> elements(allocator_, 3 * triangles_.count);
    std::size_t count = 0;
    withListedVertices(mesh_, triangles_, [&](auto vertexOf) {
        for (std::size_t i = 0; i < 3 * triangles_.count; ++i) {
            const std::uint32_t v = vertexOf(i), mark = in_cell[v];
            if (mark == 0) continue;
            elements[count++] = makeElement(mesh_.positions[v], static_cast<std::uint32_t>(i), mark == 2);
        }
    });
    follow(elements.data(), count, representatives, nullptr);
}

/// The elements of one cell.
void WeldOrder::follow(CellElement* elements, std::size_t count, std::uint32_t* representatives,
                       std::uint8_t* not_welded) const {
    const auto found = [&](std::uint32_t entry) {
        const std::uint32_t corner = triangles_.corner(entry);
        representatives[nodes_.of(mesh_, corner)] = corner;
    };
    const auto gaveUp = [&](std::uint32_t entry) {
        if (not_welded != nullptr) not_welded[triangles_.corner(entry)] = 1;
    };
    WeldCell(elements, nodes_.all_finite, found, gaveUp).run(count);
}

/// `wanted`: one per node; empty: all nodes.
CellElement WeldOrder::elementOf(std::uint32_t entry, const Marks& wanted) const {
    const std::uint32_t corner = triangles_.corner(entry);
    const bool want = wanted.empty() || wanted[nodes_.of(mesh_, corner)] != 0;
    return makeElement(mesh_.positions[mesh_.indices[corner]], entry, want);
}

void WeldOrder::findAll(std::uint32_t* representatives, std::uint8_t* not_welded) const {
    Buffer<std::uint32_t> all(allocator_, 3 * triangles_.count);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    find(all, Marks(), representatives, not_welded);
}

/// `wanted`: one per node; empty: all nodes.
void WeldOrder::find(const Buffer<std::uint32_t>& entries, const Marks& wanted, std::uint32_t* representatives,
                     std::uint8_t* not_welded) const {
    if (entries.size() < kCells) {
        findInFew(entries, wanted, representatives, not_welded);
        return;
    }
    Buffer<std::size_t> cell_begin(allocator_, kCells + 1, std::size_t{0});
    Buffer<std::uint16_t> cells(allocator_, entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::size_t cell = cellOf(mesh_.indices[triangles_.corner(entries[i])]);
        cells[i] = static_cast<std::uint16_t>(cell);
        ++cell_begin[cell + 1];
    }
    for (std::size_t cell = 0; cell < kCells; ++cell) cell_begin[cell + 1] += cell_begin[cell];
    Buffer<CellElement> elements(allocator_, entries.size());
    Buffer<std::size_t> fill(allocator_, kCells);
    std::copy_n(cell_begin.data(), kCells, fill.data());
    for (std::size_t i = 0; i < entries.size(); ++i) elements[fill[cells[i]]++] = elementOf(entries[i], wanted);
    // Cells share nothing: a node lies in one of them.
    parallel_.forTasks(kCells, [&](std::size_t cell) {
        const std::size_t begin = cell_begin[cell], count = cell_begin[cell + 1] - begin;
        if (count != 0) follow(elements.data() + begin, count, representatives, not_welded);
    });
}

/// The same where most cells are empty.
void WeldOrder::findInFew(const Buffer<std::uint32_t>& entries, const Marks& wanted, std::uint32_t* representatives,
                          std::uint8_t* not_welded) const {
    Buffer<std::uint64_t> by_cell(allocator_, entries.size());  // cell, then place in the list
    for (std::size_t i = 0; i < entries.size(); ++i)
        by_cell[i] = std::uint64_t{cellOf(mesh_.indices[triangles_.corner(entries[i])])} << 32 | i;
    std::sort(by_cell.begin(), by_cell.end());
    Buffer<CellElement> elements(allocator_, entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) elements[i] = elementOf(entries[by_cell[i] & 0xffffffffu], wanted);
    for (std::size_t begin = 0; begin < entries.size();) {
        std::size_t end = begin + 1;
        while (end < entries.size() && by_cell[end] >> 32 == by_cell[begin] >> 32) ++end;
        follow(elements.data() + begin, end - begin, representatives, not_welded);
        begin = end;
    }
}

}  // namespace tspace::mikk
