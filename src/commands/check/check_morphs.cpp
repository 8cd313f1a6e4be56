// SPDX-License-Identifier: MIT
// Checks of morph targets: their values, and the resulting normals and tangents.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "commands/check/direction_cones.h"
#include "commands/check/findings.h"
#include "commands/check/moved_faces.h"
#include "commands/check/primitive_checks.h"
#include "commands/check/remedy.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {
namespace {

// Collects the morph targets of a primitive that share a fault into one finding.

/// A target is reported if at least this share of the rotating surface has wrong vectors. Offsets that were computed by
/// a formula, or on a finer mesh, deviate near coarse triangles.
inline constexpr double kOffShare = 0.25;

struct MorphFault {
    Tally targets = {};    ///< counts targets, not vertices; its `vertices` are those of the first faulty target
    double far_share = 0;  ///< largest share of the surface that is off by more than error_deg
    std::size_t first = 0;

    /// Adds a target that has the fault. `far_area`: area at vertices that are off by more than error_deg.
    void addTarget(std::size_t number, const Tally& vertices, double far_area, double whole_area) {
        if (targets.count++ == 0) {
            first = number;
            targets.vertices = vertices.vertices;
        }
        targets.worst_deg = std::max(targets.worst_deg, vertices.worst_deg);
        targets.surface_share = std::max(targets.surface_share, vertices.surface_share);
        if (whole_area > 0) far_share = std::max(far_share, far_area / whole_area);
    }

    /// Adds a finding if any target has the fault. `text`: its cause lacks the error angle. `vectors`: "normals" or
    /// "tangents".
    void report(PrimitiveFacts& facts, FindingCode code, Severity severity, FindingText text,
                const char* vectors) const {
        if (targets.count == 0) return;
        text.cause += std::string("; at full weight ") + vectors + " are off by up to " +
                      decimalText(targets.worst_deg) + " degrees";
        facts.add(code, severity, targets, "targets", std::move(text));
        facts.findings.back().place = facts.primitive.place + "/targets/" + std::to_string(first);
    }
};

// Checks that the offsets of morph targets are finite, and that they do not cancel the normals. A single faulty vertex
// is reported.

/// The first target that has a fault, and the number of targets that have it.
struct FaultyTargets {
    Tally vertices = {};  ///< vertices of the first faulty target
    std::size_t first = 0, count = 0;
    bool all_move = true;  ///< all faulty targets also move positions, so normals can be computed from the surface
};

class MorphValues {
  public:
    explicit MorphValues(PrimitiveFacts& facts) : facts_(facts), used_(facts.mesh.positions.size(), false) {
        for (const std::uint32_t vertex : facts.mesh.corners) used_[vertex] = true;
    }

    /// Finds targets whose offsets in one array are faulty at a used vertex, according to `is_faulty`.
    template <class Test>
    FaultyTargets find(SharedArray<Vec3> SceneMorphTarget::*array, const Test& is_faulty) const {
        FaultyTargets result;
        // Results are cached, because a file may reference the same array any number of times.
        std::map<const Vec3*, bool> known;
        const auto& targets = facts_.primitive.morph_targets;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const SharedArray<Vec3>& offsets = targets[i].*array;
            if (offsets.empty()) continue;
            const auto [entry, is_new] = known.try_emplace(offsets.data(), false);
            if (is_new) {
                const Tally tally = tallyOf(offsets, is_faulty);
                entry->second = tally.count != 0;
                if (entry->second && result.count == 0) result = {.vertices = tally, .first = i};
            }
            if (!entry->second) continue;
            ++result.count;
            result.all_move = result.all_move && !targets[i].positions.empty();
        }
        return result;
    }

    /// Reports "the offsets of morph target 2 for the normals of 1 of 525 vertices <what>; the same error occurs in 3
    /// more targets".
    void report(FindingCode code, const FaultyTargets& faulty, const char* attribute, const std::string& what) {
        if (faulty.count == 0) return;
        const std::size_t more = faulty.count - 1;
        std::string cause = "the offsets of morph target " + std::to_string(faulty.first) + " for the " + attribute +
                            " of " + countText(faulty.vertices, "vertices") + " " + what;
        if (more != 0)
            cause += "; the same error occurs in " + std::to_string(more) + " more target" + (more == 1 ? "" : "s");
        facts_.add(code, Severity::error, faulty.vertices, "vertices", {.cause = std::move(cause)});
        Finding& finding = facts_.findings.back();
        finding.place = facts_.primitive.place + "/targets/" + std::to_string(faulty.first);
        if (code == FindingCode::positionsNotFinite) return;
        setRemedy(finding, faulty.all_move ? usualRemedy(FindingCode::morphNormalsWrong)
                                           : Remedy{"Export the normals of the targets again."});
    }

  private:
    template <class Test>
    Tally tallyOf(const SharedArray<Vec3>& offsets, const Test& is_faulty) const {
        Tally tally;
        for (std::uint32_t v = 0; v < used_.size(); ++v) {
            if (!used_[v]) continue;
            ++tally.total;
            if (is_faulty(v, offsets[v])) tally.add(v, facts_.surface.vertex_areas[v]);
        }
        tally.finish(facts_.surface.area);
        return tally;
    }

    PrimitiveFacts& facts_;
    std::vector<bool> used_;
};

}  // namespace

void checkMorphValues(PrimitiveFacts& facts) {
    if (facts.primitive.morph_targets.empty()) return;
    MorphValues values(facts);
    const auto not_finite = [](std::uint32_t, const Vec3& offset) { return !isFinite(offset); };
    values.report(FindingCode::positionsNotFinite, values.find(&SceneMorphTarget::positions, not_finite), "positions",
                  "are NaN or infinite");
    if (facts.mesh.normals.empty() || facts.primitive.is_unlit) return;
    values.report(FindingCode::normalsNotFinite, values.find(&SceneMorphTarget::normals, not_finite), "normals",
                  "are NaN or infinite");
    const auto vanishes = [&](std::uint32_t v, const Vec3& offset) {
        const Vec3& base = facts.mesh.normals[v];
        return isDirection(base) && isFinite(offset) && length(toDouble(base + offset)) < kLeastLength;
    };
    values.report(FindingCode::morphNormalsWrong, values.find(&SceneMorphTarget::normals, vanishes), "normals",
                  "cancel the base normals, so shaders get NaN at full weight");
}

// Checks that base normals plus offsets are still normals of the morphed surface.

namespace {

/// A morphed normal is off if its angle to the expected normal exceeds both this fraction of the surface's rotation and
/// direction_deg. The expected normal is the base normal rotated with the surface.
constexpr double kOfTurn = 0.5;

bool addsNothing(const SharedArray<Vec3>& offsets) { return std::all_of(offsets.begin(), offsets.end(), isZero); }

class MorphNormalsChecker {
  public:
    explicit MorphNormalsChecker(PrimitiveFacts& facts)
        : facts_(facts), turns_(facts.mesh.positions, facts.mesh.normals, facts.mesh.corners) {}

    /// Compares the morphed normal with the base normal rotated with the surface. Only the change is compared, because
    /// exporters weight triangles differently, and base normals may be authored.
    void check(std::size_t number, const SceneMorphTarget& target) {
        const bool is_missing = addsNothing(target.normals);
        MorphFault& fault = is_missing ? missing_ : wrong_;
        ++fault.targets.total;
        const std::vector<VertexRotation> turns = turns_.under(target.positions.span());
        const double limit = facts_.options.direction_deg;
        std::vector<OffNormal> off;
        double turning_area = 0;
        for (std::uint32_t v = 0; v < turns.size(); ++v) {
            const Vec3& base = facts_.mesh.normals[v];
            if (!turns[v].isKnown() || !turns[v].is_certain || !isDirection(base)) continue;
            const Vec3 moved = target.normals.empty() ? base : base + target.normals[v];
            DVec3 is = toDouble(moved), should = toDouble(turns[v].apply(base));
            if (!normalize(is) || !normalize(should)) continue;
            const double error = angleBetween(is, should) * 180 / kPi;
            DVec3 was = toDouble(base);
            normalize(was);
            const double turn = std::max(angleBetween(was, should), angleBetween(was, is)) * 180 / kPi;
            if (turn > limit) turning_area += facts_.surface.vertex_areas[v];
            if (error > std::max(limit, kOfTurn * turn)) off.push_back({v, error, was, is});
        }
        if (!isMuch(tallyOf(off), turning_area)) return;
        if (!is_missing) dropPlausible(number, turns, off);
        const Tally tally = tallyOf(off);
        if (!isMuch(tally, turning_area)) return;
        double far_area = 0;
        for (const OffNormal& one : off) {
            if (one.error_deg > facts_.options.error_deg) far_area += facts_.surface.vertex_areas[one.vertex];
        }
        fault.addTarget(number, tally, far_area, facts_.surface.area);
    }

    void report() {
        const double share = facts_.options.error_share;
        missing_.report(facts_, FindingCode::morphNormalsMissing,
                        missing_.targets.surface_share >= share ? Severity::warning : Severity::note,
                        {.symptom = "shading is wrong when the mesh deforms",
                         .cause = countText(missing_.targets, "targets without normal deltas") + " rotate the surface"},
                        "normals");
        wrong_.report(
            facts_, FindingCode::morphNormalsWrong, wrong_.far_share >= share ? Severity::error : Severity::warning,
            {.symptom = "shading is wrong when the mesh deforms",
             .cause = "the normals of " + countText(wrong_.targets, "targets") + " do not rotate with the surface"},
            "normals");
    }

  private:
    /// A vertex whose normal does not rotate with the adjacent triangles.
    struct OffNormal {
        std::uint32_t vertex = 0;
        double error_deg = 0;
        DVec3 was = {}, is = {};  ///< unit normals before and after the morph
    };

    [[nodiscard]] Tally tallyOf(const std::vector<OffNormal>& off) const {
        Tally tally;
        for (const OffNormal& one : off) tally.add(one.vertex, facts_.surface.vertex_areas[one.vertex], one.error_deg);
        tally.finish(facts_.surface.area);
        return tally;
    }

    static bool isMuch(const Tally& tally, double turning_area) {
        return tally.count != 0 && tally.area >= kOffShare * turning_area;
    }

    /// Drops normals that fit the morphed surface although they do not rotate with it. There are two kinds. Exporters
    /// such as Blender recompute the normals of a target: they smooth across material borders and over whole polygons,
    /// and choose hard edges by the angles of the morphed mesh. And a normal that is tilted against its faces may be
    /// tilted in another direction after the morph: the rotation of a face normal does not determine how the face
    /// rotates about that normal.
    void dropPlausible(std::size_t number, const std::vector<VertexRotation>& turns,
                       std::vector<OffNormal>& off) const {
        std::vector<std::uint32_t> vertices;
        for (const OffNormal& one : off) vertices.push_back(one.vertex);
        const MovedFaces faces(facts_.primitive, facts_.all, number, vertices);
        const double slack = facts_.options.direction_deg * kPi / 180;
        std::size_t i = 0;
        std::erase_if(off, [&](const OffNormal& one) {
            const std::size_t at = i++;
            const VertexRotation& turn = turns[one.vertex];
            const double tilt = angleBetween(one.was, toDouble(turn.from));
            return angleBetween(one.is, toDouble(turn.to)) <= tilt + slack ||
                   faces.admit(at, one.is, turn, tilt <= slack, slack);
        });
    }

    PrimitiveFacts& facts_;
    SurfaceRotations turns_;
    MorphFault missing_ = {}, wrong_ = {};
};

}  // namespace

void checkMorphNormals(PrimitiveFacts& facts) {
    const auto& targets = facts.primitive.morph_targets;
    if (facts.mesh.normals.empty() || targets.empty() || facts.primitive.is_unlit) return;
    MorphNormalsChecker checker(facts);
    // Pairs of arrays are checked once, because a file may reference them any number of times.
    std::set<std::array<const Vec3*, 2>> seen;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (targets[i].positions.empty()) continue;  // targets that change only normals are intentional
        if (seen.insert({targets[i].positions.data(), targets[i].normals.data()}).second) checker.check(i, targets[i]);
    }
    checker.report();
}

namespace {

struct MorphedMesh {
    OwnedMesh own = {};  ///< arrays that a target changes
    TangentView view = {};
};

std::vector<Vec3> moved(std::span<const Vec3> base, const SharedArray<Vec3>& deltas) {
    std::vector<Vec3> result(base.begin(), base.end());
    for (std::size_t v = 0; v < deltas.size(); ++v) result[v] = result[v] + deltas[v];
    return result;
}

void applyTarget(const TangentView& base, const SceneMorphTarget& target, MorphedMesh& morphed) {
    OwnedMesh& own = morphed.own;
    own.positions = moved(base.positions, target.positions);
    own.normals = moved(base.normals, target.normals);
    own.tangents.assign(base.tangents.begin(), base.tangents.end());
    for (std::size_t v = 0; v < target.tangents.size(); ++v) {
        Vec4& tangent = own.tangents[v];
        const Vec3 sum = xyz(tangent) + target.tangents[v];
        tangent = {sum.x, sum.y, sum.z, tangent.w};
    }
    morphed.view = tangentView(own);
    morphed.view.uvs = base.uvs;
    morphed.view.corners = base.corners;
}

/// Returns the error of each vertex's tangent in degrees: the larger of its direction error in the surface
/// (`distances`) and its tilt out of the surface.
std::vector<float> frameErrors(const TangentView& mesh, std::vector<float> distances) {
    std::vector<float> errors = std::move(distances);
    for (std::size_t v = 0; v < errors.size(); ++v) {
        DVec3 normal = toDouble(mesh.normals[v]), tangent = toDouble(xyz(mesh.tangents[v]));
        if (!normalize(normal)) continue;
        const bool has_tangent = normalize(tangent);
        const double tilt = has_tangent ? std::fabs(90 - angleBetween(normal, tangent) * 180 / kPi) : 90;
        errors[v] = std::max(errors[v], static_cast<float>(tilt));
    }
    return errors;
}

double turnDegrees(const Vec4& from, const Vec4& to) {
    DVec3 a = toDouble(xyz(from)), b = toDouble(xyz(to));
    return normalize(a) && normalize(b) ? angleBetween(a, b) * 180 / kPi : 0;
}

/// Returns the vertices whose base frame is known to be good. A frame that is wrong on the base is already reported. If
/// no triangle determines the tangent, its direction is arbitrary, and targets cannot be compared with it.
std::vector<bool> goodVertices(const PrimitiveFacts& facts) {
    const double limit = facts.options.direction_deg;
    const std::vector<float> distances = directionDistances(facts.mesh, facts.surface, limit);
    const std::vector<float> errors = frameErrors(facts.mesh, distances);
    std::vector<bool> good(errors.size());
    for (std::size_t v = 0; v < good.size(); ++v) good[v] = distances[v] != kUnknownDirection && errors[v] <= limit;
    return good;
}

/// Returns whether the triangle is degenerate: its area relative to its longest edge is within rounding.
bool isThin(const TangentView& mesh, std::size_t face, float area) {
    constexpr double kThin = 1e-6;
    const auto square = [&](std::size_t k) {
        const auto position = [&](std::size_t i) { return toDouble(mesh.positions[mesh.corners[3 * face + i % 3]]); };
        const DVec3 edge = position(k + 1) - position(k);
        return dot(edge, edge);
    };
    return area <= kThin * std::max({square(0), square(1), square(2)});
}

/// Excludes vertices whose tangents before and after the morph cannot be compared, and vertices equal to them: those of
/// triangles that become degenerate, stop being degenerate, or are flipped, which makes them degenerate in between.
/// Vertices are grouped on the base mesh. So a group still contains a triangle that becomes degenerate, with an
/// arbitrary direction, but not a triangle that was degenerate on the base. Triangles that are degenerate before and
/// after have no influence.
void excludeCollapsed(const TangentView& mesh, const Surface& base, const TangentView& morphed_mesh,
                      const Surface& morphed, const EqualVertices& equal, std::vector<bool>& good) {
    constexpr float kCollapsed = 1e-4f;            // ratio of the areas; corresponds to 1 percent along each side
    constexpr double kFlipped = -0.8660254037844;  // cosine of 150 degrees, the limit of SurfaceRotations (surface.cpp)
    std::vector<bool> is_out(equal.class_count, false);
    for (std::size_t f = 0; f < base.faces.size(); ++f) {
        const SurfaceFrame &before = base.faces[f], &after = morphed.faces[f];
        if (before.tangent == Vec3{} && after.tangent == Vec3{}) continue;
        if (after.area >= kCollapsed * before.area && !isThin(mesh, f, before.area) &&
            !isThin(morphed_mesh, f, after.area) && dot(toDouble(before.normal), toDouble(after.normal)) > kFlipped)
            continue;
        for (std::size_t k = 0; k < 3; ++k) is_out[equal.class_of[mesh.corners[3 * f + k]]] = true;
    }
    for (std::size_t v = 0; v < good.size(); ++v) good[v] = good[v] && !is_out[equal.class_of[v]];
}

class MorphChecker {
  public:
    explicit MorphChecker(PrimitiveFacts& facts)
        : facts_(facts), good_on_base_(goodVertices(facts)), equal_(findEqualVertices(facts.mesh, true)) {}

    void check(std::size_t number, const SceneMorphTarget& target) {
        const bool missing = target.tangents.empty();
        if (missing && target.positions.empty() && target.normals.empty()) return;
        MorphFault& fault = missing ? missing_ : wrong_;
        ++fault.targets.total;
        MorphedMesh morphed;
        applyTarget(facts_.mesh, target, morphed);
        const Surface surface = describeSurface(morphed.view);
        const double limit = facts_.options.direction_deg;
        const std::vector<float> errors = frameErrors(morphed.view, directionDistances(morphed.view, surface, limit));
        std::vector<bool> good = good_on_base_;
        excludeCollapsed(facts_.mesh, facts_.surface, morphed.view, surface, equal_, good);
        Tally tally;
        double far_area = 0, turning_area = 0;
        std::vector<std::uint32_t> off;
        for (std::uint32_t v = 0; v < errors.size(); ++v) {
            if (!good[v]) continue;
            const bool is_off = errors[v] > limit;
            const double area = facts_.surface.vertex_areas[v];
            if (is_off || turnDegrees(facts_.mesh.tangents[v], morphed.own.tangents[v]) > limit) turning_area += area;
            if (!is_off) continue;
            tally.add(v, facts_.surface.vertex_areas[v], errors[v]);
            off.push_back(v);
            if (errors[v] > facts_.options.error_deg) far_area += area;
        }
        if (tally.count == 0) return;
        if (!missing && far_area == 0 && tally.area < kOffShare * turning_area) return;
        if (!missing) {
            for (const std::uint32_t v : off) facts_.fault(v, FindingCode::morphTangentsWrong);
        }
        tally.finish(facts_.surface.area);
        fault.addTarget(number, tally, far_area, facts_.surface.area);
    }

    void report() {
        const double share = facts_.options.error_share;
        missing_.report(
            facts_, FindingCode::morphTangentsMissing,
            missing_.targets.surface_share >= share ? Severity::warning : Severity::note,
            {.symptom = "the relief is lit incorrectly when the mesh deforms",
             .cause = countText(missing_.targets, "targets") + " without tangent deltas rotate the surface"},
            "tangents");
        wrong_.report(
            facts_, FindingCode::morphTangentsWrong, wrong_.far_share >= share ? Severity::error : Severity::warning,
            {.symptom = "the relief is lit incorrectly when the mesh deforms",
             .cause = "the tangents of " + countText(wrong_.targets, "targets") + " do not fit the morphed surface"},
            "tangents");
    }

  private:
    PrimitiveFacts& facts_;
    std::vector<bool> good_on_base_;
    EqualVertices equal_;
    MorphFault missing_ = {}, wrong_ = {};
};

}  // namespace

void checkMorphTargets(PrimitiveFacts& facts) {
    const bool is_needed = !facts.primitive.uses.empty();
    if (!is_needed || facts.mesh.tangents.empty() || facts.mesh.normals.empty() || facts.mesh.uvs.empty() ||
        facts.primitive.morph_targets.empty()) {
        return;
    }
    MorphChecker checker(facts);
    // Combinations of arrays are checked once, because a file may reference them any number of times.
    std::set<std::array<const Vec3*, 3>> seen;
    for (std::size_t i = 0; i < facts.primitive.morph_targets.size(); ++i) {
        const SceneMorphTarget& target = facts.primitive.morph_targets[i];
        if (seen.insert({target.positions.data(), target.normals.data(), target.tangents.data()}).second)
            checker.check(i, target);
    }
    checker.report();
}

}  // namespace tspace
