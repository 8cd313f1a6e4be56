// SPDX-License-Identifier: MIT
// Low polys and the high polys that they stand for, of surfaces with a formula.
#pragma once

#include <string>
#include <vector>

#include "surfaces.h"
#include "tspace/maps.h"
#include "tspace/tangents.h"

namespace tspace::bench {

enum class Charts {
    one,
    four,     ///< quarters, turned by 0, 37 and 90 degrees, and one mirrored
    mirrored  ///< both halves on the same texels, one of them mirrored
};

/// Three entries per triangle, as LowPoly.
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

/// 16 x 16 irregular cells in frames of the method, glTF's convention.
LowMesh makeLow(const accuracy::Surface& surface, Charts charts, Method method = Method::mikktspace);

/// `cells` x `cells` x 2 triangles. `relief`: waves and rings that lean by about 10 degrees in the mean.
/// `beyond`: cells that it goes on by on each side. Chords of a curved border lie outside of it, and rays from there would meet
/// nothing.
HighMesh makeHigh(const accuracy::Surface& surface, int cells, bool relief, int beyond = 0);

}  // namespace tspace::bench
