// SPDX-License-Identifier: MIT
// Signs against the orientation of the UVs.
#include <cmath>

#include "check/frame_health.h"
#include "core/unit.h"

namespace tspace {

namespace {

/// Share of the surface from which wrong signs are a wrong convention and no accident.
constexpr double kNearlyAll = 0.95;

/// Triangles that turn their back on N say nothing reliable: methods differ in whether the sign looks at N.
constexpr double kLeastFacing = 0.05;

/// Areas of the triangles around each vertex, by the sign that their UVs ask for.
struct SignAreas {
    std::vector<float> plus, minus;
};

SignAreas sumAreas(const TangentView& mesh, const Surface& surface, const Convention& convention) {
    const float factor = signFactor(convention);
    SignAreas areas{std::vector<float>(mesh.positions.size(), 0.0f), std::vector<float>(mesh.positions.size(), 0.0f)};
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        const FaceFrame& face = surface.faces[c / 3];
        if (face.orientation == 0) continue;
        const std::uint32_t vertex = mesh.corners[c];
        DVec3 normal = toDouble(mesh.normals[vertex]);
        if (!normalize(normal) || dot(normal, toDouble(face.normal)) < kLeastFacing) continue;
        (static_cast<float>(face.orientation) * factor > 0 ? areas.plus : areas.minus)[vertex] += face.area / 3;
    }
    return areas;
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
        if (plus > 0 && minus > 0) {
            health.mirrored_seams.add(v, std::min(plus, minus));
            continue;
        }
        // What points elsewhere follows other UVs, whose orientation nobody knows.
        if (!std::isfinite(sign) || sign == 0 || directions[v] > options.error_deg) continue;
        ++health.signs_wrong.total;
        judged += plus + minus;
        if ((sign > 0) == (plus > 0)) continue;
        wrong += plus + minus;
        health.signs_wrong.add(v, plus + minus);
    }
    health.all_signs_wrong = wrong > 0 && wrong >= kNearlyAll * judged;
}

}  // namespace tspace
