// SPDX-License-Identifier: MIT
// Low polys with matching high polys, of surfaces given by formulas.
#pragma once

#include <string>
#include <vector>

#include "surfaces.h"
#include "tspace/maps.h"
#include "tspace/tangents.h"

namespace tspace::bench {

enum class Charts {
    one,
    four,     ///< quarters, rotated by 0, 37 and 90 degrees, and one mirrored
    mirrored  ///< both halves use the same texels, one of them mirrored
};

/// Three entries per triangle, like LowPoly.
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

/// Returns 16 x 16 irregular cells with frames of the method, in glTF's convention.
LowMesh makeLow(const accuracy::Surface& surface, Charts charts, Method method = Method::mikktspace);

/// Returns `cells` x `cells` x 2 triangles. `relief`: waves and rings with a mean slope of about 10 degrees. `beyond`:
/// cells added on each side, because chords of a curved border are outside of it, and rays from there would hit
/// nothing.
HighMesh makeHigh(const accuracy::Surface& surface, int cells, bool relief, int beyond = 0);

}  // namespace tspace::bench
