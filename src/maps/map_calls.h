// SPDX-License-Identifier: MIT
// What the calls on maps have in common.
#pragma once

#include "tspace/map_bake.h"
#include "tspace/result.h"

namespace tspace {

/// What bakeMap asks of its options, for meshes of so many triangles. An Error with code ok when all is well.
Error checkBakeOptions(const BakeOptions& options, std::size_t low_triangles, std::size_t high_triangles);

}  // namespace tspace
