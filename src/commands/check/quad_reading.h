// SPDX-License-Identifier: MIT
// Tangents that were made on quads, compared with the triangles that MikkTSpace cuts these into.
#pragma once

#include <optional>
#include <vector>

#include "commands/check/frame_health.h"

namespace tspace {

struct QuadReading {
    std::vector<std::uint32_t> corners = {};  ///< three per triangle, as TangentView::corners
    Surface surface = {};                     ///< of these; the two halves of a quad have one orientation
};

/// The quads that CheckOptions::faces means, cut as MikkTSpace cuts them. Nothing: the mesh's own triangles are meant,
/// or, with Faces::automatic, nothing in `health` asks for another reading. `health`: of the mesh. Near-linear;
/// fails where generateTangents does.
Result<std::optional<QuadReading>> findQuads(const TangentView& mesh, const FrameHealth& health,
                                             const CheckOptions& options);

}  // namespace tspace
