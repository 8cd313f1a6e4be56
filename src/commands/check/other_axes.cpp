// SPDX-License-Identifier: MIT
#include "commands/check/other_axes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// Share of the surface with tangents that lean out of it, from which other axes are looked for.
constexpr double kClearlyLeaning = 0.2;
/// Share of leaning tangents, and of wrong directions, that may remain in the right axes.
constexpr double kMostWrong = 0.02;

/// Component i of the result is `sign[i]` times component `from[i]`.
struct AxisExchange {
    std::array<std::size_t, 3> from = {0, 1, 2};
    std::array<float, 3> sign = {1, 1, 1};

    [[nodiscard]] Vec4 operator()(const Vec4& t) const {
        const std::array<float, 3> v{t.x, t.y, t.z};
        return {sign[0] * v[from[0]], sign[1] * v[from[1]], sign[2] * v[from[2]], t.w};
    }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (std::size_t i = 0; i < 3; ++i)
            text += std::string(i == 0 ? "" : ", ") + (sign[i] < 0 ? "-" : "") + "xyz"[from[i]];
        return text;
    }
};

double leaningShare(const PrimitiveFacts& facts, std::span<const Vec4> tangents) {
    double leaning = 0;
    for (std::uint32_t v = 0; v < tangents.size(); ++v) {
        DVec3 n = toDouble(facts.mesh.normals[v]), t = toDouble(xyz(tangents[v]));
        if (!normalize(n) || !normalize(t)) continue;
        const double lean = std::fabs(90 - angleBetween(n, t) * 180 / kPi);
        if (lean > facts.options.orthogonal_deg) leaning += facts.surface.vertex_areas[v];
    }
    return leaning / facts.surface.area;
}

double wrongShare(const PrimitiveFacts& facts, std::span<const Vec4> tangents) {
    TangentView mesh = facts.mesh;
    mesh.tangents = tangents;
    const double limit = facts.options.direction_deg;
    const std::vector<float> directions = directionDistances(mesh, facts.surface, limit);
    double wrong = 0;
    for (std::uint32_t v = 0; v < directions.size(); ++v)
        wrong += directions[v] > limit ? facts.surface.known_areas[v] : 0;
    return wrong / facts.surface.known_area;
}

}  // namespace

std::string findOtherAxes(const PrimitiveFacts& facts, const FrameHealth& health) {
    if (facts.mesh.uvs.empty() || !(facts.surface.known_area > 0)) return {};
    if (health.not_orthogonal.surface_share + health.parallel.surface_share < kClearlyLeaning ||
        health.directions_wrong.count == 0)
        return {};
    std::vector<Vec4> turned(facts.mesh.tangents.size());
    AxisExchange axes;
    do {
        for (unsigned signs = 0; signs < 8; ++signs) {
            for (std::size_t i = 0; i < 3; ++i) axes.sign[i] = (signs >> i & 1) != 0 ? -1.0f : 1.0f;
            std::transform(facts.mesh.tangents.begin(), facts.mesh.tangents.end(), turned.begin(), axes);
            if (leaningShare(facts, turned) <= kMostWrong && wrongShare(facts, turned) <= kMostWrong)
                return axes.text();
        }
    } while (std::next_permutation(axes.from.begin(), axes.from.end()));
    return {};
}

}  // namespace tspace
