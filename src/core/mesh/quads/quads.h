// SPDX-License-Identifier: MIT
// Reconstruction of quads from a list of triangles: candidates, selection by tangents or shape, and the faces to use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/result.h"

namespace tspace {

// Candidates for quads. Exporters cut a polygon into triangles that are consecutive in the list, so a quad can only
// consist of triangles t and t + 1, across a shared edge. Candidates depend on topology and shape, not on tangents.

/// Finds triangles that can form a quad with the next triangle. Linear in the triangles; one byte per triangle.
class QuadCandidates {
  public:
    /// Triangles t and t + 1 can form a quad if they share one edge, in opposite directions, and do not fold back on
    /// each other. An edge is shared if its ends are the same vertices, or equal in position, normal, UV and (if there
    /// are any) tangent: a corner of a quad has one of each.
    ///
    /// triangles   valid; three corners per face
    /// tangents    one per vertex, or empty
    explicit QuadCandidates(const MeshView& triangles, std::span<const Vec4> tangents = {});

    [[nodiscard]] std::size_t triangleCount() const { return seams_.size(); }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool has(std::size_t t) const { return seams_[t] != 0; }
    /// Returns the quad of triangles t and t + 1: four corners of the triangle list, in the winding of the triangles.
    /// The first and the third corner are the ends of the shared edge; if turned, the second and the fourth.
    void cornersOf(std::size_t t, bool is_turned, std::uint32_t quad[4]) const;
    /// Returns the pattern of the shared edge: combination of an edge of t and an edge of t + 1, 0 to 8.
    [[nodiscard]] unsigned patternOf(std::size_t t) const { return seams_[t] - 1u; }

  private:
    /// pattern of triangles t and t + 1: 0 for no candidate, otherwise 1 + 3 * edge of t + edge of t + 1
    std::vector<std::uint8_t> seams_;
    std::size_t count_ = 0;
};

/// Role of triangle t in a quad. If both diagonals of a quad are equally long, MikkTSpace cuts it between its first and
/// third corner, so the first corner matters: an end of the shared edge, as Blender writes since 2.80, or another
/// corner.
enum class PairKind : std::uint8_t {
    none = 0,    ///< the triangle is not paired, or is the second triangle of a quad
    quad = 1,    ///< the triangle forms a quad with triangle t + 1
    turned = 2,  ///< like `quad`, but the corners of the quad start one corner later
};
using QuadPairs = std::vector<PairKind>;

/// Quads and triangles over the corners of a triangle list, in its order.
struct QuadFaces {
    std::vector<std::uint32_t> sizes = {};    ///< number of corners of each face, 3 or 4
    std::vector<std::uint32_t> corners = {};  ///< for each corner of a face: the corner of the triangle list
    /// For each corner of the triangle list: the corner of a face. At each end of a quad's diagonal, two corners of the
    /// list belong to one corner of the face.
    std::vector<std::uint32_t> face_corners = {};
    std::size_t quad_count = 0;
};

/// Selects disjoint pairs with the largest sum of gains. `gains`: gain of forming a quad of triangles t and t + 1, for
/// each t; pairs with a gain of 0 or less are never selected. Among equal sums earlier pairs win. Returns no turned
/// pairs. Linear.
QuadPairs choosePairs(const QuadCandidates& candidates, std::span<const float> gains);

/// Selects the pairs that look most like modeled quads. The gain of a pair, from 1 to 3, is 1, plus the frequency of
/// the corner positions of its shared edge among all candidates (relative to the most frequent), plus the closeness of
/// its corners to right angles. choosePairs maximizes the sum of gains.
QuadPairs pairsByShape(const MeshView& triangles, const QuadCandidates& candidates);

/// Returns whether turning any of these quads changes the diagonal along which MikkTSpace cuts it.
bool hasTies(const MeshView& triangles, const QuadCandidates& candidates, const QuadPairs& pairs);

/// Builds the faces. `pairs`: one entry per triangle.
QuadFaces facesOfPairs(const QuadCandidates& candidates, const QuadPairs& pairs);

// Detection of tangents that MikkTSpace computed on quads before the quads were triangulated, as in Blender, and of the
// pairs of triangles that formed these quads.

/// Returns whether quads explain clearly more corners than triangles. Pairs are selected by the corners that they
/// explain, which explains a few more corners of any mesh; so quads must explain a minimum share of the unexplained
/// corners, and of all corners.
bool quadsWin(std::uint64_t corner_count, std::uint64_t near_on_triangles, std::uint64_t near_on_quads);

struct QuadFit {
    QuadFaces faces = {};
    std::vector<Vec4> tangents = {};  ///< mikktspace tangents on the faces, one per corner of the triangle list
    std::uint64_t corner_count = 0;   ///< number of corners that are compared
    std::uint64_t near_on_triangles = 0, near_on_quads = 0;  ///< corners whose tangent is explained

    [[nodiscard]] bool wins() const { return quadsWin(corner_count, near_on_triangles, near_on_quads); }
};

/// Finds the pairs of triangles that explain most corners. Starts with the pairs by shape; then weighs each pair by the
/// distance of the stored tangents of its six corners from the mikktspace results with and without the pair. These
/// results come from three runs: with the pairs by shape, with the same pairs turned, and with alternative pairs. Then
/// selects pairs again, with the improved neighbors, as long as that explains more.
///
/// triangles      valid; three corners per face; with normals and UVs. Triangles whose UVs determine no direction
///                (uvVotes) are ignored
/// stored         one tangent per vertex
/// tolerance_deg  maximum angle between equal tangents
/// on_triangles   mikktspace results on the unpaired triangles, one per corner; empty: computed here
///
/// At most eight runs of mikktspace, and none if no consecutive triangles share an edge, or if the triangles leave too
/// few corners unexplained: then no face is a quad. Otherwise linear, with about 60 bytes per corner. Errors: those of
/// generateTangents.
Result<QuadFit> fitQuads(const MeshView& triangles, std::span<const Vec4> stored, const Execution& execution,
                         double tolerance_deg = 1, std::span<const Vec4> on_triangles = {});

/// Computes mikktspace on these faces: one tangent per corner of the triangle list, with the raw sign
/// (before the factor of a convention is applied).
Result<std::vector<Vec4>> tangentsOnFaces(const MeshView& triangles, const QuadFaces& faces,
                                          const Execution& execution);

// Faces for computing or comparing tangents: triangles, or their original quads.

/// Returns the quads for the option `faces`; none (quad_count 0) means triangles. `triangles`: none. For the other
/// values, if tangents exist and fit clearly better to quads: these quads. Otherwise:
///
/// `quads`      triangles paired by shape
/// `automatic`  the same pairs if there are no tangents, Blender wrote the mesh, and most of its triangles have the
///              edge pattern of Blender's quads; else none
///
/// triangles    as required by fitQuads
/// stored       one tangent per vertex, or empty
/// is_from_blender  whether Blender wrote the file
///
/// Cost and errors: those of fitQuads.
Result<QuadFaces> chooseFaces(const MeshView& triangles, std::span<const Vec4> stored, bool is_from_blender,
                              Faces faces, const Execution& execution);

/// Returns polygons as faces over their own triangles. Polygons with fewer than three corners are omitted.
QuadFaces facesOfPolygons(std::span<const std::uint32_t> face_sizes, const Triangulation& triangles);

}  // namespace tspace
