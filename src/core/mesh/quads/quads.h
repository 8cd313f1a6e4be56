// SPDX-License-Identifier: MIT
// Quads out of a list of triangles: which pairs can be quads, which were, by the tangents, and which faces are taken.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

// Quads out of a list of triangles. Exporters cut a polygon into triangles that follow each other in the list, so a
// quad can only be triangle t with triangle t + 1, across an edge that both have. Knows topology and shape, no tangents.

/// Finds triangles that can form a quad with the next one. Linear in the triangles; one byte per triangle.
class QuadCandidates {
  public:
    /// Triangles t and t + 1 can be a quad when they share one edge, in opposite directions, and do not fold back on
    /// each other. An edge is shared when its ends are the same vertices, or equal in position, normal, UV and (where
    /// there are any) tangent: a corner of a quad has one of each.
    ///
    /// triangles   valid; three corners a face
    /// tangents    one per vertex, or empty
    explicit QuadCandidates(const MeshView& triangles, std::span<const Vec4> tangents = {});

    [[nodiscard]] std::size_t triangleCount() const { return seams_.size(); }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool has(std::size_t t) const { return seams_[t] != 0; }
    /// The quad of triangles t and t + 1: four corners of the triangle list, in the triangles' winding. The first and
    /// the third are the ends of the edge between the two; turned: the second and the fourth.
    void cornersOf(std::size_t t, bool is_turned, std::uint32_t quad[4]) const;
    /// Pattern of the shared edge: combination of an edge of t and an edge of t + 1, 0 to 8.
    [[nodiscard]] unsigned patternOf(std::size_t t) const { return seams_[t] - 1u; }

  private:
    std::vector<std::uint8_t> seams_;  ///< 0: none; 1 + 3 * edge of t + edge of t + 1
    std::size_t count_ = 0;
};

/// The part of a quad that triangle t is. Where both diagonals of a quad are equally long MikkTSpace cuts it between
/// its first and third corner, so there its first corner matters: an end of the triangles' common edge, as Blender
/// writes them since 2.80, or another corner.
enum class PairKind : std::uint8_t {
    none = 0,    ///< a triangle, or the second of a quad
    quad = 1,    ///< one quad with triangle t + 1
    turned = 2,  ///< one quad with triangle t + 1, starting one corner later
};
using QuadPairs = std::vector<PairKind>;

/// Quads and triangles over the corners of a list of triangles, in its order.
struct QuadFaces {
    std::vector<std::uint32_t> sizes = {};    ///< 3 or 4 per face
    std::vector<std::uint32_t> corners = {};  ///< per corner of a face: the corner of the list that it is
    /// Per corner of the list: the corner of a face that it is. The ends of a quad's diagonal are two corners of the
    /// list each.
    std::vector<std::uint32_t> face_corners = {};
    std::size_t quad_count = 0;
};

/// The pairs of which no two share a triangle and whose gains add up to most. `gains`: one per triangle t, for making
/// one quad of t and t + 1; 0 or less: not. Of equal sums the one with the earlier pairs. None is turned. Linear.
QuadPairs choosePairs(const QuadCandidates& candidates, std::span<const float> gains);

/// The pairs that look most like quads of a modeller: as many as there can be, and among these choices the one whose
/// triangles meet as most in this list do, and whose corners are nearest to square.
QuadPairs pairsByShape(const MeshView& triangles, const QuadCandidates& candidates);

/// Whether MikkTSpace cuts one of these quads otherwise when it is turned.
bool hasTies(const MeshView& triangles, const QuadCandidates& candidates, const QuadPairs& pairs);

/// `pairs`: one per triangle.
QuadFaces facesOfPairs(const QuadCandidates& candidates, const QuadPairs& pairs);

// Whether tangents were made by MikkTSpace on quads that were cut into triangles later, as Blender does, and which
// pairs of triangles those quads were.

/// Whether quads explain clearly more corners than triangles do. Pairs are chosen by the corners that they explain,
/// which explains a few more of any mesh; so quads must explain a part of the unexplained corners, and a least number.
bool quadsWin(std::uint64_t corner_count, std::uint64_t near_on_triangles, std::uint64_t near_on_quads);

struct QuadFit {
    QuadFaces faces = {};
    std::vector<Vec4> tangents = {};  ///< mikktspace tangents on the faces, one per corner of the triangle list
    std::uint64_t corner_count = 0;   ///< corners that vote
    std::uint64_t near_on_triangles = 0, near_on_quads = 0;  ///< corners whose tangent is explained

    [[nodiscard]] bool wins() const { return quadsWin(corner_count, near_on_triangles, near_on_quads); }
};

/// Finds the pairs of triangles that explain most. The first choice is that by shape; then each pair is weighed by how
/// near the stored tangents of its six corners are to those of mikktspace with the pair and without, which is known
/// after the pairs by shape, these turned, and those they exclude were computed once each; then again with the better
/// neighbours, as long as that explains more.
///
/// triangles      valid; three corners a face; with normals and UVs. Those whose UVs say nothing (uvVotes) fit nowhere
/// stored         one tangent per vertex
/// tolerance_deg  tangents nearer than this are the same
/// on_triangles   what mikktspace gives on the triangles as they are, one per corner; empty: it is computed here
///
/// Eight runs of mikktspace at most, and none where there are no two consecutive triangles with a common edge, or the
/// triangles leave too little unexplained for quads to win: then no face is a quad. Otherwise linear, with about 60
/// bytes per corner. Fails where generateTangents does.
Result<QuadFit> fitQuads(const MeshView& triangles, std::span<const Vec4> stored, const Execution& execution,
                         double tolerance_deg = 1, std::span<const Vec4> on_triangles = {});

/// mikktspace on these faces, one tangent per corner of the triangle list, with the raw sign.
Result<std::vector<Vec4>> tangentsOnFaces(const MeshView& triangles, const QuadFaces& faces,
                                          const Execution& execution);

// The faces that tangents are computed on or compared with: triangles, or quads that these were cut from.

/// The quads that are meant by `faces`; none (quad_count 0): the triangles. Where tangents are there and fit clearly
/// better to quads, those that they fit; else `quads` takes the pairs by shape, and so does `automatic` where Blender
/// wrote a mesh without tangents most of whose triangles meet as those do that it cuts quads into.
///
/// triangles    as fitQuads wants them
/// stored       one tangent per vertex, or empty
/// is_blenders  Blender wrote the file
///
/// Cost and errors: those of fitQuads.
Result<QuadFaces> chooseFaces(const MeshView& triangles, std::span<const Vec4> stored, bool is_blenders, Faces faces,
                              const Execution& execution);

/// Polygons as faces over their own triangles. Those with fewer than three corners are left out.
QuadFaces facesOfPolygons(std::span<const std::uint32_t> face_sizes, const Triangulation& triangles);

}  // namespace tspace
