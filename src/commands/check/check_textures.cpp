// SPDX-License-Identifier: MIT
// Several textures of one primitive, which has only one tangent per vertex.
#include <cmath>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// Triangles on which two readings of the UVs give different frames.
Tally compareReadings(const PrimitiveFacts& facts, const UvReading& reading) {
    TangentView other = facts.mesh;
    other.uvs = reading.uvs;
    const Surface surface = describeSurface(other);
    Tally different;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const SurfaceFrame &a = facts.surface.faces[f], &b = surface.faces[f];
        if (a.orientation == 0 || b.orientation == 0) continue;
        ++different.total;
        const double angle = angleBetween(toDouble(a.tangent), toDouble(b.tangent)) * 180 / kPi;
        if (a.orientation != b.orientation || angle > facts.options.direction_deg) {
            different.add(facts.mesh.corners[3 * f], a.area, angle);
        }
    }
    different.finish(facts.surface.area);
    return different;
}

bool readsTheSame(const TangentUse& a, const TangentUse& b) {
    return a.uv_set == b.uv_set && a.transform.rotation == b.transform.rotation &&
           a.transform.scale[0] == b.transform.scale[0] && a.transform.scale[1] == b.transform.scale[1];
}

}  // namespace

void checkTextures(PrimitiveFacts& facts) {
    const std::vector<TangentUse>& uses = facts.primitive.uses;
    if (facts.mesh.uvs.empty()) return;
    for (std::size_t i = 1; i < uses.size(); ++i) {
        bool known = false;
        for (std::size_t j = 0; j < i; ++j) known = known || readsTheSame(uses[j], uses[i]);
        const UvReading reading = readingOf(facts.primitive, uses[i]);
        if (known || reading.uvs.empty()) continue;
        const Tally different = compareReadings(facts, reading);
        if (different.count == 0) continue;
        facts.add(FindingCode::texturesDisagree, Severity::warning, different, "triangles",
                  uses[i].needed_by + " needs other tangents than " + uses[0].needed_by + " on " +
                      countText(different, "triangles") + "; tangents can follow only the first of them");
        facts.findings.back().place = uses[i].place;
    }
}

}  // namespace tspace
