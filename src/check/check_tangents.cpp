// SPDX-License-Identifier: MIT
// Whether tangents are there when they are needed, and whether they are good along the UVs that they should follow;
// else, whether they are along other ones.
#include "check/findings.h"
#include "check/primitive_checks.h"

namespace tspace {

namespace {

/// Share of the surface from which wrong tangents may have a common cause.
constexpr double kSuspicious = 0.1;
/// What is left of it where the cause was found.
constexpr double kExplained = 0.02;

struct Faults {
    double directions = 0, signs = 0;  ///< shares of the surface
};

Faults faultsOf(const FrameHealth& health) {
    return {health.directions_wrong.surface_share + health.uv_seams.surface_share, health.signs_wrong.surface_share};
}

/// True when other UVs explain what is wrong: the directions where those are, else the signs.
bool explains(const Faults& with_other, const Faults& now) {
    if (with_other.directions > kExplained) return false;
    return now.directions > kSuspicious || with_other.signs <= kExplained;
}

struct Explanation {
    UvReading reading = {};
    Surface surface = {};
    FrameHealth health = {};
};

/// The first other reading of the UVs that the tangents fit: the same set without its transform, then the other sets.
Result<std::optional<Explanation>> explain(const PrimitiveFacts& facts, const FrameHealth& health) {
    const Faults now = faultsOf(health);
    if (now.directions <= kSuspicious && now.signs <= kSuspicious) return std::optional<Explanation>{};
    for (std::size_t i = 0; i <= facts.primitive.uv_sets.size(); ++i) {
        const std::size_t set = i == 0 ? facts.reading.uv_set : i - 1;
        const bool is_own = set == facts.reading.uv_set;
        if (is_own && (i > 0 || !facts.reading.transformed)) continue;
        Explanation other{.reading = plainReading(facts.primitive, set)};
        if (other.reading.uvs.empty()) continue;
        TangentView mesh = facts.mesh;
        mesh.uvs = other.reading.uvs;
        other.surface = describeSurface(mesh);
        Result<FrameHealth> found = examineTangents(mesh, other.surface, facts.options);
        if (!found) return found.error();
        other.health = *std::move(found);
        if (other.health.directions_wrong.total > 0 && explains(faultsOf(other.health), now)) {
            return std::optional<Explanation>(std::move(other));
        }
    }
    return std::optional<Explanation>{};
}

void addExplanation(PrimitiveFacts& facts, const FrameHealth& health, const Explanation& other) {
    const std::string set = "TEXCOORD_" + std::to_string(facts.reading.uv_set);
    Tally wrong = faultsOf(health).directions > kSuspicious ? health.directions_wrong : health.signs_wrong;
    if (other.reading.uv_set == facts.reading.uv_set) {
        facts.add(FindingCode::textureTransformIgnored, Severity::warning, wrong, "vertices",
                  "the tangents follow " + set + " as it is, not as KHR_texture_transform turns or mirrors it for " +
                      facts.primitive.uses.front().needed_by);
    } else {
        facts.add(FindingCode::uvSetWrong, Severity::error, wrong, "vertices",
                  "the tangents follow TEXCOORD_" + std::to_string(other.reading.uv_set) +
                      ", but the texture is read with " + set);
    }
}

/// Nothing renders wrong where nothing is read in tangent space.
void demote(std::span<Finding> findings) {
    for (Finding& finding : findings) {
        finding.severity = finding.severity == Severity::error ? Severity::warning : Severity::note;
    }
}

void checkMissing(PrimitiveFacts& facts) {
    if (facts.primitive.uses.empty()) return;
    Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
    const char* state =
        facts.primitive.tangents_not_read ? "were not read (the importer cannot give them)" : "are missing";
    const std::string& user = facts.primitive.uses.front().needed_by;
    facts.add(FindingCode::tangentsMissing, facts.is_gltf ? Severity::warning : Severity::note, all, "vertices",
              facts.is_gltf
                  ? user + " needs tangents, and there are none"
                  : user + " needs tangents, and they " + state + "; tspace generate writes a glTF file that has them");
}

/// Goes on with the quads on which the tangents were made, where they were.
Result<Done> readOnQuads(PrimitiveFacts& facts, FrameHealth& health) {
    Result<std::optional<QuadReading>> quads = findQuads(facts.mesh, facts.surface, health, facts.options);
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
    if (facts.mesh.tangents.empty()) {
        checkMissing(facts);
        return Done{};
    }
    Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
    if (facts.mesh.normals.empty()) {
        facts.add(FindingCode::tangentsIgnored, facts.primitive.uses.empty() ? Severity::note : Severity::warning, all,
                  "vertices", "it has tangents but no normals, and glTF tells readers to ignore such tangents");
    }
    const std::size_t first = facts.findings.size();
    Result<FrameHealth> health = examineTangents(facts.mesh, facts.surface, facts.options);
    if (!health) return health.error();
    if (Result<Done> done = readOnQuads(facts, *health); !done) return done;
    Result<std::optional<Explanation>> other = explain(facts, *health);
    if (!other) return other.error();
    if (*other) {
        if (!facts.primitive.uses.empty()) addExplanation(facts, *health, **other);
        *health = std::move((*other)->health);
        facts.reading = std::move((*other)->reading);
        facts.surface = std::move((*other)->surface);
        facts.mesh.uvs = facts.reading.uvs;
    }
    for (Finding& finding : tangentFindings(*health, facts.options)) facts.findings.push_back(std::move(finding));
    if (facts.primitive.uses.empty()) {
        demote(std::span(facts.findings).subspan(first));
        facts.add(FindingCode::tangentsUnused, Severity::note, all, "vertices",
                  "it has tangents, but its material needs none");
    }
    return Done{};
}

}  // namespace tspace
