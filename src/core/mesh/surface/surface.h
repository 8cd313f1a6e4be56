// SPDX-License-Identifier: MIT
// What other wings ask about triangles: the view that checks read, sound values of tangents, rounding of positions, properties
// of single triangles, equal vertices, how a surface turns, and which pieces are one surface.
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

// The arrays of one triangle mesh that checks read, from a file of any format.

/// All arrays but `corners` have one entry per vertex.
struct TangentView {
    std::span<const Vec3> positions = {};
    std::span<const Vec3> normals = {};           ///< may be empty only where a function says so
    std::span<const Vec4> tangents = {};          ///< w: the sign
    std::span<const Vec2> uvs = {};               ///< UVs that the texture uses, after its transform
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, all smaller than positions.size()
    double position_step = 0;  ///< quantization step of positions stored as integers, in their units; 0: floats

    /// Its triangles, as the core takes them.
    [[nodiscard]] MeshView triangles() const {
        MeshView view;
        view.positions = positions;
        view.normals = normals;
        view.uvs = uvs;
        view.indices = corners;
        return view;
    }
};

/// Makes a view of triangles with indices, or of unindexed vertices.
inline TangentView tangentView(const OwnedMesh& mesh) {
    return {.positions = mesh.positions,
            .normals = mesh.normals,
            .tangents = mesh.tangents,
            .uvs = mesh.uvs,
            .corners = mesh.indices};
}

// Values that a stored tangent must have whatever the UVs are: finite, unit, a sign of +1 or -1, and not along N.

/// A tangent within 5 degrees of N or of its opposite makes no frame: cross(N, T) is next to nothing, and a shader that
/// normalises it gets NaN, or a direction by chance.
inline constexpr double kParallelDeg = 5;
inline constexpr double kParallelCosine = 0.99619469809174555;  ///< cosine of kParallelDeg

/// Finite, with a length, and not along N. A normal without a direction is not looked at.
inline bool hasDirection(const Vec4& tangent, const Vec3& normal) {
    DVec3 n = toDouble(normal), t = toDouble(xyz(tangent));
    if (!isFinite(xyz(tangent)) || length(t) < kLeastLength) return false;
    return !normalize(n) || !normalize(t) || std::fabs(dot(n, t)) <= kParallelCosine;
}

/// Whether the glTF format allows it.
inline bool hasSoundValues(const Vec4& tangent) {
    return isFinite(xyz(tangent)) && std::fabs(length(toDouble(xyz(tangent))) - 1) <= kMostFromUnit &&
           (tangent.w == 1 || tangent.w == -1);
}

// Distance of stored positions from the intended ones: floats far from the origin have coarse steps, and positions may have
// been rounded to decimals before.

struct PositionRounding {
    double step = 0;          ///< between neighbouring numbers, along the coarsest axis; 0: nothing to speak of
    double error = 0;         ///< the farthest that a position can be from the one that was rounded to it
    double far = 0;           ///< the largest coordinate
    bool was_before = false;  ///< they had been rounded before they were stored as floats
};

/// `stored_step`: of a format with whole numbers, in units of the positions; 0 for floats. Their steps are those of the
/// largest coordinates, or coarser where all positions lie on multiples; none along axes of a raster. Near the origin
/// positions that lie on multiples were rounded only where the UVs say so (empty: nothing does). `corner_lists`: three
/// per triangle, for each mesh over these positions. Nothing where the mesh is 2^16 steps wide or more. `allocator`: of what it
/// makes for a while; null: the system's.
PositionRounding roundingOf(StridedSpan<const Vec3> positions, StridedSpan<const Vec2> uvs,
                            std::span<const std::span<const std::uint32_t>> corner_lists, double stored_step = 0,
                            const Allocator* allocator = nullptr);

/// Triangles that rounding turns.
struct TurnedTriangles {
    std::uint64_t count = 0, total = 0;
    double share = 0;  ///< share of the surface in triangles rotated by more than the limit
    double worst_deg = 0;
    std::uint32_t first = 0;  ///< one corner of the first such triangle
};
/// Returns how much rounding rotates the plane of each triangle (root mean square). Linear.
TurnedTriangles turnedBy(const PositionRounding& rounding, StridedSpan<const Vec3> positions,
                         std::span<const std::uint32_t> corners, double limit_deg);

/// Minimum share of the surface that is more than a few slivers.
inline constexpr double kSomeTurned = 0.01;

// Properties of single triangles: normal and area, where u grows on it, and on which side v lies.

struct SurfaceFrame {
    Vec3 normal = {};   ///< unit, by the right-hand rule; zero where the triangle has no area
    Vec3 tangent = {};  ///< unit dP/du; zero where the UVs have no area
    float area = 0;
    /// The sine of the angle by which rounding of the positions can have turned `tangent`, at most; from 1 on it can point
    /// anywhere.
    float tangent_error = 0;
    /// Sign of the UV determinant; 0 where the UVs have no area, or so little that rounding decides. In that last case
    /// `tangent` may as well point the other way.
    std::int8_t orientation = 0;
};

struct Surface {
    std::vector<SurfaceFrame> faces = {};   ///< one per triangle
    std::vector<double> vertex_areas = {};  ///< a third of each triangle around the vertex
    std::vector<double> known_areas = {};   ///< area per vertex of the triangles that have an orientation
    double area = 0;
    double known_area = 0;  ///< area of the triangles that have an orientation
    PositionRounding rounding = {};
};

/// Triangles that turn their back on N say nothing reliable of signs: methods differ in whether the sign looks at N.
bool facesNormal(const SurfaceFrame& face, const Vec3& normal);

/// One triangle; `uvs`: null where there are none. `position_error`: PositionRounding::error.
SurfaceFrame describeFace(const std::array<Vec3, 3>& positions, const std::array<Vec2, 3>* uvs,
                          double position_error = 0);

/// Positions, UVs (empty: no orientation anywhere) and corners of the view are looked at. Triangles that are not finite
/// have no area. Linear.
Surface describeSurface(const TangentView& mesh);

// Finds triangles whose UVs determine a tangent direction.

/// One byte per triangle: 1 where its UVs have an orientation; 0 where they have no area, or so little that rounding
/// decides, or where the triangle itself has none. Normals are not looked at. Linear.
std::vector<std::uint8_t> uvVotes(const MeshView& triangles);

// Vertices with equal position and normal, or position, normal and UV.

/// A key of UniqueIndex: positions that are equal, both zeros being one value, have one key.
inline std::array<std::uint32_t, 3> positionKey(const Vec3& p) { return {weldBits(p.x), weldBits(p.y), weldBits(p.z)}; }

struct EqualVertices {
    std::vector<std::uint32_t> class_of = {};  ///< one per vertex
    std::size_t class_count = 0;               ///< numbered in order of their first vertices
};

/// One entry per vertex in each; `uvs` may be empty. Bits decide, but both zeros are one value. Expected linear time.
EqualVertices findEqualVertices(const StridedSpan<const Vec3>& positions, const StridedSpan<const Vec3>& normals,
                                const StridedSpan<const Vec2>& uvs);
EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs);

// How a moved surface turns around its vertices, and how that turns normals that an artist has chosen.

/// The mean normals of the triangles around a vertex before and after, weighted by their angles.
struct VertexTurn {
    Vec3 from = {}, to = {};  ///< unit; both zero where one of them cannot be had
    /// No triangle around the vertex collapses, opens or is flipped (turned by more than 150 degrees), and none is more than 40
    /// degrees from the mean, before or after: else the mean is a matter of weights, and exporters differ.
    bool is_certain = false;

    [[nodiscard]] bool isKnown() const { return !(from == Vec3{}); }
    /// The normal, turned by the shortest rotation from `from` to `to`; as it is where the turn is not known.
    [[nodiscard]] Vec3 apply(const Vec3& normal) const;
};

/// The triangles around a vertex are those of all vertices with its position and normal, and, for one movement, its offset:
/// vertices are split for UVs, but a hard edge is one still.
class SurfaceTurns {
  public:
    /// One normal per position. `corners`: three per triangle. All must outlive this.
    SurfaceTurns(std::span<const Vec3> positions, std::span<const Vec3> normals,
                 std::span<const std::uint32_t> corners);

    /// One per vertex; `offsets` are added to the positions. Linear.
    [[nodiscard]] std::vector<VertexTurn> under(std::span<const Vec3> offsets) const;

  private:
    std::span<const Vec3> positions_;
    std::span<const std::uint32_t> corners_;
    std::vector<std::uint32_t> class_of_ = {};
};

// Finds pieces of a mesh that form one surface: files split a mesh at the border of two materials, and each piece has its own
// vertices.

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
/// of triangles of the other: the two sides of a sheet, or layers). Positions are equal as NormalOptions::weld_distance says.
/// O(n log n) in the triangles at borders, linear in the rest.
class JoinedPieces {
  public:
    /// An edge that two pieces of one surface share.
    struct Border {
        std::array<PieceTriangle, 2> triangles = {};  ///< the piece of the first has the lower number
        std::array<std::uint32_t, 2> points = {};
    };

    /// All that is given must outlive this.
    JoinedPieces(std::span<const std::span<const Vec3>> vertex_lists, std::span<const SurfacePiece> pieces,
                 float weld_distance);

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

    void weld(std::span<const std::span<const Vec3>> vertex_lists, float distance);
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
    std::vector<std::size_t> first_vertex_ = {};  ///< first vertex of each list
    std::vector<std::uint32_t> points_ = {};      ///< points of the vertices of all lists
    std::vector<bool> is_shared_ = {};            ///< points that several pieces have
    std::vector<std::uint32_t> group_ = {};
    std::vector<std::vector<std::uint32_t>> groups_ = {};
    std::vector<Border> borders_ = {};
    /// Triangles at each point that is shared or near one: those of point p from begins_[p] to before begins_[p + 1].
    std::vector<std::uint32_t> begins_ = {};
    std::vector<PieceTriangle> triangles_ = {};
};

}  // namespace tspace
