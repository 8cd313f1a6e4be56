// SPDX-License-Identifier: MIT
// Requirements that do not depend on UVs. Tangents are finite, unit, in the plane of the surface, with a sign of +1 or -1 that
// all corners of a triangle share.
#include <cmath>

#include "commands/check/frame_health.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// Lengths so far off that the normalisation of renderers does not hide the fault.
constexpr double kFarFromUnit = 0.1;

constexpr double kParallel = 90 - kParallelDeg;
/// Beyond this lean a single vertex is a finding.
constexpr double kNoFrame = 89;

void examineMixedSigns(const TangentView& mesh, const Surface& surface, FrameHealth& health) {
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        // The texture shows one texel there, and no sign is right: MikkTSpace itself mixes them.
        if (!mesh.uvs.empty() && surface.faces[f].orientation == 0) continue;
        const std::uint32_t* corner = mesh.corners.data() + 3 * f;
        if (!mesh.normals.empty() && !(facesNormal(surface.faces[f], mesh.normals[corner[0]]) &&
                                       facesNormal(surface.faces[f], mesh.normals[corner[1]]) &&
                                       facesNormal(surface.faces[f], mesh.normals[corner[2]]))) {
            continue;
        }
        ++health.signs_mixed.total;
        if (health.isSettled(corner[0]) && health.isSettled(corner[1]) && health.isSettled(corner[2])) continue;
        const bool positive = mesh.tangents[corner[0]].w > 0;
        if ((mesh.tangents[corner[1]].w > 0) != positive || (mesh.tangents[corner[2]].w > 0) != positive) {
            health.signs_mixed.add(corner[0], surface.faces[f].area);
            for (std::size_t k = 0; k < 3; ++k) {
                health.fault(corner[k], FindingCode::signsMixed, mesh.positions.size());
            }
        }
    }
}

}  // namespace

void examineValues(const TangentView& mesh, const Surface& surface, const CheckOptions& options, FrameHealth& health) {
    // Vertices that no triangle uses have no pixel, but the format forbids broken values there too.
    std::vector<bool> used(mesh.positions.size(), false);
    // Where no triangle has UV area the texture shows one texel, so a lean distorts nothing that can be seen; but there
    // must be a frame.
    std::vector<bool> knows_direction(mesh.positions.size(), false);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        used[mesh.corners[c]] = true;
        if (surface.faces[c / 3].orientation != 0) knows_direction[mesh.corners[c]] = true;
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        const Vec4& stored = mesh.tangents[v];
        const double area = surface.vertex_areas[v];
        const auto fault = [&](FindingCode code) { health.fault(v, code, mesh.positions.size()); };
        DVec3 tangent = toDouble(xyz(stored));
        for (Tally* tally : {&health.not_finite, &health.not_unit, &health.sign_not_one}) ++tally->total;
        if (!isFinite(xyz(stored)) || !std::isfinite(stored.w)) {
            health.not_finite.add(v, area);
            health.has_not_finite = health.has_not_finite || used[v];
            fault(FindingCode::tangentsNotFinite);
            continue;
        }
        if (std::fabs(stored.w) != 1) {  // exact in every format that glTF allows
            health.sign_not_one.add(v, area);
            fault(FindingCode::signsNotOne);
            health.sign_vanishes = health.sign_vanishes || (used[v] && std::fabs(stored.w) < 0.5f);
        }
        const double size = length(tangent), off = std::fabs(size - 1);
        if (off > options.unit_tolerance) {
            health.not_unit.add(v, area);
            fault(FindingCode::tangentsNotUnit);
        }
        if (!used[v]) continue;
        if (off > kFarFromUnit) health.far_from_unit += area;
        health.has_zero = health.has_zero || size < kShortest;
        DVec3 normal = mesh.normals.empty() ? DVec3{} : toDouble(mesh.normals[v]);
        if (!normalize(tangent) || !normalize(normal)) continue;
        ++health.not_orthogonal.total;
        ++health.parallel.total;
        const double lean = std::fabs(90 - angleBetween(normal, tangent) * 180 / kPi);
        const double limit = mesh.uvs.empty() || knows_direction[v] ? options.orthogonal_deg : kParallel;
        if (!(lean > limit) || health.isSettled(v)) continue;
        (lean > kParallel ? health.parallel : health.not_orthogonal).add(v, area, lean);
        fault(FindingCode::tangentsNotOrthogonal);
        if (lean <= kParallel) continue;
        health.has_no_frame = health.has_no_frame || lean > kNoFrame;
        health.addFaults(v, kParallelTangent, mesh.positions.size());
    }
    examineMixedSigns(mesh, surface, health);
}

}  // namespace tspace
