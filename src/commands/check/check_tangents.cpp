// SPDX-License-Identifier: MIT
// Whether tangents are there when they are needed, and whether they are good along the UVs that they should follow;
// else, whether they are along other ones.
#include <algorithm>

#include "commands/check/findings.h"
#include "commands/check/other_axes.h"
#include "commands/check/other_reading.h"
#include "commands/check/primitive_checks.h"

namespace tspace {

namespace {

/// The tangents fit other UVs. That is an error only where it would be one without this explanation, and where no
/// other texture of the primitive is read like that.
void addExplanation(PrimitiveFacts& facts, const FrameHealth& health, const OtherReading& other) {
    const std::string set = "TEXCOORD_" + std::to_string(facts.reading.uv_set);
    const Tally& wrong = areDirectionsWrong(health, facts.surface) ? health.directions_wrong : health.signs_wrong;
    FindingCode code = FindingCode::textureTransformIgnored;
    Severity severity = Severity::warning;
    std::string message = "the tangents follow " + set +
                          " as it is, not as KHR_texture_transform turns or mirrors it for " +
                          facts.primitive.uses.front().needed_by;
    if (other.reading.uv_set != facts.reading.uv_set) {
        code = FindingCode::uvSetWrong;
        message = "the tangents follow TEXCOORD_" + std::to_string(other.reading.uv_set) +
                  ", but the texture is read with " + set;
        if (!other.use && !whyTangentsAreWrong(health, facts.options).empty()) severity = Severity::error;
    }
    if (other.use) message += "; " + facts.primitive.uses[*other.use].needed_by + " is read as they are";
    facts.add(code, severity, wrong, "vertices", message);
    // Readings that agree do not make the tangents better.
    for (const std::uint32_t vertex : facts.mesh.corners) facts.faults[vertex] |= faultBit(code);
}

void checkUnreadable(PrimitiveFacts& facts) {
    const Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
    for (const SceneTangentFault& fault : facts.primitive.tangent_faults) {
        const std::string what = fault.target < 0
                                     ? "the tangents"
                                     : "what morph target " + std::to_string(fault.target) + " adds to the tangents";
        facts.add(FindingCode::tangentsUnreadable, Severity::error, all, "vertices",
                  what + " cannot be read: " + fault.why);
    }
}

bool isUnreadable(const ScenePrimitive& primitive) {
    return std::any_of(primitive.tangent_faults.begin(), primitive.tangent_faults.end(),
                       [](const SceneTangentFault& fault) { return fault.target < 0; });
}

void checkTangentsMissing(PrimitiveFacts& facts) {
    if (facts.primitive.uses.empty() || isUnreadable(facts.primitive)) return;
    Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
    const char* state =
        facts.primitive.tangents_not_read ? "were not read (the importer cannot give them)" : "are missing";
    const std::string& user = facts.primitive.uses.front().needed_by;
    if (const ScenePacked* packed = facts.primitive.packedAlone()) {
        facts.add(FindingCode::tangentsMissing, Severity::note, all, "vertices",
                  user + " needs tangents, and they are only in the packed frames of " + packed->attribute);
        return;
    }
    facts.add(FindingCode::tangentsMissing, facts.is_gltf ? Severity::warning : Severity::note, all, "vertices",
              facts.is_gltf
                  ? user + " needs tangents, and there are none"
                  : user + " needs tangents, and they " + state + "; tspace generate writes a glTF file that has them");
}

/// Replaces the triangles by the quads on which the tangents were made, if they were made on quads.
Result<Done> readOnQuads(PrimitiveFacts& facts, FrameHealth& health) {
    Result<std::optional<QuadReading>> quads = findQuads(facts.mesh, health, facts.options);
    if (!quads) return std::move(quads).error();
    if (!*quads) return Done{};
    facts.quads = **std::move(quads);
    facts.mesh.corners = facts.quads.corners;
    facts.surface = facts.quads.surface;
    Result<FrameHealth> found = examineTangents(facts.mesh, facts.surface, facts.options);
    if (!found) return std::move(found).error();
    health = *std::move(found);
    return Done{};
}

}  // namespace

Result<Done> checkTangents(PrimitiveFacts& facts) {
    checkUnreadable(facts);
    if (facts.mesh.tangents.empty()) {
        checkTangentsMissing(facts);
        return Done{};
    }
    Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
    if (facts.primitive.uses.empty() && !facts.primitive.hasFreeTangents()) {
        // No material reads these tangents, so their faults are not seen.
        facts.add(FindingCode::tangentsUnused, Severity::note, all, "vertices",
                  "it has tangents, but its material needs none");
        return Done{};
    }
    if (facts.mesh.normals.empty()) {
        facts.add(FindingCode::tangentsIgnored, Severity::warning, all, "vertices",
                  "it has tangents but no normals, and glTF tells readers to ignore such tangents");
        return Done{};
    }
    Result<FrameHealth> health = examineTangents(facts.mesh, facts.surface, facts.options);
    if (!health) return health.error();
    if (Result<Done> done = readOnQuads(facts, *health); !done) return done;
    Result<std::optional<OtherReading>> other = findOtherReading(facts, *health);
    if (!other) return other.error();
    facts.looked_at_values = true;
    facts.faults = std::move(health->faults);
    facts.wrong_sign_share = health->wrong_sign_share;
    if (*other) {
        facts.faults.assign(facts.mesh.positions.size(), 0);
        addExplanation(facts, *health, **other);
        *health = std::move((*other)->health);
        facts.wrong_sign_share = health->wrong_sign_share;
        facts.reading = std::move((*other)->reading);
        facts.surface = std::move((*other)->surface);
        facts.mesh.uvs = facts.reading.uvs;
        for (std::size_t v = 0; v < health->faults.size(); ++v) facts.faults[v] |= health->faults[v];
    }
    const std::string axes = *other ? std::string() : findOtherAxes(facts, *health);
    if (!axes.empty()) {
        // All of them are wrong for one reason, also those that happen to be near the right ones.
        for (const std::uint32_t vertex : facts.mesh.corners) facts.fault(vertex, FindingCode::directionsWrong);
    }
    for (Finding& finding : tangentFindings(*health, facts.options)) {
        if (finding.code == FindingCode::directionsWrong && !axes.empty()) {
            finding.message +=
                "; as (" + axes +
                ") of what is stored they fit, so the mesh was turned to other axes, and its tangents were not";
        }
        // Without a texture the side on which v grows is seldom seen.
        if (finding.code == FindingCode::signsMixed && facts.primitive.hasFreeTangents())
            finding.severity = Severity::warning;
        facts.findings.push_back(std::move(finding));
    }
    return Done{};
}

}  // namespace tspace
