// SPDX-License-Identifier: MIT
// A scene with what a picture of it needs beside frames: where its primitives stand, and how they look.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/mesh/surface/affine.h"
#include "model/scene/scene.h"
#include "model/scene/texture_reading.h"

namespace tspace {

/// What a primitive's own material says.
struct SurfaceLook {
    std::array<float, 4> base_color = {1, 1, 1, 1};  ///< linear
    std::optional<TextureReading> base_texture = {};
    std::optional<TextureReading> normal_texture = {};
    double normal_scale = 1;
    /// Where alpha is smaller the surface is not there; 0: it is there everywhere.
    double alpha_cutoff = 0;
    bool is_double_sided = false;
    bool is_unlit = false;
};

/// A primitive at one of its places.
struct ScenePlacement {
    std::size_t primitive = 0;  ///< of the scene
    Affine to_world = {};
    std::string node_name = {};  ///< of the node that puts it there; may be empty
};

struct DrawnScene {
    Scene scene = {};
    std::vector<SurfaceLook> looks = {};          ///< one per primitive
    std::vector<ScenePlacement> placements = {};  ///< in the order of nodes; never empty where there are primitives
};

}  // namespace tspace
