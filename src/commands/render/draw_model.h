// SPDX-License-Identifier: MIT
// A whole model in a picture.
#pragma once

#include "commands/render/model_picture.h"
#include "commands/shared/picture/draw_surfaces.h"
#include "tspace/render.h"

namespace tspace {

/// Size, camera, light and execution are those of `options`; options.show is what `model` was made for. Under a heat map
/// stands its scale. Throws FileError (tooLarge).
SurfacePicture drawModel(const ModelPicture& model, const RenderOptions& options);

}  // namespace tspace
