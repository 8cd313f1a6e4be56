// SPDX-License-Identifier: MIT
// Positions and normals: finite, unit, and on the front of their triangles.
#include <algorithm>
#include <cmath>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"
#include "commands/shared/noted_noise.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "tspace/winding.h"

namespace tspace {

namespace {

/// Beyond 96 degrees a normal points to the back, with some room for coarse smooth shading.
constexpr double kLeastFacing = -0.1;
/// From this share of the surface on the whole mesh is said to be inside out.
constexpr double kMostOfSurface = 0.5;
constexpr double kNearlyAll = 0.95;
constexpr double kSomeNormals = 0.01;
/// Degrees between a normal and the nearest of its triangles: a normal that is the mean over an edge of a box is 45 from both.
constexpr double kFarDeg = 40;
/// Share of the surface from which normals off their triangles are reported.
constexpr double kSomeFar = 0.5;

std::vector<bool> usedVertices(const TangentView& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t vertex : mesh.corners) used[vertex] = true;
    return used;
}

void checkNormalValues(PrimitiveFacts& facts) {
    const TangentView& mesh = facts.mesh;
    Tally not_finite, not_unit;
    std::uint64_t zero_count = 0;
    const std::vector<bool> used = usedVertices(mesh);
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        ++not_finite.total;
        ++not_unit.total;
        if (!isFinite(mesh.normals[v])) {
            not_finite.add(v, facts.surface.vertex_areas[v]);
            continue;
        }
        const double size = length(toDouble(mesh.normals[v]));
        if (std::fabs(size - 1) > facts.options.unit_tolerance) not_unit.add(v, facts.surface.vertex_areas[v]);
        zero_count += size < kShortest ? 1 : 0;
    }
    not_finite.finish(facts.surface.area);
    not_unit.finish(facts.surface.area);
    if (not_finite.count > 0) {
        facts.add(FindingCode::normalsNotFinite, Severity::error, not_finite, "vertices",
                  "the normals of " + countText(not_finite, "vertices") + " are NaN or infinite");
    }
    if (not_unit.count > 0) {
        // One normal without length gives NaN in shaders.
        facts.add(FindingCode::normalsNotUnit, zero_count != 0 ? Severity::error : Severity::warning, not_unit,
                  "vertices",
                  "the normals of " + countText(not_unit, "vertices") + " do not have length 1" +
                      (zero_count != 0 ? ", " + std::to_string(zero_count) + " of them length 0" : ""));
        if (zero_count != 0) {
            facts.findings.back().remedy =
                "Export the normals again, those of length 0 cannot be normalised; then compute the tangents anew.";
        }
    }
}

/// Cosine between the normals of a face and its own.
double facingOf(const PrimitiveFacts& facts, std::size_t face) {
    DVec3 mean;
    for (std::size_t k = 0; k < 3; ++k) {
        DVec3 normal = toDouble(facts.mesh.normals[facts.mesh.corners[3 * face + k]]);
        if (normalize(normal)) mean = mean + normal;
    }
    return normalize(mean) ? dot(mean, toDouble(facts.surface.faces[face].normal)) : 0;
}

/// Whether turning triangles as `generate --mend-winding` does would leave no normal on the back of its own.
bool areTrianglesToBlame(const PrimitiveFacts& facts) {
    std::vector<std::uint8_t> turned(facts.surface.faces.size());
    if (!mendWinding(facts.mesh.triangles(), {}, turned, facts.options.execution)) return false;
    for (std::size_t f = 0; f < turned.size(); ++f) {
        const double facing = facts.surface.faces[f].area == 0 ? 0 : facingOf(facts, f);
        if ((turned[f] != 0 ? -facing : facing) < kLeastFacing) return false;
    }
    return true;
}

void checkWinding(PrimitiveFacts& facts) {
    const TangentView& mesh = facts.mesh;
    Tally against;
    for (std::size_t f = 0; f < facts.surface.faces.size(); ++f) {
        const SurfaceFrame& face = facts.surface.faces[f];
        if (face.area == 0) continue;
        ++against.total;
        if (facingOf(facts, f) < kLeastFacing) against.add(mesh.corners[3 * f], face.area);
    }
    against.finish(facts.surface.area);
    if (against.count == 0) return;
    // Leaves and grass that show both sides often have the normals of the whole tree or ground, on purpose.
    const double mostly = facts.primitive.is_double_sided ? kNearlyAll : kMostOfSurface;
    const Severity severity = against.surface_share >= mostly         ? Severity::error
                              : against.surface_share >= kSomeNormals ? Severity::warning
                                                                      : Severity::note;
    facts.add(FindingCode::normalsAgainstWinding, severity, against, "triangles",
              "the normals of " + countText(against, "triangles") + " point to the back (" +
                  shareText(against.surface_share) + " of the surface)");
    if (areTrianglesToBlame(facts))
        facts.findings.back().remedy =
            "Turn those triangles round: tspace generate --mend-winding. Tangents that are there stay.";
}

/// Normals smoothed over hard edges, those of a whole tree on its leaves, or those of another shape. Some are meant, so the
/// finding is a note.
void checkFarNormals(PrimitiveFacts& facts) {
    const TangentView& mesh = facts.mesh;
    const EqualVertices equal = findEqualVertices(mesh, false);
    std::vector<float> least(equal.class_count, 180);
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const SurfaceFrame& face = facts.surface.faces[c / 3];
        DVec3 normal = toDouble(mesh.normals[mesh.corners[c]]);
        if (face.area == 0 || !normalize(normal)) continue;
        float& angle = least[equal.class_of[mesh.corners[c]]];
        angle = std::min(angle, static_cast<float>(angleBetween(normal, toDouble(face.normal)) * 180 / kPi));
    }
    Tally far;
    const std::vector<bool> used = usedVertices(mesh);
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (!used[v] || !isDirection(mesh.normals[v]) || facts.surface.vertex_areas[v] == 0) continue;
        ++far.total;
        // Normals that point to the back are another finding.
        const double angle = least[equal.class_of[v]];
        if (angle > kFarDeg && angle <= 90) far.add(v, facts.surface.vertex_areas[v], angle);
    }
    far.finish(facts.surface.area);
    if (far.surface_share < kSomeFar) return;
    facts.add(FindingCode::normalsFarFromFaces, Severity::note, far, "vertices",
              "the normals of " + countText(far, "vertices") + " are more than " + decimalText(kFarDeg) +
                  " and up to " + decimalText(far.worst_deg) + " degrees from every triangle around them (" +
                  shareText(far.surface_share) + " of the surface)");
}

}  // namespace

void checkPositions(PrimitiveFacts& facts) {
    Tally bad;
    const std::vector<bool> used = usedVertices(facts.mesh);
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        ++bad.total;
        if (!isFinite(facts.mesh.positions[v])) bad.add(v, 0);
    }
    if (bad.count == 0) return;
    facts.add(FindingCode::positionsNotFinite, Severity::error, bad, "vertices",
              "the positions of " + countText(bad, "vertices") + " are NaN or infinite");
}

/// Random offsets of positions, by the mesh alone: what the file has as normals may well be without them.
void checkNoise(PrimitiveFacts& facts) {
    const double noise = notedNoise(facts.mesh.triangles(), facts.mesh.position_step);
    if (noise == 0) return;
    Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
    facts.add(FindingCode::positionsNoisy, Severity::note, all, "vertices",
              "its positions are noisy: they lie " + stepText(noise) +
                  " of the length of an edge beside a smooth surface, in the mean square");
}

void checkNormals(PrimitiveFacts& facts) {
    if (facts.mesh.normals.empty()) {
        Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
        facts.add(FindingCode::normalsMissing, Severity::note, all, "vertices",
                  facts.is_gltf ? "it has no normals, so it is shaded flat"
                                : "not all faces have normals, so new ones are made for those without");
        return;
    }
    const std::size_t first = facts.findings.size();
    checkNormalValues(facts);
    checkWinding(facts);
    checkFarNormals(facts);
    if (!facts.primitive.is_unlit) return;
    for (Finding& finding : std::span(facts.findings).subspan(first)) {
        finding.severity = Severity::note;
        finding.message += "; its material is unlit, so nobody sees that";
    }
}

}  // namespace tspace
