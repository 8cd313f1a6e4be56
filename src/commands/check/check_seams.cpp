// SPDX-License-Identifier: MIT
// Finds the edges that primitives of one smooth surface share, mesh by mesh, and compares the normals on both sides at
// both ends.
#include "commands/check/scene_checks.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "commands/check/findings.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {
namespace {

constexpr double kToDegrees = 180 / kPi;
/// Normals that differ by less than this angle make no visible seam.
constexpr double kMinSeamDeg = 2;
/// A normal counts as the mean of the primitive's own triangles if it is within this angle of that mean, for any of the
/// three weightings. The tolerance covers rounding to 8 bits.
constexpr double kOwnDeg = 1;
/// A border is smooth if it bends at most kMoreBend times as much as the smooth edges of either side. Their bend is the
/// angle that a share kSmoothPart of them does not exceed.
constexpr double kMoreBend = 1.25, kSmoothPart = 0.9;
/// A seam is reported only if at least this share, and at least this number, of the points with differing normals look
/// like a seam.
constexpr double kMinPlaceShare = 0.8;
constexpr std::size_t kMinPlaces = 3;

/// Approximate memory for comparing the primitives of a mesh; freed afterwards.
constexpr std::uint64_t kBytesPerVertex = 200, kBytesPerCorner = 100;

/// Normal of a triangle and its weights at its corners. Three weightings are used: equal weights, area and corner
/// angle.
struct Face {
    DVec3 normal = {};
    double area = 0;
    std::array<double, 3> angles = {};
};

/// Smoothing of one primitive: the mean normals of the triangles around each group of vertices with equal positions and
/// normals.
class SmoothPiece {
  public:
    SmoothPiece(const ScenePrimitive& primitive, const JoinedPieces& joined, std::uint32_t piece)
        : primitive_(primitive) {
        EqualVertices equal = findEqualVertices(primitive.positions.span(), primitive.normals.span(), {});
        class_of_ = std::move(equal.class_of);
        means_.resize(equal.class_count);
        for (std::size_t c = 0; c + 2 < primitive.corners.size(); c += 3) addFace(c);
        bends(joined, piece);
    }

    [[nodiscard]] const DVec3& faceNormal(std::uint32_t triangle) const { return faces_[triangle].normal; }
    /// Returns whether the vertex normal equals a mean of the normals of the primitive's own triangles.
    [[nodiscard]] bool isOwn(std::uint32_t vertex) const {
        DVec3 normal = toDouble(primitive_.normals[vertex]);
        if (!normalize(normal)) return false;
        return std::any_of(means_[class_of_[vertex]].begin(), means_[class_of_[vertex]].end(), [&](DVec3 mean) {
            return normalize(mean) && angleBetween(mean, normal) * kToDegrees <= kOwnDeg;
        });
    }
    [[nodiscard]] double smoothDeg() const { return smooth_deg_; }
    [[nodiscard]] double minHardDeg() const { return min_hard_deg_; }

  private:
    void addFace(std::size_t c) {
        const auto at = [&](std::size_t k) { return toDouble(primitive_.positions[primitive_.corners[c + k % 3]]); };
        Face& face = faces_.emplace_back();
        face.normal = cross(at(1) - at(0), at(2) - at(0));
        face.area = length(face.normal);
        if (!normalize(face.normal)) face.normal = {};
        for (std::size_t k = 0; k < 3; ++k) {
            DVec3 next = at(k + 1) - at(k), previous = at(k + 2) - at(k);
            const double angle = normalize(next) && normalize(previous) ? angleBetween(next, previous) : 0;
            std::array<DVec3, 3>& mean = means_[class_of_[primitive_.corners[c + k]]];
            mean[0] = mean[0] + face.normal;
            mean[1] = mean[1] + face.area * face.normal;
            mean[2] = mean[2] + angle * face.normal;
        }
    }

    /// Measures the angles at inner edges, separately for smooth and hard edges.
    void bends(const JoinedPieces& joined, std::uint32_t piece) {
        struct Edge {
            std::array<std::uint32_t, 2> points, classes;
            std::size_t face;
        };
        std::vector<Edge> edges;
        for (std::size_t c = 0; c < 3 * faces_.size(); ++c) {
            std::uint32_t a = primitive_.corners[c], b = primitive_.corners[c / 3 * 3 + (c + 1) % 3];
            if (joined.pointOf(piece, a) > joined.pointOf(piece, b)) std::swap(a, b);
            const std::array<std::uint32_t, 2> points = {joined.pointOf(piece, a), joined.pointOf(piece, b)};
            if (points[0] != points[1]) edges.push_back({points, {class_of_[a], class_of_[b]}, c / 3});
        }
        sortStably(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.points < b.points; });
        std::vector<double> smooth;
        for (std::size_t i = 0, past = 0; i < edges.size(); i = past) {
            while (past < edges.size() && edges[past].points == edges[i].points) ++past;
            if (past - i != 2) continue;
            const double bend =
                angleBetween(faces_[edges[i].face].normal, faces_[edges[i + 1].face].normal) * kToDegrees;
            if (bend < kMinSeamDeg) continue;
            if (edges[i].classes == edges[i + 1].classes)
                smooth.push_back(bend);
            else
                min_hard_deg_ = std::min(min_hard_deg_, bend);
        }
        if (smooth.empty()) return;
        const auto place = smooth.begin() + static_cast<std::ptrdiff_t>(kSmoothPart * double(smooth.size() - 1));
        std::nth_element(smooth.begin(), place, smooth.end());
        smooth_deg_ = *place;
    }

    const ScenePrimitive& primitive_;
    std::vector<std::uint32_t> class_of_ = {};
    std::vector<Face> faces_ = {};
    std::vector<std::array<DVec3, 3>> means_ = {};
    double smooth_deg_ = 0, min_hard_deg_ = 180;
};

struct Seam {
    // `places` are the points where normals differ, and `likely` are those of them that look like a seam.
    std::set<std::uint32_t> places = {}, likely = {};
    double worst_deg = 0;
    std::vector<std::uint32_t> vertices = {};
};

class MeshSeams {
  public:
    MeshSeams(std::vector<const ScenePrimitive*> primitives, float weld_distance)
        : primitives_(std::move(primitives)), weld_distance_(weld_distance) {
        std::map<const Vec3*, std::size_t> list_of;
        for (const ScenePrimitive* primitive : primitives_) {
            const auto [entry, is_new] = list_of.try_emplace(primitive->positions.data(), lists_.size());
            if (is_new) lists_.push_back(primitive->positions.span());
            pieces_.push_back({entry->second, primitive->corners.span()});
        }
    }

    void find(std::vector<Finding>& findings) {
        const JoinedPieces joined(lists_, pieces_, weld_distance_);
        if (joined.borders().empty()) return;
        std::map<std::uint32_t, SmoothPiece> smooth;
        std::map<std::pair<std::uint32_t, std::uint32_t>, Seam> seams;
        for (const JoinedPieces::Border& border : joined.borders()) {
            for (const PieceTriangle& at : border.triangles)
                smooth.try_emplace(at.piece, *primitives_[at.piece], joined, at.piece);
            compareBorder(joined, border, smooth, seams[{border.triangles[0].piece, border.triangles[1].piece}]);
        }
        for (const auto& [pair, seam] : seams) {
            const auto least = kMinPlaceShare * static_cast<double>(seam.places.size());
            if (seam.likely.size() < kMinPlaces || static_cast<double>(seam.likely.size()) < least) continue;
            findings.push_back(findingOf(pair, seam));
        }
    }

  private:
    [[nodiscard]] std::uint32_t vertexAt(const JoinedPieces& joined, const PieceTriangle& at,
                                         std::uint32_t point) const {
        const std::span<const std::uint32_t> corners = pieces_[at.piece].corners;
        std::size_t c = 3 * std::size_t{at.triangle};
        while (joined.pointOf(at.piece, corners[c]) != point) ++c;
        return corners[c];
    }

    void compareBorder(const JoinedPieces& joined, const JoinedPieces::Border& border,
                       const std::map<std::uint32_t, SmoothPiece>& smooth, Seam& seam) const {
        const auto& [a, b] = border.triangles;
        const SmoothPiece &side_a = smooth.at(a.piece), &side_b = smooth.at(b.piece);
        const double bend = angleBetween(side_a.faceNormal(a.triangle), side_b.faceNormal(b.triangle)) * kToDegrees;
        const bool is_smooth = bend <= kMoreBend * std::min(side_a.smoothDeg(), side_b.smoothDeg()) &&
                               bend < std::min(side_a.minHardDeg(), side_b.minHardDeg());
        for (const std::uint32_t point : border.points) {
            const std::uint32_t vertex_a = vertexAt(joined, a, point), vertex_b = vertexAt(joined, b, point);
            DVec3 normal_a = toDouble(primitives_[a.piece]->normals[vertex_a]);
            DVec3 normal_b = toDouble(primitives_[b.piece]->normals[vertex_b]);
            if (!normalize(normal_a) || !normalize(normal_b)) continue;
            const double angle_deg = angleBetween(normal_a, normal_b) * kToDegrees;
            if (angle_deg <= kMinSeamDeg) continue;
            seam.places.insert(point);
            if (!is_smooth || !side_a.isOwn(vertex_a) || !side_b.isOwn(vertex_b)) continue;
            if (seam.likely.insert(point).second && seam.vertices.size() < Tally::kMaxVertices)
                seam.vertices.push_back(vertex_a);
            seam.worst_deg = std::max(seam.worst_deg, angle_deg);
        }
    }

    [[nodiscard]] Finding findingOf(const std::pair<std::uint32_t, std::uint32_t>& pair, const Seam& seam) const {
        const ScenePrimitive &first = *primitives_[pair.first], &second = *primitives_[pair.second];
        Tally tally{.count = seam.likely.size(), .total = seam.places.size()};
        tally.worst_deg = seam.worst_deg;
        tally.vertices = seam.vertices;
        Finding finding = makeFinding(
            FindingCode::normalSeam, Severity::note, tally, "positions",
            {.symptom = "an edge is visible on a smooth surface",
             .cause = "the normals of this primitive and of primitive " + std::to_string(second.primitive) +
                      " differ by up to " + decimalText(seam.worst_deg) + " degrees at " +
                      std::to_string(seam.likely.size()) +
                      " positions of their common border; the normals of each primitive are computed from its "
                      "own triangles only"});
        placeAt(first, first.place, finding);
        return finding;
    }

    std::vector<const ScenePrimitive*> primitives_;
    float weld_distance_;
    std::vector<std::span<const Vec3>> lists_ = {};
    std::vector<SurfacePiece> pieces_ = {};
};

Finding notCompared(const ScenePrimitive& first, const std::string& why) {
    Finding finding = makeFinding(
        FindingCode::fileRemark, Severity::note, Tally::all(1), "meshes",
        {.cause = "normals at the borders of the primitives of this mesh were not compared: comparing them " + why});
    placeAt(first, first.place, finding);
    finding.material_name.clear();  // the finding concerns the whole mesh
    return finding;
}

}  // namespace

std::vector<Finding> checkSeams(const Scene& scene, const CheckOptions& options) {
    std::vector<Finding> findings;
    for (std::size_t first = 0, past = 0; first < scene.primitives.size(); first = past) {
        std::vector<const ScenePrimitive*> primitives;
        // Pairs of arrays are used once, because a file may reference them any number of times.
        std::set<std::pair<const Vec3*, const std::uint32_t*>> seen;
        std::uint64_t bytes = 0;
        for (; past < scene.primitives.size() && scene.primitives[past].mesh == scene.primitives[first].mesh; ++past) {
            const ScenePrimitive& primitive = scene.primitives[past];
            if (primitive.corners.empty() || primitive.normals.empty() || primitive.is_unlit) continue;
            if (!seen.insert({primitive.positions.data(), primitive.corners.data()}).second) continue;
            primitives.push_back(&primitive);
            bytes += kBytesPerCorner * primitive.corners.size() + kBytesPerVertex * primitive.positions.size();
        }
        if (primitives.size() < 2) continue;
        if (scene.memory && !scene.memory->has(bytes)) {
            findings.push_back(notCompared(*primitives.front(), scene.memory->whyNot(bytes)));
            continue;
        }
        MeshSeams(std::move(primitives), options.weld_distance).find(findings);
    }
    return findings;
}

}  // namespace tspace
