// SPDX-License-Identifier: MIT
// Reproduces the order of the reference's welding: a grid of 2048 cells along the longest axis of the
// bounding box, then in each cell a repeated partition in place at the middle of the longest axis, until
// positions no longer differ there. The first corner of a node in the order that results is its
// representative.
//
// Every partition halves one axis of a float box, so the number of levels is bounded by the range of floats
// whatever the input; the work list below stays short because the larger side is always put off.
#include "tangents/mikktspace/grid_order.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/float4.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/words.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kVertexGrain = 16384;  // vertices

float component(const Vec3& v, int axis) { return (&v.x)[axis]; }
/// x, y, z and z again.
Float4 loadVec3(const Vec3& v) {
    const Float4 xyyz = joinPairs(&v.x, &v.y);
    return __builtin_shufflevector(xyyz, xyyz, 0, 1, 3, 3);
}

/// A bounding box; the fourth lanes do not matter. As in the reference, a NaN never moves a bound, and a bound
/// that starts as NaN stays.
struct Box {
    Float4 low, high;

    explicit Box(Float4 start) : low(start), high(start) {}
    void add(Float4 p) {
        low = min4(p, low);
        high = max4(p, high);
    }
    void add(const Box& other) {
        low = min4(other.low, low);
        high = max4(other.high, high);
    }
    [[nodiscard]] int longestAxis() const {
        const Float4 d = high - low;
        if (d[1] > d[0] && d[1] > d[2]) return 1;
        return d[2] > d[0] ? 2 : 0;
    }
};

/// What the reference does with the corners in one cell of its grid.
/// found(entry): called for all entries of leaves, within each in an order such that the last call for a node
/// is for its representative. All entries of a node are in one leaf, because equal positions always go to the
/// same side. Ranges where no element is marked are left out.
template <class Found>
class Cell {
  public:
    Cell(std::span<CellElement> elements, const Found& found)
        : elements_(elements.data()), count_(elements.size()), found_(found) {}

    void run() {
        Range waiting[64];  // each at most half of the one before
        std::size_t depth = 0;
        Range range{0, count_};
        while (true) {
            Range smaller{}, larger{};
            if (divide(range, smaller, larger)) {
                if (smaller.end - smaller.begin > larger.end - larger.begin) std::swap(smaller, larger);
                waiting[depth++] = larger;
                range = smaller;
            } else {
                if (depth == 0) return;
                range = waiting[--depth];
            }
        }
    }

  private:
    struct Range {
        std::size_t begin, end;
    };

    /// Partitions the range, or finishes it and returns false.
    bool divide(Range range, Range& left, Range& right) {
        const auto at = [&](std::size_t i) { return loadFloat4(&elements_[i].position.x); };
        Box box(at(range.begin));
        std::uint32_t any = 0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            box.add(at(i));
            any |= elements_[i].entry;
        }
        if ((any & kMark) == 0) return false;
        const int axis = box.longestAxis();
        const float low = box.low[axis], high = box.high[axis], middle = 0.5f * (high + low);
        if (middle >= high || middle <= low) {
            // The first of a node is kept; going backwards makes the first the last to be named.
            for (std::size_t i = range.end; i-- > range.begin;) found_(elements_[i].entry & kValue);
            return false;
        }
        const std::size_t cut = partition(range, axis, middle);
        left = {range.begin, cut};
        right = {cut, range.end};
        return true;
    }

    /// The reference swaps the first element that belongs to the right with the last one that belongs to the
    /// left, and so on.
    std::size_t partition(Range range, int axis, float middle) {
        const auto goesLeft = [&](std::size_t n) { return component(elements_[n].position, axis) < middle; };
        std::size_t i = range.begin, j = range.end - 1;
        while (i < j) {
            while (i < j && goesLeft(i)) ++i;
            while (i < j && !goesLeft(j)) --j;
            if (i < j) std::swap(elements_[i++], elements_[j--]);
        }
        return i == j && goesLeft(i) ? i + 1 : i;
    }

    CellElement* elements_;
    std::size_t count_;
    const Found& found_;
};

/// What the reference computes: the box of the corner list but for its first entry, starting from corner 0 of
/// the mesh.
[[gnu::noinline]] Box listedBox(const MeshView& mesh, const TriangleList& triangles) {
    Box box(loadVec3(mesh.positions[mesh.indices[0]]));
    withListedVertices(mesh, triangles, [&](auto vertexOf) {
        for (std::size_t i = 1; i < 3 * triangles.count; ++i) box.add(loadVec3(mesh.positions[vertexOf(i)]));
    });
    return box;
}

/// Whether a vertex is in the corner list. Looks first where it is when vertices are numbered as triangles use them.
[[gnu::noinline]] bool isListed(std::uint32_t vertex, const MeshView& mesh, const TriangleList& triangles) {
    constexpr std::size_t kStep = 1024;  // entries between looks at what was found: a loop without branches
    const std::size_t count = 3 * triangles.count, steps = count / kStep + 1;
    const std::size_t guess = std::size_t{vertex} * steps / mesh.vertexCount();
    return withListedVertices(mesh, triangles, [&](auto vertexOf) {
        for (std::size_t n = 0; n < steps; ++n) {
            const std::size_t begin = (guess + n) % steps * kStep, end = std::min(begin + kStep, count);
            std::uint32_t found = 0;
            for (std::size_t i = begin; i < end; ++i) found |= vertexOf(i) == vertex ? 1u : 0u;
            if (found != 0) return true;
        }
        return false;
    });
}

/// A box with the same longest axis as listedBox, and the same ends on it. Reading vertices in order is much faster
/// than reading those of the list; nearly always they make the same box. It does for us when vertices on both ends
/// of its longest axis are in the list: the box of the list may be shorter on other axes only, and so has the
/// same longest one. Not for a NaN in the list.
Box boundingBox(const MeshView& mesh, const TriangleList& triangles, const Allocator* allocator, Parallel& parallel) {
    constexpr std::size_t kBoxed = 512;  // vertices
    constexpr std::size_t kBoxes = 64;   // for a task
    if (triangles.corner(0) != 0) return listedBox(mesh, triangles);
    const Box start(loadVec3(mesh.positions[mesh.indices[0]]));
    const std::size_t count = mesh.vertexCount(), box_count = (count + kBoxed - 1) / kBoxed;
    Buffer<Box> boxes(allocator, box_count, start);
    parallel.forRanges(box_count, kBoxes, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            for (std::size_t v = b * kBoxed; v < std::min((b + 1) * kBoxed, count); ++v)
                boxes[b].add(loadVec3(mesh.positions[v]));
        }
    });
    Box whole = start;
    for (const Box& box : boxes) whole.add(box);
    const int axis = whole.longestAxis();
    for (const Float4 Box::*side : {&Box::low, &Box::high}) {
        const float bound = (whole.*side)[axis];
        if ((start.*side)[axis] == bound) continue;  // in the list for sure
        std::size_t v = 0;
        while ((boxes[v / kBoxed].*side)[axis] != bound) v += kBoxed;
        while (component(mesh.positions[v], axis) != bound) ++v;
        if (!isListed(static_cast<std::uint32_t>(v), mesh, triangles)) return listedBox(mesh, triangles);
    }
    return whole;
}

}  // namespace

GridOrder::GridOrder(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                     const Allocator* allocator, Parallel& parallel)
    : mesh_(mesh), triangles_(triangles), nodes_(nodes), allocator_(allocator), parallel_(parallel) {
    if (triangles.count == 0) return;
    const Box box = boundingBox(mesh, triangles, allocator, parallel);
    const int axis = box.longestAxis();
    const float low = box.low[axis], extent = box.high[axis] - low;
    // By the float-to-int conversion of x86: what does not fit becomes the smallest int, which lands in cell 0.
    const auto cellOf = [=](float x) {
        const float q = static_cast<float>(kCells) * ((x - low) / extent);
        const float inside = q > 0.0f && q < 2147483648.0f ? q : 0.0f;
        constexpr float kLast = static_cast<float>(kCells - 1);
        return static_cast<std::uint16_t>(static_cast<std::int32_t>(inside < kLast ? inside : kLast));
    };
    cells_ = Buffer<std::uint16_t>(allocator, mesh.vertexCount());
    parallel.forRanges(cells_.size(), kVertexGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) cells_[v] = cellOf(component(mesh.positions[v], axis));
    });
}

void GridOrder::follow(std::span<CellElement> elements, std::uint32_t* representatives) const {
    const auto found = [&](std::uint32_t entry) {
        const std::uint32_t corner = triangles_.corner(entry);
        representatives[nodes_.of(mesh_, corner)] = corner;
    };
    Cell(elements, found).run();
}

/// entryAt(i) for i < count: all of the wanted cells, in the order of the corner list. Cells share nothing: a node lies
/// in one of them.
template <class EntryAt>
void GridOrder::followCells(std::size_t count, const EntryAt& entryAt, std::uint32_t* representatives) const {
    std::array<std::uint16_t, kCells> number_of = {};  // of cells that have entries, from 1
    std::array<std::uint32_t, kCells + 2> begin;       // first, one up, how many each has
    std::uint16_t cells = 0;
    begin[0] = begin[1] = 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint16_t& number = number_of[cells_[entryAt(i).vertex]];
        if (number == 0) begin[(number = ++cells) + 1] = 0;
        ++begin[number + 1];
    }
    for (std::size_t number = 1; number <= cells; ++number) begin[number + 1] += begin[number];
    Buffer<CellElement> elements(allocator_, count);
    for (std::size_t i = 0; i < count; ++i) {
        const Entry e = entryAt(i);
        elements[begin[number_of[cells_[e.vertex]]]++] = {mesh_.positions[e.vertex], e.entry};
    }
    constexpr std::size_t kElements = 4096;  // for a thread: fewer are done sooner than one is started
    const std::size_t grain = 1 + cells * kElements / (elements.size() + 1);
    parallel_.forRanges(cells, grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell)
            follow({elements.data() + begin[cell], begin[cell + 1] - begin[cell]}, representatives);
    });
}

void GridOrder::find(std::span<const std::uint32_t> vertices, std::uint32_t* representatives) const {
    if (triangles_.count == 0) return;
    Marks wanted = noMarks(allocator_, nodes_.count);
    std::array<std::uint8_t, kCells> is_wanted = {};
    for (const std::uint32_t vertex : vertices) {
        wanted[nodes_.ofVertex(vertex)] = 1;
        is_wanted[cells_[vertex]] = 1;
    }
    Marks marks(allocator_, mesh_.vertexCount());
    parallel_.forRanges(marks.size(), kVertexGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) marks[v] = is_wanted[cells_[v]];
    });
    Growing<Entry> entries(allocator_);
    for (const std::uint32_t t : collectTriangles(mesh_, triangles_, marks, nullptr, {}, allocator_, parallel_)) {
        for (std::uint32_t entry = 3 * t; entry < 3 * t + 3; ++entry) {
            const std::uint32_t vertex = mesh_.indices[triangles_.corner(entry)];
            if (marks[vertex] != 0)
                entries.push({vertex, wanted[nodes_.ofVertex(vertex)] != 0 ? entry | kMark : entry});
        }
    }
    followCells(
        entries.size(), [&](std::size_t i) { return entries[i]; }, representatives);
}

void GridOrder::findAll(std::uint32_t* representatives) const {
    const auto entryAt = [&](std::size_t i) {
        return Entry{mesh_.indices[triangles_.corner(i)], static_cast<std::uint32_t>(i) | kMark};
    };
    followCells(3 * triangles_.count, entryAt, representatives);
}

}  // namespace tspace::mikk
