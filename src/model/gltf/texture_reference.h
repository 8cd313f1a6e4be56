// SPDX-License-Identifier: MIT
// A material's reference to a texture, such as normalTexture.
#pragma once

#include <string>

#include "model/gltf/document.h"
#include "model/scene/texture_reading.h"

namespace tspace::gltf {

/// `texture`: the reference, at `place`. An image is named where the texture leads to one. Fails with invalidFile.
TextureReading readTexture(const Document& document, const Json& texture, const std::string& place);

}  // namespace tspace::gltf
