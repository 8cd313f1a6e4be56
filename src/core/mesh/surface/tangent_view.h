// SPDX-License-Identifier: MIT
// The arrays of one triangle mesh that checks read, from a file of any format.
#pragma once

#include <cstdint>
#include <span>

#include "tspace/mesh.h"
#include "tspace/vec.h"

namespace tspace {

/// All arrays but `corners` have one entry per vertex.
struct TangentView {
    std::span<const Vec3> positions = {};
    std::span<const Vec3> normals = {};           ///< may be empty only where a function says so
    std::span<const Vec4> tangents = {};          ///< w: the sign
    std::span<const Vec2> uvs = {};               ///< those that the texture is read with (after its transform)
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, all smaller than positions.size()
    double position_step = 0;  ///< of positions stored as whole numbers, in their units; 0: they are floats

    /// Its triangles, as the core takes them.
    [[nodiscard]] MeshView triangles() const {
        MeshView view;
        view.positions = positions;
        view.normals = normals;
        view.uvs = uvs;
        view.indices = corners;
        return view;
    }
};

}  // namespace tspace
