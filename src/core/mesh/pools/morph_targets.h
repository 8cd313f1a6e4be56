// SPDX-License-Identifier: MIT
// Morph targets on the way into and out of computeFrames.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tspace/result.h"
#include "tspace/vec.h"

namespace tspace {

/// Offsets that one target adds to the vertices of a pool, one entry per vertex. Empty: it does not move this
/// attribute.
struct MorphOffsets {
    std::vector<Vec3> positions = {};
    std::vector<Vec3> tangents = {};  ///< what the file has; looked at only where tangents are mended
    std::vector<Vec3> normals = {};   ///< added, then the sum is made unit; not looked at where normals are generated
};

/// The targets of a pool. They are read one by one, because a face has hundreds.
struct MorphTargets {
    std::size_t count = 0;
    /// Returns target `i`. Called by the thread that computes the pool, up to twice for each target.
    std::function<Result<MorphOffsets>(std::size_t)> read = {};
};

/// Offsets of some vertices, ascending by vertex; all others are zero.
struct VertexOffsets {
    std::vector<std::uint32_t> vertices = {};
    std::vector<Vec3> offsets = {};  ///< finite
};

/// Offsets that one target adds to the frames of the new vertices.
struct MorphFrames {
    VertexOffsets normals = {};   ///< only where normals were generated
    VertexOffsets tangents = {};  ///< to xyz; the sign cannot be morphed
};

}  // namespace tspace
