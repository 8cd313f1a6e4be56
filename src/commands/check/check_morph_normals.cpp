// SPDX-License-Identifier: MIT
// Morph targets: whether base plus delta is still a normal of the morphed surface.
#include <algorithm>
#include <array>
#include <set>

#include "commands/check/findings.h"
#include "commands/check/morph_faults.h"
#include "commands/check/primitive_checks.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {

namespace {

/// A vertex is off where its normal is further from where the surface turns it than this part of the turn, and direction_deg.
constexpr double kOfTurn = 0.5;

bool addsNothing(const SharedArray<Vec3>& offsets) { return std::all_of(offsets.begin(), offsets.end(), isZero); }

class MorphNormalsChecker {
  public:
    explicit MorphNormalsChecker(PrimitiveFacts& facts)
        : facts_(facts), turns_(facts.mesh.positions, facts.mesh.normals, facts.mesh.corners) {}

    /// The normal of the base is turned as the surface turns: exporters weight triangles in other ways, and normals of the
    /// base may be somebody's choice, but how they change is the surface's.
    void check(std::size_t number, const SceneMorphTarget& target) {
        MorphFault& fault = addsNothing(target.normals) ? missing_ : wrong_;
        ++fault.targets.total;
        const std::vector<VertexTurn> turns = turns_.under(target.positions.span());
        Tally tally;
        double far_area = 0, turning_area = 0;
        for (std::uint32_t v = 0; v < turns.size(); ++v) {
            const Vec3& base = facts_.mesh.normals[v];
            if (!turns[v].isKnown() || !turns[v].is_certain || !isDirection(base)) continue;
            const Vec3 moved = target.normals.empty() ? base : base + target.normals[v];
            DVec3 is = toDouble(moved), should = toDouble(turns[v].apply(base));
            if (!normalize(is) || !normalize(should)) continue;
            const double limit = facts_.options.direction_deg, error = angleBetween(is, should) * 180 / kPi;
            DVec3 was = toDouble(base);
            normalize(was);
            const double turn = std::max(angleBetween(was, should), angleBetween(was, is)) * 180 / kPi;
            if (turn > limit) turning_area += facts_.surface.vertex_areas[v];
            if (error <= std::max(limit, kOfTurn * turn)) continue;
            tally.add(v, facts_.surface.vertex_areas[v], error);
            if (error > facts_.options.error_deg) far_area += facts_.surface.vertex_areas[v];
        }
        tally.finish(facts_.surface.area);
        if (tally.count == 0 || tally.area < kOffShare * turning_area) return;
        fault.addTarget(number, tally, far_area, facts_.surface.area);
    }

    void report() {
        const double share = facts_.options.error_share;
        missing_.report(facts_, FindingCode::morphNormalsMissing,
                        missing_.targets.surface_share >= share ? Severity::warning : Severity::note,
                        countText(missing_.targets, "targets that add nothing to normals") + " turn the surface",
                        "normals");
        wrong_.report(
            facts_, FindingCode::morphNormalsWrong, wrong_.far_share >= share ? Severity::error : Severity::warning,
            "the normals of " + countText(wrong_.targets, "targets") + " do not turn with the surface", "normals");
    }

  private:
    PrimitiveFacts& facts_;
    SurfaceTurns turns_;
    MorphFault missing_ = {}, wrong_ = {};
};

}  // namespace

void checkMorphNormals(PrimitiveFacts& facts) {
    const auto& targets = facts.primitive.morph_targets;
    if (facts.mesh.normals.empty() || targets.empty() || facts.primitive.is_unlit) return;
    MorphNormalsChecker checker(facts);
    // A file may name the same arrays any number of times.
    std::set<std::array<const Vec3*, 2>> seen;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (targets[i].positions.empty()) continue;  // targets that move normals alone are authored
        if (seen.insert({targets[i].positions.data(), targets[i].normals.data()}).second) checker.check(i, targets[i]);
    }
    checker.report();
}

}  // namespace tspace
