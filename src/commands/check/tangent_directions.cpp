// SPDX-License-Identifier: MIT
// Directions against the UVs, and the usual cause: one mean over a seam.
#include <algorithm>

#include "commands/check/frame_health.h"
#include "commands/check/vertex_patches.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {

namespace {

/// A mean lies inside the cone of its terms, but for rounding and quantised storage.
constexpr double kInsideDeg = 2;
/// Tangents that somebody computed once and gave to several vertices.
constexpr double kSameDeg = 1;
/// Most vertices at one point that a vertex is compared with. Poles have more, and one is enough.
constexpr std::size_t kMostCompared = 64;
/// Share of the surface from which all directions count as wrong.
constexpr double kNothingRight = 0.95;
constexpr double kMostly = 0.5;

enum class Cause { unknown, uvSeam, mirroredSeam };

/// Finds out why tangents are outside their cones: whether they are the mean of all triangles at the point, of which
/// some lie on the other side of a seam.
class SeamFinder {
  public:
    SeamFinder(const TangentView& mesh, const Surface& surface, std::span<const std::uint32_t> far)
        : mesh_(mesh), orientations_(vertexOrientations(mesh, surface)), points_(findEqualVertices(mesh, false)) {
        std::vector<bool> wanted(points_.class_count, false);
        for (const std::uint32_t vertex : far) wanted[points_.class_of[vertex]] = true;
        std::vector<std::uint32_t> classes(mesh.positions.size(), kNoClass);
        for (std::uint32_t v = 0; v < classes.size(); ++v) {
            if (!wanted[points_.class_of[v]]) continue;
            classes[v] = points_.class_of[v];
            members_.push_back(v);
        }
        cones_ = conesOfClasses(mesh, surface, classes, points_.class_count);
        sortStably(members_.begin(), members_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return points_.class_of[a] < points_.class_of[b]; });
    }

    [[nodiscard]] Cause causeOf(std::uint32_t vertex) const {
        const std::uint32_t point = points_.class_of[vertex];
        bool found = false;
        const double angle = planeAngle(mesh_.normals[vertex], xyz(mesh_.tangents[vertex]), found);
        if (!found || cones_[point].distanceTo(angle) * 180 / kPi > kInsideDeg) return Cause::unknown;
        const auto first = std::lower_bound(
            members_.begin(), members_.end(), point,
            [&](std::uint32_t member, std::uint32_t wanted) { return points_.class_of[member] < wanted; });
        std::size_t compared = 0;
        for (auto other = first; other != members_.end() && points_.class_of[*other] == point; ++other) {
            if (*other == vertex || orientations_[*other] == 0) continue;
            if (++compared > kMostCompared) break;
            if (!isSame(vertex, *other)) continue;
            if (orientations_[vertex] != orientations_[*other]) return Cause::mirroredSeam;
            if (mesh_.uvs[vertex] != mesh_.uvs[*other]) return Cause::uvSeam;
        }
        return Cause::unknown;
    }

    /// Mirrored and other triangles use the vertex itself.
    [[nodiscard]] bool isShared(std::uint32_t vertex) const { return orientations_[vertex] == 3; }

  private:
    [[nodiscard]] bool isSame(std::uint32_t a, std::uint32_t b) const {
        DVec3 ta = toDouble(xyz(mesh_.tangents[a])), tb = toDouble(xyz(mesh_.tangents[b]));
        return normalize(ta) && normalize(tb) && angleBetween(ta, tb) * 180 / kPi < kSameDeg;
    }

    const TangentView& mesh_;
    std::vector<std::uint8_t> orientations_;
    EqualVertices points_;
    std::vector<std::uint32_t> members_ = {};
    std::vector<DirectionCone> cones_ = {};
};

/// Where nearly all directions of a patch are wrong, the remaining ones count as wrong too: cones are wide where triangles
/// fold, and nearly any direction lies inside. Mending some without the others would leave seams. In a patch where most are
/// right, the remaining ones count as right.
void findUndecided(const TangentView& mesh, const Surface& surface, std::span<const float> directions,
                   std::span<const std::uint32_t> far, FrameHealth& health) {
    const std::size_t count = mesh.positions.size();
    VertexPatches patches(count, mesh.corners, [](const std::uint32_t*) { return true; });
    std::vector<double> judged(count, 0.0), wrong(count, 0.0);
    double all_judged = 0, all_wrong = 0;
    for (std::uint32_t v = 0; v < count; ++v) {
        if (directions[v] == kUnknownDirection) continue;
        judged[patches.of(v)] += surface.known_areas[v];
        all_judged += surface.known_areas[v];
    }
    for (const std::uint32_t v : far) {
        wrong[patches.of(v)] += surface.known_areas[v];
        all_wrong += surface.known_areas[v];
    }
    const double share = all_wrong >= kNothingRight * all_judged ? kMostly : kNothingRight;
    for (std::uint32_t v = 0; v < count; ++v) {
        if (directions[v] == kUnknownDirection || health.isSettled(v)) continue;
        const std::uint32_t patch = patches.of(v);
        // Where most are wrong, tangents outside of their cones by less than the tolerance count as wrong too.
        const double least = directions[v] > kInsideDeg ? kMostly : share;
        if (wrong[patch] > 0 && wrong[patch] >= least * judged[patch])
            health.fault(v, FindingCode::directionsWrong, count);
    }
}

}  // namespace

void examineDirections(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                       std::span<const float> directions, FrameHealth& health) {
    std::vector<std::uint32_t> far;
    std::uint64_t judged = 0;
    for (std::uint32_t v = 0; v < directions.size(); ++v) {
        judged += directions[v] != kUnknownDirection;
        if (directions[v] > options.direction_deg && !health.isSettled(v)) far.push_back(v);
    }
    health.directions_wrong.total = health.uv_seams.total = judged;
    if (far.empty()) return;
    const SeamFinder seams(mesh, surface, far);
    for (const std::uint32_t v : far) {
        const double area = surface.known_areas[v];
        if (directions[v] > options.error_deg) health.far_directions += area;
        // Vertices that triangles of both orientations use were counted with the signs.
        if (seams.isShared(v)) continue;
        const Cause cause = seams.causeOf(v);
        Tally& tally = cause == Cause::mirroredSeam ? health.mirrored_seams
                       : cause == Cause::uvSeam     ? health.uv_seams
                                                    : health.directions_wrong;
        tally.add(v, area, directions[v]);
        health.fault(v,
                     cause == Cause::mirroredSeam ? FindingCode::mirroredSeamAveraged
                     : cause == Cause::uvSeam     ? FindingCode::uvSeamAveraged
                                                  : FindingCode::directionsWrong,
                     mesh.positions.size());
    }
    findUndecided(mesh, surface, directions, far, health);
}

}  // namespace tspace
