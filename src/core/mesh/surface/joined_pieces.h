// SPDX-License-Identifier: MIT
// Which pieces of a mesh are one surface: files cut one at the border of two materials, and each piece has its own vertices.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tspace/vec.h"

namespace tspace {

struct SurfacePiece {
    std::size_t vertices = 0;                     ///< number of the list that its corners point into
    std::span<const std::uint32_t> corners = {};  ///< three per triangle
};

struct PieceTriangle {
    std::uint32_t piece = 0, triangle = 0;
};

/// Two pieces are one surface where they meet along edges, the way that neighbours do: each edge is one of a single triangle
/// in both, and is run through the other way by the other. Not where more edges are run through the same way (one of the
/// two is turned over), nor where the pieces lie on one another (a tenth of the triangles of the smaller have the positions
/// of triangles of the other: the two sides of a sheet, or layers). Positions are compared exactly, but -0 equals 0.
/// O(n log n) in the triangles at borders, linear in the rest.
class JoinedPieces {
  public:
    /// An edge that two pieces of one surface share.
    struct Border {
        std::array<PieceTriangle, 2> triangles = {};  ///< the piece of the first has the lower number
        std::array<std::uint32_t, 2> points = {};
    };

    /// All that is given must outlive this.
    JoinedPieces(std::span<const std::span<const Vec3>> vertex_lists, std::span<const SurfacePiece> pieces);

    /// Vertices with one position have one point.
    [[nodiscard]] std::uint32_t pointOf(std::uint32_t piece, std::uint32_t vertex) const {
        return points_[first_vertex_[pieces_[piece].vertices] + vertex];
    }
    [[nodiscard]] bool areJoined(std::uint32_t a, std::uint32_t b) const { return group_[a] == group_[b]; }
    /// Pieces of the surface of one, itself not counted.
    [[nodiscard]] std::size_t othersOf(std::uint32_t piece) const { return groups_[group_[piece]].size() - 1; }
    /// In the order of their points.
    [[nodiscard]] const std::vector<Border>& borders() const { return borders_; }

    /// Points of a piece that others of its surface have too.
    [[nodiscard]] std::vector<std::uint32_t> sharedPoints(std::uint32_t piece) const;
    /// Triangles of the others around those points, and `rings` - 1 times those around their points. Ascending.
    [[nodiscard]] std::vector<PieceTriangle> around(std::uint32_t piece, unsigned rings) const;

  private:
    struct EdgeUse {
        std::uint32_t low, high;  // points
        PieceTriangle at;
        bool is_forward;
    };
    struct Votes {
        std::size_t agreeing = 0, turned = 0, overlapping = 0;
    };
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    void weld(std::span<const std::span<const Vec3>> vertex_lists);
    void markShared();
    [[nodiscard]] std::vector<EdgeUse> sharedEdges() const;
    void voteByEdges(const std::vector<EdgeUse>& edges, std::map<Pair, Votes>& votes);
    void voteByTriangles(std::map<Pair, Votes>& votes) const;
    void group(const std::map<Pair, Votes>& votes);
    void listTriangles();
    [[nodiscard]] std::uint32_t corner(const PieceTriangle& at, std::size_t k) const {
        return pointOf(at.piece, pieces_[at.piece].corners[3 * std::size_t{at.triangle} + k]);
    }

    std::span<const SurfacePiece> pieces_;
    std::vector<std::size_t> first_vertex_ = {};  ///< of each list
    std::vector<std::uint32_t> points_ = {};      ///< of the vertices of all lists
    std::vector<bool> is_shared_ = {};            ///< points that several pieces have
    std::vector<std::uint32_t> group_ = {};
    std::vector<std::vector<std::uint32_t>> groups_ = {};
    std::vector<Border> borders_ = {};
    /// Triangles at each point that is shared or near one: those of point p from begins_[p] to before begins_[p + 1].
    std::vector<std::uint32_t> begins_ = {};
    std::vector<PieceTriangle> triangles_ = {};
};

}  // namespace tspace
