// SPDX-License-Identifier: MIT
// UVs as far as tangents need them.
#include <cmath>
#include <set>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"

namespace tspace {

namespace {

/// Shares of the surface from which triangles without UV area are more than a few slivers.
constexpr double kSomeUvs = 0.01;

bool isFinite(const Vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }

std::string setName(std::size_t set) { return "TEXCOORD_" + std::to_string(set); }

void checkUvsMissing(PrimitiveFacts& facts) {
    std::set<std::size_t> reported;
    for (const TangentUse& use : facts.primitive.uses) {
        if (!use.has_texture) continue;
        if (!plainReading(facts.primitive, use.uv_set).uvs.empty() || !reported.insert(use.uv_set).second) continue;
        Tally all{.count = facts.mesh.positions.size(), .total = facts.mesh.positions.size()};
        facts.add(FindingCode::uvsMissing, Severity::error, all, "vertices",
                  facts.is_gltf ? use.needed_by + " is read with " + setName(use.uv_set) + ", which is not there"
                                : "the material has a normal map, but the faces have no texture coordinates");
    }
}

void checkFinite(PrimitiveFacts& facts) {
    Tally bad;
    for (std::uint32_t v = 0; v < facts.mesh.uvs.size(); ++v) {
        ++bad.total;
        if (!isFinite(facts.mesh.uvs[v])) bad.add(v, facts.surface.vertex_areas[v]);
    }
    bad.finish(facts.surface.area);
    if (bad.count == 0) return;
    facts.add(FindingCode::uvsNotFinite, onShare(Severity::error, bad.surface_share, facts.options), bad, "vertices",
              setName(facts.reading.uv_set) + " is NaN or infinite at " + countText(bad, "vertices"));
}

void checkDegenerate(PrimitiveFacts& facts) {
    Tally degenerate;
    for (std::size_t f = 0; f < facts.surface.faces.size(); ++f) {
        const SurfaceFrame& face = facts.surface.faces[f];
        if (face.area == 0) continue;
        ++degenerate.total;
        if (face.orientation == 0) degenerate.add(facts.mesh.corners[3 * f], face.area);
    }
    degenerate.finish(facts.surface.area);
    if (degenerate.count == 0) return;
    const bool matters = !facts.primitive.uses.empty() && degenerate.surface_share >= kSomeUvs;
    facts.add(FindingCode::uvsDegenerate, matters ? Severity::warning : Severity::note, degenerate, "triangles",
              countText(degenerate, "triangles") + " have no area in " + setName(facts.reading.uv_set) + " (" +
                  shareText(degenerate.surface_share) + " of the surface), so nothing says where their tangents point");
}

}  // namespace

void checkUvs(PrimitiveFacts& facts) {
    checkUvsMissing(facts);
    // UVs that no tangents follow do not matter.
    if (facts.mesh.uvs.empty() || (facts.primitive.uses.empty() && facts.mesh.tangents.empty())) return;
    checkFinite(facts);
    checkDegenerate(facts);
}

}  // namespace tspace
