// SPDX-License-Identifier: MIT
// Reproduces the order of the reference's welding: a grid of 2048 cells along the longest axis of the
// bounding box, then in each cell a repeated partition in place at the middle of the longest axis, until
// positions no longer differ there. The first corner of a node in the order that results is its
// representative.
//
// Every partition halves one axis of a float box, so the number of levels is bounded by the range of floats
// whatever the input; the work list below stays short because the larger side is always put off.
#include "tangents/mikktspace/weld_order.h"

#include <atomic>
#include <cmath>

#include "core/vec_math.h"
#include "tangents/mikktspace/grouped_plan.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kCells = 2048;
constexpr std::uint32_t kWanted = 1, kNotWanted = 0;

float component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Box {
    Vec3 low, high;

    explicit Box(const Vec3& start) : low(start), high(start) {}
    /// A NaN never moves a bound, and a bound that starts as NaN stays.
    void add(const Vec3& p) {
        grow(low.x, high.x, p.x);
        grow(low.y, high.y, p.y);
        grow(low.z, high.z, p.z);
    }
    [[nodiscard]] int longestAxis() const {
        const Vec3 d = high - low;
        if (d.y > d.x && d.y > d.z) return 1;
        return d.z > d.x ? 2 : 0;
    }

  private:
    static void grow(float& lowest, float& highest, float x) {
        if (lowest > x) lowest = x;
        if (highest < x) highest = x;
    }
};

/// The float-to-int conversion of x86: what does not fit becomes the smallest int, which lands in cell 0.
std::size_t cellOf(float low, float high, float x) {
    const float q = static_cast<float>(kCells) * ((x - low) / (high - low));
    if (!(q > 0.0f) || q >= 2147483648.0f) return 0;
    return q < static_cast<float>(kCells) ? static_cast<std::size_t>(q) : kCells - 1;
}

struct Element {
    Vec3 position;
    std::uint32_t corner, node, wanted;
};

struct Range {
    std::size_t begin, end;
};

class Cell {
  public:
    Cell(Element* elements, std::uint32_t* representatives, std::uint8_t* not_welded)
        : elements_(elements), representatives_(representatives), not_welded_(not_welded) {}

    void run(Range all) {
        Range waiting[64];  // each at most half of the one before
        std::size_t depth = 0;
        Range range = all;
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
    /// Partitions the range, or finishes it and returns false.
    bool divide(Range range, Range& left, Range& right) {
        bool wanted = false;
        Box box(elements_[range.begin].position);
        for (std::size_t i = range.begin; i < range.end; ++i) {
            box.add(elements_[i].position);
            wanted |= elements_[i].wanted == kWanted;
        }
        if (!wanted) return false;
        if (range.end - range.begin == 1) {
            leaf(range);
            return false;
        }
        const int axis = box.longestAxis();
        const float low = component(box.low, axis), high = component(box.high, axis);
        const float middle = 0.5f * (high + low);
        if (!std::isfinite(middle)) {
            giveUp(range);
            return false;
        }
        if (middle >= high || middle <= low) {
            leaf(range);
            return false;
        }
        const std::size_t cut = partition(range, axis, middle);
        left = {range.begin, cut};
        right = {cut, range.end};
        return true;
    }

    std::size_t partition(Range range, int axis, float middle) {
        std::size_t i = range.begin, j = range.end - 1;
        const auto goesLeft = [&](std::size_t n) { return component(elements_[n].position, axis) < middle; };
        while (i < j) {
            while (i < j && goesLeft(i)) ++i;
            while (i < j && !goesLeft(j)) --j;
            if (i < j) std::swap(elements_[i++], elements_[j--]);
        }
        return i == j && goesLeft(i) ? i + 1 : i;
    }

    /// All members of a node are in one leaf, because equal positions always go to the same side. The first
    /// is kept; going backwards makes the first the last to be written.
    void leaf(Range range) {
        for (std::size_t i = range.end; i-- > range.begin;)
            representatives_[elements_[i].node] = elements_[i].corner;
    }

    void giveUp(Range range) {
        if (not_welded_ == nullptr) return;
        for (std::size_t i = range.begin; i < range.end; ++i) not_welded_[elements_[i].corner] = 1;
    }

    Element* elements_;
    std::uint32_t* representatives_;
    std::uint8_t* not_welded_;
};

/// Over the corner list but for its first entry, starting from corner 0 of the mesh: that is what the
/// reference does, and it shows when the first face is one that is skipped.
Box boundingBox(const MeshView& mesh, const TriangleList& triangles) {
    Box box(mesh.positions[mesh.indices[0]]);
    for (std::size_t i = 1; i < 3 * triangles.count; ++i)
        box.add(mesh.positions[mesh.indices[triangles.corner(i)]]);
    return box;
}

}  // namespace

void findRepresentatives(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                         const std::uint8_t* wanted, std::uint32_t* representatives, std::uint8_t* not_welded,
                         const Allocator* allocator, Parallel& parallel) {
    const std::size_t entries = 3 * triangles.count;
    if (entries == 0) return;
    const Box box = boundingBox(mesh, triangles);
    const int axis = box.longestAxis();
    const float low = component(box.low, axis), high = component(box.high, axis);

    const std::size_t vertex_count = mesh.vertexCount();
    Buffer<std::uint16_t> vertex_cell(allocator, vertex_count);
    Buffer<std::size_t> cell_begin(allocator, kCells + 1, std::size_t{0});
    Buffer<std::uint8_t> cell_wanted(allocator, kCells, std::uint8_t{0});
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const std::size_t cell = cellOf(low, high, component(mesh.positions[v], axis));
        vertex_cell[v] = static_cast<std::uint16_t>(cell);
        if (wanted == nullptr || wanted[nodes.ofVertex(static_cast<std::uint32_t>(v))] != 0) cell_wanted[cell] = 1;
    }
    for (std::size_t i = 0; i < entries; ++i) {
        const std::size_t cell = vertex_cell[mesh.indices[triangles.corner(i)]];
        if (cell_wanted[cell] != 0) ++cell_begin[cell + 1];
    }
    for (std::size_t cell = 0; cell < kCells; ++cell) cell_begin[cell + 1] += cell_begin[cell];
    Buffer<Element> elements(allocator, cell_begin[kCells]);
    Buffer<std::size_t> fill(allocator, kCells);
    std::copy_n(cell_begin.data(), kCells, fill.data());
    for (std::size_t i = 0; i < entries; ++i) {
        const std::uint32_t corner = triangles.corner(i), vertex = mesh.indices[corner];
        const std::size_t cell = vertex_cell[vertex];
        if (cell_wanted[cell] == 0) continue;
        const std::uint32_t node = nodes.of(mesh, corner);
        const bool want = wanted == nullptr || wanted[node] != 0;
        elements[fill[cell]++] = {mesh.positions[vertex], corner, node, want ? kWanted : kNotWanted};
    }
    // Cells share nothing: a node lies in one of them.
    parallel.forTasks(elements.size() < kCells ? 1 : kCells, [&](std::size_t task) {
        const std::size_t first = elements.size() < kCells ? 0 : task;
        const std::size_t last = elements.size() < kCells ? kCells : task + 1;
        for (std::size_t cell = first; cell < last; ++cell) {
            if (cell_begin[cell] == cell_begin[cell + 1]) continue;
            Cell(elements.data(), representatives, not_welded).run({cell_begin[cell], cell_begin[cell + 1]});
        }
    });
}

}  // namespace tspace::mikk
