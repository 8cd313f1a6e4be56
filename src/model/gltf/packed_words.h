// SPDX-License-Identifier: MIT
// Words of packed frames, made by all threads.
#pragma once

#include <span>

#include "model/io/file_io.h"
#include "tspace/execution.h"
#include "tspace/pack.h"

namespace tspace::gltf {

/// One word of `format` for each frame, without padding. Adds to `report` what was mended.
Bytes packWords(FrameFormat format, std::span<const Vec3> normals, std::span<const Vec4> tangents,
                const Execution& execution, PackReport& report);

}  // namespace tspace::gltf
