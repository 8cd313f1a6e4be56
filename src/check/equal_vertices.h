// SPDX-License-Identifier: MIT
// Vertices with equal position and normal, or position, normal and UV.
#pragma once

#include <cstdint>
#include <vector>

#include "check/tangent_view.h"

namespace tspace {

struct EqualVertices {
    std::vector<std::uint32_t> class_of = {};  ///< one per vertex
    std::size_t class_count = 0;               ///< numbered in order of their first vertices
};

/// Bits decide, but both zeros are one value. Expected linear time.
EqualVertices findEqualVertices(const TangentView& mesh, bool with_uvs);

}  // namespace tspace
