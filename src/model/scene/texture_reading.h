// SPDX-License-Identifier: MIT
// How a material reads a texture.
#pragma once

#include <cstddef>
#include <optional>

#include "tspace/texture_wrap.h"

namespace tspace {

/// KHR_texture_transform: uv' = translation * rotation * scale * uv. `rotation` in radians, counter-clockwise as the
/// extension defines it.
struct UvTransform {
    double offset[2] = {0, 0};
    double rotation = 0;
    double scale[2] = {1, 1};

    /// true when it turns, mirrors or squeezes directions: an offset alone does not touch frames.
    [[nodiscard]] bool changesFrames() const { return rotation != 0 || scale[0] != 1 || scale[1] != 1; }
    [[nodiscard]] bool mirrors() const { return scale[0] * scale[1] < 0; }
};

struct TextureReading {
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; KHR_texture_transform's own texCoord goes first
    UvTransform transform = {};
    std::optional<std::size_t> image = {};  ///< index into the file's images
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
};

}  // namespace tspace
