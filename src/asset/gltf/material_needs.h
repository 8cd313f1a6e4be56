// SPDX-License-Identifier: MIT
// Which materials need tangents, because of which texture, and along which UV set.
#pragma once

#include <string>

#include "asset/gltf/document.h"
#include "asset/gltf/primitive_reader.h"

namespace tspace::gltf {

struct TangentNeed {
    std::string needed_by =
        {};                  ///< "normalTexture", "clearcoatNormalTexture" or "anisotropy"; empty: not needed
    std::size_t uv_set = 0;  ///< n of TEXCOORD_n; 0 where no texture asks

    [[nodiscard]] bool needed() const { return !needed_by.empty(); }
};

/// What the primitive's material asks for. Where it asks for nothing, the materials of its
/// KHR_materials_variants are looked at in file order.
TangentNeed tangentNeed(const Document& document, const Primitive& primitive);

/// The name of the primitive's material, may be empty.
std::string materialName(const Document& document, const Primitive& primitive);

}  // namespace tspace::gltf
