// SPDX-License-Identifier: MIT
// One primitive: what it should follow, then family by family.
#include "check/primitive_checks.h"

#include "check/findings.h"

namespace tspace {

void PrimitiveFacts::add(FindingCode code, Severity severity, const Tally& tally, const char* unit,
                         std::string message) {
    findings.push_back(makeFinding(code, severity, tally, unit, std::move(message)));
}

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
                  .uvs = facts.reading.uvs,
                  .corners = primitive.corners.span()};
    facts.surface = describeSurface(facts.mesh);
    checkPositions(facts);
    checkNormals(facts);
    checkMorphNormals(facts);
    checkUvs(facts);
    checkTextures(facts);
    if (const Result<Done> done = checkTangents(facts); !done) return done.error();
    checkMorphTargets(facts);
    return PrimitiveVerdict{std::move(facts.findings), std::move(facts.faults), facts.wrong_sign_share};
}

Result<std::vector<Finding>> checkPrimitive(const ScenePrimitive& primitive, const CheckOptions& options,
                                            bool is_gltf) {
    Result<PrimitiveVerdict> verdict = judgePrimitive(primitive, options, is_gltf);
    if (!verdict) return verdict.error();
    return std::move(verdict->findings);
}

}  // namespace tspace
