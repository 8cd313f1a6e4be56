// SPDX-License-Identifier: MIT
// Runs the examinations in order.
#include "commands/check/frame_health.h"

#include <utility>

namespace tspace {

namespace {

Result<FrameHealth> examineOnce(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                                FrameHealth&& known) {
    FrameHealth health;
    health.settled = std::move(known.settled);
    health.settled_sign = known.settled_sign;
    examineValues(mesh, surface, options, health);
    if (mesh.normals.empty() || mesh.uvs.empty()) return health;
    const std::vector<float> directions = directionDistances(mesh, surface, options.direction_deg);
    examineSigns(mesh, surface, options, directions, health);
    examineDirections(mesh, surface, options, directions, health);
    if (const Result<Done> done = examineSplits(mesh, surface, options, health); !done) return done.error();
    return health;
}

}  // namespace

Result<FrameHealth> examineTangents(const TangentView& mesh, const Surface& surface, const CheckOptions& options) {
    Result<FrameHealth> found = examineOnce(mesh, surface, options, {});
    if (!found) return found;
    if (!mesh.normals.empty() && !mesh.uvs.empty()) {
        const Result<bool> settles = settleVertices(mesh, surface, options, *found);
        if (!settles) return settles.error();
        if (*settles) found = examineOnce(mesh, surface, options, *std::move(found));
        if (!found) return found;
    }
    FrameHealth& health = *found;
    for (Tally* tally : {&health.not_finite, &health.not_unit, &health.not_orthogonal, &health.parallel,
                         &health.sign_not_one, &health.signs_mixed, &health.signs_wrong, &health.mirrored_seams,
                         &health.uv_seams, &health.directions_wrong, &health.frames_differ}) {
        tally->finish(surface.area);
    }
    if (surface.area > 0) {
        health.far_from_unit /= surface.area;
        health.far_directions /= surface.area;
    }
    health.parallel_apart = health.has_no_frame && health.parallel.surface_share < options.error_share;
    if (health.parallel_apart) {
        for (std::uint32_t& bits : health.faults) {
            if ((bits & kParallelTangent) == 0) bits &= ~faultBit(FindingCode::tangentsNotOrthogonal);
        }
    }
    return found;
}

Result<FrameHealth> examineTangents(const TangentView& mesh, const CheckOptions& options) {
    return examineTangents(mesh, describeSurface(mesh), options);
}

}  // namespace tspace
