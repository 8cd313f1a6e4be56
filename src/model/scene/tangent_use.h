// SPDX-License-Identifier: MIT
// Why a primitive needs tangents: one texture or parameter of a material that is shaded in tangent space.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "model/scene/texture_reading.h"

namespace tspace {

struct TangentUse {
    std::string needed_by = {};  ///< "normalTexture", "clearcoatNormalTexture" or "anisotropy"
    std::string place = {};      ///< JSON pointer of the texture reference, or of the extension
    /// False: a factor alone (KHR_materials_anisotropy), which tangents along any direction serve.
    bool has_texture = true;
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; KHR_texture_transform's own texCoord goes first
    UvTransform transform = {};
    std::optional<std::size_t> image = {};  ///< index into the file's images
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    double scale = 1;               ///< of a normal map: what x and y are multiplied by
    bool is_declared_down = false;  ///< the file says that green of its normal maps points down, as its readers know
    bool may_be_heights = false;    ///< the format takes a grey image for a height map there (map_bump of OBJ)
    std::size_t material = 0;
    bool only_in_variant = false;  ///< the material is one of KHR_materials_variants, not the primitive's own
};

}  // namespace tspace
