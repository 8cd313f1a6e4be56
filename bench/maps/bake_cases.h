// SPDX-License-Identifier: MIT
// Low polys with matching high polys, of surfaces that are given by formulas.
#pragma once

#include <string>
#include <vector>

#include "surfaces.h"
#include "tspace/maps.h"
#include "tspace/tangents.h"

namespace tspace::bench {

enum class Charts {
    one,
    four,     ///< one chart per quarter, rotated by 0, 37 and 90 degrees; one of them mirrored
    mirrored  ///< both halves use the same texels, one of them mirrored
};

/// Low poly with three entries per triangle, as in LowPoly.
struct LowMesh {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec4> tangents = {};
    std::vector<Vec2> uvs = {};

    [[nodiscard]] LowPoly view() const {
        return {.positions = positions, .normals = normals, .tangents = tangents, .uvs = uvs};
    }
};

struct HighMesh {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<std::uint32_t> corners = {};

    [[nodiscard]] HighPoly view() const { return {.positions = positions, .normals = normals, .corners = corners}; }
};

/// Returns a mesh of 16 x 16 irregular cells with frames of the method, in glTF's convention.
LowMesh makeLow(const accuracy::Surface& surface, Charts charts, Method method = Method::mikktspace);

/// Returns a mesh of `cells` x `cells` x 2 triangles. `relief`: adds waves and rings with a mean slope of about 10
/// degrees. `beyond`: number of cells added on each side, because the low poly's chords of a curved border may lie
/// outside of the surface, and rays from them would hit nothing.
HighMesh makeHigh(const accuracy::Surface& surface, int cells, bool relief, int beyond = 0);

}  // namespace tspace::bench
