// SPDX-License-Identifier: MIT
// Tests whether the order of the last bucket (last_bucket.h) may change a link in a mesh of at most 64 triangles. Sets
// of triangles are 64-bit words, and representatives are computed only for the few nodes that may be in the bucket.
#include <algorithm>
#include <bit>

#include "core/tangents/mikktspace/grid_cells.h"
#include "core/tangents/mikktspace/last_bucket.h"

namespace tspace::mikk {
namespace {

constexpr std::size_t kMostNodes = 192;

constexpr bool hasThree(std::uint64_t set) {
    set &= set - 1;
    return (set & (set - 1)) != 0;
}

constexpr std::uint32_t middleOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

class SmallBucket {
  public:
    explicit SmallBucket(const FewTriangles& mesh) : in_(mesh) {}

    bool mayMatter() {
        findCandidates();
        const std::span<const std::uint32_t> all = candidates();
        const auto isCrowded = [&](std::uint32_t node) { return hasThree(in_.around[node] & twice_); };
        if (std::none_of(all.begin(), all.end(), isCrowded)) return false;
        makeGrid();
        findRepresentatives();
        return orderMatters();
    }

  private:
    [[nodiscard]] std::uint32_t cornerOf(std::uint32_t triangle, std::uint32_t node) const {
        const std::uint32_t* const n = in_.nodes + 3 * triangle;
        return 3 * triangle + (n[0] == node ? 0 : n[1] == node ? 1 : 2);
    }
    [[nodiscard]] std::uint32_t firstCorner(std::uint32_t node) const {
        return cornerOf(static_cast<std::uint32_t>(std::countr_zero(in_.around[node])), node);
    }
    [[nodiscard]] std::uint32_t lastCorner(std::uint32_t node) const {
        return cornerOf(63 - static_cast<std::uint32_t>(std::countl_zero(in_.around[node])), node);
    }

    /// Finds the nodes that may be in the last bucket. Each representative is between the first and the last corner of
    /// its node, so V, the largest key, is at least the largest key computed from first corners. Candidates are nodes
    /// whose last corner is at least that bound. The order of the bucket can matter only if three half-edges share the
    /// node of V; they belong to three triangles with two candidates each, because a triangle has at most one half-edge
    /// in the bucket.
    void findCandidates() {
        const auto count = static_cast<std::uint32_t>(in_.welded.triangles.count);
        for (std::uint32_t triangle = count; triangle-- > 0 && 3 * triangle + 2 >= least_;) {
            const std::uint32_t* const n = in_.nodes + 3 * triangle;
            least_ = std::max(least_, middleOf(firstCorner(n[0]), firstCorner(n[1]), firstCorner(n[2])));
        }
        std::uint64_t once = 0;
        for (std::uint32_t corner = least_; corner < 3 * count; ++corner) {
            const std::uint32_t node = in_.nodes[corner];
            if (lastCorner(node) != corner) continue;
            candidates_[candidate_count_++] = node;
            twice_ |= once & in_.around[node];
            once |= in_.around[node];
        }
    }

    void makeGrid() {
        const WeldedMesh& welded = in_.welded;
        const std::size_t count = welded.nodes.count;
        Box box(loadVec3(welded.mesh.positions[welded.mesh.indices[0]]));
        for (std::size_t node = 0; node < count; ++node) {
            positions_[node] = loadVec3(welded.mesh.positions[welded.nodes.vertex(node)]);
            if (in_.around[node] != 0) box.add(positions_[node]);
        }
        const Grid grid(box);
        const auto axis = static_cast<std::size_t>(grid.axis);
        for (std::size_t node = 0; node < count; node += 4) {
            const auto at = [&](std::size_t i) { return positions_[std::min(node + i, count - 1)][axis]; };
            cells_[node / 4] = grid.cellsOf(Float4{at(0), at(1), at(2), at(3)});
        }
        std::fill_n(representatives_, count, std::uint8_t{0});
        for (const std::uint32_t node : candidates()) representatives_[node] = kUnknown;
    }

    [[nodiscard]] std::int32_t cellOf(std::uint32_t node) const { return cells_[node / 4][node % 4]; }

    void findRepresentatives() {
        const std::size_t count = in_.welded.nodes.count;
        for (const std::uint32_t node : candidates()) {
            if (representatives_[node] != kUnknown) continue;
            const std::int32_t cell = cellOf(node);
            std::uint64_t triangles = 0;
            bool is_divided = false;
            for (std::uint32_t other = 0; other < count; ++other) {
                if (cellOf(other) != cell) continue;
                triangles |= in_.around[other];
                is_divided |= laneBits(positions_[other] != positions_[node]) != 0;
            }
            // If all corners in a cell have one position, the reference does not divide the cell, and keeps the first
            // corner of each node.
            if (!is_divided)
                representatives_[node] = static_cast<std::uint8_t>(firstCorner(node));
            else
                divide(cell, triangles);
        }
    }

    /// Finds the representatives of the candidates in one cell, whose corners all belong to the given triangles.
    void divide(std::int32_t cell, std::uint64_t triangles) {
        alignas(CellElement) std::byte room[(kMostNodes + 1) * sizeof(CellElement)];
        auto* const elements = reinterpret_cast<CellElement*>(room);
        std::size_t size = 0;
        for (; triangles != 0; triangles &= triangles - 1) {
            const auto t = static_cast<std::uint32_t>(std::countr_zero(triangles));
            for (std::uint32_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
                const std::uint32_t node = in_.nodes[corner];
                storeFloat4(&elements[size].position.x, positions_[node]);
                elements[size].entry = representatives_[node] == kUnknown ? corner | kTopBit : corner;
                size += cellOf(node) == cell ? 1 : 0;
            }
        }
        const auto name = [&](std::uint32_t corner) {
            representatives_[in_.nodes[corner]] = static_cast<std::uint8_t>(corner);
        };
        Cell({elements, size}, name).run();
    }

    [[nodiscard]] std::span<const std::uint32_t> candidates() const { return {candidates_, candidate_count_}; }

    /// Returns whether the bucket has at least three half-edges, and an edge in both directions.
    [[nodiscard]] bool orderMatters() const {
        std::uint32_t largest = 0, low_node = 0;
        for (std::uint64_t set = twice_; set != 0; set &= set - 1) {
            const std::uint32_t* const n = in_.nodes + 3 * std::countr_zero(set);
            const std::uint32_t r[3] = {representatives_[n[0]], representatives_[n[1]], representatives_[n[2]]};
            const std::uint32_t key = middleOf(r[0], r[1], r[2]);
            if (key <= largest) continue;
            largest = key;
            low_node = r[0] == key ? n[0] : r[1] == key ? n[1] : n[2];
        }
        if (largest == 0) return false;
        std::uint64_t leaving = 0, arriving = 0;  // triangles with half-edges from the lower end, and to the lower end
        for (std::uint64_t set = in_.around[low_node] & twice_; set != 0; set &= set - 1) {
            const auto t = static_cast<std::uint32_t>(std::countr_zero(set));
            const std::uint32_t k = cornerOf(t, low_node) - 3 * t;
            if (representatives_[in_.nodes[3 * t + (k + 1) % 3]] > largest) leaving |= std::uint64_t{1} << t;
            if (representatives_[in_.nodes[3 * t + (k + 2) % 3]] > largest) arriving |= std::uint64_t{1} << t;
        }
        if (!hasThree(leaving | arriving)) return false;
        for (std::uint64_t set = leaving; set != 0; set &= set - 1) {
            const auto t = static_cast<std::uint32_t>(std::countr_zero(set));
            const std::uint32_t k = cornerOf(t, low_node) - 3 * t;
            if ((in_.around[in_.nodes[3 * t + (k + 1) % 3]] & arriving) != 0) return true;
        }
        return false;
    }

    static constexpr std::uint8_t kUnknown = 255;

    const FewTriangles& in_;
    std::uint32_t candidates_[kMostNodes];
    std::size_t candidate_count_ = 0;
    Float4 positions_[kMostNodes];              // positions of nodes; the fourth lanes are unused
    Mask4 cells_[kMostNodes / 4];               // grid cell of each node
    std::uint32_t least_ = 1;                   // lower bound of V, the largest key, which is never 0
    std::uint64_t twice_ = 0;                   // triangles with at least two candidates
    std::uint8_t representatives_[kMostNodes];  // representative of each candidate; 0 for other nodes
};

}  // namespace

bool lastBucketMayMatter(const FewTriangles& mesh) { return SmallBucket(mesh).mayMatter(); }

}  // namespace tspace::mikk
