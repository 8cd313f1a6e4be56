// SPDX-License-Identifier: MIT
// Properties of triangle surfaces for other modules: views for checks, valid values of tangents, rounding of positions,
// properties of single triangles, equal vertices, rotation of a moved surface, and pieces that form one surface.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/base/owned_mesh.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/span.h"

namespace tspace {

// Arrays of one triangle mesh, as input of checks, from a file of any format.

/// View of a triangle mesh. All arrays except `corners` have one entry per vertex.
struct TangentView {
    std::span<const Vec3> positions = {};
    std::span<const Vec3> normals = {};           ///< may be empty only if a function allows it
    std::span<const Vec4> tangents = {};          ///< tangents; w is the sign
    std::span<const Vec2> uvs = {};               ///< UVs that the texture uses, after its transform
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, all smaller than positions.size()
    double position_step = 0;  ///< quantization step of positions stored as integers, in position units; 0: floats

    /// Returns the triangles as a MeshView.
    [[nodiscard]] MeshView triangles() const {
        MeshView view;
        view.positions = positions;
        view.normals = normals;
        view.uvs = uvs;
        view.indices = corners;
        return view;
    }
};

/// Returns a view of the triangles of a mesh with indices, or of unindexed vertices.
inline TangentView tangentView(const OwnedMesh& mesh) {
    return {.positions = mesh.positions,
            .normals = mesh.normals,
            .tangents = mesh.tangents,
            .uvs = mesh.uvs,
            .corners = mesh.indices};
}

// Validity of the values of a stored tangent, independent of UVs: finite, unit, a sign of +1 or -1, and not parallel to
// N.

/// Angle between a tangent and N or -N below which they form no frame: cross(N, T) is nearly zero, and a shader that
/// normalizes it gets NaN or a random direction.
inline constexpr double kParallelDeg = 5;
inline constexpr double kParallelCosine = 0.99619469809174555;  ///< cosine of kParallelDeg

/// Returns whether a tangent is finite, not zero, and not parallel to N. A normal without a direction is ignored.
inline bool hasDirection(const Vec4& tangent, const Vec3& normal) {
    DVec3 n = toDouble(normal), t = toDouble(xyz(tangent));
    if (!isFinite(xyz(tangent)) || length(t) < kLeastLength) return false;
    return !normalize(n) || !normalize(t) || std::fabs(dot(n, t)) <= kParallelCosine;
}

/// Returns whether the glTF format allows the tangent.
inline bool hasValidValues(const Vec4& tangent) {
    return isFinite(xyz(tangent)) && std::fabs(length(toDouble(xyz(tangent))) - 1) <= kMostFromUnit &&
           (tangent.w == 1 || tangent.w == -1);
}

// Distance of stored positions from the exact ones: floats far from the origin have coarse steps, and positions may
// have been rounded to decimals before.

struct PositionRounding {
    double step = 0;          ///< distance of adjacent representable numbers, along the coarsest axis; 0: negligible
    double error = 0;         ///< maximum distance of a position from its value before rounding
    double far = 0;           ///< largest coordinate, as a magnitude
    bool was_before = false;  ///< true: positions had been rounded before the conversion to float
};

/// Estimates the rounding of positions. `stored_step`: step of an integer format, in position units; 0 for floats. The
/// step of floats is their spacing at the largest coordinates, or coarser if all positions are multiples of a larger
/// step. Axes along which terrain has a regular raster are ignored. Near the origin, multiples of a step count as
/// rounding only if dP/du scatters between neighboring triangles as it does after rounding (without UVs: never).
/// `corner_lists`: three corners per triangle, for each mesh over these positions. Returns zeros if the mesh is 2^16
/// steps wide or more. `allocator`: for temporary memory; null: operator new.
PositionRounding roundingOf(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                            std::span<const std::span<const std::uint32_t>> corner_lists, double stored_step = 0,
                            const Allocator* allocator = nullptr);

/// Triangles that rounding rotates.
struct RotatedTriangles {
    std::uint64_t count = 0, total = 0;
    double share = 0;  ///< share of the surface in triangles rotated by more than the limit
    double worst_deg = 0;
    std::uint32_t first = 0;  ///< a corner of the first triangle that is rotated by more than the limit
};
/// Computes how much rounding rotates the plane of each triangle (root mean square). Linear.
RotatedTriangles rotatedBy(const PositionRounding& rounding, StridedSpan<const Vec3> positions,
                           std::span<const std::uint32_t> corners, double limit_deg);

/// Minimum share of the surface in rotated triangles that is reported: a smaller share may consist of a few slivers.
inline constexpr double kLeastRotatedShare = 0.01;

// Properties of a triangle: normal, area, direction of dP/du, and UV orientation.

struct SurfaceFrame {
    Vec3 normal = {};   ///< unit normal by the right-hand rule; zero if the triangle has no area
    Vec3 tangent = {};  ///< unit vector along dP/du; zero if the UVs have no area
    float area = 0;
    /// Sine of the maximum angle by which rounding of the positions can have rotated `tangent`; from 1 on, any
    /// direction is possible.
    float tangent_error = 0;
    /// Sign of the UV determinant; 0 if the UVs have no area, or so little that rounding decides its sign. If rounding
    /// decides, `tangent` may also point in the opposite direction.
    std::int8_t orientation = 0;
};

struct Surface {
    std::vector<SurfaceFrame> faces = {};   ///< properties of each triangle
    std::vector<double> vertex_areas = {};  ///< area of each vertex: a third of each triangle around it
    std::vector<double> known_areas = {};   ///< area per vertex of the triangles that have an orientation
    double area = 0;
    double known_area = 0;  ///< area of the triangles that have an orientation
    PositionRounding rounding = {};
};

/// Returns whether the triangle faces N. Signs of triangles that do not are unreliable: methods differ in whether the
/// sign depends on N.
bool facesNormal(const SurfaceFrame& face, const Vec3& normal);

/// Computes the properties of one triangle; `uvs`: null if there are none. `position_error`: PositionRounding::error.
SurfaceFrame describeFace(const std::array<Vec3, 3>& positions, const std::array<Vec2, 3>* uvs,
                          double position_error = 0);

/// Computes the properties of all triangles from the positions, UVs and corners of `mesh`. Without UVs, no triangle has
/// a UV orientation. Triangles with positions that are not finite have area 0. Takes linear time.
Surface describeSurface(const TangentView& mesh);

// Test for triangles whose UVs determine a tangent direction.

/// Returns one byte per triangle: 1 if its UVs have an orientation; 0 if they have no area, or so little that rounding
/// decides, or if the triangle has no area. Normals are ignored. Linear.
std::vector<std::uint8_t> uvVotes(const MeshView& triangles);

// Equality of vertices: by position, and optionally by normal, by UV, or by both.

/// Returns a key for UniqueIndex: equal positions have equal keys, with both zeros equal.
inline std::array<std::uint32_t, 3> positionKey(const Vec3& p) { return {weldBits(p.x), weldBits(p.y), weldBits(p.z)}; }

struct EqualVertices {
    std::vector<std::uint32_t> class_of = {};  ///< class of each vertex
    std::size_t class_count = 0;               ///< number of classes, in order of their first vertices
};

/// Finds equal vertices. One entry per vertex in each array; `normals` and `uvs` may be empty. Compares bits, but both
/// zeros are equal. Expected linear time.
EqualVertices findEqualVertices(const StridedSpan<const Vec3>& positions, const StridedSpan<const Vec3>& normals,
                                const StridedSpan<const Vec2>& uvs);
EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs);

// Rotation of a surface around its vertices when it moves, which also rotates the normals that an artist chose there.

/// Mean normals of the triangles around a vertex before and after a movement, weighted by their angles.
struct VertexRotation {
    Vec3 from = {}, to = {};  ///< unit normals; both are zero if one of them is undefined
    /// true: no triangle around the vertex collapses, expands from nothing or is flipped (rotated by more than 150
    /// degrees), and none deviates by more than 40 degrees from the mean, before or after. Otherwise the mean depends
    /// on the weights, and exporters differ.
    bool is_certain = false;

    [[nodiscard]] bool isKnown() const { return !(from == Vec3{}); }
    /// Returns the normal, rotated by the shortest rotation from `from` to `to`; unchanged if the rotation is unknown.
    [[nodiscard]] Vec3 apply(const Vec3& normal) const;
};

/// Rotations of a surface at its vertices. The triangles around a vertex include those of all vertices with the same
/// position, normal and, for a movement, offset: UV seams do not separate them, but hard edges do.
class SurfaceRotations {
  public:
    /// Prepares the search for a mesh with one normal per position. `corners`: three per triangle. All arguments must
    /// outlive the object.
    SurfaceRotations(std::span<const Vec3> positions, std::span<const Vec3> normals,
                     std::span<const std::uint32_t> corners);

    /// Returns one rotation per vertex; `offsets` are added to the positions. Linear.
    [[nodiscard]] std::vector<VertexRotation> under(std::span<const Vec3> offsets) const;

  private:
    std::span<const Vec3> positions_;
    std::span<const std::uint32_t> corners_;
    std::vector<std::uint32_t> class_of_ = {};
};

// Pieces of a mesh that form one surface: files split a mesh at the border of two materials, and each piece has its own
// vertices.

struct SurfacePiece {
    std::size_t vertices = 0;                     ///< index of the vertex list that its corners refer to
    std::span<const std::uint32_t> corners = {};  ///< three per triangle
};

struct PieceTriangle {
    std::uint32_t piece = 0, triangle = 0;
};

/// Groups of pieces that form one surface. Two pieces are joined if they share border edges: each edge belongs to a
/// single triangle in each piece, and runs in opposite directions in the two. They are not joined if most shared edges
/// run in the same direction (one piece is inverted), nor if the pieces coincide: at least a tenth of the triangles of
/// the smaller piece have the positions of triangles of the other piece (two sides of a sheet, or layers). Positions
/// are compared with NormalOptions::weld_distance. O(n log n) in the number of triangles at borders, otherwise linear.
class JoinedPieces {
  public:
    /// Edge that two pieces of one surface share.
    struct Border {
        /// triangles at the edge; triangles[0] belongs to the piece with the lower index
        std::array<PieceTriangle, 2> triangles = {};
        std::array<std::uint32_t, 2> points = {};
    };

    /// Finds the groups. All arguments must outlive the object.
    JoinedPieces(std::span<const std::span<const Vec3>> vertex_lists, std::span<const SurfacePiece> pieces,
                 float weld_distance);

    /// Returns the point of a vertex. Vertices at one position have the same point.
    [[nodiscard]] std::uint32_t pointOf(std::uint32_t piece, std::uint32_t vertex) const {
        return points_[first_vertex_[pieces_[piece].vertices] + vertex];
    }
    [[nodiscard]] bool areJoined(std::uint32_t a, std::uint32_t b) const { return group_[a] == group_[b]; }
    /// Returns the number of other pieces in the surface of a piece.
    [[nodiscard]] std::size_t othersOf(std::uint32_t piece) const { return groups_[group_[piece]].size() - 1; }
    /// Returns the border edges, in the order of their points.
    [[nodiscard]] const std::vector<Border>& borders() const { return borders_; }

    /// Returns the points of a piece that other pieces of its surface share.
    [[nodiscard]] std::vector<std::uint32_t> sharedPoints(std::uint32_t piece) const;
    /// Returns the triangles of the other pieces within `rings` rings of the shared points, ascending.
    [[nodiscard]] std::vector<PieceTriangle> around(std::uint32_t piece, unsigned rings) const;

  private:
    struct Votes {
        std::size_t agreeing = 0, turned = 0, overlapping = 0;
    };
    using Pair = std::pair<std::uint32_t, std::uint32_t>;

    void weld(std::span<const std::span<const Vec3>> vertex_lists, float distance);
    void markShared();
    void voteByEdges(std::map<Pair, Votes>& votes);
    void voteByTriangles(std::map<Pair, Votes>& votes) const;
    void group(const std::map<Pair, Votes>& votes);
    void listTriangles();
    [[nodiscard]] std::uint32_t corner(const PieceTriangle& at, std::size_t k) const {
        return pointOf(at.piece, pieces_[at.piece].corners[3 * std::size_t{at.triangle} + k]);
    }

    std::span<const SurfacePiece> pieces_;
    std::vector<std::size_t> first_vertex_ = {};  ///< index of the first vertex of each vertex list
    std::vector<std::uint32_t> points_ = {};      ///< point of each vertex of all lists
    std::vector<bool> is_shared_ = {};            ///< flags of points that several pieces share
    std::vector<std::uint32_t> group_ = {};
    std::vector<std::vector<std::uint32_t>> groups_ = {};
    std::vector<Border> borders_ = {};
    /// Triangles at each shared or nearby point: for point p, the range [begins_[p], begins_[p + 1]).
    std::vector<std::uint32_t> begins_ = {};
    std::vector<PieceTriangle> triangles_ = {};
};

}  // namespace tspace
