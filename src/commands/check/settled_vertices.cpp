// SPDX-License-Identifier: MIT
// Which vertices have the tangents that `generate` would give them. The checks have rules of their own, but bakers and
// renderers expect the tangents of the reference, so these vertices are in no finding.
#include "commands/check/frame_health.h"
#include "core/base/vec_math.h"
#include "tspace/sanitize.h"
#include "tspace/tangents.h"

namespace tspace {

namespace {

/// Degrees that storing in 8 bits and welding of equal tangents may take.
constexpr double kSettledDeg = 1;

/// One per corner, mended as `generate` does.
Result<std::vector<Vec4>> expectedTangents(const TangentView& mesh, const TangentOptions& options) {
    const MeshView view = mesh.triangles();
    std::vector<Vec4> tangents(mesh.corners.size());
    const Result<TangentReport> made = generateTangents(view, options, {.tangents = tangents});
    if (!made) return made.error();
    const Result<SanitizeReport> mended = sanitizeTangents(view, {}, std::span(tangents));
    if (!mended) return mended.error();
    return tangents;
}

bool isSame(const Vec4& stored, const Vec4& expected, float factor) {
    if (!isFinite(xyz(stored)) || (stored.w * factor > 0) != (expected.w > 0)) return false;
    return angleBetween(toDouble(xyz(stored)), toDouble(xyz(expected))) * 180 / kPi <= kSettledDeg;
}

/// Settles vertices at all of whose corners with UV area one method gives the stored tangents.
Result<Done> settleBy(const TangentOptions& how, const TangentView& mesh, const Surface& surface, FrameHealth& health) {
    const Result<std::vector<Vec4>> expected = expectedTangents(mesh, how);
    if (!expected) return expected.error();
    std::vector<bool> judged(mesh.positions.size(), false), differs(mesh.positions.size(), false);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        if (surface.faces[c / 3].orientation == 0) continue;
        const std::uint32_t v = mesh.corners[c];
        judged[v] = true;
        if (!isSame(mesh.tangents[v], (*expected)[c], health.settled_sign)) differs[v] = true;
    }
    for (std::size_t v = 0; v < differs.size(); ++v) {
        if (judged[v] && !differs[v]) health.settled[v] = true;
    }
    return Done{};
}

}  // namespace

Result<bool> settleVertices(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                            FrameHealth& health) {
    const bool only_signs = health.all_signs_wrong && health.mirrored_seams.count == 0;
    const std::uint64_t doubtful = health.not_orthogonal.count + health.parallel.count + health.signs_mixed.count +
                                   health.mirrored_seams.count + health.uv_seams.count + health.directions_wrong.count +
                                   health.frames_differ.count + (only_signs ? 0 : health.signs_wrong.count);
    if (doubtful == 0) return false;
    // Where nearly all signs are inverted, that is said once; the others are compared with what it leaves.
    health.settled_sign = health.all_signs_wrong ? -1.0f : 1.0f;
    health.settled.assign(mesh.positions.size(), false);
    TangentOptions how{.convention = options.convention};
    if (Result<Done> done = settleBy(how, mesh, surface, health); !done) return done.error();
    // Tangents of fitting methods may lie a little outside of all triangles around.
    how.method = Method::best;
    for (how.refine = 0; how.refine <= 2 && health.directions_wrong.count != 0; ++how.refine) {
        if (Result<Done> done = settleBy(how, mesh, surface, health); !done) return done.error();
    }
    for (std::size_t v = 0; v < health.faults.size(); ++v) {
        if (health.settled[v] && health.faults[v] != 0) return true;
    }
    return false;
}

}  // namespace tspace
