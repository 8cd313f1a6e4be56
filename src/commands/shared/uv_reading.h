// SPDX-License-Identifier: MIT
// The UVs that tangents may follow.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/span.h"

namespace tspace {

struct UvReading {
    std::size_t uv_set = 0;
    bool transformed = false;        ///< changed by the use's texture transform, which changes frames
    std::vector<Vec2> own = {};      ///< storage of the transformed UVs
    std::span<const Vec2> uvs = {};  ///< empty: the primitive has no such set
};

/// The UVs that a texture of this use is read with.
UvReading readingOf(const ScenePrimitive& primitive, const TangentUse& use);
/// A set as it is in the file.
UvReading plainReading(const ScenePrimitive& primitive, std::size_t uv_set);

/// UVs that a texture is sampled with, including scales and offsets, which directions do not depend on.
std::vector<Vec2> textureUvs(std::span<const Vec2> uvs, const UvTransform& transform);

}  // namespace tspace
