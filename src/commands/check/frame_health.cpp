// SPDX-License-Identifier: MIT
// Examines tangents in these steps: values, signs, directions, and vertices that differ only in their tangents.
// Tangents that generate itself would compute are not reported.
#include "commands/check/frame_health.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/sort.h"
#include "core/base/unique_index.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "model/io/file_error.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

// Finds connected vertices.

/// Sets of vertices that triangles connect by index. Near-linear time.
class VertexPatches {
  public:
    /// `connects(v)`: returns whether the triangle with the vertices v[0], v[1] and v[2] connects them.
    template <class Connects>
    VertexPatches(std::size_t vertex_count, std::span<const std::uint32_t> corners, const Connects& connects)
        : parents_(vertex_count) {
        std::iota(parents_.begin(), parents_.end(), 0u);
        for (const std::uint32_t* v = corners.data(); v != corners.data() + corners.size(); v += 3) {
            if (!connects(v)) continue;
            joinSets(parents_.data(), v[0], v[1]);
            joinSets(parents_.data(), v[0], v[2]);
        }
    }

    /// Returns the lowest vertex index in the patch of a vertex.
    std::uint32_t of(std::uint32_t vertex) { return rootOf(parents_.data(), vertex); }

  private:
    std::vector<std::uint32_t> parents_;
};

// Requirements that do not depend on UVs: tangents are finite, have unit length, and lie in the plane of the surface.
// Signs are +1 or -1, and equal at all corners of a triangle.

/// Tilt out of the tangent plane, in degrees, above which a tangent is parallel to N.
constexpr double kParallel = 90 - kParallelDeg;
/// Tilt in degrees above which even a single vertex is reported.
constexpr double kNoFrame = 89;

void examineMixedSigns(const TangentView& mesh, const Surface& surface, FrameHealth& health) {
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        // A triangle without UV area shows a single texel, and no sign is correct: MikkTSpace itself mixes signs there.
        if (!mesh.uvs.empty() && surface.faces[f].orientation == 0) continue;
        const std::uint32_t* corner = mesh.corners.data() + 3 * f;
        if (!mesh.normals.empty() && !(facesNormal(surface.faces[f], mesh.normals[corner[0]]) &&
                                       facesNormal(surface.faces[f], mesh.normals[corner[1]]) &&
                                       facesNormal(surface.faces[f], mesh.normals[corner[2]]))) {
            continue;
        }
        ++health.signs_mixed.total;
        if (health.isSettled(corner[0]) && health.isSettled(corner[1]) && health.isSettled(corner[2])) continue;
        const bool positive = mesh.tangents[corner[0]].w > 0;
        if ((mesh.tangents[corner[1]].w > 0) != positive || (mesh.tangents[corner[2]].w > 0) != positive) {
            health.signs_mixed.add(corner[0], surface.faces[f].area);
            for (std::size_t k = 0; k < 3; ++k) health.fault(corner[k], FindingCode::signsMixed, mesh.positions.size());
        }
    }
}

void examineValues(const TangentView& mesh, const Surface& surface, const CheckOptions& options, FrameHealth& health) {
    // Unused vertices are not rendered, but the format forbids invalid values in them too.
    std::vector<bool> used(mesh.positions.size(), false);
    // If no triangle at a vertex has UV area, the texture shows a single texel, so a tilt has no visible effect; but a
    // valid frame is required.
    std::vector<bool> knows_direction(mesh.positions.size(), false);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        used[mesh.corners[c]] = true;
        if (surface.faces[c / 3].orientation != 0) knows_direction[mesh.corners[c]] = true;
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        const Vec4& stored = mesh.tangents[v];
        const double area = surface.vertex_areas[v];
        const auto fault = [&](FindingCode code) { health.fault(v, code, mesh.positions.size()); };
        DVec3 tangent = toDouble(xyz(stored));
        for (Tally* tally : {&health.not_finite, &health.not_unit, &health.sign_not_one}) ++tally->total;
        if (!isFinite(xyz(stored)) || !std::isfinite(stored.w)) {
            health.not_finite.add(v, area);
            health.has_not_finite = health.has_not_finite || used[v];
            fault(FindingCode::tangentsNotFinite);
            continue;
        }
        if (std::fabs(stored.w) != 1) {  // exact in every format that glTF allows
            health.sign_not_one.add(v, area);
            fault(FindingCode::signsNotOne);
            health.sign_vanishes = health.sign_vanishes || (used[v] && std::fabs(stored.w) < 0.5f);
        }
        const double size = length(tangent), off = std::fabs(size - 1);
        if (off > options.unit_tolerance) {
            health.not_unit.add(v, area);
            fault(FindingCode::tangentsNotUnit);
        }
        if (!used[v]) continue;
        if (off > kFarFromUnit) health.far_from_unit += area;
        health.has_zero = health.has_zero || size < kLeastLength;
        DVec3 normal = mesh.normals.empty() ? DVec3{} : toDouble(mesh.normals[v]);
        if (!normalize(tangent) || !normalize(normal)) continue;
        ++health.not_orthogonal.total;
        ++health.parallel.total;
        const double tilt = std::fabs(90 - angleBetween(normal, tangent) * 180 / kPi);
        const double limit = mesh.uvs.empty() || knows_direction[v] ? options.orthogonal_deg : kParallel;
        if (!(tilt > limit) || health.isSettled(v)) continue;
        (tilt > kParallel ? health.parallel : health.not_orthogonal).add(v, area, tilt);
        fault(FindingCode::tangentsNotOrthogonal);
        if (tilt <= kParallel) continue;
        health.has_no_frame = health.has_no_frame || tilt > kNoFrame;
        health.addFaults(v, kParallelTangent, mesh.positions.size());
    }
    examineMixedSigns(mesh, surface, health);
}

// Compares signs with the orientation of the UVs.

/// If wrong signs cover a larger share of the surface, the convention is wrong rather than single signs.
constexpr double kEverySign = 0.95;

/// Area of the triangles around each vertex, summed separately for each sign that their UVs require.
struct SignAreas {
    std::vector<float> plus, minus;
};

SignAreas sumAreas(const TangentView& mesh, const Surface& surface, const Convention& convention) {
    const float factor = signFactor(convention);
    SignAreas areas{std::vector<float>(mesh.positions.size(), 0.0f), std::vector<float>(mesh.positions.size(), 0.0f)};
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        const SurfaceFrame& face = surface.faces[c / 3];
        if (face.orientation == 0) continue;
        const std::uint32_t vertex = mesh.corners[c];
        if (!facesNormal(face, mesh.normals[vertex])) continue;
        (static_cast<float>(face.orientation) * factor > 0 ? areas.plus : areas.minus)[vertex] += face.area / 3;
    }
    return areas;
}

/// Sets the bit kUndecidedSign at vertices whose signs are probably inverted. Called if nearly all signs are inverted.
/// A sign counts as correct if all triangles at the vertex confirm it, or if correct signs cover more of its patch than
/// inverted ones. Otherwise it is probably inverted: a folded quad, for example, has triangles of both orientations,
/// but only one sign.
void findUndecided(const TangentView& mesh, const SignAreas& areas, FrameHealth& health) {
    // Only triangles with equal signs at all corners connect vertices.
    VertexPatches patches(mesh.positions.size(), mesh.corners, [&](const std::uint32_t* v) {
        const bool positive = mesh.tangents[v[0]].w > 0;
        return (mesh.tangents[v[1]].w > 0) == positive && (mesh.tangents[v[2]].w > 0) == positive;
    });
    std::vector<float> right(mesh.positions.size(), 0.0f), wrong(mesh.positions.size(), 0.0f);
    for (std::uint32_t v = 0; v < right.size(); ++v) {
        const bool is_positive = mesh.tangents[v].w > 0;
        right[patches.of(v)] += is_positive ? areas.plus[v] : areas.minus[v];
        wrong[patches.of(v)] += is_positive ? areas.minus[v] : areas.plus[v];
    }
    for (const std::uint32_t vertex : mesh.corners) {
        const float fits = mesh.tangents[vertex].w > 0 ? areas.plus[vertex] : areas.minus[vertex];
        const float other = mesh.tangents[vertex].w > 0 ? areas.minus[vertex] : areas.plus[vertex];
        if (fits > 0 && other == 0) continue;  // all triangles at the vertex confirm its sign
        const std::uint32_t patch = patches.of(vertex);
        if (wrong[patch] >= right[patch]) health.addFaults(vertex, kUndecidedSign, right.size());
    }
}

void examineSigns(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                  std::span<const float> directions, FrameHealth& health) {
    const SignAreas areas = sumAreas(mesh, surface, options.convention);
    double judged = 0, wrong = 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const float plus = areas.plus[v], minus = areas.minus[v];
        const float sign = mesh.tangents[v].w;
        if (plus == 0 && minus == 0) continue;
        ++health.mirrored_seams.total;
        const std::size_t count = mesh.positions.size();
        if (plus > 0 && minus > 0) {
            if (health.isSettled(v)) continue;
            health.mirrored_seams.add(v, std::min(plus, minus));
            health.fault(v, FindingCode::mirroredSeamAveraged, count);
            continue;
        }
        // A tangent far from the direction of these UVs follows other UVs, whose orientation is unknown.
        if (!std::isfinite(sign) || sign == 0 || directions[v] > options.error_deg) continue;
        ++health.signs_wrong.total;
        judged += plus + minus;
        if ((sign > 0) == (plus > 0)) continue;
        wrong += plus + minus;
        if (health.isSettled(v) && health.settled_sign > 0) continue;
        health.signs_wrong.add(v, plus + minus);
        health.fault(v, FindingCode::signsWrong, count);
    }
    health.wrong_sign_share = judged > 0 ? wrong / judged : 0;
    health.all_signs_wrong = wrong > 0 && wrong >= kEverySign * judged;
    if (health.all_signs_wrong) findUndecided(mesh, areas, health);
}

// Compares directions with the UVs, and detects the most common cause of wrong ones: averaging across a seam.

/// Tolerance in degrees. A mean lies inside the cone of its terms, except for rounding and quantized storage.
constexpr double kInsideDeg = 2;
/// Maximum angle in degrees between tangents that are copies of one result.
constexpr double kSameDeg = 1;
/// Maximum number of vertices at one point that a vertex is compared with. Poles have more, but one match is
/// sufficient.
constexpr std::size_t kMaxCompared = 64;
/// If this share of a patch has wrong directions, all its directions are treated as wrong. kMajority is sufficient if
/// kNothingRight of the whole surface is wrong.
constexpr double kNothingRight = 0.95;
constexpr double kMajority = 0.5;

enum class Cause { unknown, uvSeam, mirroredSeam };

/// Finds the cause of tangents outside their cones. The most common cause is a mean over all triangles at the point,
/// including those on the other side of a seam.
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
            if (++compared > kMaxCompared) break;
            if (!isSame(vertex, *other)) continue;
            if (orientations_[vertex] != orientations_[*other]) return Cause::mirroredSeam;
            if (mesh_.uvs[vertex] != mesh_.uvs[*other]) return Cause::uvSeam;
        }
        return Cause::unknown;
    }

    /// Returns whether both mirrored and unmirrored triangles use the vertex.
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

/// Reports the remaining directions of a patch as wrong too if nearly all judged ones are: cones are wide where
/// triangles fold, so nearly any direction lies inside. Fixing only some of them would leave seams. If most directions
/// of a patch are correct, the remaining ones are treated as correct.
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
    const double share = all_wrong >= kNothingRight * all_judged ? kMajority : kNothingRight;
    for (std::uint32_t v = 0; v < count; ++v) {
        if (directions[v] == kUnknownDirection || health.isSettled(v)) continue;
        const std::uint32_t patch = patches.of(v);
        // A tangent that is outside its cone, but within the tolerance, is treated as wrong if half of its patch is.
        const double least = directions[v] > kInsideDeg ? kMajority : share;
        if (wrong[patch] > 0 && wrong[patch] >= least * judged[patch])
            health.fault(v, FindingCode::directionsWrong, count);
    }
}

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
        // Vertices of triangles with both orientations are already counted in mirrored_seams.
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

// Finds vertices whose tangents equal those that `generate` would compute. The checks have rules of their own, but
// bakers and renderers expect the tangents of the reference, so these vertices are not reported.

/// Tolerance in degrees; covers storage in 8 bits and welding of equal tangents.
constexpr double kSettledDeg = 1;

/// Computes one tangent per corner, sanitized as `generate` does it.
std::vector<Vec4> expectedTangents(const TangentView& mesh, const TangentOptions& options) {
    const MeshView view = mesh.triangles();
    std::vector<Vec4> tangents(mesh.corners.size());
    valueOrThrow(generateTangents(view, options, {.tangents = tangents}));
    valueOrThrow(sanitizeTangents(view, {}, std::span(tangents)));
    return tangents;
}

bool isSame(const Vec4& stored, const Vec4& expected, float factor) {
    if (!isFinite(xyz(stored)) || (stored.w * factor > 0) != (expected.w > 0)) return false;
    return angleBetween(toDouble(xyz(stored)), toDouble(xyz(expected))) * 180 / kPi <= kSettledDeg;
}

/// Sets FrameHealth::settled for vertices whose stored tangent the method computes at all corners in triangles with UV
/// area.
void settleBy(const TangentOptions& how, const TangentView& mesh, const Surface& surface, FrameHealth& health) {
    const std::vector<Vec4> expected = expectedTangents(mesh, how);
    std::vector<bool> judged(mesh.positions.size(), false), differs(mesh.positions.size(), false);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        if (surface.faces[c / 3].orientation == 0) continue;
        const std::uint32_t v = mesh.corners[c];
        judged[v] = true;
        if (!isSame(mesh.tangents[v], expected[c], health.settled_sign)) differs[v] = true;
    }
    for (std::size_t v = 0; v < differs.size(); ++v) {
        if (judged[v] && !differs[v]) health.settled[v] = true;
    }
}

/// Sets FrameHealth::settled for vertices whose tangents equal those that `generate` would compute. Returns whether any
/// of them had a fault.
bool settleVertices(const TangentView& mesh, const Surface& surface, const CheckOptions& options, FrameHealth& health) {
    const bool only_signs = health.all_signs_wrong && health.mirrored_seams.count == 0;
    const std::uint64_t doubtful = health.not_orthogonal.count + health.parallel.count + health.signs_mixed.count +
                                   health.mirrored_seams.count + health.uv_seams.count + health.directions_wrong.count +
                                   health.frames_differ.count + (only_signs ? 0 : health.signs_wrong.count);
    if (doubtful == 0) return false;
    // If nearly all signs are inverted, this is reported once, and the rest is compared with flipped signs.
    health.settled_sign = health.all_signs_wrong ? -1.0f : 1.0f;
    health.settled.assign(mesh.positions.size(), false);
    TangentOptions how{.convention = options.convention};
    settleBy(how, mesh, surface, health);
    // Tangents of Method::best may lie slightly outside the cone of the adjacent triangles.
    how.method = Method::best;
    for (how.refine = 0; how.refine <= 2 && health.directions_wrong.count != 0; ++how.refine)
        settleBy(how, mesh, surface, health);
    for (std::size_t v = 0; v < health.faults.size(); ++v) {
        if (health.settled[v] && health.faults[v] != 0) return true;
    }
    return false;
}

// Finds vertices that differ only in their tangents. Some must differ: MikkTSpace separates triangles that are not
// connected in a fan, or whose orientations differ. So its result decides which tangents should be equal.

bool areFar(const Vec4& a, const Vec4& b, double tolerance_deg) {
    return (a.w > 0) != (b.w > 0) || angleBetween(toDouble(xyz(a)), toDouble(xyz(b))) * 180 / kPi > tolerance_deg;
}

bool isUsable(const Vec4& tangent) { return isFinite(xyz(tangent)) && tangent.w == tangent.w; }

bool doAnyDiffer(const TangentView& mesh, const EqualVertices& equal, double tolerance_deg) {
    std::vector<std::uint32_t> first(equal.class_count, kNoClass);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (!isUsable(mesh.tangents[v])) continue;
        std::uint32_t& other = first[equal.class_of[v]];
        if (other == kNoClass) {
            other = v;
        } else if (areFar(mesh.tangents[other], mesh.tangents[v], tolerance_deg)) {
            return true;
        }
    }
    return false;
}

/// Returns whether the tangent has nearly unit length. If the directions of triangles cancel out, the length is small,
/// and the tangent that a tool stores depends on more than the vertex.
bool isSound(const Vec4& tangent) {
    const float size = length(xyz(tangent));
    return size > 0.9f && size < 1.1f;
}

std::vector<Vec4> referenceTangents(const TangentView& mesh) {
    const MeshView view = mesh.triangles();
    std::vector<Vec4> tangents(mesh.corners.size());
    const TangentOptions options{.convention = conventions::opengl, .pairing = Pairing::corrected};
    valueOrThrow(generateTangents(view, options, {.tangents = tangents}));
    return tangents;
}

void examineSplits(const TangentView& mesh, const Surface& surface, const CheckOptions& options, FrameHealth& health) {
    const EqualVertices equal = findEqualVertices(mesh, true);
    health.frames_differ.total = mesh.positions.size();
    if (equal.class_count == mesh.positions.size() || !doAnyDiffer(mesh, equal, options.split_deg)) return;
    const std::vector<Vec4> reference = referenceTangents(mesh);
    // Corners with equal class and equal reference tangent belong to one group.
    UniqueIndex<std::array<std::uint32_t, 5>> groups(mesh.positions.size());
    std::vector<std::uint32_t> first_vertex;
    std::vector<bool> counted(mesh.positions.size(), false);
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const std::uint32_t vertex = mesh.corners[c];
        if (surface.faces[c / 3].orientation == 0 || !isUsable(mesh.tangents[vertex])) continue;
        const Vec4& t = reference[c];
        if (!isSound(t)) continue;
        const std::uint32_t group =
            groups.indexOf({equal.class_of[vertex], weldBits(t.x), weldBits(t.y), weldBits(t.z), weldBits(t.w)});
        if (group == first_vertex.size()) first_vertex.push_back(vertex);
        const Vec4& first = mesh.tangents[first_vertex[group]];
        if (counted[vertex] || health.isSettled(vertex) || !areFar(first, mesh.tangents[vertex], options.split_deg))
            continue;
        counted[vertex] = true;
        health.fault(vertex, FindingCode::splitFramesDiffer, mesh.positions.size());
        const double angle = angleBetween(toDouble(xyz(first)), toDouble(xyz(mesh.tangents[vertex]))) * 180 / kPi;
        health.frames_differ.add(vertex, surface.known_areas[vertex], angle);
    }
}

FrameHealth examineOnce(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                        FrameHealth&& known) {
    FrameHealth health;
    health.settled = std::move(known.settled);
    health.settled_sign = known.settled_sign;
    examineValues(mesh, surface, options, health);
    if (mesh.normals.empty() || mesh.uvs.empty()) return health;
    const std::vector<float> directions = directionDistances(mesh, surface, options.direction_deg);
    examineSigns(mesh, surface, options, directions, health);
    examineDirections(mesh, surface, options, directions, health);
    examineSplits(mesh, surface, options, health);
    return health;
}

}  // namespace

FrameHealth examineTangents(const TangentView& mesh, const Surface& surface, const CheckOptions& options) {
    FrameHealth health = examineOnce(mesh, surface, options, {});
    if (!mesh.normals.empty() && !mesh.uvs.empty() && settleVertices(mesh, surface, options, health))
        health = examineOnce(mesh, surface, options, std::move(health));
    for (Tally* tally : {&health.not_finite, &health.not_unit, &health.not_orthogonal, &health.parallel,
                         &health.sign_not_one, &health.signs_mixed, &health.signs_wrong, &health.mirrored_seams,
                         &health.uv_seams, &health.directions_wrong, &health.frames_differ}) {
        tally->finish(surface.area);
    }
    if (surface.area > 0) {
        health.far_from_unit /= surface.area;
        health.far_directions /= surface.area;
    }
    health.parallel_apart = health.has_no_frame && health.parallel.surface_share < options.error_share;
    if (health.parallel_apart) {
        for (std::uint32_t& bits : health.faults) {
            if ((bits & kParallelTangent) == 0) bits &= ~faultBit(FindingCode::tangentsNotOrthogonal);
        }
    }
    return health;
}

FrameHealth examineTangents(const TangentView& mesh, const CheckOptions& options) {
    return examineTangents(mesh, describeSurface(mesh), options);
}

}  // namespace tspace
