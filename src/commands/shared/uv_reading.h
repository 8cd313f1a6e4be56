// SPDX-License-Identifier: MIT
// UVs by which the textures of a primitive are sampled (a UV set, with or without its texture transform), for
// comparison with tangents.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/scene/scene.h"
#include "tspace/span.h"

namespace tspace {

struct UvReading {
    std::size_t uv_set = 0;
    bool transformed = false;        ///< the texture transform of the use changed the UVs, in a way that changes frames
    std::vector<Vec2> own = {};      ///< storage of the transformed UVs
    std::span<const Vec2> uvs = {};  ///< the UVs; empty if the primitive does not have this set
};

/// Returns the UVs by which the texture of this use is sampled, without scale and offset that do not affect frames.
UvReading readingOf(const ScenePrimitive& primitive, const TangentUse& use);
/// Returns a UV set as stored in the file.
UvReading plainReading(const ScenePrimitive& primitive, std::size_t uv_set);

/// Returns the UVs by which a texture is sampled, including scale and offset, which do not affect directions.
std::vector<Vec2> textureUvs(std::span<const Vec2> uvs, const UvTransform& transform);

}  // namespace tspace
