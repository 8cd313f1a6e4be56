// SPDX-License-Identifier: MIT
#include "maps/layout/uv_pieces.h"

#include <numeric>

#include "core/base/disjoint_sets.h"
#include "core/base/sort.h"
#include "core/mesh/surface/uvs.h"
#include "maps/layout/low_points.h"

namespace tspace {
namespace {

struct HashedCorner {
    std::uint64_t hash = 0;
    std::uint32_t triangle = 0;
};

class Pieces {
  public:
    Pieces(const LowPoly& low, const Allocator* allocator)
        : low_(low), allocator_(allocator), parents_(allocator, low.positions.count / 3) {
        std::iota(parents_.begin(), parents_.end(), 0U);
        joinAtCorners();
    }

    /// Returns the first triangle of the UV island that contains a triangle.
    std::uint32_t firstOf(std::uint32_t triangle) { return rootOf(parents_.data(), triangle); }

  private:
    /// Returns the orientation of a triangle's UVs: 1 or -1, or 0 if the UVs have no area.
    [[nodiscard]] int turnOf(std::size_t triangle) const {
        const StridedSpan<const Vec2>& uvs = low_.uvs;
        const double area = signedUvArea(uvs[3 * triangle], uvs[3 * triangle + 1], uvs[3 * triangle + 2], false);
        return area > 0 ? 1 : area < 0 ? -1 : 0;
    }

    [[nodiscard]] std::uint64_t hashOf(std::size_t corner) const {
        return foldHash(hashCorner(low_, corner), static_cast<std::uint64_t>(1 + turnOf(corner / 3)));
    }

    void joinAtCorners() {
        Buffer<HashedCorner> corners(allocator_, low_.positions.count);
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = {hashOf(i), static_cast<std::uint32_t>(i / 3)};
        sortList(corners.begin(), corners.end(), [](const HashedCorner& a, const HashedCorner& b) {
            return a.hash != b.hash ? a.hash < b.hash : a.triangle < b.triangle;
        });
        for (std::size_t i = 1; i < corners.size(); ++i) {
            if (corners[i].hash == corners[i - 1].hash)
                joinSets(parents_.data(), corners[i].triangle, corners[i - 1].triangle);
        }
    }

    const LowPoly& low_;
    const Allocator* allocator_;
    Buffer<std::uint32_t> parents_;
};

}  // namespace

Buffer<std::uint32_t> ranksOfPieces(const LowPoly& low, MapOverlap overlap, const Allocator* allocator) {
    if (overlap == MapOverlap::mean) return {};
    const std::size_t count = low.positions.count / 3;
    Pieces pieces(low, allocator);
    Buffer<std::uint32_t> ranks(allocator, count);
    for (std::uint32_t i = 0; i < count; ++i) ranks[i] = pieces.firstOf(i);
    if (overlap == MapOverlap::first) return ranks;
    struct Piece {
        double area = 0;
        std::uint32_t first = 0;
    };
    Buffer<Piece> by_area(allocator, count, Piece{});
    for (std::uint32_t i = 0; i < count; ++i) {
        by_area[i].first = i;
        by_area[ranks[i]].area += faceSize(low.positions, i);
    }
    sortList(by_area.begin(), by_area.end(),
             [](const Piece& a, const Piece& b) { return a.area != b.area ? a.area > b.area : a.first < b.first; });
    Buffer<std::uint32_t> rank_of(allocator, count);
    for (std::uint32_t i = 0; i < count; ++i) rank_of[by_area[i].first] = i;
    for (std::uint32_t& rank : ranks) rank = rank_of[rank];
    return ranks;
}

}  // namespace tspace
