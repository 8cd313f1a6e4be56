// SPDX-License-Identifier: MIT
// Hash grid with cells of four times the weld distance: a position is compared with the cells within the distance, in
// most cases one. Positions that were welded to another one are not added to the table, so chains of close positions
// are not all welded together, and cells have few entries.
#include "core/base/near_positions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/mesh_loops.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "core/base/weld.h"
#include "tspace/normals.h"

namespace tspace {
namespace {

constexpr std::uint32_t kNoVertexNear = 0xffffffffu;
/// Parameters of weld_auto: the weld distance, in float spacings, and the minimum length of the longest edge at a
/// vertex, in weld distances. Vertices with shorter edges are not welded, which preserves the shape of meshes far from
/// the origin.
constexpr double kSpacings = 2, kLeastEdge = 32;
constexpr double kCellWidth = 4;

double longestCoordinate(const Vec3& p) {
    return std::max({std::fabs(double{p.x}), std::fabs(double{p.y}), std::fabs(double{p.z})});
}

bool areNear(const Vec3& a, const Vec3& b, double distance) {
    return std::fabs(double{a.x} - b.x) <= distance && std::fabs(double{a.y} - b.y) <= distance &&
           std::fabs(double{a.z} - b.z) <= distance;
}

/// Returns the distance between a nonnegative float and the next larger one.
double spacingAt(float value) {
    const auto next = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) + 1);
    return std::isfinite(next) ? double{next} - value : 0;
}

/// Hash table of the positions that were added, by grid cell.
class PositionCells {
  public:
    PositionCells(const StridedSpan<const Vec3>& positions, double distance, std::size_t most,
                  const Allocator* allocator)
        : positions_(positions), distance_(distance), width_(kCellWidth * distance),
          slots_(allocator, std::bit_ceil(2 * most + 2)) {
        std::fill(slots_.begin(), slots_.end(), Slot{0, kNoVertexNear});
    }

    void add(std::uint32_t vertex) {
        const Vec3& p = positions_[vertex];
        const std::uint32_t hash = hashOf({cellOf(p.x), cellOf(p.y), cellOf(p.z)});
        std::size_t at = hash & (slots_.size() - 1);
        while (slots_[at].vertex != kNoVertexNear) at = (at + 1) & (slots_.size() - 1);
        slots_[at] = {hash, vertex};
    }

    /// Returns the vertex with the lowest index within the distance, or kNoVertexNear.
    [[nodiscard]] std::uint32_t lowestNear(const Vec3& p) const {
        const std::array<double, 2> x = cellsNear(p.x), y = cellsNear(p.y), z = cellsNear(p.z);
        std::uint32_t lowest = kNoVertexNear;
        for (unsigned i = 0; i < 8; ++i) {
            const bool is_again =
                ((i & 1) != 0 && x[0] == x[1]) || ((i & 2) != 0 && y[0] == y[1]) || ((i & 4) != 0 && z[0] == z[1]);
            if (!is_again) lowest = std::min(lowest, lowestIn({x[i & 1], y[i >> 1 & 1], z[i >> 2]}, p));
        }
        return lowest;
    }

  private:
    struct Slot {
        std::uint32_t hash, vertex;
    };

    [[nodiscard]] double cellOf(double coordinate) const { return std::floor(coordinate / width_); }
    [[nodiscard]] std::array<double, 2> cellsNear(double coordinate) const {
        return {cellOf(coordinate - distance_), cellOf(coordinate + distance_)};
    }
    static std::uint32_t hashOf(const std::array<double, 3>& cell) {
        // Adding +0 converts -0 to +0, so that both zeros are equal.
        const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value + 0.0); };
        return static_cast<std::uint32_t>(mixBits(mixBits(mixBits(bits(cell[0])) ^ bits(cell[1])) ^ bits(cell[2])) >>
                                          32);
    }
    [[nodiscard]] std::uint32_t lowestIn(const std::array<double, 3>& cell, const Vec3& p) const {
        const std::uint32_t hash = hashOf(cell);
        std::uint32_t lowest = kNoVertexNear;
        for (std::size_t at = hash & (slots_.size() - 1); slots_[at].vertex != kNoVertexNear;
             at = (at + 1) & (slots_.size() - 1)) {
            const Slot& slot = slots_[at];
            if (slot.hash == hash && slot.vertex < lowest && areNear(positions_[slot.vertex], p, distance_))
                lowest = slot.vertex;
        }
        return lowest;
    }

    const StridedSpan<const Vec3>& positions_;
    double distance_, width_;
    Buffer<Slot> slots_;
};

/// Returns the longest edge at each vertex, in the maximum norm; 0 at unused vertices.
Buffer<float> longestEdges(const MeshView& mesh, const Buffer<std::uint32_t>& equal, const Allocator* allocator) {
    Buffer<float> longest(allocator, mesh.vertexCount(), 0.0f);
    withIndices(mesh.indices, [&](auto vertexOf) {
        forEachFace(mesh, [&](std::size_t, std::size_t first, std::size_t size) {
            for (std::size_t k = 0; k < size; ++k) {
                const std::uint32_t a = equal[vertexOf(first + k)], b = equal[vertexOf(first + (k + 1) % size)];
                const Vec3 edge = mesh.positions[b] - mesh.positions[a];
                if (!isFinite(edge)) continue;
                const auto size_of_edge = static_cast<float>(longestCoordinate(edge));
                longest[a] = std::max(longest[a], size_of_edge);
                longest[b] = std::max(longest[b], size_of_edge);
            }
        });
    });
    return longest;
}

}  // namespace

Error checkWeldDistance(float distance) {
    const bool is_valid = (distance >= 0 && std::isfinite(distance)) || distance == NormalOptions::weld_auto;
    if (is_valid) return {ErrorCode::ok, {}};
    return {ErrorCode::invalidOption, "weld_distance must be a finite number of 0 or more, or weld_auto (-1)"};
}

NearPositions::NearPositions(const MeshView& mesh, float distance, const Allocator* allocator, Parallel& parallel)
    : allocator_(allocator), distance_(distance) {
    const std::size_t count = mesh.vertexCount();
    if (distance == 0 || count == 0) return;
    Buffer<std::uint32_t> roots = weldPositions(mesh, allocator, parallel);
    if (roots.empty()) {
        roots = Buffer<std::uint32_t>(allocator, count);
        for (std::uint32_t v = 0; v < count; ++v) roots[v] = v;
    }
    Buffer<float> edges;
    if (distance < 0) {
        edges = longestEdges(mesh, roots, allocator);
        float most = 0;
        for (std::size_t v = 0; v < count; ++v)
            if (edges[v] > 0) most = std::max(most, static_cast<float>(longestCoordinate(mesh.positions[v])));
        distance_ = kSpacings * spacingAt(most);
    }
    std::size_t most = 0;
    const auto isWeldable = [&](std::uint32_t v) {
        return roots[v] == v && (edges.empty() || edges[v] >= kLeastEdge * distance_) && isFinite(mesh.positions[v]);
    };
    for (std::uint32_t v = 0; v < count; ++v) most += isWeldable(v) ? 1 : 0;
    if (!(distance_ > 0) || most < 2) return;
    PositionCells cells(mesh.positions, distance_, most, allocator);
    bool any = false;
    for (std::uint32_t v = 0; v < count; ++v) {
        if (!isWeldable(v)) {
            roots[v] = roots[roots[v]];
            continue;
        }
        const std::uint32_t near = cells.lowestNear(mesh.positions[v]);
        if (near == kNoVertexNear) {
            cells.add(v);
        } else {
            roots[v] = near;
            any = true;
        }
    }
    if (any) roots_ = std::move(roots);
}

Buffer<Vec3> NearPositions::moved(StridedSpan<const Vec3> positions) const {
    Buffer<Vec3> result(allocator_, positions.count);
    for (std::size_t v = 0; v < positions.count; ++v) {
        const Vec3 &own = positions[v], &other = positions[roots_.empty() ? v : roots_[v]];
        result[v] = areNear(own, other, distance_) ? other : own;
    }
    return result;
}

}  // namespace tspace
