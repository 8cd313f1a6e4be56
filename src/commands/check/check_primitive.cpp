// SPDX-License-Identifier: MIT
// One primitive: the UVs that its tangents should follow, then the checks, family by family.
#include "commands/check/primitive_checks.h"

#include "commands/check/findings.h"
#include "core/base/vec_math.h"

namespace tspace {

void PrimitiveFacts::add(FindingCode code, Severity severity, const Tally& tally, const char* unit,
                         std::string message) {
    findings.push_back(makeFinding(code, severity, tally, unit, std::move(message)));
}

namespace {

/// Share of the surface where UVs determine tangents, and positions are not too coarse for that.
double comparedShare(const PrimitiveFacts& facts) {
    const double most = sineCosine(facts.options.direction_deg * kPi / 180).sine;
    double area = 0;
    for (const SurfaceFrame& face : facts.surface.faces) {
        if (face.orientation != 0 && face.tangent_error <= most) area += face.area;
    }
    return facts.surface.area > 0 ? area / facts.surface.area : 0;
}

/// Positions so coarse that triangles say neither where tangents point nor, reliably, where they face.
void checkRounding(PrimitiveFacts& facts) {
    PositionRounding rounding = facts.surface.rounding;
    // Positions that were rounded on purpose matter only to tangents.
    const bool has_readers = !facts.primitive.uses.empty() || !facts.primitive.tangents.empty();
    if (rounding.was_before && !has_readers) {
        const std::span<const std::uint32_t> corners = facts.mesh.corners;
        rounding = roundingOf(facts.mesh.positions, {}, {&corners, 1}, facts.mesh.position_step);
    }
    const TurnedTriangles turned =
        turnedBy(rounding, facts.mesh.positions, facts.mesh.corners, facts.options.direction_deg);
    if (turned.share < kSomeTurned) return;
    const Tally tally{.count = turned.count,
                      .total = turned.total,
                      .surface_share = turned.share,
                      .worst_deg = turned.worst_deg,
                      .vertices = {turned.first}};
    facts.add(FindingCode::positionsRounded, Severity::warning, tally, "triangles",
              "positions are rounded to steps of " + stepText(rounding.step) + " at up to " + stepText(rounding.far) +
                  " from the origin, which turns " + countText(tally, "triangles") + " by " +
                  decimalText(facts.options.direction_deg) + " degrees or more, up to " +
                  decimalText(turned.worst_deg) + " (" + shareText(turned.share) +
                  " of the surface); tangents are not blamed for it");
    if (rounding.was_before) {
        facts.findings.back().remedy =
            "Take the model as it was before its positions were rounded, or round them finer, and keep the tangents "
            "and "
            "normals that were made then.";
    }
}

}  // namespace

Result<PrimitiveVerdict> judgePrimitive(const ScenePrimitive& primitive, const CheckOptions& options, bool is_gltf) {
    PrimitiveFacts facts{.primitive = primitive, .options = options, .is_gltf = is_gltf};
    if (primitive.corners.empty()) {
        // glTF lights points and lines by their tangents where the material has a normal map.
        if (!primitive.tangents.empty() && primitive.uses.empty()) {
            Tally all{.count = 1, .total = 1};
            facts.add(FindingCode::tangentsUnused, Severity::note, all, "primitives",
                      "it has tangents, but draws " + primitive.mode);
        }
        return PrimitiveVerdict{.findings = std::move(facts.findings)};
    }
    facts.reading = primitive.uses.empty() ? plainReading(primitive, 0) : readingOf(primitive, primitive.uses.front());
    facts.mesh = {.positions = primitive.positions.span(),
                  .normals = primitive.normals.span(),
                  .tangents = primitive.tangents.span(),
                  .uvs = primitive.hasFreeTangents() ? std::span<const Vec2>{} : facts.reading.uvs,
                  .corners = primitive.corners.span(),
                  .position_step = primitive.position_step};
    facts.surface = describeSurface(facts.mesh);
    checkPositions(facts);
    checkRounding(facts);
    checkNormals(facts);
    checkNoise(facts);
    checkMorphValues(facts);
    checkMorphNormals(facts);
    checkUvs(facts);
    checkTextures(facts);
    if (const Result<Done> done = checkTangents(facts); !done) return done.error();
    checkMorphTargets(facts);
    const double compared = facts.looked_at_values ? comparedShare(facts) : 0;
    return PrimitiveVerdict{std::move(facts.findings), std::move(facts.faults), facts.wrong_sign_share, compared};
}

Result<std::vector<Finding>> checkPrimitive(const ScenePrimitive& primitive, const CheckOptions& options,
                                            bool is_gltf) {
    Result<PrimitiveVerdict> verdict = judgePrimitive(primitive, options, is_gltf);
    if (!verdict) return verdict.error();
    return std::move(verdict->findings);
}

}  // namespace tspace
