// SPDX-License-Identifier: MIT
// Builds a GLB accessor by accessor, and counts repaired values.
#pragma once

#include <cstdint>
#include <vector>

#include "model/gltf/document_builder.h"
#include "repair.h"

namespace tspace::import {

class GlbBuilder : public gltf::DocumentBuilder {
  public:
    GlbBuilder() : DocumentBuilder(Json::object({{"version", "2.0"}})) {}

    RepairCounts& repairs() { return repairs_; }
    std::vector<std::uint8_t> finish();

  private:
    RepairCounts repairs_ = {};
};

}  // namespace tspace::import
