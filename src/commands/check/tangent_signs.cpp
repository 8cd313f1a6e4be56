// SPDX-License-Identifier: MIT
// Signs against the orientation of the UVs.
#include <cmath>

#include "commands/check/frame_health.h"
#include "commands/check/vertex_patches.h"
#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// Share of the surface from which wrong signs are a wrong convention and no accident.
constexpr double kEverySign = 0.95;

/// Areas of the triangles around each vertex, by the sign that their UVs ask for.
struct SignAreas {
    std::vector<float> plus, minus;
};

SignAreas sumAreas(const TangentView& mesh, const Surface& surface, const Convention& convention) {
    const float factor = signFactor(convention);
    SignAreas areas{std::vector<float>(mesh.positions.size(), 0.0f), std::vector<float>(mesh.positions.size(), 0.0f)};
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        const SurfaceFrame& face = surface.faces[c / 3];
        if (face.orientation == 0) continue;
        const std::uint32_t vertex = mesh.corners[c];
        if (!facesNormal(face, mesh.normals[vertex])) continue;
        (static_cast<float>(face.orientation) * factor > 0 ? areas.plus : areas.minus)[vertex] += face.area / 3;
    }
    return areas;
}

/// Where nearly all signs are inverted, the undecided ones of a patch count as inverted too, whatever their triangles ask for:
/// a folded quad, for one, has triangles of both orientations and one sign. So do those of patches without a decided sign.
/// In a patch where most signs are right, they count as right.
void findUndecided(const TangentView& mesh, const SignAreas& areas, FrameHealth& health) {
    // Only triangles with one sign at all corners count.
    VertexPatches patches(mesh.positions.size(), mesh.corners, [&](const std::uint32_t* v) {
        const bool positive = mesh.tangents[v[0]].w > 0;
        return (mesh.tangents[v[1]].w > 0) == positive && (mesh.tangents[v[2]].w > 0) == positive;
    });
    std::vector<float> right(mesh.positions.size(), 0.0f), wrong(mesh.positions.size(), 0.0f);
    for (std::uint32_t v = 0; v < right.size(); ++v) {
        const bool is_positive = mesh.tangents[v].w > 0;
        right[patches.of(v)] += is_positive ? areas.plus[v] : areas.minus[v];
        wrong[patches.of(v)] += is_positive ? areas.minus[v] : areas.plus[v];
    }
    for (const std::uint32_t vertex : mesh.corners) {
        const float fits = mesh.tangents[vertex].w > 0 ? areas.plus[vertex] : areas.minus[vertex];
        const float other = mesh.tangents[vertex].w > 0 ? areas.minus[vertex] : areas.plus[vertex];
        if (fits > 0 && other == 0) continue;  // its own triangles say that it is right
        const std::uint32_t patch = patches.of(vertex);
        if (wrong[patch] >= right[patch]) health.addFaults(vertex, kUndecidedSign, right.size());
    }
}

}  // namespace

void examineSigns(const TangentView& mesh, const Surface& surface, const CheckOptions& options,
                  std::span<const float> directions, FrameHealth& health) {
    const SignAreas areas = sumAreas(mesh, surface, options.convention);
    double judged = 0, wrong = 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const float plus = areas.plus[v], minus = areas.minus[v];
        const float sign = mesh.tangents[v].w;
        if (plus == 0 && minus == 0) continue;
        ++health.mirrored_seams.total;
        const std::size_t count = mesh.positions.size();
        if (plus > 0 && minus > 0) {
            if (health.isSettled(v)) continue;
            health.mirrored_seams.add(v, std::min(plus, minus));
            health.fault(v, FindingCode::mirroredSeamAveraged, count);
            continue;
        }
        // Tangents that point elsewhere follow other UVs, whose orientation is unknown.
        if (!std::isfinite(sign) || sign == 0 || directions[v] > options.error_deg) continue;
        ++health.signs_wrong.total;
        judged += plus + minus;
        if ((sign > 0) == (plus > 0)) continue;
        wrong += plus + minus;
        if (health.isSettled(v) && health.settled_sign > 0) continue;
        health.signs_wrong.add(v, plus + minus);
        health.fault(v, FindingCode::signsWrong, count);
    }
    health.wrong_sign_share = judged > 0 ? wrong / judged : 0;
    health.all_signs_wrong = wrong > 0 && wrong >= kEverySign * judged;
    if (health.all_signs_wrong) findUndecided(mesh, areas, health);
}

}  // namespace tspace
