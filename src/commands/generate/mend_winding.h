// SPDX-License-Identifier: MIT
// GenerateOptions::mend_winding: the surfaces of a model, and which of their faces are turned.
#pragma once

#include <cstdint>
#include <vector>

#include "model/gltf/model.h"
#include "model/obj/obj_reader.h"
#include "tspace/asset.h"

namespace tspace {

struct WindingPlan {
    std::vector<MendedWindingReport> reports = {};
    /// Of each primitive: one per triangle, 1 to turn it; or empty: none.
    std::vector<std::vector<std::uint8_t>> turned = {};

    [[nodiscard]] bool turnsAny() const;
};

/// Of a glTF model, mesh by mesh: where nodes put a mesh, and whether they mirror it, does not matter, since viewers look
/// at the winding in the mesh's own coordinates. Changes nothing.
WindingPlan planWinding(gltf::Model& model, const GenerateOptions& options);

/// Fills winding_mended_count.
void countTurned(const WindingPlan& plan, std::vector<PrimitiveReport>& primitives);

/// Turns the faces of an OBJ file. Returns one per face: 1 if it was turned.
std::vector<std::uint8_t> mendObjWinding(obj::Model& model, const GenerateOptions& options, GenerateReport& report);

}  // namespace tspace
