// SPDX-License-Identifier: MIT
// Morph targets: whether base plus delta is still a frame of the morphed surface.
#include <algorithm>
#include <array>
#include <set>

#include "commands/check/direction_cones.h"
#include "commands/check/findings.h"
#include "commands/check/morph_faults.h"
#include "commands/check/primitive_checks.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {

namespace {

struct MorphedMesh {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec4> tangents = {};
    TangentView view = {};
};

std::vector<Vec3> moved(std::span<const Vec3> base, const SharedArray<Vec3>& deltas) {
    std::vector<Vec3> result(base.begin(), base.end());
    for (std::size_t v = 0; v < deltas.size(); ++v) result[v] = result[v] + deltas[v];
    return result;
}

void applyTarget(const TangentView& base, const SceneMorphTarget& target, MorphedMesh& morphed) {
    morphed.positions = moved(base.positions, target.positions);
    morphed.normals = moved(base.normals, target.normals);
    morphed.tangents.assign(base.tangents.begin(), base.tangents.end());
    for (std::size_t v = 0; v < target.tangents.size(); ++v) {
        Vec4& tangent = morphed.tangents[v];
        const Vec3 sum = xyz(tangent) + target.tangents[v];
        tangent = {sum.x, sum.y, sum.z, tangent.w};
    }
    morphed.view = {.positions = morphed.positions,
                    .normals = morphed.normals,
                    .tangents = morphed.tangents,
                    .uvs = base.uvs,
                    .corners = base.corners};
}

/// How wrong each vertex's tangent is, in degrees: its direction in the surface (`distances`), or its lean
/// out of it.
std::vector<float> frameErrors(const TangentView& mesh, std::vector<float> distances) {
    std::vector<float> errors = std::move(distances);
    for (std::size_t v = 0; v < errors.size(); ++v) {
        DVec3 normal = toDouble(mesh.normals[v]), tangent = toDouble(xyz(mesh.tangents[v]));
        if (!normalize(normal)) continue;
        const bool has_tangent = normalize(tangent);
        const double lean = has_tangent ? std::fabs(90 - angleBetween(normal, tangent) * 180 / kPi) : 90;
        errors[v] = std::max(errors[v], static_cast<float>(lean));
    }
    return errors;
}

double turnDegrees(const Vec4& from, const Vec4& to) {
    DVec3 a = toDouble(xyz(from)), b = toDouble(xyz(to));
    return normalize(a) && normalize(b) ? angleBetween(a, b) * 180 / kPi : 0;
}

/// Vertices whose frame on the base is known and good. A frame that is wrong on the base is found there already. Where no
/// triangle determines the tangent, its direction is arbitrary, and no target can be compared with it.
std::vector<bool> goodVertices(const PrimitiveFacts& facts) {
    const double limit = facts.options.direction_deg;
    const std::vector<float> distances = directionDistances(facts.mesh, facts.surface, limit);
    const std::vector<float> errors = frameErrors(facts.mesh, distances);
    std::vector<bool> good(errors.size());
    for (std::size_t v = 0; v < good.size(); ++v) good[v] = distances[v] != kUnknownDirection && errors[v] <= limit;
    return good;
}

/// Whether the triangle is degenerate: its area, beside its longest edge, is that of rounding.
bool isThin(const TangentView& mesh, std::size_t face, float area) {
    constexpr double kThin = 1e-6;
    const auto square = [&](std::size_t k) {
        const auto position = [&](std::size_t i) { return toDouble(mesh.positions[mesh.corners[3 * face + i % 3]]); };
        const DVec3 edge = position(k + 1) - position(k);
        return dot(edge, edge);
    };
    return area <= kThin * std::max({square(0), square(1), square(2)});
}

/// Takes out the vertices of triangles that are degenerate either before or after, and vertices equal to them. The groups
/// are those of the base, so a triangle that collapses still counts in them, with an arbitrary direction, and one that
/// opens does not. Triangles that are degenerate before and after change nothing.
void forgetCollapsed(const TangentView& mesh, const Surface& base, const TangentView& morphed_mesh,
                     const Surface& morphed, const EqualVertices& equal, std::vector<bool>& good) {
    constexpr float kCollapsed = 1e-4f;  // of the area: a hundredth of each side
    std::vector<bool> is_out(equal.class_count, false);
    for (std::size_t f = 0; f < base.faces.size(); ++f) {
        const SurfaceFrame &before = base.faces[f], &after = morphed.faces[f];
        if (before.tangent == Vec3{} && after.tangent == Vec3{}) continue;
        if (after.area >= kCollapsed * before.area && !isThin(mesh, f, before.area) &&
            !isThin(morphed_mesh, f, after.area))
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
        forgetCollapsed(facts_.mesh, facts_.surface, morphed.view, surface, equal_, good);
        Tally tally;
        double far_area = 0, turning_area = 0;
        std::vector<std::uint32_t> off;
        for (std::uint32_t v = 0; v < errors.size(); ++v) {
            if (!good[v]) continue;
            const bool is_off = errors[v] > limit;
            const double area = facts_.surface.vertex_areas[v];
            if (is_off || turnDegrees(facts_.mesh.tangents[v], morphed.tangents[v]) > limit) turning_area += area;
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
        missing_.report(facts_, FindingCode::morphTangentsMissing,
                        missing_.targets.surface_share >= share ? Severity::warning : Severity::note,
                        countText(missing_.targets, "targets") + " without tangents turn the surface", "tangents");
        wrong_.report(
            facts_, FindingCode::morphTangentsWrong, wrong_.far_share >= share ? Severity::error : Severity::warning,
            "the tangents of " + countText(wrong_.targets, "targets") + " do not fit the morphed surface", "tangents");
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
    // A file may name the same arrays any number of times.
    std::set<std::array<const Vec3*, 3>> seen;
    for (std::size_t i = 0; i < facts.primitive.morph_targets.size(); ++i) {
        const SceneMorphTarget& target = facts.primitive.morph_targets[i];
        if (seen.insert({target.positions.data(), target.normals.data(), target.tangents.data()}).second) {
            checker.check(i, target);
        }
    }
    checker.report();
}

}  // namespace tspace
